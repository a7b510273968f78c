// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/piper_patches.h"

#include "sublimit/base/detail/format_number.h"
#include "sublimit/geometric/piper.h"
#include "sublimit/patches/constructions/triangle_patch.h"

namespace sublimit {

std::vector<NamedPatch> piper_patches(const NormalMesh& mesh, const std::string& name, const std::string& place) {
  const auto quartic = std::make_shared<const TrianglePatch>(4);
  std::vector<NamedPatch> patches;
  for (Index face = 0; face < mesh.num_faces(); ++face) {
    const PiperPatch<double> patch(mesh.corners(mesh.positions, face), mesh.corners(mesh.normals, face));
    for (const PiperPatch<double>::Net& net : patch.control_points()) {
      Points columns(std::ssize(net), 3);
      for (size_t i = 0; i < net.size(); ++i) columns.row(Eigen::Index(i)) = net[i];
      patches.push_back(
          {quartic, std::move(columns), Coordinates::plain, name, place + ": triangle " + format_number(face)});
    }
  }
  return patches;
}

}  // namespace sublimit
