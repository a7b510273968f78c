// SPDX-License-Identifier: Apache-2.0
#pragma once
// Universally quantified statements for verdicts. Elements are counted: without any the statement is undecided,
// so that nothing is proved about an empty set by mistake.
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace sublimit {

/// Accumulator for a statement about every element of a set.
class ForAll {
 public:
  /// Adds the result for one element.
  /// @param holds  whether the statement holds for it; nothing if undecided
  /// @param where  name of the element, for messages
  void look(std::optional<bool> holds, std::string where = {}) {
    ++looked_at_;
    if (holds == true) return;
    bool& known = holds ? fails_ : open_;
    if (!fails_ && !known) where_ = std::move(where);
    known = true;
  }

  /// Returns true if the statement holds for all elements added and there are any, false if it fails for one,
  /// else nothing.
  std::optional<bool> holds() const {
    if (fails_) return false;
    if (open_ || looked_at_ == 0) return std::nullopt;
    return true;
  }
  /// Returns the number of elements added.
  std::int64_t looked_at() const { return looked_at_; }
  /// Returns the name of the first element for which the statement fails; if there is none, of the first
  /// undecided one.
  const std::string& where() const { return where_; }

 private:
  std::int64_t looked_at_ = 0;
  bool fails_ = false, open_ = false;
  std::string where_;
};

/// Returns whether a condition holds for every element of a range; nothing if the range is empty.
template <class Range, class Condition>
std::optional<bool> holds_for_all(const Range& range, const Condition& condition) {
  ForAll all;
  for (const auto& element : range) all.look(condition(element));
  return all.holds();
}

}  // namespace sublimit
