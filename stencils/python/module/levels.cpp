// SPDX-License-Identifier: Apache-2.0
// Refined meshes, their matrices, and the limits of their vertices.
#include <pybind11/stl.h>

#include <memory>

#include "arrays.h"
#include "calls.h"
#include "module.h"
#include "sublimit/base/error.h"
#include "sublimit/jobs/refined_job.h"
#include "sublimit/limit/limit.h"

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

Limit limit(const ControlMesh& mesh, const MeshRequest& request, int level, int threads) {
  const Threads held(threads);
  const MeshJob job = mesh_job(request, mesh, "mesh");
  return sublimit::limit(job.mesh, *job.scheme, {.level = level});
}

py::dict arrays(Limit limit) {
  std::vector<std::int8_t> status;
  for (const LimitStatus one : limit.status) status.push_back(std::int8_t(one));
  py::dict all;
  all["points"] = array(std::move(limit.points));
  all["normals"] = array(std::move(limit.normals));
  all["tangents"] = py::make_tuple(array(std::move(limit.tangent1)), array(std::move(limit.tangent2)));
  all["matrix"] = csr(std::move(limit.matrix));
  all["tangent_matrices"] =
      py::make_tuple(csr(std::move(limit.tangent1_matrix)), csr(std::move(limit.tangent2_matrix)));
  all["side_vertex"] = array(std::move(limit.side_vertex));
  all["corner_side"] = array(std::move(limit.corner_side));
  all["status"] = array(std::move(status));
  all["sizes"] = array(std::move(limit.face_sizes));
  all["corners"] = array(std::move(limit.face_vertices));
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
