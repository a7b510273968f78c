// SPDX-License-Identifier: Apache-2.0
#pragma once
// Local subdivision matrices: they take the points of a vertex's neighbourhood to those of its child's
// neighbourhood. Assembled by the same code as S, on the unfolded patch.
#include <Eigen/Core>

#include <string>

#include "sublimit/base/error.h"
#include "sublimit/neighborhood/canonical_neighborhood.h"
#include "sublimit/scheme/detail/subdivision_matrix_impl.h"
#include "sublimit/splits/detail/child_sharpness.h"

namespace sublimit {

template <class T>
using DenseMatrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

/// One step at a vertex: child points = matrix * parent points, by the slots of `child` and of the parent.
template <class T>
struct LocalStep {
  CanonicalNeighborhood child;
  DenseMatrix<T> matrix;
};

/// Sparse form of LocalStep.
template <class T>
struct SparseStep {
  CanonicalNeighborhood child;
  SparseMatrixOf<T> matrix;
};

/// Returns the step of `scheme` at a neighbourhood. If the child has the same signature as its parent, the
/// matrix is square and the same on all later levels.
/// @param level  number of the parent level
/// @throws AnalysisError  a scheme of several steps, or rows that use points outside the neighbourhood
template <class T>
SparseStep<T> sparse_step(const Scheme<T>& scheme, const CanonicalNeighborhood& type, int level = 0) {
  if (scheme.steps.size() != 1)
    throw AnalysisError(scheme.name + ": local analysis of several steps at once is not known");
  const UnfoldedPatch patch = unfold(type);
  const Step<T>& step = scheme.steps[0];
  const Refinement refinement = refine(patch.topology, step.split);
  Sharpness sharpness = refine(patch.sharpness, patch.topology, refinement);
  const std::vector<Edge> edges = spoke_edges(type, patch.topology);
  for (size_t i = 0; i < edges.size(); ++i) {
    const Edge e = edges[i];
    const auto [first, second] = refinement.halves(patch.topology, patch.topology.half_edge(e));
    const HalfEdge far = patch.topology.tail(e) == Vertex{0} ? second : first;
    sharpness.edge[index(refinement.topology.edge(far))] = type.spokes[i].far_child;
  }
  const SparseMatrixOf<T> S =
      subdivision_matrix(scheme, step, patch.topology, refinement, patch.sharpness, sharpness, level);
  NeighborhoodAt child = neighborhood(refinement.topology, sharpness, refinement.child(Vertex{0}), true);

  SparseStep<T> result;
  result.matrix.resize(child.type.num_slots, type.num_slots);
  for (Index slot = 0; slot < child.type.num_slots; ++slot) {
    const Vertex v{child.vertices[slot]};
    const Index parent = refinement.parent(v);
    bool closed = false;
    switch (refinement.origin(v)) {
      case Refinement::Origin::vertex:
        closed = parent == 0;
        break;
      case Refinement::Origin::face:
        closed = true;
        break;
      case Refinement::Origin::edge:
        closed = patch.topology.tail(Edge{parent}) == Vertex{0} || patch.topology.head(Edge{parent}) == Vertex{0};
        break;
      default:
        break;
    }
    if (!closed)
      throw AnalysisError(scheme.name + ": the one-ring is not closed under refinement; more rings are needed");
    result.matrix.startVec(slot);
    for (typename SparseMatrixOf<T>::InnerIterator it(S, index(v)); it; ++it)
      result.matrix.insertBack(slot, it.col()) = it.value();
  }
  result.matrix.finalize();
  result.child = std::move(child.type);
  return result;
}

/// Returns the local matrix as a dense one.
template <class T>
LocalStep<T> local_step(const Scheme<T>& scheme, const CanonicalNeighborhood& type, int level = 0) {
  SparseStep<T> sparse = sparse_step(scheme, type, level);
  LocalStep<T> result;
  result.child = std::move(sparse.child);
  result.matrix.setZero(sparse.matrix.rows(), sparse.matrix.cols());
  for (Eigen::Index i = 0; i < sparse.matrix.rows(); ++i)
    for (typename SparseMatrixOf<T>::InnerIterator it(sparse.matrix, i); it; ++it)
      result.matrix(i, it.col()) = it.value();
  return result;
}

}  // namespace sublimit
