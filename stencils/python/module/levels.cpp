// SPDX-License-Identifier: Apache-2.0
// Refined meshes, their levels and matrices, and the limits of their vertices.
#include <pybind11/stl.h>

#include <memory>

#include "arrays.h"
#include "calls.h"
#include "module.h"
#include "sublimit/limit/limit.h"
#include "sublimit/stencils/jobs/detail/refined_job.h"
#include "sublimit/sublimit.h"

namespace sublimit::python {
namespace {

std::shared_ptr<Mesh> refine(const Mesh& mesh, const MeshRequest& request, int levels, bool tags, int threads) {
  const Threads held(threads);
  MeshJob job = mesh_job(request, mesh, "mesh");
  Mesh refined = refined_mesh(job, levels);
  return std::make_shared<Mesh>(tags ? std::move(refined) : without_tags(std::move(refined)));
}

std::vector<Level> levels_of(const Mesh& mesh, const MeshRequest& request, int levels, int threads) {
  const Threads held(threads);
  const MeshJob job = mesh_job(request, mesh, "mesh");
  return sublimit::levels(job.mesh, *job.scheme, levels);
}

SparseMatrix matrix(const Mesh& mesh, const MeshRequest& request, int levels, int threads) {
  const Threads held(threads);
  const MeshJob job = mesh_job(request, mesh, "mesh");
  return sublimit::subdivision_matrix(job.mesh, *job.scheme, levels);
}

Limit limit(const Mesh& mesh, const MeshRequest& request, int levels, int threads) {
  const Threads held(threads);
  const MeshJob job = mesh_job(request, mesh, "mesh");
  return sublimit::limit(job.mesh, *job.scheme, {.levels = levels});
}

py::dict arrays(Level&& level) {
  const Topology& topology = level.topology();
  std::vector<Index> sizes, corners, holes;
  for (Index f = 0; f < topology.num_faces(); ++f) {
    sizes.push_back(topology.size(Face{f}));
    const auto vertices = topology.vertices(Face{f});
    corners.insert(corners.end(), vertices.begin(), vertices.end());
    if (size_t(f) < level.holes.size() && level.holes[size_t(f)]) holes.push_back(f);
  }
  py::dict all;
  all["number"] = level.number;
  all["S"] = csr(std::move(level.S));
  all["sizes"] = array(std::move(sizes));
  all["corners"] = array(std::move(corners));
  all["holes"] = array(std::move(holes));
  return all;
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
      "levels",
      [](const Mesh& mesh, const MeshRequest& request, int levels, int threads) {
        py::list all;
        for (Level& level : without_gil([&] { return levels_of(mesh, request, levels, threads); }))
          all.append(arrays(std::move(level)));
        return all;
      },
      py::arg("mesh"), py::arg("request"), py::arg("levels"), py::arg("threads"));
  m.def(
      "subdivision_matrix",
      [](const Mesh& mesh, const MeshRequest& request, int levels, int threads) {
        return csr(without_gil([&] { return matrix(mesh, request, levels, threads); }));
      },
      py::arg("mesh"), py::arg("request"), py::arg("levels"), py::arg("threads"));
  m.def(
      "limit",
      [](const Mesh& mesh, const MeshRequest& request, int levels, int threads) {
        return arrays(without_gil([&] { return limit(mesh, request, levels, threads); }));
      },
      py::arg("mesh"), py::arg("request"), py::arg("levels"), py::arg("threads"));
}

}  // namespace sublimit::python
