// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/table/baked_table.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

constexpr std::array names{"level", "limit", "grid", "samples"};

static_assert(std::endian::native == std::endian::little, "hashes and files are little-endian");

}  // namespace

const char* name(TableRows rows) { return names[size_t(rows)]; }

std::optional<TableRows> table_rows(const std::string& name) {
  for (size_t i = 0; i < names.size(); ++i)
    if (name == names[i]) return TableRows(i);
  return std::nullopt;
}

std::uint64_t topology_hash(std::int32_t num_vertices, std::span<const std::int32_t> sizes,
                            std::span<const std::int32_t> corners) {
  const std::uint64_t of_sizes = XXH3_64bits_withSeed(sizes.data(), sizes.size_bytes(), std::uint64_t(num_vertices));
  const std::uint64_t hash = XXH3_64bits_withSeed(corners.data(), corners.size_bytes(), of_sizes);
  return hash == 0 ? 1 : hash;  // 0 stands for none
}

BakedTable<float> in_float(const BakedTable<double>& table) {
  return {in_float(table.table), table.info,        table.lattices, table.faces, table.addresses,
          table.row_status,      table.rest_status, table.channels, table.tags,  table.refined_points};
}

template <class Real>
std::vector<std::uint8_t> statuses_of(const BakedTable<Real>& table) {
  const PatternTable<Real>& t = table.table;
  if (table.row_status.empty() && table.rest_status.empty()) return {};
  std::vector<std::uint8_t> statuses(size_t(t.num_points()), 0);
  t.for_each_run(0, t.num_patches(), [&](size_t g, std::int64_t first, std::int64_t count) {
    const auto& group = t.arrays().groups[g];
    for (std::int64_t patch = first; patch < first + count && !table.row_status.empty(); ++patch)
      std::copy_n(table.row_status.data() + group.rows, group.num_rows, statuses.data() + t.first_point(g, patch));
  });
  std::copy(table.rest_status.begin(), table.rest_status.end(),
            statuses.end() - std::ptrdiff_t(table.rest_status.size()));
  return statuses;
}

namespace {

/// Puts down the corners of the faces of one lattice.
/// @param points  by row
void put_faces(const Lattice& lattice, std::span<const std::int32_t> points, std::int32_t* out) {
  const auto add = [&](std::int32_t i, std::int32_t j) { *out++ = points[size_t(lattice.row(i, j))]; };
  for (std::int32_t j = 0; j < lattice.n; ++j)
    for (std::int32_t i = 0; i < (lattice.triangle ? lattice.n - j : lattice.n); ++i) {
      add(i, j), add(i + 1, j);
      if (!lattice.triangle) add(i + 1, j + 1);
      add(i, j + 1);
      if (lattice.triangle && i + j + 1 < lattice.n) add(i + 1, j), add(i + 1, j + 1), add(i, j + 1);
    }
}

/// Faces of lattices, each of which has a `point(lattice, row)`.
template <class Point>
FaceList faces_of(const Lattice& lattice, std::int64_t count, const Point& point) {
  const int sides = lattice.num_sides();
  const std::int64_t per_lattice = std::int64_t{lattice.num_cells()} * sides;
  std::vector<std::int32_t> corners(size_t(count * per_lattice));
  const auto make = [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    std::vector<std::int32_t> points(size_t(lattice.size()));  // a point is a corner of up to six faces: found once
    for (std::int64_t at = begin; at < end; ++at) {
      for (std::int32_t row = 0; row < lattice.size(); ++row)
        points[size_t(row)] = static_cast<std::int32_t>(point(at, row));
      put_faces(lattice, points, corners.data() + at * per_lattice);
    }
  };
  parallel_for_blocks(count, make, 256);
  return {std::vector<std::int32_t>(size_t(count) * size_t(lattice.num_cells()), sides), std::move(corners)};
}

}  // namespace

template <class Real>
FaceList faces_of(const BakedTable<Real>& table) {
  if (table.table.num_points() > std::numeric_limits<std::int32_t>::max())
    throw ResourceError("faces of " + std::to_string(table.table.num_points()) +
                        " points: numbers of 32 bits do not count so many");
  if (table.info.rows == TableRows::grid) {
    const Lattice lattice{table.info.grid - 1, table.info.triangles};
    const std::vector<std::uint8_t> statuses = statuses_of(table);
    std::vector<std::int64_t> kept;
    for (std::int64_t first = 0; first < table.table.num_points(); first += lattice.size())
      if (statuses.empty() || table.info.statuses[statuses[first]] != "hole") kept.push_back(first);
    return faces_of(lattice, std::int64_t(kept.size()),
                    [&](std::int64_t at, std::int32_t row) { return kept[at] + row; });
  }
  if (!table.lattices) return table.faces;
  const FaceLattices& lattices = *table.lattices;
  std::vector<std::int32_t> kept;
  for (std::int32_t f = 0; f < lattices.num_faces(); ++f)
    if (!lattices.is_hole(f)) kept.push_back(f);
  return faces_of(lattices.lattice(), std::int64_t(kept.size()),
                  [&](std::int64_t at, std::int32_t row) { return lattices.point(kept[at], row); });
}

template <class Real>
std::int64_t num_corners(const BakedTable<Real>& table) {
  if (!table.lattices) return std::int64_t(table.faces.corners.size());
  const FaceLattices& lattices = *table.lattices;
  std::int64_t kept = 0;
  for (std::int32_t f = 0; f < lattices.num_faces(); ++f) kept += !lattices.is_hole(f);
  return kept * lattices.lattice().num_cells() * lattices.lattice().num_sides();
}

template std::vector<std::uint8_t> statuses_of(const BakedTable<float>&);
template std::vector<std::uint8_t> statuses_of(const BakedTable<double>&);
template FaceList faces_of(const BakedTable<float>&);
template FaceList faces_of(const BakedTable<double>&);
template std::int64_t num_corners(const BakedTable<float>&);
template std::int64_t num_corners(const BakedTable<double>&);

}  // namespace sublimit
