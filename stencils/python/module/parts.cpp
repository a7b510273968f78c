// SPDX-License-Identifier: Apache-2.0
// Control meshes of fields and files of CAD programs. OpenVDB and OpenCASCADE are in the program's own libraries, which
// are loaded when they are wanted.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calls.h"
#include "cli/support/loaded_library.h"
#include "cli/opencascade/entry.h"
#include "cli/openvdb/entry.h"
#include "face_names.h"
#include "module.h"
#include "sources.h"
#include "sublimit/cad/step_file.h"
#include "sublimit/stencils/recipes/implicit.h"

namespace sublimit::python {
namespace {

namespace py = pybind11;

/// Loads OpenVDB when there is a grid: what is wrong with a field is reported first.
Mesh loaded_polygonize(const FieldGrid& grid) {
  void* const entry =
      cli::loaded_function(implicit_mesh_part, cli::openvdb_library, cli::polygonize_entry, "control meshes of fields");
  Mesh mesh;
  reinterpret_cast<cli::PolygonizeEntry*>(entry)(grid, mesh);
  return mesh;
}

CadFileMaker loaded_cad_file() {
  void* const entry = cli::loaded_function(cad_part, cli::opencascade_library, cli::cad_file_entry, "CAD files");
  return [make = reinterpret_cast<cli::CadFileEntry*>(entry)](const BoundaryModel& model, const std::string& name,
                                                              bool step) {
    CadFile file;
    make(model, name, step, file);
    return file;
  };
}

py::dict implicit_of(const std::string& field, const MeshRequest& request, int cells, double tolerance, int threads) {
  ImplicitMesh made = without_gil([&] {
    const Threads held(threads);
    return implicit_mesh(field, *scheme_job(request).scheme, loaded_polygonize,
                         {.cells = cells, .tolerance = tolerance});
  });
  py::dict all;
  all["mesh"] = std::make_shared<Mesh>(std::move(made.mesh));
  all["met"] = made.met;
  all["tolerance"] = made.tolerance;
  all["largest_distance"] = made.largest_distance;
  all["mean_distance"] = made.mean_distance;
  all["notes"] = made.notes;
  return all;
}

/// @throws InvalidOption  another word
StepJoin step_join(const std::string& word) {
  if (word != "g0" && word != "g1") throw InvalidOption("join is '" + word + "'; 'g0' or 'g1' are right");
  return word == "g1" ? StepJoin::g1 : StepJoin::g0;
}

/// @throws InvalidOption  another word
LengthUnit length_unit(const std::string& word) {
  if (word == "mm") return LengthUnit::mm;
  if (word == "m") return LengthUnit::m;
  if (word == "inch") return LengthUnit::inch;
  throw InvalidOption("unit is '" + word + "'; 'mm', 'm' or 'inch' are right");
}

template <class Surface>
py::dict step_of(const Surface& surface, const std::filesystem::path& path, std::optional<double> tolerance,
                 const std::string& join, bool pack, const std::string& unit, const std::vector<std::string>& names,
                 int threads) {
  const StepFile written = without_gil([&] {
    const Threads held(threads);
    const StepOptions options{.tolerance = tolerance,
                              .join = step_join(join),
                              .pack = pack,
                              .unit = length_unit(unit),
                              .face_names = face_names(names)};
    check_step(path, options);
    return write_step(surface, path, options, loaded_cad_file());
  });
  py::dict all;
  all["solids"] = written.solids;
  all["shells"] = written.shells;
  all["faces"] = written.faces;
  all["caps"] = written.caps;
  all["deviation"] = written.deviation;
  all["met"] = written.met;
  all["is_valid"] = written.is_valid;
  return all;
}

template <class Source, class Of>
void add_step(py::module_& m, const Of& of) {
  m.def(
      "step",
      [of](const Source& source, const std::filesystem::path& path, std::optional<double> tolerance,
           const std::string& join, bool pack, const std::string& unit, const std::vector<std::string>& names,
           int threads) { return step_of(of(source), path, tolerance, join, pack, unit, names, threads); },
      py::arg("surface"), py::arg("path"), py::arg("tolerance"), py::arg("join"), py::arg("pack"), py::arg("unit"),
      py::arg("face_names"), py::arg("threads"));
}

}  // namespace

void add_parts(py::module_& m) {
  m.def("implicit", &implicit_of, py::arg("field"), py::arg("request"), py::arg("cells"), py::arg("tolerance"),
        py::arg("threads"));
  add_step<Surface>(m, [](const Surface& s) { return s.limit_surface(); });
  add_step<PatchSurfaces>(m, [](const PatchSurfaces& s) { return s.patches(); });
}

}  // namespace sublimit::python
