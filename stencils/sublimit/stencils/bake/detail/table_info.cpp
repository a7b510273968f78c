// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/bake/detail/table_info.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <numeric>

#include "sublimit/base/version.h"
#include "sublimit/stencils/bake/detail/bake_channels.h"
#include "sublimit/stencils/formats/rule_of_word.h"
#include "sublimit/stencils/patterns/point_status.h"

namespace sublimit {
namespace {

template <class T>
std::uint64_t hash_of(const std::vector<T>& items, std::uint64_t seed) {
  return XXH3_64bits_withSeed(items.data(), items.size() * sizeof(T), seed);
}

std::string digits_of(std::uint64_t hash) {
  std::string digits(16, '0');
  for (size_t i = digits.size(); i-- > 0; hash >>= 4) digits[i] = "0123456789abcdef"[hash & 15];
  return digits;
}

std::string tags_of(const Mesh& mesh) {
  static_assert(sizeof(Mesh::Crease) == 12 && sizeof(Mesh::Corner) == 8, "no bytes between members");
  static_assert(sizeof(Mesh::KnotInterval) == 16, "no bytes between members");
  if (mesh.creases.empty() && mesh.corners.empty() && mesh.holes.empty() && mesh.knot_intervals.empty()) return "none";
  std::uint64_t hash = hash_of(mesh.holes, hash_of(mesh.corners, hash_of(mesh.creases, mesh.creases.size())));
  if (!mesh.knot_intervals.empty()) hash = hash_of(mesh.knot_intervals, hash);
  return digits_of(hash);
}

/// Of all channels: names, values, indices.
std::string channels_of(const Mesh& mesh) {
  std::uint64_t hash = mesh.face_varying.size();
  for (const Mesh::FaceVarying& channel : mesh.face_varying) {
    hash = XXH3_64bits_withSeed(channel.name.data(), channel.name.size(), hash);
    hash = XXH3_64bits_withSeed(channel.values.data(), size_t(channel.values.size()) * sizeof(double), hash);
    hash = hash_of(channel.indices, hash + std::uint64_t(channel.values.cols()));
  }
  return digits_of(hash);
}

/// Numbers in lowest terms, so that 0.75 and 6/8 are the same.
std::string value_of(const OptionInfo& known, const SchemeOptions& given) {
  if (!known.range) return option(given, known);
  const Ratio ratio = ratio_option(given, known);
  const int divisor = std::gcd(ratio.p, ratio.q);
  return to_string({ratio.p / divisor, ratio.q / divisor});
}

/// What tables of any source say.
void add_request(const BakeRequest& request, TableInfo& info) {
  info.rows = request.rows;
  if (request.rows == TableRows::level || request.rows == TableRows::limit) info.level = request.level;
  if (request.rows == TableRows::grid) info.grid = request.grid;
  info.tool = "sublimit " SUBLIMIT_VERSION;
  if (request.rows == TableRows::level) return;
  PointStatuses statuses(request.derivatives);
  info.statuses = std::move(statuses.words);
  if (request.derivatives > 0) info.orders = std::move(statuses.orders);
}

}  // namespace

std::uint64_t topology_hash(const Mesh& mesh) {
  return topology_hash(mesh.num_vertices(), mesh.face_sizes, mesh.face_vertices);
}

TableInfo table_info(const Scheme<double>& scheme, const Mesh& mesh, const BakeRequest& request,
                     const SubdivisionOptions& rules) {
  TableInfo info;
  info.scheme = scheme.name;
  for (const OptionInfo& known : scheme.options) info.options[known.name] = value_of(known, scheme.chosen);
  info.options["boundary"] = word(rules.boundary.value_or(mesh.boundary.value_or(Boundary::edge_and_corner)));
  const Creasing creasing = rules.creasing.value_or(mesh.creasing.value_or(Creasing::uniform));
  info.options["creasing"] = word(creasing);
  info.options["tags"] = tags_of(mesh);
  if (request.face_varying) {
    info.options["face-varying"] = word(interpolation_of(request, mesh));
    info.options["face-varying-values"] = channels_of(mesh);
  }
  if (request.tags) info.options["tags-left"] = "written";
  info.triangles = scheme.face_size() == 3;
  info.topology_hash = topology_hash(mesh);
  add_request(request, info);
  return info;
}

TableInfo table_info(const PatchSet& patches, const BakeRequest& request) {
  TableInfo info;
  info.scheme = free_form_scheme;
  info.triangles = patches.faces().triangles;
  info.topology_hash = patches.hash();
  info.rational = patches.coordinates() == Coordinates::homogeneous;
  add_request(request, info);
  return info;
}

template <class Real>
bool is_table_of(const BakedTable<Real>& table, const TableInfo& info, const BakeRequest& request) {
  const TableInfo& own = table.info;
  if (own.scheme != info.scheme || own.options != info.options || own.rows != info.rows || own.level != info.level ||
      own.grid != info.grid || own.triangles != info.triangles || own.topology_hash != info.topology_hash ||
      own.tool != info.tool || own.rational != info.rational)
    return false;
  constexpr int quantities[] = {1, 3, 6};
  if (table.table.quantities() != quantities[request.derivatives]) return false;
  if (request.rows != TableRows::samples) return true;
  const SampleAddresses& at = table.addresses;
  if (at.faces.size() != request.samples.size()) return false;
  for (size_t i = 0; i < request.samples.size(); ++i) {
    const Place& s = request.samples[i];
    if (at.faces[i] != s.face || at.parameters[2 * i] != s.u || at.parameters[2 * i + 1] != s.v) return false;
  }
  return std::ranges::equal(table.faces.sizes, request.face_sizes) &&
         std::ranges::equal(table.faces.corners, request.face_vertices);
}

template bool is_table_of(const BakedTable<float>&, const TableInfo&, const BakeRequest&);
template bool is_table_of(const BakedTable<double>&, const TableInfo&, const BakeRequest&);

}  // namespace sublimit
