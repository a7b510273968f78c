// SPDX-License-Identifier: Apache-2.0
#pragma once
// Points at corners of cells, by number, each with one of its places.
#include <vector>

#include "sublimit/nets/place_numbers.h"

namespace sublimit {

class CellVertices {
 public:
  /// @param parts  which must stay
  explicit CellVertices(const LimitMap::Parts& parts) : numbers_(parts) {}
  explicit CellVertices(const LimitMap::Parts&&) = delete;

  Index add(Index address, const CellCorner& c) {
    const Index number = numbers_.add(address, c);
    if (number == std::ssize(places_)) places_.push_back(c.in(address));
    return number;
  }
  /// Or -1.
  Index find(Index address, const CellCorner& c) const { return numbers_.find(address, c); }
  const std::vector<Place>& places() const { return places_; }

 private:
  PlaceNumbers numbers_;
  std::vector<Place> places_;
};

}  // namespace sublimit
