// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/detail/sector_rows.h"

#include <algorithm>

namespace sublimit {
namespace {

/// Tarjan 1972, "Depth-first search and linear graph algorithms".
class Components {
 public:
  explicit Components(const std::vector<std::vector<Index>>& columns)
      : columns_(columns), order_(columns.size(), -1), low_(columns.size()), open_(columns.size()) {
    for (Index i = 0; i < std::ssize(columns); ++i)
      if (order_[i] < 0) visit(i);
  }
  std::vector<std::vector<Index>> found;

 private:
  void visit(Index i) {
    order_[i] = low_[i] = next_++;
    stack_.push_back(i);
    open_[i] = true;
    for (const Index j : columns_[i]) {
      if (order_[j] < 0) {
        visit(j);
        low_[i] = std::min(low_[i], low_[j]);
      } else if (open_[j]) {
        low_[i] = std::min(low_[i], order_[j]);
      }
    }
    if (low_[i] != order_[i]) return;
    const auto from = std::find(stack_.begin(), stack_.end(), i);
    found.emplace_back(from, stack_.end());
    stack_.erase(from, stack_.end());
    std::sort(found.back().begin(), found.back().end());
    for (const Index j : found.back()) open_[j] = false;
  }

  const std::vector<std::vector<Index>>& columns_;
  std::vector<Index> order_, low_, stack_;
  std::vector<bool> open_;
  Index next_ = 0;
};

}  // namespace

std::vector<std::vector<Index>> strong_components(const std::vector<std::vector<Index>>& columns) {
  return Components(columns).found;
}

}  // namespace sublimit
