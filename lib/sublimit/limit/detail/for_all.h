// SPDX-License-Identifier: Apache-2.0
#pragma once
// Statements about every element of a set, as verdicts need them. Elements that were looked at are counted: where there
// was none the statement is not decided, so that nothing is ever proved of an empty set.
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace sublimit {

class ForAll {
 public:
  /// Takes the result of one element into account.
  /// @param holds  whether the statement holds of it; nothing if that is not decided
  /// @param where  names the element, for messages
  void look(std::optional<bool> holds, std::string where = {}) {
    ++looked_at_;
    if (holds == true) return;
    bool& known = holds ? fails_ : open_;
    if (!fails_ && !known) where_ = std::move(where);
    known = true;
  }

  /// True if elements were looked at and it holds of each; false if it fails for one; nothing if neither is known.
  std::optional<bool> holds() const {
    if (fails_) return false;
    if (open_ || looked_at_ == 0) return std::nullopt;
    return true;
  }
  std::int64_t looked_at() const { return looked_at_; }
  /// The first element that it fails for; if there is none, the first one that is not decided.
  const std::string& where() const { return where_; }

 private:
  std::int64_t looked_at_ = 0;
  bool fails_ = false, open_ = false;
  std::string where_;
};

/// Returns whether a condition holds of every element of a range: nothing of an empty one.
template <class Range, class Condition>
std::optional<bool> holds_for_all(const Range& range, const Condition& condition) {
  ForAll all;
  for (const auto& element : range) all.look(condition(element));
  return all.holds();
}

}  // namespace sublimit
