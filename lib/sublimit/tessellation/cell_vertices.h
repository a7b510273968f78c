// SPDX-License-Identifier: Apache-2.0
#pragma once
// Numbers of points, by the numbers that faces share or, inside of one, by the place there.
#include <unordered_map>
#include <vector>

#include "sublimit/limit/limit_surface_parts.h"
#include "sublimit/limit/piece_parts.h"
#include "sublimit/limit/shared_places.h"

namespace sublimit {

class CellVertices {
 public:
  /// @param parts  which must stay
  explicit CellVertices(const LimitSurface::Parts& parts)
      : shared_(parts.level.topology(), parts.addresses, cell_steps, parts.scheme.is_dual()) {}

  Index add(Index address, const CellCorner& c) {
    const auto [at, is_new] = numbers_.try_emplace(key(address, c), static_cast<Index>(places_.size()));
    if (is_new) places_.push_back({address, double(c.i) / cell_steps, double(c.j) / cell_steps});
    return at->second;
  }
  /// Or -1.
  Index find(Index address, const CellCorner& c) const {
    const auto at = numbers_.find(key(address, c));
    return at == numbers_.end() ? -1 : at->second;
  }
  const std::vector<Sample>& places() const { return places_; }

 private:
  struct Key {
    std::int64_t address, number;  // no address: a shared number
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    size_t operator()(const Key& k) const {
      const auto mixed =
          static_cast<std::uint64_t>(k.number) * 0x9e3779b97f4a7c15u ^ static_cast<std::uint64_t>(k.address);
      return static_cast<size_t>(mixed ^ mixed >> 32);
    }
  };
  Key key(Index address, const CellCorner& c) const {
    if (const std::int64_t number = shared_.number(address, c.i, c.j); number != SharedPlaces::nobody)
      return {-1, number};
    return {address, std::int64_t{c.i} << 32 | c.j};
  }
  SharedPlaces shared_;
  std::unordered_map<Key, Index, Hash> numbers_;
  std::vector<Sample> places_;
};

}  // namespace sublimit
