// SPDX-License-Identifier: Apache-2.0
// Control meshes. They never change, so that arrays may show what is in them.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "calls.h"
#include "face_names.h"
#include "mesh_values.h"
#include "module.h"
#include "sublimit/base/error.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/mesh/sharpness.h"
#include "sublimit/stencils/formats/rule_of_word.h"
#include "sublimit/stencils/formats/sidecar.h"
#include "sublimit/stencils/jobs/detail/mesh_info_json.h"
#include "sublimit/stencils/jobs/detail/mesh_job.h"

namespace sublimit::python {
namespace {

/// What every scheme would refuse.
/// @throws InvalidMesh  faces or tags that name what there is not
void check(const Mesh& mesh) {
  const Topology topology(view(mesh));
  initial_sharpness(topology, mesh, Boundary::edge_and_corner, Creasing::uniform);
  initial_holes(topology, mesh, Boundary::edge_and_corner);
}

/// Edges or vertices with their sharpness.
using Tags = std::pair<Array<Index>, Array<float>>;

/// Values, and which of them each corner has; of normals -1 for none, and no indices if they are of vertices.
using Channel = std::optional<std::pair<Array<double>, Array<Index>>>;

/// What a mesh carries: groups, objects, materials and smoothing groups of faces; files of materials; values of
/// vertices and of faces.
using Carried = std::tuple<std::array<std::vector<std::string>, 4>, std::vector<std::string>, ValueRows, ValueRows>;

Mesh made(const Array<double>& positions, const Array<Index>& sizes, const Array<Index>& corners, const Tags& creases,
          const Tags& sharp_vertices, const Array<Index>& holes, const std::optional<std::string>& boundary,
          const Channel& uv, const Channel& normals, const Array<Index>& face_ids, const Carried& carried) {
  Mesh mesh;
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
  if (normals) {
    mesh.normals = points(normals->first);
    mesh.face_normals = vector(normals->second);
  }
  mesh.face_ids = vector(face_ids);
  const auto& [names, material_files, vertex_values, face_values] = carried;
  mesh.groups = face_names(names[0]);
  mesh.objects = face_names(names[1]);
  mesh.materials = face_names(names[2]);
  mesh.smoothing_groups = face_names(names[3]);
  mesh.material_files = material_files;
  mesh.vertex_values = mesh_values(vertex_values);
  mesh.face_values = mesh_values(face_values);
  const LongCall scope;
  check(mesh);
  return mesh;
}

py::tuple tags(const std::vector<Mesh::Crease>& creases) {
  std::vector<float> sharpness;
  Array<Index> edges({py::ssize_t(creases.size()), py::ssize_t(2)});
  for (py::ssize_t i = 0; i < edges.shape(0); ++i) {
    edges.mutable_at(i, 0) = creases[size_t(i)].tail;
    edges.mutable_at(i, 1) = creases[size_t(i)].head;
    sharpness.push_back(creases[size_t(i)].sharpness);
  }
  return py::make_tuple(edges, array(std::move(sharpness)));
}
py::tuple tags(const std::vector<Mesh::Corner>& corners) {
  std::vector<Index> vertices;
  std::vector<float> sharpness;
  for (const Mesh::Corner& corner : corners) {
    vertices.push_back(corner.vertex);
    sharpness.push_back(corner.sharpness);
  }
  return py::make_tuple(array(std::move(vertices)), array(std::move(sharpness)));
}

/// Name, values, and the value of every corner of every channel.
py::list channels(const py::object& self) {
  py::list all;
  for (const Mesh::FaceVarying& channel : self.cast<const Mesh&>().face_varying)
    all.append(py::make_tuple(channel.name, view(channel.values, self), view(channel.indices, self)));
  return all;
}

/// Values of vertices or of faces.
py::list values(const py::object& self, std::vector<Mesh::Values> Mesh::*of) {
  return value_rows(self.cast<const Mesh&>().*of, [&](const auto& numbers) { return view(numbers, self); });
}

/// Texts of a file, which need not be UTF-8.
py::list bytes(const std::vector<std::string>& texts) {
  py::list all;
  for (const std::string& text : texts) all.append(py::bytes(text));
  return all;
}

py::tuple carried(const Mesh& mesh) {
  const auto copy = [](const std::vector<double>& numbers) { return array(std::vector<double>(numbers)); };
  return py::make_tuple(py::make_tuple(names_by_face(mesh.groups), names_by_face(mesh.objects),
                                       names_by_face(mesh.materials), names_by_face(mesh.smoothing_groups)),
                        bytes(mesh.material_files), value_rows(mesh.vertex_values, copy),
                        value_rows(mesh.face_values, copy));
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
py::tuple state(const Mesh& mesh) {
  py::list channels, knots;
  for (const Mesh::FaceVarying& channel : mesh.face_varying)
    channels.append(
        py::make_tuple(channel.name, array(Points(channel.values)), array(std::vector<Index>(channel.indices))));
  for (const Mesh::KnotInterval& knot : mesh.knot_intervals)
    knots.append(py::make_tuple(knot.tail, knot.head, knot.length));
  py::dict all;
  all["points"] = array(Points(mesh.positions));
  all["sizes"] = array(std::vector<Index>(mesh.face_sizes));
  all["corners"] = array(std::vector<Index>(mesh.face_vertices));
  all["creases"] = tags(mesh.creases);
  all["sharp_vertices"] = tags(mesh.corners);
  all["holes"] = array(std::vector<Index>(mesh.holes));
  all["channels"] = channels;
  all["knots"] = knots;
  all["rules"] = py::make_tuple(number(mesh.boundary), number(mesh.creasing), number(mesh.triangles),
                                number(mesh.face_varying_interpolation), number(mesh.attributes));
  all["normals"] = py::make_tuple(array(Points(mesh.normals)), array(std::vector<Index>(mesh.face_normals)));
  all["texture"] = array(Points(mesh.texture));
  all["face_ids"] = array(std::vector<Index>(mesh.face_ids));
  all["carried"] = carried(mesh);
  all["comments"] = bytes(mesh.comments);
  all["scheme"] = mesh.scheme;
  all["warnings"] = mesh.warnings;
  return py::make_tuple(all);
}
Mesh from_state(const py::tuple& state) {
  const auto all = state[0].cast<py::dict>();
  const auto whole_numbers = [&](const char* name) { return all[name].cast<Array<Index>>(); };
  Mesh mesh = made(all["points"].cast<Array<double>>(), whole_numbers("sizes"), whole_numbers("corners"),
                   all["creases"].cast<Tags>(), all["sharp_vertices"].cast<Tags>(), whole_numbers("holes"), {}, {},
                   all["normals"].cast<Channel>(), whole_numbers("face_ids"), all["carried"].cast<Carried>());
  for (const py::handle one : all["channels"].cast<py::list>()) {
    const auto channel = one.cast<py::tuple>();
    mesh.face_varying.push_back({channel[0].cast<std::string>(), points(channel[1].cast<Array<double>>()),
                                 vector(channel[2].cast<Array<Index>>())});
  }
  for (const py::handle one : all["knots"].cast<py::list>()) {
    const auto knot = one.cast<py::tuple>();
    mesh.knot_intervals.push_back({knot[0].cast<Index>(), knot[1].cast<Index>(), knot[2].cast<double>()});
  }
  const auto rules = all["rules"].cast<py::tuple>();
  mesh.boundary = rule<Boundary>(rules[0]);
  mesh.creasing = rule<Creasing>(rules[1]);
  mesh.triangles = rule<Triangles>(rules[2]);
  mesh.face_varying_interpolation = rule<FaceVaryingInterpolation>(rules[3]);
  mesh.attributes = rule<Attributes>(rules[4]);
  mesh.texture = points(all["texture"].cast<Array<double>>());
  mesh.comments = all["comments"].cast<std::vector<std::string>>();
  mesh.scheme = all["scheme"].cast<std::string>();
  mesh.warnings = all["warnings"].cast<std::vector<std::string>>();
  return mesh;
}

/// What a scheme accepts of a mesh but its user should know: of its file, tags that the scheme ignores, what is no
/// manifold.
std::vector<std::string> warnings(const Mesh& mesh, const MeshRequest& request) {
  const MeshJob job = mesh_job(request, mesh, "mesh");
  std::vector<std::string> all = job.mesh.warnings;
  for (std::string& fault : faults(job.mesh, request.orient)) all.push_back(std::move(fault));
  return all;
}

/// The mesh of a file with the tags of a sidecar.
/// @param sidecar  its path, "none", or empty: the one that lies beside the file, if there is one
Mesh read(const std::filesystem::path& path, const std::filesystem::path& sidecar) {
  Mesh mesh = read_mesh(path);
  if (!sidecar.empty() && sidecar != "none")
    apply_sidecar(mesh, sidecar);
  else if (const auto found = sidecar.empty() ? find_sidecar(path) : std::nullopt)
    apply_sidecar(mesh, *found);
  return mesh;
}

}  // namespace

void add_meshes(py::module_& m) {
  const py::call_guard<LongCall> long_call;
  m.attr("value_types") = py::tuple(py::cast(std::vector<std::string>(value_types.begin(), value_types.end())));
  py::class_<Mesh, std::shared_ptr<Mesh>>(m, "Mesh")
      .def(py::init(&made), py::arg("points"), py::arg("sizes"), py::arg("corners"), py::arg("creases"),
           py::arg("sharp_vertices"), py::arg("holes"), py::arg("boundary"), py::arg("uv"), py::arg("normals"),
           py::arg("face_ids"), py::arg("carried"))
      .def_property_readonly("points",
                             [](const py::object& self) { return view(self.cast<const Mesh&>().positions, self); })
      .def_property_readonly("sizes",
                             [](const py::object& self) { return view(self.cast<const Mesh&>().face_sizes, self); })
      .def_property_readonly("corners",
                             [](const py::object& self) { return view(self.cast<const Mesh&>().face_vertices, self); })
      .def_property_readonly("holes", [](const py::object& self) { return view(self.cast<const Mesh&>().holes, self); })
      .def_property_readonly("creases", [](const Mesh& mesh) { return tags(mesh.creases); })
      .def_property_readonly("sharp_vertices", [](const Mesh& mesh) { return tags(mesh.corners); })
      .def_property_readonly("boundary",
                             [](const Mesh& mesh) {
                               return mesh.boundary ? std::optional<std::string>(word(*mesh.boundary)) : std::nullopt;
                             })
      .def_property_readonly("channels", &channels)
      .def_property_readonly("normals",
                             [](const py::object& self) { return view(self.cast<const Mesh&>().normals, self); })
      .def_property_readonly("face_normals",
                             [](const py::object& self) { return view(self.cast<const Mesh&>().face_normals, self); })
      .def_property_readonly("face_ids",
                             [](const py::object& self) { return view(self.cast<const Mesh&>().face_ids, self); })
      .def_property_readonly("face_names", [](const Mesh& mesh) { return names_by_face(mesh.face_names()); })
      .def_property_readonly("groups", [](const Mesh& mesh) { return names_by_face(mesh.groups); })
      .def_property_readonly("objects", [](const Mesh& mesh) { return names_by_face(mesh.objects); })
      .def_property_readonly("materials", [](const Mesh& mesh) { return names_by_face(mesh.materials); })
      .def_property_readonly("smoothing_groups", [](const Mesh& mesh) { return names_by_face(mesh.smoothing_groups); })
      .def_property_readonly("material_files", [](const Mesh& mesh) { return bytes(mesh.material_files); })
      .def_property_readonly("vertex_values", [](const py::object& self) { return values(self, &Mesh::vertex_values); })
      .def_property_readonly("face_values", [](const py::object& self) { return values(self, &Mesh::face_values); })
      .def_readonly("scheme", &Mesh::scheme)
      .def_property_readonly("warnings", [](const Mesh& mesh) { return mesh.warnings; })
      .def(py::pickle(&state, &from_state))
      .def(
          "with_points",
          [](const Mesh& mesh, const Array<double>& given) {
            return std::make_shared<Mesh>(mesh.with_points(points(given)));
          },
          py::arg("points"))
      .def(
          "faults", [](const Mesh& mesh) { return faults(mesh); }, long_call)
      .def(
          "write", [](const Mesh& mesh, const std::filesystem::path& path) { write_mesh(path, mesh); }, py::arg("path"),
          long_call);
  m.def(
      "info",
      [](const Mesh& mesh, const MeshRequest& request, const std::string& name, bool limit) {
        const MeshJob job = mesh_job(request, mesh, name);
        MeshInfo found = mesh_info(job);
        if (limit) found.limit = limit_integrals(job);
        return to_json(found, name).dump();
      },
      py::arg("mesh"), py::arg("request"), py::arg("name"), py::arg("limit"), long_call);
  m.def("warnings", &warnings, py::arg("mesh"), py::arg("request"), long_call);
  m.def("read", &read, py::arg("path"), py::arg("sidecar"), long_call);
}

}  // namespace sublimit::python
