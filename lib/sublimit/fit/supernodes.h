// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which rows the columns of a Cholesky factor have, before it is made: neighbouring columns with (almost) the same rows
// are one supernode, a dense block, and supernodes form a forest in which work flows from the leaves to the roots.
// Sources: Liu 1990, "The role of elimination trees in sparse factorization"; Duff, Reid 1983, "The multifrontal
// solution of indefinite sparse symmetric linear equations".
#include <cstdint>
#include <vector>

#include "sublimit/types.h"

namespace sublimit {

struct Supernodes {
  std::vector<Index>
      order;  ///< new to old, filling in little; a parent comes after its children, subtrees in one piece
  std::vector<Index> inverse;            ///< old to new
  std::vector<Index> first;              ///< column of each supernode, and the end
  std::vector<Index> parent;             ///< of each supernode; -1 at roots
  std::vector<Index> first_descendant;   ///< the subtree of s is first_descendant[s] .. s
  std::vector<std::int64_t> rows_begin;  ///< of the rows below its own columns, and the end
  std::vector<Index> rows;               ///< ascending

  Index count() const { return Index(parent.size()); }
  Index width(Index s) const { return first[s + 1] - first[s]; }
  Index below(Index s) const { return Index(rows_begin[s + 1] - rows_begin[s]); }
  const Index* rows_of(Index s) const { return rows.data() + rows_begin[s]; }
  double entries() const;      ///< of all blocks
  double work(Index s) const;  ///< multiplications, about
};

/// @param M  symmetric, both halves stored
Supernodes supernodes(const SparseMatrix& M);

}  // namespace sublimit
