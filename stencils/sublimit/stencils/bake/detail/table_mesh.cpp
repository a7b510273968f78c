// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/bake/detail/table_mesh.h"

#include <algorithm>

#include "sublimit/primvar/vertex_values.h"
#include "sublimit/scheme/detail/prepare.h"
#include "sublimit/source/address.h"
#include "sublimit/stencils/bake/detail/table_info.h"
#include "sublimit/stencils/formats/rule_of_word.h"

namespace sublimit {

template <class Real>
void add_channels(Mesh& mesh, const BakedTable<Real>& table) {
  if (!table.channels.list.empty()) {
    const FaceVaryingValues& channel = table.channels.list.front();
    const auto rows = static_cast<Eigen::Index>(channel.values.size()) / channel.channels;
    mesh.face_varying.push_back({.name = channel.name,
                                 .values = Eigen::Map<const Points>(channel.values.data(), rows, channel.channels),
                                 .indices = {channel.indices.begin(), channel.indices.end()}});
  }
  if (!table.tags) return;
  const TableTags& tags = *table.tags;
  for (size_t i = 0; i < tags.crease_sharpness.size(); ++i)
    mesh.creases.push_back({tags.creases[2 * i], tags.creases[2 * i + 1], tags.crease_sharpness[i]});
  for (size_t i = 0; i < tags.corners.size(); ++i) mesh.corners.push_back({tags.corners[i], tags.corner_sharpness[i]});
  mesh.boundary = rule_of<Boundary>(tags.boundary);
  // As `refine` writes it: uniform is what files without a word mean.
  if (tags.creasing == word(Creasing::chaikin)) mesh.creasing = Creasing::chaikin;
  if (!mesh.face_varying.empty())
    mesh.face_varying_interpolation = rule_of<FaceVaryingInterpolation>(table.channels.interpolation);
}

template <class Real>
std::vector<Index> control_faces(const BakedTable<Real>& table, const Mesh& control) {
  const bool is_grid = table.info.rows == TableRows::grid;
  if (!is_grid && (!table.lattices || !table.lattices->has_addresses())) return {};
  const Addresses addresses(Topology(view(control)), table.info.triangles);
  const Lattice lattice = is_grid ? Lattice{table.info.grid - 1, table.info.triangles} : table.lattices->lattice();
  std::vector<Index> faces;
  const auto add = [&](Index address) {
    faces.insert(faces.end(), size_t(lattice.num_cells()), index(addresses.place(address).face));
  };
  if (!is_grid) {
    for (std::int32_t f = 0; f < table.lattices->num_faces(); ++f)
      if (!table.lattices->is_hole(f)) add(table.lattices->place(f).address);
    return faces;
  }
  const std::vector<std::uint8_t> statuses = statuses_of(table);
  for (std::int64_t first = 0; first < table.table.num_points(); first += lattice.size())
    if (statuses.empty() || table.info.statuses[statuses[size_t(first)]] != "hole")
      add(static_cast<Index>(first / lattice.size()));
  return faces;
}

std::optional<Mesh> baked_cage(const Mesh& cage, const TableInfo& info) {
  Mesh mesh = cage;
  for (const bool turned : {false, true}) {
    if (turned && orient_faces(mesh).empty()) break;
    if (topology_hash(mesh) == info.topology_hash) return mesh;
    Mesh cut = triangulated(mesh);
    if (topology_hash(cut) == info.topology_hash) return cut;
  }
  return std::nullopt;
}

template <class Real>
void carry_attributes(const BakedTable<Real>& table, const Mesh& cage, const ApplyTable<Real>& apply, Mesh& out) {
  if (has_face_attributes(cage)) {
    const std::optional<Mesh> baked = baked_cage(cage, table.info);
    const std::vector<Index> faces = baked ? control_faces(table, *baked) : std::vector<Index>();
    if (std::ssize(faces) == out.num_faces()) carry_faces(*baked, faces, out);
  }
  const Points columns = vertex_values(cage);
  if (columns.cols() == 0) return;
  const std::vector<Real> given(columns.data(), columns.data() + columns.size());
  const std::int64_t count = table.table.num_points();
  std::vector<Real> sums(size_t(count * columns.cols() * table.table.quantities()));
  apply(given, static_cast<int>(columns.cols()), sums);
  Points at_points(count, columns.cols());
  std::copy_n(sums.begin(), at_points.size(), at_points.data());
  set_vertex_values(out, cage, at_points);
}

template void carry_attributes(const BakedTable<float>&, const Mesh&, const ApplyTable<float>&, Mesh&);
template void carry_attributes(const BakedTable<double>&, const Mesh&, const ApplyTable<double>&, Mesh&);
template std::vector<Index> control_faces(const BakedTable<float>&, const Mesh&);
template std::vector<Index> control_faces(const BakedTable<double>&, const Mesh&);
template void add_channels(Mesh&, const BakedTable<float>&);
template void add_channels(Mesh&, const BakedTable<double>&);

}  // namespace sublimit
