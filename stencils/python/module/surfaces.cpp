// SPDX-License-Identifier: Apache-2.0
// Limit surfaces: points with derivatives and stencils anywhere, closest points, rays, triangles.
#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "calls.h"
#include "module.h"
#include "sources.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/uninitialized.h"
#include "sublimit/search/closest_point.h"
#include "sublimit/search/intersect.h"
#include "sublimit/source/curvature.h"
#include "sublimit/source/place_stencils.h"
#include "sublimit/stencils/jobs/detail/tessellated_job.h"
#include "sublimit/sublimit.h"

namespace sublimit::python {
namespace {

/// Places as the library takes them, in memory that is touched once: there may be millions.
class Places {
 public:
  /// Needs no GIL.
  /// @throws InvalidParameter  the first one that is on no face
  Places(const FaceCount& on, const Array<Index>& faces, const Array<double>& u, const Array<double>& v)
      : size_(size_t(faces.size())), memory_(size_ * sizeof(Place)) {
    auto* const samples = reinterpret_cast<Place*>(memory_.data());
    const Index* const face = faces.data();
    const double *const at_u = u.data(), *const at_v = v.data();
    std::atomic<bool> all_inside = true;
    parallel_for_blocks(std::int64_t(size_), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      bool inside = true;
      for (std::int64_t i = begin; i < end; ++i)
        inside &= is_inside(on, *std::construct_at(samples + i, face[i], at_u[i], at_v[i]));
      if (!inside) all_inside = false;
    });
    if (all_inside) return;
    for (const Place& sample : all()) check_inside(on, sample);
  }
  size_t size() const { return size_; }
  std::span<const Place> all() const { return {reinterpret_cast<const Place*>(memory_.data()), size_}; }
  const Place& operator[](size_t i) const { return all()[i]; }

