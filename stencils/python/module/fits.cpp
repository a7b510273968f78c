// SPDX-License-Identifier: Apache-2.0
// Control points whose limit passes through points, or near to them.
#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "arrays.h"
#include "calls.h"
#include "module.h"
#include "sublimit/stencils/jobs/detail/mesh_job.h"
#include "sublimit/sublimit.h"

namespace sublimit::python {
namespace {

using Vectors = std::optional<Array<double>>;

py::array_t<double> column(const Eigen::VectorXd& values) {
  return array(std::vector<double>(values.begin(), values.end()));
}

std::vector<double> weights(const Vectors& given) { return given ? vector(*given) : std::vector<double>(); }

/// @param normals  rows of not-a-number where there is none
py::dict fit_vertices(const Mesh& mesh, const MeshRequest& request, const Array<Index>& vertices,
                      const Array<double>& positions, const Vectors& normals, const Fairness& fairness,
                      std::pair<int, int> refinements, int threads) {
  std::vector<VertexTarget> targets;
  for (py::ssize_t i = 0; i < vertices.size(); ++i) {
    VertexTarget& target = targets.emplace_back();
    target.vertex = vertices.at(i);
    for (int c = 0; c < 3; ++c) target.position[c] = positions.at(i, c);
    if (!normals || std::isnan(normals->at(i, 0))) continue;
    target.normal = Eigen::Vector3d(normals->at(i, 0), normals->at(i, 1), normals->at(i, 2));
  }
  Fit found = without_gil([&] {
    const Threads held(threads);
    const MeshJob job = mesh_job(request, mesh, "mesh");
    return fit(job.mesh, *job.scheme, targets,
               {.fairness = fairness, .least_refinements = refinements.first, .most_refinements = refinements.second});
  });
  py::dict all;
  all["mesh"] = std::make_shared<Mesh>(std::move(found.mesh));
  all["solved"] = found.solved;
  all["why_not"] = found.why_not;
  all["refinements"] = found.refinements;
  all["position_error"] = column(found.position_error);
  all["normal_error"] = column(found.normal_error);
  return all;
}

py::dict fit_to_places(const Mesh& mesh, const MeshRequest& request, const Array<Index>& faces, const Array<double>& u,
                       const Array<double>& v, const Array<double>& values, const Vectors& weight,
                       const Fairness& fairness, const Array<Index>& pins, int threads) {
  PlaceTargets targets;
  for (py::ssize_t i = 0; i < faces.size(); ++i) targets.places.push_back({faces.at(i), u.at(i), v.at(i)});
  targets.values = points(values);
  targets.weights = weights(weight);
  ScatteredFitOptions options{.fairness = fairness};
  options.pins.vertices = vector(pins);
  ScatteredFit found = without_gil([&] {
    const Threads held(threads);
    const MeshJob job = mesh_job(request, mesh, "mesh");
    return fit_places(LimitSurface(job.mesh, *job.scheme), targets, options);
  });
  py::dict all;
  all["points"] = array(std::move(found.points));
  all["residuals"] = column(found.residuals);
  all["rms"] = found.rms;
  all["largest"] = found.largest;
  return all;
}

py::dict fit_to_cloud(const Mesh& mesh, const MeshRequest& request, const Array<double>& cloud, const Vectors& weight,
                      const Fairness& fairness, const std::vector<double>& schedule, const Array<Index>& pins,
                      int iterations, double tolerance, int threads) {
  CloudFitOptions options{.fairness = fairness, .schedule = schedule, .iterations = iterations, .tolerance = tolerance};
  options.pins.vertices = vector(pins);
  const Cloud near{points(cloud), weights(weight)};
  CloudFit found = without_gil([&] {
    const Threads held(threads);
    const MeshJob job = mesh_job(request, mesh, "mesh");
    return fit_cloud(LimitSurface(job.mesh, *job.scheme), near, options);
  });
  std::vector<double> rms;
  for (const CloudIteration& one : found.iterations) rms.push_back(one.rms);
  py::dict all;
  all["points"] = array(std::move(found.points));
  all["residuals"] = column(found.foot_points.distances);
  all["rms"] = rms.back();
  all["largest"] = found.iterations.back().largest;
  all["iterations"] = array(std::move(rms));
  all["converged"] = found.converged;
  return all;
}

}  // namespace

void add_fits(py::module_& m) {
  py::class_<Fairness>(m, "Fairness")
      .def(py::init([](double thin_plate, double membrane) {
             return Fairness{thin_plate, membrane};
           }),
           py::arg("thin_plate"), py::arg("membrane"));
  m.def("fit", &fit_vertices, py::arg("mesh"), py::arg("request"), py::arg("vertices"), py::arg("points"),
        py::arg("normals"), py::arg("fairness"), py::arg("refinements"), py::arg("threads"));
  m.def("fit_places", &fit_to_places, py::arg("mesh"), py::arg("request"), py::arg("face"), py::arg("u"), py::arg("v"),
        py::arg("values"), py::arg("weights"), py::arg("fairness"), py::arg("pins"), py::arg("threads"));
  m.def("fit_cloud", &fit_to_cloud, py::arg("mesh"), py::arg("request"), py::arg("points"), py::arg("weights"),
        py::arg("fairness"), py::arg("schedule"), py::arg("pins"), py::arg("iterations"), py::arg("tolerance"),
        py::arg("threads"));
}

}  // namespace sublimit::python
