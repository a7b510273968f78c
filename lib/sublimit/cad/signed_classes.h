// SPDX-License-Identifier: Apache-2.0
#pragma once
// Classes of numbers that are found to belong together, and which of them are turned over beside others.
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sublimit {

class SignedClasses {
 public:
  explicit SignedClasses(std::size_t count = 0) {
    while (parent_.size() < count) add();
  }
  std::size_t size() const { return parent_.size(); }
  /// Adds an element in a class of its own.
  std::size_t add() {
    parent_.push_back(parent_.size());
    turned_.push_back(false);
    return parent_.size() - 1;
  }
  /// Returns the least element of the class of i, and whether i is reversed relative to it.
  std::pair<std::size_t, bool> find(std::size_t i) {
    bool turned = false;
    while (parent_[i] != i) {
      turned_[i] ^= turned_[parent_[i]];  // beside the one after next, which is next from now on
      parent_[i] = parent_[parent_[i]];
      turned ^= bool(turned_[i]);
      i = parent_[i];
    }
    return {i, turned};
  }
  /// @return  whether that agrees with what was known
  bool join(std::size_t i, std::size_t j, bool turned = false) {
    const auto [a, turned_a] = find(i);
    const auto [b, turned_b] = find(j);
    turned ^= turned_a ^ turned_b;
    if (a == b) return !turned;
    parent_[std::max(a, b)] = std::min(a, b);
    turned_[std::max(a, b)] = turned;
    return true;
  }

 private:
  std::vector<std::size_t> parent_;
  std::vector<char> turned_;
};

}  // namespace sublimit
