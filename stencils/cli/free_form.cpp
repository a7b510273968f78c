// SPDX-License-Identifier: Apache-2.0
#include "free_form.h"

#include <fmt/core.h>

#include <array>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/io/file_extension.h"

namespace sublimit::cli {

bool is_free_form_job(const Common& common) {
  if (!common.scheme.empty()) return false;
  if (file_extension(common.mesh) == ".obj") return true;
  throw InvalidOption(
      "-s SCHEME is missing: meshes need one (see `sublimit schemes`); an .obj with free-form surfaces " +
      std::string("does not, and ") + common.mesh + " is none");
}

void refuse_mesh_options(const Common& common) {
  const std::array given{
      std::pair{"--boundary", !common.boundary.empty()},   std::pair{"--creasing", !common.creasing.empty()},
      std::pair{"--triangles", !common.triangles.empty()}, std::pair{"--face-varying", !common.face_varying.empty()},
      std::pair{"--option", !common.options.empty()},      std::pair{"--triangulate", common.triangulate},
      std::pair{"--no-creases", common.no_creases}};
  for (const auto& [name, is_given] : given)
    if (is_given)
      throw InvalidOption(std::string(name) +
                          " is for meshes, which need -s SCHEME; free-form surfaces have no such rule");
}

FreeForm load_free_form(const Common& common) {
  FreeForm shapes = read_free_form(common.mesh);
  if (!common.quiet)
    for (const std::string& warning : shapes.warnings) fmt::print(stderr, "sublimit: warning: {}\n", warning);
  if (shapes.num_faces > 0 && !common.quiet)
    fmt::print(stderr, "sublimit: warning: {}: {} faces of a mesh too, which need -s SCHEME\n", common.mesh,
               shapes.num_faces);
  return shapes;
}

}  // namespace sublimit::cli
