// SPDX-License-Identifier: Apache-2.0
// Names of schemes, and what is asked of a mesh.
#include <pybind11/stl.h>

#include "module.h"
#include "own_schemes.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/jobs/mesh_job.h"
#include "sublimit/schemes.h"

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

template <class Scheme>
py::dict described(const Scheme& scheme, const char* kind, bool linear) {
  py::dict all;
  all["name"] = scheme.name;
  all["kind"] = kind;
  all["linear"] = linear;
  all["source"] = scheme.source;
  all["limit"] = scheme.claims.limit;
  all["interpolates"] = scheme.claims.interpolates;
  all["options"] = options(scheme.options);
  return all;
}

/// All schemes, in the order of the program's list.
py::list all_of_them() {
  py::list all;
  for (const Scheme<double>& scheme : all_schemes()) {
    py::dict one = described(scheme, "surface", true);
    one["faces"] = scheme.face_size() == 3 ? "triangles" : "any";
    one["continuity"] = scheme.claims.regular;
    one["extraordinary_continuity"] = scheme.claims.extraordinary;
    one["generates_degree"] = scheme.claims.generates;
    one["reproduces_degree"] = scheme.claims.reproduces;
    one["convex_hull"] = scheme.claims.convex_hull;
    all.append(one);
  }
  for (const CurveScheme<double>& scheme : all_curve_schemes()) {
    py::dict one = described(scheme, "curve", true);
    one["continuity"] = scheme.claims.regular;
    one["generates_degree"] = scheme.claims.generates;
    one["reproduces_degree"] = scheme.claims.reproduces;
    one["convex_hull"] = scheme.claims.convex_hull;
    all.append(one);
  }
  for (const auto& scheme : all_geometric_schemes()) all.append(described(scheme, "curve", false));
  for (const auto& scheme : all_geometric_schemes<CurvatureMesh>()) all.append(described(scheme, "surface", false));
  for (const auto& scheme : all_geometric_schemes<NormalMesh>()) all.append(described(scheme, "surface", false));
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
  m.def("schemes", &all_of_them);
  m.def("check_scheme", &check, py::arg("name"), py::arg("options"));
  py::class_<MeshRequest>(m, "MeshRequest")
      .def(py::init<>())
      .def_readwrite("scheme", &MeshRequest::scheme)
      .def_readwrite("options", &MeshRequest::options)
      .def_readwrite("boundary", &MeshRequest::boundary)
      .def_readwrite("creasing", &MeshRequest::creasing)
      .def_readwrite("triangles", &MeshRequest::triangles)
      .def_readwrite("face_varying", &MeshRequest::face_varying)
      .def_readwrite("triangulate", &MeshRequest::triangulate)
      .def_readwrite("no_creases", &MeshRequest::no_creases)
      .def_readwrite("strict", &MeshRequest::strict)
      .def(
          "use", [](MeshRequest& request, const OwnScheme& own) { request.own_scheme = own.scheme; }, py::arg("own"));
}

}  // namespace sublimit::python
