// SPDX-License-Identifier: Apache-2.0
#pragma once
// Numbers and ids shared by everything in lib.
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstdint>

namespace sublimit {

using Index = std::int32_t;

enum class Vertex : Index {};
enum class Edge : Index {};
enum class Face : Index {};
/// A half-edge is a corner of a face: it starts at that corner's vertex and runs to the next corner's.
enum class HalfEdge : Index {};

constexpr Index index(Vertex v) { return static_cast<Index>(v); }
constexpr Index index(Edge e) { return static_cast<Index>(e); }
constexpr Index index(Face f) { return static_cast<Index>(f); }
constexpr Index index(HalfEdge h) { return static_cast<Index>(h); }

inline constexpr HalfEdge no_half_edge{-1};
constexpr bool exists(HalfEdge h) { return index(h) >= 0; }

/// One row per point, one column per coordinate.
using Points = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
/// A row is a stencil: the weights of one new point over the old ones, columns ascending.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, Index>;

}  // namespace sublimit
