// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sparse matrices that are moved without memory being taken.
#include <Eigen/SparseCore>

namespace sublimit {

/// The elements of `m` in another matrix, for a move constructor: Eigen 3.4 copies where it could move, and even an
/// empty sparse matrix takes memory, which an object that is moved must not. `m` may then be assigned to or destroyed,
/// and nothing else.
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
