// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/shards/shard_faces.h"

#include <limits>

#include "sublimit/base/error.h"

namespace sublimit {

FaceList faces_between(PartLattices lattices, const MeshPart& part,
                       std::span<const std::array<std::int64_t, 2>> points) {
  FaceLattices::Arrays& arrays = lattices.arrays;
  const std::vector<Index>& control_faces = lattices.control_faces;
  const auto count = static_cast<Index>(control_faces.size());
  // Faces of the level that has the patterns follow each other in their control face.
  LatticeRanks ranks(arrays.lattice);
  std::vector<std::int64_t> first_points(control_faces.size()), found(part.faces.size(), 0);
  std::vector<std::uint8_t> left_out(control_faces.size());
  for (Index f = 0; f < count; ++f) {
    const auto control = size_t(control_faces[size_t(f)]);
    first_points[size_t(f)] = points[control][0] + found[control];
    const LatticeRanks::Share share = FaceLattices::share(arrays, f);
    ranks.add(share);
    found[control] += ranks.num_rows(share);
    left_out[size_t(f)] = !part.is_owned[control] || (!arrays.holes.empty() && arrays.holes[f] != 0);
  }
  const size_t sides = size_t(arrays.lattice.num_sides());
  for (size_t i = 0; i < sides * control_faces.size(); ++i) {
    if (!part.is_owned[size_t(control_faces[i / sides])]) continue;
    for (const std::int32_t owner : {arrays.side_faces[i], arrays.corner_faces[i]}) {
      const auto control = size_t(control_faces[size_t(owner)]);
      if (found[control] != points[control][1])
        throw AnalysisError("face " + std::to_string(part.faces[control]) + " has " + std::to_string(found[control]) +
                            " points as seen from a part beside it and " + std::to_string(points[control][1]) +
                            " in the whole");
    }
  }
  arrays.first_points = std::move(first_points);
  arrays.holes = std::move(left_out);
  BakedTable<double> faces;
  faces.lattices.emplace(std::numeric_limits<std::int64_t>::max(), std::move(arrays));
  return faces_of(faces);
}

}  // namespace sublimit