 private:
  size_t size_;
  UninitializedVector<std::byte> memory_;
};

py::array_t<std::int8_t> numbers(const std::vector<LimitStatus>& statuses) {
  UninitializedVector<std::int8_t> all(statuses.size());
  parallel_for(std::ssize(statuses), [&](std::int64_t i) { all[size_t(i)] = std::int8_t(statuses[size_t(i)]); });
  return array(std::move(all));
}

py::dict arrays(LimitSamples&& samples) {
  py::dict all;
  all["status"] = numbers(samples.status);
  all["order"] = array(std::move(samples.order));
  all["points"] = array(std::move(samples.position));
  for (const auto& [name, part] : {std::pair{"du", &samples.du},
                                   {"dv", &samples.dv},
                                   {"duu", &samples.duu},
                                   {"duv", &samples.duv},
                                   {"dvv", &samples.dvv},
                                   {"normals", &samples.normal}})
    if (part->rows() > 0 || samples.status.size() == 0) all[name] = array(std::move(*part));
  return all;
}

/// @throws InvalidMesh  a position or a derivative larger than numbers are: says where
void check_finite(const LimitSamples& found, const Places& at) {
  const auto row = first_infinite_row({&found.position, &found.du, &found.dv, &found.duu, &found.duv, &found.dvv});
  if (!row) return;
  const Place& place = at[size_t(*row)];
  throw InvalidMesh(
      "face " + std::to_string(place.face) + ", u " + format_number(place.u) + ", v " + format_number(place.v) +
      ": the position or a derivative there is larger than numbers are (1.8e308); give control points in another "
      "unit of length");
}

py::dict evaluate(const Source& surface, const Array<Index>& faces, const Array<double>& u, const Array<double>& v,
                  int order, int threads) {
  return arrays(without_gil([&] {
    const Threads held(threads);
    const Places at(surface.surface().faces(), faces, u, v);
    LimitSamples found = surface.evaluate(at.all(), order);
    check_finite(found, at);
    return found;
  }));
}

py::tuple stencils(const Source& surface, const Array<Index>& faces, const Array<double>& u, const Array<double>& v,
                   int order, int threads) {
  PlaceStencils found = without_gil([&] {
    const Threads held(threads);
    return place_stencils(surface.surface(), Places(surface.surface().faces(), faces, u, v).all(), order);
  });
  py::list matrices;
  for (SparseMatrix& matrix : found.matrices) matrices.append(csr(std::move(matrix)));
  return py::make_tuple(matrices, numbers(found.status));
}

const char* word(LimitPath::End end) { return end == LimitPath::End::polynomial ? "polynomial" : "corner"; }

py::dict explain(const Surface& surface, Index face, double u, double v) {
  const LimitPath path = without_gil([&] {
    const Place place{face, u, v};
    check_inside(surface.surface().faces(), place);
    return surface.limit_surface().explain(place);
  });
  py::list steps;
  for (const LimitPath::Step& step : path.steps) {
    py::dict one;
    one["level"] = step.level;
    one["piece"] = step.piece;
    one["u"] = step.u;
    one["v"] = step.v;
    one["num_points"] = step.num_points;
    one["child"] = step.child;
    one["times"] = step.times;
    steps.append(std::move(one));
  }
  const LimitStencil& stencil = path.stencil;
  std::vector<double> weights(stencil.vertices.size());
  for (size_t i = 0; i < weights.size(); ++i) weights[i] = stencil.weights(0, Eigen::Index(i));
  py::dict all;
  all["steps"] = std::move(steps);
  all["end"] = word(path.end);
  all["degree"] = path.degree;
  all["is_total"] = path.is_total;
  all["spectrum"] = path.spectrum;
  all["vertex"] = path.vertex;
  all["rule"] = path.rule;
  all["status"] = name(stencil.status);
  all["vertices"] = array(std::vector<Index>(stencil.vertices));
  all["weights"] = array(std::move(weights));
  return all;
}

py::array_t<double> column(const Eigen::VectorXd& values) {
  return array(std::vector<double>(values.begin(), values.end()));
}

/// As three arrays.
void add_places(py::dict& all, const std::vector<Place>& places) {
  std::vector<Index> faces;
  std::vector<double> u, v;
  for (const Place& place : places) {
    faces.push_back(place.face);
    u.push_back(place.u);
    v.push_back(place.v);
  }
  all["face"] = array(std::move(faces));
  all["u"] = array(std::move(u));
  all["v"] = array(std::move(v));
}

py::dict closest(const Source& surface, const Array<double>& queries, int nearest, double radius, bool is_signed,
                 int threads) {
  const Points from = points(queries);
  ClosestPoints found = without_gil([&] {
    const Threads held(threads);
    return surface.closest(from, {.nearest = nearest, .radius = radius, .is_signed = is_signed});
  });
  py::dict all;
  add_places(all, found.places);
  all["points"] = array(std::move(found.points));
  all["normals"] = array(std::move(found.normals));
  all["distance"] = column(found.distances);
  all["lower"] = column(found.lower);
  all["status"] = numbers(found.status);
  all["first"] = array(std::move(found.first));
  return all;
}

py::dict intersect(const Source& surface, const Array<double>& origins, const Array<double>& directions,
                   const Array<double>& tmin, const Array<double>& tmax, bool all_hits, int most_parts, int threads) {
  const Points from = points(origins), along = points(directions);
  RayHits hits = without_gil([&] {
    const Threads held(threads);
    std::vector<Ray> rays;
    for (Eigen::Index i = 0; i < from.rows(); ++i)
      rays.push_back({from.row(i).transpose(), along.row(i).transpose(), tmin.data()[i], tmax.data()[i]});
    return surface.intersect(rays, {.all = all_hits, .most_parts = most_parts});
  });
  py::dict all;
  add_places(all, hits.places);
  all["t"] = array(std::move(hits.t));
  all["points"] = array(std::move(hits.points));
  all["normals"] = array(std::move(hits.normals));
  all["status"] = numbers(hits.status);
  std::vector<std::int8_t> kinds;
  for (const HitKind kind : hits.kinds) kinds.push_back(std::int8_t(kind));
  all["kind"] = array(std::move(kinds));
  all["first"] = array(std::move(hits.first));
  all["undecided"] = array(std::move(hits.undecided));
  return all;
}

/// Edges, rows of two vertices, and into how many segments each is cut.
using Rates = std::pair<Array<Index>, Array<Index>>;

/// For each edge; none if there are no rates.
/// @throws InvalidParameter  no edge of the surface, an edge twice
std::vector<Index> rates_of_edges(const Topology& topology, const Rates& given) {
  const auto& [ends, rates] = given;
  if (rates.size() == 0) return {};
  std::map<std::pair<Index, Index>, Index> edges;
  for (Index e = 0; e < topology.num_edges(); ++e)
    edges[std::minmax({index(topology.tail(Edge{e})), index(topology.head(Edge{e}))})] = e;
  std::vector<Index> all(size_t(topology.num_edges()), 0);
  for (py::ssize_t i = 0; i < rates.size(); ++i) {
    const Index a = ends.at(i, 0), b = ends.at(i, 1);
    const auto edge = edges.find(std::minmax({a, b}));
    const std::string name = "(" + std::to_string(a) + "," + std::to_string(b) + ")";
    if (edge == edges.end()) throw InvalidParameter("rates: no face has an edge " + name);
    if (all[size_t(edge->second)] != 0) throw InvalidParameter("rates: edge " + name + " has two rates; leave one out");
    if (rates.at(i) < 1)
      throw InvalidParameter("rates: edge " + name + " has the rate " + std::to_string(rates.at(i)) +
                             "; 1 or more is right");
    all[size_t(edge->second)] = rates.at(i);
  }
  std::ranges::replace(all, Index{0}, Index{1});
  return all;
}

py::dict tessellate_source(const Source& surface, double chord, double angle, std::int64_t most, const Rates& rates,
                           bool normals, int threads) {
  std::vector<Index> triangles, face_of;
  std::vector<double> corners;
  TessellationOptions options{.chord = chord, .angle = angle, .max_triangles = most, .normals = normals};
  if (const auto* const limit = dynamic_cast<const Surface*>(&surface))
    options.rates = rates_of_edges(limit->surface().level().topology(), rates);
  Tessellation made = without_gil([&] {
    const Threads held(threads);
    Tessellation found = surface.tessellate(options);
    for (const Tessellation::Triangle& triangle : found.triangles) {
      triangles.insert(triangles.end(), triangle.vertices.begin(), triangle.vertices.end());
      face_of.push_back(triangle.face);
      for (const auto& [u, v] : triangle.uv) corners.insert(corners.end(), {u, v});
    }
    return found;
  });
  const auto count = py::ssize_t(made.triangles.size()), three = py::ssize_t(3);
  py::dict all;
  add_places(all, made.places);
  all["points"] = array(std::move(made.points));
  all["triangles"] = array(std::move(triangles)).reshape({count, three});
  all["triangle_face"] = array(std::move(face_of));
  all["corners"] = array(std::move(corners)).reshape({count, three, py::ssize_t(2)});
  all["normals"] = py::none();
  if (normals) all["normals"] = array(std::move(made.normals)).reshape({count, three, three});
  all["bound"] = made.bound;
  all["cells"] = made.cells;
  return all;
}

/// With texture coordinates; they are left out with a warning if the scheme has no limit of them and they were not
/// asked for, as the program does.
std::shared_ptr<Mesh> tessellate_mesh(const Mesh& mesh, const MeshRequest& request, double chord, double angle,
                                      std::int64_t most, const Rates& rates, bool normals, int threads) {
  TessellationOptions options{.chord = chord, .angle = angle, .max_triangles = most, .normals = normals};
  return without_gil([&] {
    const Threads held(threads);
    MeshJob job = mesh_job(request, mesh, "mesh");
    if (rates.second.size() > 0)
      options.rates = rates_of_edges(LimitSurface(job.mesh, *job.scheme).map().level().topology(), rates);
    return std::make_shared<Mesh>(tessellated_mesh(job, options));
  });
}

/// Gauss, mean, k1, k2 and the directions of these: 10 columns; not a number where there is no curvature.
py::array_t<double> curvatures(const Array<double>& du, const Array<double>& dv, const Array<double>& duu,
                               const Array<double>& duv, const Array<double>& dvv, const Array<double>& normals,
                               const Array<std::int8_t>& status, const Array<std::int8_t>& order) {
  LimitSamples samples;
  samples.du = points(du), samples.dv = points(dv), samples.normal = points(normals);
  samples.duu = points(duu), samples.duv = points(duv), samples.dvv = points(dvv);
  samples.order = vector(order);
  for (const std::int8_t one : span(status)) samples.status.push_back(LimitStatus(one));
  Points all = Points::Constant(samples.du.rows(), 10, std::numeric_limits<double>::quiet_NaN());
  for (Index i = 0; i < all.rows(); ++i)
    if (const std::optional<Curvature> c = curvature(samples, i))
      all.row(i) << c->gauss, c->mean, c->k1, c->k2, c->direction1.transpose(), c->direction2.transpose();
  return array(std::move(all));
}

}  // namespace

