// SPDX-License-Identifier: Apache-2.0
#pragma once
// Union-find with signs: classes of numbers that belong together, each with a bit that says whether it is
// reversed relative to the representative of its class.
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
    reversed_.push_back(false);
    return parent_.size() - 1;
  }
  /// Returns the least element of the class of i, and whether i is reversed relative to it.
  std::pair<std::size_t, bool> find(std::size_t i) {
    bool reversed = false;
    while (parent_[i] != i) {
      reversed_[i] ^= reversed_[parent_[i]];  // relative to the grandparent, the new parent
      parent_[i] = parent_[parent_[i]];
      reversed ^= bool(reversed_[i]);
      i = parent_[i];
    }
    return {i, reversed};
  }
  /// Joins the classes of i and j.
  /// @param reversed  whether i is reversed relative to j
  /// @return  false if i and j were in one class already, with the other relation
  bool join(std::size_t i, std::size_t j, bool reversed = false) {
    const auto [a, reversed_a] = find(i);
    const auto [b, reversed_b] = find(j);
    reversed ^= reversed_a ^ reversed_b;
    if (a == b) return !reversed;
    parent_[std::max(a, b)] = std::min(a, b);
    reversed_[std::max(a, b)] = reversed;
    return true;
  }

 private:
  std::vector<std::size_t> parent_;
  std::vector<char> reversed_;
};

}  // namespace sublimit
