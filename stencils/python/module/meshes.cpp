// SPDX-License-Identifier: Apache-2.0
// Control meshes. They never change, so that arrays may show what is in them.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "arrays.h"
#include "calls.h"
#include "module.h"
#include "sublimit/base/error.h"
#include "sublimit/files/rule_words.h"
#include "sublimit/files/sidecar.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/jobs/mesh_info_json.h"
#include "sublimit/jobs/mesh_job.h"
#include "sublimit/mesh/sharpness.h"

namespace sublimit::python {
namespace {

/// What every scheme would refuse.
/// @throws InvalidMesh  faces or tags that name what there is not
void check(const ControlMesh& mesh) {
  const Topology topology(view(mesh));
  initial_sharpness(topology, mesh, Boundary::edge_and_corner, Creasing::uniform);
  initial_holes(topology, mesh, Boundary::edge_and_corner);
}

/// Edges or vertices with their sharpness.
using Tags = std::pair<Array<Index>, Array<float>>;

ControlMesh made(const Array<double>& positions, const Array<Index>& sizes, const Array<Index>& corners,
                 const Tags& creases, const Tags& sharp_vertices, const Array<Index>& holes,
                 const std::optional<std::string>& boundary,
                 const std::optional<std::pair<Array<double>, Array<Index>>>& uv) {
  ControlMesh mesh;
  mesh.positions = points(positions);
  mesh.face_sizes = vector(sizes);
  mesh.face_vertices = vector(corners);
  for (py::ssize_t i = 0; i < creases.second.size(); ++i)
    mesh.creases.push_back({creases.first.at(i, 0), creases.first.at(i, 1), creases.second.at(i)});
  for (py::ssize_t i = 0; i < sharp_vertices.second.size(); ++i)
    mesh.corners.push_back({sharp_vertices.first.at(i), sharp_vertices.second.at(i)});
  mesh.holes = vector(holes);
  if (boundary) {
    mesh.boundary = rule_of<Boundary>(*boundary);
    if (!mesh.boundary)
      throw InvalidOption("boundary '" + *boundary + "' is no rule; there are none, edge-only, edge-and-corner");
  }
  if (uv) mesh.face_varying.push_back({"uv", points(uv->first), vector(uv->second)});
  const LongCall scope;
  check(mesh);
  return mesh;
}

py::tuple tags(const std::vector<ControlMesh::Crease>& creases) {
  std::vector<float> sharpness;
  Array<Index> edges({py::ssize_t(creases.size()), py::ssize_t(2)});
  for (py::ssize_t i = 0; i < edges.shape(0); ++i) {
    edges.mutable_at(i, 0) = creases[size_t(i)].tail;
    edges.mutable_at(i, 1) = creases[size_t(i)].head;
    sharpness.push_back(creases[size_t(i)].sharpness);
  }
  return py::make_tuple(edges, array(std::move(sharpness)));
}
py::tuple tags(const std::vector<ControlMesh::Corner>& corners) {
  std::vector<Index> vertices;
  std::vector<float> sharpness;
  for (const ControlMesh::Corner& corner : corners) {
    vertices.push_back(corner.vertex);
    sharpness.push_back(corner.sharpness);
  }
  return py::make_tuple(array(std::move(vertices)), array(std::move(sharpness)));
}

/// Name, values, and the value of every corner of every channel.
py::list channels(const py::object& self) {
  py::list all;
  for (const ControlMesh::FaceVarying& channel : self.cast<const ControlMesh&>().face_varying)
    all.append(py::make_tuple(channel.name, view(channel.values, self), view(channel.indices, self)));
  return all;
}

template <class Rule>
std::optional<int> number(const std::optional<Rule>& rule) {
  return rule ? std::optional(int(*rule)) : std::nullopt;
}
template <class Rule>
std::optional<Rule> rule(const py::handle& number) {
  return number.is_none() ? std::nullopt : std::optional(Rule(number.cast<int>()));
}

/// All that a mesh has, for pickles.
py::tuple state(const ControlMesh& mesh) {
  py::list values, knots;
  for (const ControlMesh::FaceVarying& channel : mesh.face_varying)
    values.append(
        py::make_tuple(channel.name, array(Points(channel.values)), array(std::vector<Index>(channel.indices))));
  for (const ControlMesh::KnotInterval& knot : mesh.knot_intervals)
    knots.append(py::make_tuple(knot.tail, knot.head, knot.length));
  return py::make_tuple(array(Points(mesh.positions)), array(std::vector<Index>(mesh.face_sizes)),
                        array(std::vector<Index>(mesh.face_vertices)), tags(mesh.creases), tags(mesh.corners),
                        array(std::vector<Index>(mesh.holes)), values, knots,
                        py::make_tuple(number(mesh.boundary), number(mesh.creasing), number(mesh.triangles),
                                       number(mesh.face_varying_interpolation)),
                        mesh.warnings);
}
ControlMesh from_state(const py::tuple& state) {
  ControlMesh mesh = made(state[0].cast<Array<double>>(), state[1].cast<Array<Index>>(), state[2].cast<Array<Index>>(),
                          state[3].cast<Tags>(), state[4].cast<Tags>(), state[5].cast<Array<Index>>(), {}, {});
  for (const py::handle one : state[6].cast<py::list>()) {
    const auto channel = one.cast<py::tuple>();
    mesh.face_varying.push_back({channel[0].cast<std::string>(), points(channel[1].cast<Array<double>>()),
                                 vector(channel[2].cast<Array<Index>>())});
  }
  for (const py::handle one : state[7].cast<py::list>()) {
    const auto knot = one.cast<py::tuple>();
    mesh.knot_intervals.push_back({knot[0].cast<Index>(), knot[1].cast<Index>(), knot[2].cast<double>()});
  }
  const auto rules = state[8].cast<py::tuple>();
  mesh.boundary = rule<Boundary>(rules[0]);
  mesh.creasing = rule<Creasing>(rules[1]);
  mesh.triangles = rule<Triangles>(rules[2]);
  mesh.face_varying_interpolation = rule<FaceVaryingInterpolation>(rules[3]);
  mesh.warnings = state[9].cast<std::vector<std::string>>();
  return mesh;
}

/// What a scheme accepts of a mesh but its user should know: of its file, tags that the scheme ignores, what is no
/// manifold.
std::vector<std::string> warnings(const ControlMesh& mesh, const MeshRequest& request) {
  const MeshJob job = mesh_job(request, mesh, "mesh");
  std::vector<std::string> all = job.mesh.warnings;
  for (std::string& fault : faults(job.mesh)) all.push_back(std::move(fault));
  return all;
}

/// The file with the tags that lie beside it.
ControlMesh read(const std::filesystem::path& path) {
  ControlMesh mesh = read_mesh(path);
  if (const auto sidecar = find_sidecar(path)) apply_sidecar(mesh, *sidecar);
  return mesh;
}

}  // namespace

void add_meshes(py::module_& m) {
  const py::call_guard<LongCall> long_call;
  py::class_<ControlMesh, std::shared_ptr<ControlMesh>>(m, "ControlMesh")
      .def(py::init(&made), py::arg("points"), py::arg("sizes"), py::arg("corners"), py::arg("creases"),
           py::arg("sharp_vertices"), py::arg("holes"), py::arg("boundary"), py::arg("uv"))
      .def_property_readonly(
          "points", [](const py::object& self) { return view(self.cast<const ControlMesh&>().positions, self); })
      .def_property_readonly(
          "sizes", [](const py::object& self) { return view(self.cast<const ControlMesh&>().face_sizes, self); })
      .def_property_readonly(
          "corners", [](const py::object& self) { return view(self.cast<const ControlMesh&>().face_vertices, self); })
      .def_property_readonly("holes",
                             [](const py::object& self) { return view(self.cast<const ControlMesh&>().holes, self); })
      .def_property_readonly("creases", [](const ControlMesh& mesh) { return tags(mesh.creases); })
      .def_property_readonly("sharp_vertices", [](const ControlMesh& mesh) { return tags(mesh.corners); })
      .def_property_readonly("boundary",
                             [](const ControlMesh& mesh) {
                               return mesh.boundary ? std::optional<std::string>(word(*mesh.boundary)) : std::nullopt;
                             })
      .def_property_readonly("channels", &channels)
      .def_property_readonly("warnings", [](const ControlMesh& mesh) { return mesh.warnings; })
      .def(py::pickle(&state, &from_state))
      .def("faults", &faults, long_call)
      .def(
          "write", [](const ControlMesh& mesh, const std::filesystem::path& path) { write_mesh(path, output(mesh)); },
          py::arg("path"), long_call);
  m.def(
      "info",
      [](const ControlMesh& mesh, const MeshRequest& request, const std::string& name, bool limit) {
        const MeshJob job = mesh_job(request, mesh, name);
        MeshInfo found = mesh_info(job);
        if (limit) found.limit = limit_integrals(job);
        return to_json(found, name).dump();
      },
      py::arg("mesh"), py::arg("request"), py::arg("name"), py::arg("limit"), long_call);
  m.def("warnings", &warnings, py::arg("mesh"), py::arg("request"), long_call);
  m.def("read", &read, py::arg("path"), long_call);
}

}  // namespace sublimit::python
