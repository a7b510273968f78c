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

#if EIGEN_MAX_ALIGN_BYTES != 16 || !EIGEN_MALLOC_ALREADY_ALIGNED
#error \
    "Eigen's allocation differs from the library's; compile with -DEIGEN_MAX_ALIGN_BYTES=16 -DEIGEN_MALLOC_ALREADY_ALIGNED=1, which linking sublimit::lib in CMake and pkg-config add"
#endif

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

/// Returns a matrix that has taken over the elements of `m`. Eigen 3.4 copies where it could move, and even its empty
/// sparse matrix takes memory, which a move constructor must not. Afterwards `m` may only be assigned to or destroyed.
template <class Matrix>
Matrix moved(Matrix& m) noexcept {
  Matrix result(m.markAsRValue());
  struct Mark : Matrix {
    static auto member() { return &Mark::m_isRValue; }
  };
  m.*Mark::member() = false;  // or the next copy of `m` would take its elements away
  return result;
}

}  // namespace sublimit
