// SPDX-License-Identifier: Apache-2.0
#pragma once
// The meshes of the benchmarks, as control meshes and in the form that OpenSubdiv takes.
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "meshes/meshes.h"
#include "opensubdiv_peer.h"
#include "sublimit/io/read_mesh.h"

namespace sublimit::bench {

struct Case {
  std::string name, scheme;
  Mesh mesh;
};

/// Returns the car, if its file exists; regular tori of 100k quads and of 100k triangles; and 33k triangles
/// split into 100k quads, where half of the vertices are extraordinary.
/// @param quick  true: meshes of about 1000 faces instead (not the car)
inline std::vector<Case> cases(bool quick = false) {
  std::vector<Case> list;
  const std::filesystem::path car = std::filesystem::path(SUBLIMIT_SHARED_MESHES) / "catmark_car.obj";
  if (std::filesystem::exists(car)) {
    list.push_back({"car", "catmull-clark", read_mesh(car)});
  } else {
    std::fprintf(stderr, "NO %s: the car is not measured\n", car.c_str());
  }
  using namespace testing;
  list.push_back({"torus", "catmull-clark", quick ? torus(40, 25) : torus(400, 250)});
  list.push_back({"split_triangles", "catmull-clark",
                  quads_from_triangles(quick ? triangle_torus(18, 9) : triangle_torus(182, 92))});
  list.push_back({"loop_torus", "loop", quick ? triangle_torus(25, 20) : triangle_torus(250, 200)});
  return list;
}

/// A case in the form that OpenSubdiv takes, with the arrays that it refers to.
struct PeerCase {
  std::vector<int> crease_vertices, corner_vertices;
  std::vector<float> crease_sharpness, corner_sharpness;
  PeerMesh mesh;

  explicit PeerCase(const Case& c) {
    for (const auto& crease : c.mesh.creases) {
      crease_vertices.insert(crease_vertices.end(), {crease.tail, crease.head});
      crease_sharpness.push_back(crease.sharpness);
    }
    for (const auto& corner : c.mesh.corners) {
      corner_vertices.push_back(corner.vertex);
      corner_sharpness.push_back(corner.sharpness);
    }
    mesh = {.scheme = c.scheme == "loop" ? PeerScheme::loop : PeerScheme::catmull_clark,
            .num_vertices = c.mesh.num_vertices(),
            .face_sizes = c.mesh.face_sizes,
            .face_vertices = c.mesh.face_vertices,
            .crease_vertices = crease_vertices,
            .crease_sharpness = crease_sharpness,
            .corner_vertices = corner_vertices,
            .corner_sharpness = corner_sharpness};
  }
  PeerCase(const PeerCase&) = delete;
  PeerCase& operator=(const PeerCase&) = delete;
};

}  // namespace sublimit::bench