void add_surfaces(py::module_& m) {
  m.attr("hit_kinds") = py::make_tuple(name(HitKind::crossing), name(HitKind::touching), name(HitKind::given_up));
  const py::call_guard<LongCall> long_call;
  py::class_<Source, std::shared_ptr<Source>>(m, "Source")
      .def_property_readonly("num_points", [](const Source& s) { return s.surface().num_points(); })
      .def_property_readonly("num_faces", [](const Source& s) { return s.surface().faces().size; })
      .def_property_readonly("triangles", [](const Source& s) { return s.surface().faces().triangles; })
      .def("evaluate", &evaluate, py::arg("face"), py::arg("u"), py::arg("v"), py::arg("derivatives"),
           py::arg("threads"))
      .def("stencils", &stencils, py::arg("face"), py::arg("u"), py::arg("v"), py::arg("derivatives"),
           py::arg("threads"))
      .def("closest", &closest, py::arg("points"), py::arg("nearest"), py::arg("radius"), py::arg("is_signed"),
           py::arg("threads"))
      .def("intersect", &intersect, py::arg("origins"), py::arg("directions"), py::arg("tmin"), py::arg("tmax"),
           py::arg("all"), py::arg("most_parts"), py::arg("threads"))
      .def("tessellate", &tessellate_source, py::arg("chord"), py::arg("angle"), py::arg("most"), py::arg("rates"),
           py::arg("normals"), py::arg("threads"));
  py::class_<Surface, Source, std::shared_ptr<Surface>>(m, "Surface")
      .def(py::init<const Mesh&, const MeshRequest&>(), py::arg("mesh"), py::arg("request"), long_call)
      .def_property_readonly("points",
                             [](const py::object& self) { return view(self.cast<const Surface&>().points(), self); })
      .def(
          "with_points",
          [](const Surface& s, const Array<double>& given) {
            return std::make_shared<Surface>(s.limit_surface().with(points(given)));
          },
          py::arg("points"))
      .def("explain", &explain, py::arg("face"), py::arg("u"), py::arg("v"));
  py::class_<PatchSurfaces, Source, std::shared_ptr<PatchSurfaces>>(m, "Patches")
      .def_property_readonly(
          "columns", [](const py::object& self) { return view(self.cast<const PatchSurfaces&>().points(), self); })
      .def_property_readonly("first_faces",
                             [](const PatchSurfaces& p) {
                               std::vector<Index> first;
                               for (Index i = 0; i <= p.patches().num_patches(); ++i)
                                 first.push_back(p.patches().first_face(i));
                               return array(std::move(first));
                             })
      .def(
          "with_points",
          [](const PatchSurfaces& p, const Array<double>& columns) {
            return std::make_shared<PatchSurfaces>(p.patches().with(points(columns)));
          },
          py::arg("columns"));
  m.def("tessellate", &tessellate_mesh, py::arg("mesh"), py::arg("request"), py::arg("chord"), py::arg("angle"),
        py::arg("most"), py::arg("rates"), py::arg("normals"), py::arg("threads"));
  m.def("curvatures", &curvatures, py::arg("du"), py::arg("dv"), py::arg("duu"), py::arg("duv"), py::arg("dvv"),
        py::arg("normals"), py::arg("status"), py::arg("order"));
}

}  // namespace sublimit::python
