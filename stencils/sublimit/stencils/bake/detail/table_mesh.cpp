// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/bake/detail/table_mesh.h"

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

template void add_channels(Mesh&, const BakedTable<float>&);
template void add_channels(Mesh&, const BakedTable<double>&);

}  // namespace sublimit
