// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fixture: a mesh in a directory, and the program that makes tables of it.
#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/read_mesh.h"

namespace sublimit::testing {

class Tables {
 public:
  explicit Tables(const Mesh& control) { write_obj(mesh, control); }
  std::string path(std::string_view name) const { return (directory / name).string(); }

  Outcome bake(const std::vector<std::string>& arguments, const std::string& scheme = "catmull-clark",
               const std::function<void()>& prepare = {}) const {
    std::vector<std::string> all{"bake", mesh, "-s", scheme, "-o", table};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return sublimit(all, prepare);
  }
  Outcome apply(const std::string& points, const std::string& out,
                const std::vector<std::string>& arguments = {}) const {
    std::vector<std::string> all{"apply", table, points, "-o", out};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return sublimit(all);
  }

  TemporaryDirectory directory;
  const std::string mesh = (directory / "mesh.obj").string(), table = (directory / "table.safetensors").string();
};

/// Returns a jittered cube with an infinite and a semi-sharp crease.
inline Mesh creased_cube() {
  Mesh mesh = jittered(cube());
  mesh.creases = {{0, 1, 10}, {1, 3, 10}, {4, 5, 1.5f}};
  return mesh;
}

}  // namespace sublimit::testing
