// SPDX-License-Identifier: Apache-2.0
#include "sublimit/surface/detail/patch_tree.h"

namespace sublimit {
namespace {

constexpr int max_depth = 8;       // LimitPatches::Loop follows no more
constexpr size_t max_nodes = 600;  // a piece at a semi-sharp crease has about 2^sharpness patches: 200 kB then
/// Nodes times points: pieces of many points have fewer patches, else they would take gigabytes together.
constexpr size_t max_size = 20000;

/// Monomials of T_i(s) T_j(t): rows by (i, j) of the monomial.
RowMatrix monomials_of(const PolynomialBasis& basis) {
  const int n = basis.degree() + 1;
  RowMatrix T = RowMatrix::Zero(n, n);  // coefficient of s^row in T_column
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      if (i < 2)
        T(k, i) = k == i;
      else
        T(k, i) = (k > 0 ? 2 * T(k - 1, i - 1) : 0) - T(k, i - 2);
    }
  const auto numbered = [&](const auto& each) {
    for (int i = 0, at = 0; i < n; ++i)
      for (int j = 0; j < (basis.total() ? n - i : n); ++j, ++at) each(i, j, at);
  };
  RowMatrix M = RowMatrix::Zero(basis.size(), basis.size());
  numbered(
      [&](int i, int j, int row) { numbered([&](int k, int l, int column) { M(row, column) = T(i, k) * T(j, l); }); });
  return M;
}

/// Quadrilaterals in four, as their parent lies: the bits of the parameters tell the child.
bool in_four(const std::deque<PieceLink>& links) {
  if (links.size() != 4) return false;
  for (size_t i = 0; i < 4; ++i) {
    const PieceMap& map = links[i].map;
    const Span u = i == 1 || i == 2 ? Span::upper : Span::lower, v = i >= 2 ? Span::upper : Span::lower;
    if (map.is_triangle || map.axes[0].from != 0 || map.axes[1].from != 1 || map.axes[0].reversed ||
        map.axes[1].reversed || map.axes[0].span != u || map.axes[1].span != v || map.axes[0].scale != 2 ||
        map.axes[1].scale != 2)
      return false;
  }
  return true;
}

}  // namespace

PatchTree::PatchTree(const PieceType& type) {
  struct Open {
    const PieceType* type;
    int parent = -1;                    // node
    const PieceBlock* block = nullptr;  // from the parent's points; null: these are the root's
    int depth = 0;
  };
  const auto n = type.num_slots() - 1;
  std::vector<Open> open{{.type = &type}};
  if (type.kind() == Piece::Kind::cut) {  // the corner of a face, and the child that it becomes, are one square
    const PieceLink& only = type.children()[0];
    open[0] = {.type = only.type, .block = &only.block};
  }
  nodes_.emplace_back();
  const size_t most_nodes = std::min(max_nodes, max_size / size_t(n + 1));
  std::vector<RowMatrix> patches;
  RowMatrix monomials;
  for (size_t at = 0; at < nodes_.size(); ++at) {
    const Open here = open[at];  // a copy: `open` grows
    if (const PiecePolynomial* p = here.type->polynomial()) {
      if (p->basis.degree() > max_degree) continue;
      if (monomials.size() == 0) {
        monomials = monomials_of(p->basis);
        degree_ = p->basis.degree();
        total_ = p->basis.total();
        halves_ = p->coefficients.size() > 1;
        num_coefficients_ = p->basis.size();
      }
      nodes_[at].patch = static_cast<int>(patches.size());
      for (const RowMatrix& C : p->coefficients) {
        RowMatrix& M = patches.emplace_back(monomials * C);
        for (const Open* node = &here; node->block; node = &open[size_t(node->parent)]) {
          M = node->block->pulled_back(M);
          if (node->parent < 0) break;
        }
      }
      continue;
    }
    if (here.depth == max_depth || nodes_.size() + 9 > most_nodes || type.types().has_no_polynomials()) continue;
    if (here.type->children()[0].block.is_large()) continue;
    nodes_[at].first_child = static_cast<int>(nodes_.size());
    nodes_[at].links = &here.type->children();
    nodes_[at].in_four = in_four(here.type->children());
    for (const PieceLink& link : here.type->children()) {
      nodes_.emplace_back();
      open.push_back({link.type, static_cast<int>(at), &link.block, here.depth + 1});
    }
  }
  num_patches_ = static_cast<int>(patches.size());
  matrix_.resize(num_patches_ * num_coefficients_, n);
  for (int i = 0; i < num_patches_; ++i) matrix_.middleRows(i * num_coefficients_, num_coefficients_) = patches[i];
  find_cells();
}

void PatchTree::find_cells() {
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      Cell& cell = cells_[cells * j + i];
      for (int bit = cell_levels - 1; bit >= 0 && nodes_[cell.node].in_four; --bit) {
        const bool right = (i >> bit) & 1, up = (j >> bit) & 1;
        cell.node = static_cast<std::int16_t>(nodes_[cell.node].first_child + (right ? (up ? 2 : 1) : (up ? 3 : 0)));
        cell.size *= 2;
      }
      cell.patch = static_cast<std::int16_t>(nodes_[cell.node].patch);
    }
}

}  // namespace sublimit
