// SPDX-License-Identifier: Apache-2.0
#pragma once
// The subdivision matrix of one step, x_{k+1} = S_k x_k, its rows filled from the masks. Most programs read it from a
// level that `refine` of scheme/refine.h makes:
//
//   const std::vector<Level> levels = refine(*AnyScheme("loop"), mesh, 1);
//   const SparseMatrixOf<double>& S = levels[1].S;
//   const Points finer = S * mesh.positions;
#include "sublimit/mesh/knot_intervals.h"
#include "sublimit/mesh/sharpness.h"
#include "sublimit/mesh/topology.h"
#include "sublimit/scheme/scheme.h"
#include "sublimit/splits/split.h"

namespace sublimit {

/// Weights in numbers of type T: each row is a stencil, columns ascending.
template <class T>
using SparseMatrixOf = Eigen::SparseMatrix<T, Eigen::RowMajor, Index>;

/// Returns the subdivision matrix of one step.
///
/// Row i holds the mask of child vertex i over the parent vertices, so x_child = S * x_parent.
/// @param scheme      creases; its steps contain `step`
/// @param step        masks and split; `step.split` is the split that produced `refinement`
/// @param parent      connectivity before the step, #V vertices
/// @param refinement  of `parent`; child order [from vertices | faces | edges]
/// @param sharpness   per edge and vertex of `parent`
/// @param child_sharpness  per edge and vertex after the step: `refine(sharpness, parent, refinement)`
/// @param level       of the parent, for masks that depend on it
/// @param knots       intervals and new knots of the parent's edges; null: all intervals are equal
/// @return  S, #V' x #V, rows sum to 1 up to rounding, columns of a row ascending
/// @throws ResourceError  more nonzeros than 32-bit indices, checked before memory is taken
/// @note  Deterministic: same build and input, same bytes, whatever the number of threads.
/// @note  T = double is compiled into the library; for other numbers include detail/subdivision_matrix_impl.h.
/// Source: Zorin, Schroeder et al., "Subdivision for Modeling and Animation", SIGGRAPH 2000 course notes.
template <class T>
SparseMatrixOf<T> subdivision_matrix(const Scheme<T>& scheme, const Step<T>& step, const Topology& parent,
                                     const Refinement& refinement, const Sharpness& sharpness,
                                     const Sharpness& child_sharpness, int level, const KnotSplit* knots = nullptr);

extern template SparseMatrixOf<double> subdivision_matrix(const Scheme<double>&, const Step<double>&, const Topology&,
                                                          const Refinement&, const Sharpness&, const Sharpness&, int,
                                                          const KnotSplit*);

}  // namespace sublimit
