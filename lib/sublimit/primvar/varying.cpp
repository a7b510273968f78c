// SPDX-License-Identifier: Apache-2.0
#include "sublimit/primvar/varying.h"

#include <numeric>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/primvar/linear_scheme.h"

namespace sublimit {
namespace {

void require_levels(std::span<const Level> levels) {
  if (levels.empty()) throw InvalidParameter("no levels; a refinement has at least level 0");
}

}  // namespace

SparseMatrix varying_matrix(const Scheme<double>& scheme, std::span<const Level> levels) {
  require_levels(levels);
  if (!keeps_elements(scheme.steps_at(0, levels[0].topology())))
    throw InvalidOption("varying values are linear along edges, which the split of " + scheme.name +
                        " does not keep; use vertex values, or a scheme that does: catmull-clark, loop");
  const Scheme<double> linear = linear_scheme(scheme);
  SparseMatrix P(levels[0].topology().num_vertices(), levels[0].topology().num_vertices());
  P.setIdentity();
  for (size_t k = 1; k < levels.size(); ++k) {
    const Topology* parent = &levels[k - 1].topology();
    const std::vector<Step<double>> steps = linear.steps_at(levels[k - 1].number, *parent);
    for (size_t i = 0; i < steps.size(); ++i) {
      const Refinement& refinement = levels[k].steps[i];
      Sharpness none, child_none;
      none.edge.assign(parent->num_edges(), infinite_sharpness);  // borders need no other side; the masks are the same
      none.vertex.assign(parent->num_vertices(), 0);
      child_none.edge.assign(refinement.topology.num_edges(), infinite_sharpness);
      child_none.vertex.assign(refinement.topology.num_vertices(), 0);
      const SparseMatrix S =
          subdivision_matrix(linear, steps[i], *parent, refinement, none, child_none, levels[k - 1].number);
      product(S, P).swap(P);
      parent = &refinement.topology;
    }
  }
  return P;
}

std::vector<Index> uniform_parents(std::span<const Level> levels) {
  require_levels(levels);
  std::vector<Index> parents(levels[0].topology().num_faces());
  std::iota(parents.begin(), parents.end(), 0);
  for (const Level& level : levels.subspan(1))
    for (const Refinement& step : level.steps) {
      std::vector<Index> children(step.topology.num_faces());
      for (size_t f = 0; f < children.size(); ++f) children[f] = parents[step.face_parent[f]];
      parents = std::move(children);
    }
  return parents;
}

SparseMatrix uniform_matrix(std::span<const Level> levels) {
  const std::vector<Index> parents = uniform_parents(levels);
  SparseMatrix P(static_cast<Index>(parents.size()), levels[0].topology().num_faces());
  P.reserve(Eigen::VectorXi::Ones(P.rows()));
  for (Index f = 0; f < P.rows(); ++f) P.insert(f, parents[f]) = 1;
  P.makeCompressed();
  return P;
}

}  // namespace sublimit
