// SPDX-License-Identifier: Apache-2.0
// Names of schemes, and what is asked of a mesh.
#include <pybind11/stl.h>

#include "module.h"
#include "own_schemes.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/scheme/scheme_info.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/jobs/detail/mesh_job.h"

namespace sublimit::python {
namespace {

namespace py = pybind11;

/// By name: default, range or words, meaning.
py::dict options(const std::vector<OptionInfo>& known) {
  py::dict all;
  for (const OptionInfo& info : known)
    all[py::str(info.name)] = py::make_tuple(info.values.front(), allowed_values(info), info.meaning);
  return all;
}

py::list described_schemes() {
  py::list all;
  for (const SchemeInfo& scheme : schemes()) {
    py::dict one;
    one["name"] = scheme.name;
    one["kind"] = scheme.kind == SchemeInfo::Kind::surface ? "surface" : "curve";
    one["linear"] = scheme.linear;
    one["source"] = scheme.source;
    one["limit"] = scheme.limit;
    one["interpolates"] = scheme.interpolates;
    one["triangles"] = scheme.triangles;
    one["continuity"] = scheme.continuity;
    one["extraordinary_continuity"] = scheme.extraordinary_continuity;
    one["generates_degree"] = scheme.generates_degree;
    one["reproduces_degree"] = scheme.reproduces_degree;
    one["convex_hull"] = scheme.convex_hull;
    one["options"] = options(scheme.options);
    all.append(one);
  }
  return all;
}

/// @throws InvalidOption  no scheme of that name, or options that it does not take
void check(const std::string& name, const SchemeOptions& options) {
  if (!find_curve_scheme(name, options) && !find_geometric_scheme<ControlPolygon>(name, options) &&
      !find_geometric_scheme<CurvatureMesh>(name, options) && !find_geometric_scheme<NormalMesh>(name, options))
    scheme_or_throw(name, options);
}

}  // namespace

void add_schemes(py::module_& m) {
  m.def("schemes", &described_schemes);
  m.def("check_scheme", &check, py::arg("name"), py::arg("options"));
  py::class_<MeshRequest>(m, "MeshRequest")
      .def(py::init<>())
      .def_readwrite("scheme", &MeshRequest::scheme)
      .def_readwrite("options", &MeshRequest::options)
      .def_readwrite("boundary", &MeshRequest::boundary)
      .def_readwrite("creasing", &MeshRequest::creasing)
      .def_readwrite("triangles", &MeshRequest::triangles)
      .def_readwrite("face_varying", &MeshRequest::face_varying)
      .def_readwrite("attributes", &MeshRequest::attributes)
      .def_readwrite("orient", &MeshRequest::orient)
      .def_readwrite("crease_angle", &MeshRequest::crease_angle)
      .def_readwrite("crease_smoothing_groups", &MeshRequest::crease_smoothing_groups)
      .def_readwrite("triangulate", &MeshRequest::triangulate)
      .def_readwrite("no_creases", &MeshRequest::no_creases)
      .def_readwrite("strict", &MeshRequest::strict)
      .def(
          "use", [](MeshRequest& request, const OwnScheme& own) { request.own_scheme = own.scheme; }, py::arg("own"));
}

}  // namespace sublimit::python
