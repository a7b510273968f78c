// SPDX-License-Identifier: Apache-2.0
#pragma once
// Numbering of the points at corners of cells, with one place for each.
#include <utility>
#include <vector>

#include "sublimit/nets/place_numbers.h"

namespace sublimit {

/// Assigns consecutive numbers to corners of cells.
class CellVertices {
 public:
  explicit CellVertices(PlaceNumbers::Shared shared) : numbers_(std::move(shared)) {}
  /// @param parts  must outlive this
  explicit CellVertices(const LimitMap::Parts& parts) : numbers_(parts) {}
  explicit CellVertices(const LimitMap::Parts&&) = delete;

  /// Returns the number of a corner, a new one if it has none.
  Index add(Index address, const CellCorner& c) {
    const Index number = numbers_.add(address, c);
    if (number == std::ssize(places_)) places_.push_back(c.in(address));
    return number;
  }
  /// Returns the number of a corner, or -1 if it has none.
  Index find(Index address, const CellCorner& c) const { return numbers_.find(address, c); }
  const std::vector<Place>& places() const { return places_; }

 private:
  PlaceNumbers numbers_;
  std::vector<Place> places_;
};

}  // namespace sublimit
