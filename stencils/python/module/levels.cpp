// SPDX-License-Identifier: Apache-2.0
// Refined meshes, their matrices, and the limits of their vertices.
#include <pybind11/stl.h>

#include <memory>

#include "arrays.h"
#include "calls.h"
#include "module.h"
#include "sublimit/base/error.h"
#include "sublimit/core/sparse_product.h"
#include "sublimit/jobs/refined_job.h"
#include "sublimit/limit/limit_points.h"

namespace sublimit::python {
namespace {

std::shared_ptr<ControlMesh> refine(const ControlMesh& mesh, const MeshRequest& request, int levels, bool tags,
                                    int threads) {
  const Threads held(threads);
  MeshJob job = mesh_job(request, mesh, "mesh");
  ControlMesh refined = refined_mesh(job, levels);
  return std::make_shared<ControlMesh>(tags ? std::move(refined) : without_tags(std::move(refined)));
}

SparseMatrix matrix(const ControlMesh& mesh, const MeshRequest& request, int levels, int threads) {
  const Threads held(threads);
  const MeshJob job = mesh_job(request, mesh, "mesh");
  return refinement_matrix(sublimit::refine(*job.scheme, job.mesh, levels, job.rules));
}

/// Limits of the vertices of a level, and their rows over the control points.
struct VertexLimits {
  Points points, normals, tangent1, tangent2;
  SparseMatrix position_rows, tangent1_rows, tangent2_rows;
  std::vector<Index> side_vertex, corner_side;
  std::vector<std::int8_t> status;
  std::vector<Index> sizes, corners;
};

std::unique_ptr<VertexLimits> limit(const ControlMesh& mesh, const MeshRequest& request, int level, int threads) {
  const Threads held(threads);
  const MeshJob job = mesh_job(request, mesh, "mesh");
  std::vector<Level> levels = sublimit::refine(*job.scheme, job.mesh, level, job.rules);
  LimitTypes types(*job.scheme);
  LimitMatrices rows = limit_matrices(levels, types);
  const SparseMatrix P = refinement_matrix(levels);
  const Topology& topology = levels.back().topology();
  const Points at_level = apply(P, job.mesh.positions);
  LimitPoints limits = limit_points(rows, topology, at_level);
  auto all = std::make_unique<VertexLimits>();
  all->tangent1 = apply(rows.tangent1, at_level);
  all->tangent2 = apply(rows.tangent2, at_level);
  product(rows.position, P).swap(all->position_rows);
  product(rows.tangent1, P).swap(all->tangent1_rows);
  product(rows.tangent2, P).swap(all->tangent2_rows);
  all->points.swap(limits.position);
  all->normals.swap(limits.normal);
  all->side_vertex.swap(rows.side_vertex);
  all->corner_side.swap(rows.corner_side);
  for (const LimitStatus status : limits.status) all->status.push_back(std::int8_t(status));
  for (Index f = 0; f < topology.num_faces(); ++f) {
    all->sizes.push_back(topology.size(Face{f}));
    const auto corners = topology.vertices(Face{f});
    all->corners.insert(all->corners.end(), corners.begin(), corners.end());
  }
  return all;
}

py::dict arrays(std::unique_ptr<VertexLimits> limits) {
  py::dict all;
  all["points"] = array(std::move(limits->points));
  all["normals"] = array(std::move(limits->normals));
  all["tangents"] = py::make_tuple(array(std::move(limits->tangent1)), array(std::move(limits->tangent2)));
  all["matrix"] = csr(std::move(limits->position_rows));
  all["tangent_matrices"] =
      py::make_tuple(csr(std::move(limits->tangent1_rows)), csr(std::move(limits->tangent2_rows)));
  all["side_vertex"] = array(std::move(limits->side_vertex));
  all["corner_side"] = array(std::move(limits->corner_side));
  all["status"] = array(std::move(limits->status));
  all["sizes"] = array(std::move(limits->sizes));
  all["corners"] = array(std::move(limits->corners));
  return all;
}

}  // namespace

void add_levels(py::module_& m) {
  std::vector<std::string> statuses;
  for (int i = 0; i < num_limit_statuses; ++i) statuses.emplace_back(name(LimitStatus(i)));
  m.attr("statuses") = py::tuple(py::cast(statuses));
  m.def("refine", &refine, py::arg("mesh"), py::arg("request"), py::arg("levels"), py::arg("tags"), py::arg("threads"),
        py::call_guard<LongCall>());
  m.def(
      "subdivision_matrix",
      [](const ControlMesh& mesh, const MeshRequest& request, int levels, int threads) {
        return csr(without_gil([&] { return matrix(mesh, request, levels, threads); }));
      },
      py::arg("mesh"), py::arg("request"), py::arg("levels"), py::arg("threads"));
  m.def(
      "limit",
      [](const ControlMesh& mesh, const MeshRequest& request, int level, int threads) {
        return arrays(without_gil([&] { return limit(mesh, request, level, threads); }));
      },
      py::arg("mesh"), py::arg("request"), py::arg("level"), py::arg("threads"));
}

}  // namespace sublimit::python
