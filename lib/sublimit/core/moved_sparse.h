// SPDX-License-Identifier: Apache-2.0
#pragma once
// Moves Eigen's sparse matrices without taking memory, for the move constructors of classes that hold one:
//
//   struct Level {
//     SparseMatrix S;
//     Level(Level&& other) noexcept : S(moved(other.S)) {}
//   };
#include <Eigen/SparseCore>

namespace sublimit {

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
