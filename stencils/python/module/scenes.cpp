// SPDX-License-Identifier: Apache-2.0
// Scenes of USD.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

#include "calls.h"
#include "module.h"
#include "sublimit/sublimit.h"

namespace sublimit::python {
namespace {

namespace py = pybind11;

py::dict flatten_scene(const std::filesystem::path& scene, const std::filesystem::path& path, double chord,
                       double relative_chord, double angle, std::int64_t max_triangles, int threads) {
  const FlattenedScene made = without_gil([&] {
    const Threads held(threads);
    return flatten(scene, path,
                   {.chord = chord, .relative_chord = relative_chord, .angle = angle, .max_triangles = max_triangles});
  });
  py::list meshes;
  for (const FlattenedScene::FlatMesh& mesh : made.meshes)
    meshes.append(py::make_tuple(mesh.path, mesh.triangles, mesh.bound, mesh.why_not));
  py::dict all;
  all["meshes"] = meshes;
  all["warnings"] = made.warnings;
  return all;
}

}  // namespace

void add_scenes(py::module_& m) {
  m.def("flatten", &flatten_scene, py::arg("scene"), py::arg("path"), py::arg("chord"), py::arg("relative_chord"),
        py::arg("angle"), py::arg("max_triangles"), py::arg("threads"));
}

}  // namespace sublimit::python
