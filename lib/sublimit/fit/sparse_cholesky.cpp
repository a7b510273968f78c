// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/sparse_cholesky.h"

#include <algorithm>
#include <atomic>
#include <vector>

#include "sublimit/base/memory.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/fit/dense_front.h"
#include "sublimit/fit/supernodes.h"

namespace sublimit {
namespace {

/// Calls body(s) of every supernode, children before parents: subtrees with little work in parallel, then the rest.
template <class Body>
void towards_roots(const Supernodes& nodes, const std::vector<Index>& subtrees, const std::vector<Index>& top,
                   const Body& body) {
  parallel_for_blocks(
      std::int64_t(subtrees.size()),
      [&](std::int64_t i, std::int64_t, std::int64_t) {
        for (Index s = nodes.first_descendant[subtrees[i]]; s <= subtrees[i]; ++s) body(s);
      },
      1);
  for (const Index s : top) body(s);
}

}  // namespace

struct SparseCholesky::Factors {
  Supernodes nodes;
  std::vector<std::int64_t> begin;  // of the panel of every supernode, and the end
  std::vector<double> values;
  std::vector<Index> subtrees, top;
  std::vector<std::vector<Index>> children;
  std::atomic<bool> positive = true;

  Block panel(Index s) { return {values.data() + begin[s], nodes.width(s) + nodes.below(s), nodes.width(s)}; }

  /// Where the rows below child c are in the front of s.
  std::vector<Index> places(Index c, Index s) const {
    const Index *row = nodes.rows_of(c), *const last = row + nodes.below(c), end = nodes.first[s + 1];
    const Index* own = nodes.rows_of(s);
    std::vector<Index> result;
    result.reserve(nodes.below(c));
    for (; row != last; ++row) {
      if (*row < end) {
        result.push_back(*row - nodes.first[s]);
      } else {
        while (*own < *row) ++own;
        result.push_back(nodes.width(s) + Index(own - nodes.rows_of(s)));
      }
    }
    return result;
  }

  void plan() {
    const Index count = nodes.count();
    begin.assign(1, 0);
    children.resize(count);
    std::vector<double> work(count);
    double all = 0;
    for (Index s = 0; s < count; ++s) {
      begin.push_back(begin.back() + std::int64_t(nodes.width(s)) * (nodes.width(s) + nodes.below(s)));
      all += nodes.work(s);
      work[s] += nodes.work(s);
      if (nodes.parent[s] < 0) continue;
      work[nodes.parent[s]] += work[s];
      children[nodes.parent[s]].push_back(s);
    }
    const double little = all / 48;
    for (Index s = 0; s < count; ++s) {
      if (work[s] > little)
        top.push_back(s);
      else if (nodes.parent[s] < 0 || work[nodes.parent[s]] > little)
        subtrees.push_back(s);
    }
  }

  void factorise(const SparseMatrix& M) {
    std::vector<std::vector<double>> updates(nodes.count());
    towards_roots(nodes, subtrees, top, [&](Index s) {
      if (!positive) return;
      const Index width = nodes.width(s), below = nodes.below(s), first = nodes.first[s];
      updates[s].assign(std::size_t(below) * below, 0.0);
      Block front = panel(s), update(updates[s].data(), below, below);
      const Index *rows = nodes.rows_of(s), *const rows_end = rows + below;
      for (Index j = 0; j < width; ++j)
        for (SparseMatrix::InnerIterator e(M, nodes.order[first + j]); e; ++e) {
          const Index i = nodes.inverse[e.col()];
          if (i < first + j) continue;
          front(i < first + width ? i - first : width + (std::lower_bound(rows, rows_end, i) - rows), j) += e.value();
        }
      for (const Index c : children[s]) {
        const std::vector<Index> place = places(c, s);
        const Index size = Index(place.size());
        const double* from = updates[c].data();
        for (Index j = 0; j < size; ++j, from += size) {
          double* to = place[j] < width ? &front(0, place[j]) : &update(0, place[j] - width) - width;
          for (Index i = j; i < size; ++i) to[place[i]] += from[i];
        }
        std::vector<double>().swap(updates[c]);
      }
      if (!eliminate(front, update)) positive = false;
    });
  }

  void solve(Points& x) {
    const Index channels = Index(x.cols());
    std::vector<Eigen::MatrixXd> updates(nodes.count());
    towards_roots(nodes, subtrees, top, [&](Index s) {
      const Index width = nodes.width(s), below = nodes.below(s), first = nodes.first[s];
      Eigen::MatrixXd own = x.middleRows(first, width);
      Eigen::MatrixXd& update = updates[s];
      update.setZero(below, channels);
      for (const Index c : children[s]) {
        const std::vector<Index> place = places(c, s);
        for (Index k = 0; k < channels; ++k)
          for (size_t i = 0; i < place.size(); ++i)
            (place[i] < width ? own(place[i], k) : update(place[i] - width, k)) += updates[c](Index(i), k);
        updates[c].resize(0, 0);
      }
      const Block L = panel(s);
      L.topRows(width).triangularView<Eigen::Lower>().solveInPlace(own);
      update.noalias() -= L.bottomRows(below) * own;
      x.middleRows(first, width) = own;
    });
    const auto back = [&](Index s) {
      const Index width = nodes.width(s), below = nodes.below(s), first = nodes.first[s];
      const Index* rows = nodes.rows_of(s);
      Eigen::MatrixXd known(below, channels), own = x.middleRows(first, width);
      for (Index i = 0; i < below; ++i) known.row(i) = x.row(rows[i]);
      const Block L = panel(s);
      own.noalias() -= L.bottomRows(below).transpose() * known;
      L.topRows(width).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
      x.middleRows(first, width) = own;
    };
    for (auto s = top.rbegin(); s != top.rend(); ++s) back(*s);
    parallel_for_blocks(
        std::int64_t(subtrees.size()),
        [&](std::int64_t i, std::int64_t, std::int64_t) {
          for (Index s = subtrees[i]; s >= nodes.first_descendant[subtrees[i]]; --s) back(s);
        },
        1);
  }
};

SparseCholesky::SparseCholesky(const SparseMatrix& M) : factors_(std::make_unique<Factors>()) {
  Factors& f = *factors_;
  f.nodes = supernodes(M);
  // Fronts that wait for their parents take about as much again.
  check_memory("Cholesky factors of " + std::to_string(M.rows()) + " unknowns", 16 * f.nodes.entries(),
               "use the iterative method");
  f.plan();
  f.values.assign(std::size_t(f.begin.back()), 0.0);
  f.factorise(M);
}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

bool SparseCholesky::positive() const { return factors_->positive; }
double SparseCholesky::nonzeros() const { return double(factors_->begin.back()); }

Points SparseCholesky::solve(const Points& right) const {
  const std::vector<Index>& order = factors_->nodes.order;
  Points x(right.rows(), right.cols()), result(right.rows(), right.cols());
  for (size_t i = 0; i < order.size(); ++i) x.row(Eigen::Index(i)) = right.row(order[i]);
  factors_->solve(x);
  for (size_t i = 0; i < order.size(); ++i) result.row(order[i]) = x.row(Eigen::Index(i));
  return result;
}

}  // namespace sublimit
