// SPDX-License-Identifier: Apache-2.0
#pragma once
// Types that all of the library shares: indices, ids of mesh elements, matrices of points and of weights.
//
//   const Points control{{0, 0, 0}, {1, 0, 0}};  // a row for each point
//   SparseMatrix S(1, 2);                        // a row for each new point
//   S.insert(0, 0) = 0.5, S.insert(0, 1) = 0.5;
//   const Points middle = S * control;
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstdint>

namespace sublimit {

/// Numbers of points, faces, rows, ...: 32 bits.
using Index = std::int32_t;

/// Number of a vertex of a Topology.
enum class Vertex : Index {};
/// Number of an edge of a Topology.
enum class Edge : Index {};
/// Number of a face of a Topology.
enum class Face : Index {};
/// Number of a half-edge of a Topology: a corner of a face, which starts at that corner's vertex and runs to the next.
enum class HalfEdge : Index {};

/// Returns the number of an element, as arrays and matrices need it.
constexpr Index index(Vertex v) { return static_cast<Index>(v); }
constexpr Index index(Edge e) { return static_cast<Index>(e); }
constexpr Index index(Face f) { return static_cast<Index>(f); }
constexpr Index index(HalfEdge h) { return static_cast<Index>(h); }

/// Returned where there is no half-edge, as the twin on a boundary.
inline constexpr HalfEdge no_half_edge{-1};
/// True for the number of a half-edge, false for `no_half_edge`.
constexpr bool exists(HalfEdge h) { return index(h) >= 0; }

/// Points: one row per point, one column per coordinate.
using Points = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
/// Weights: each row is a stencil, the weights of one new point over the old ones, columns ascending.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, Index>;

}  // namespace sublimit
