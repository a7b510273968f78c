// SPDX-License-Identifier: Apache-2.0
#pragma once
// Numbers for places of cells, such that places of the same point of the surface have the same number.
#include <functional>
#include <unordered_map>
#include <utility>

#include "sublimit/nets/piece_parts.h"
#include "sublimit/surface/detail/limit_map_parts.h"
#include "sublimit/surface/detail/shared_places.h"

namespace sublimit {

/// Assigns consecutive numbers to places of cells.
class PlaceNumbers {
 public:
  /// Returns a number that all faces with a place have for it, or SharedPlaces::not_shared.
  using Shared = std::function<std::int64_t(Index address, const CellCorner& corner)>;
  explicit PlaceNumbers(Shared shared) : shared_(std::move(shared)) {}
  /// Numbers places of a limit surface: decided by connectivity, never by position.
  /// @param parts  must outlive this
  explicit PlaceNumbers(const LimitMap::Parts& parts)
      : shared_([places = SharedPlaces(parts.level.topology(), parts.addresses, cell_steps, parts.scheme.is_dual())](
                    Index address, const CellCorner& c) { return places.number(address, c.i, c.j); }) {}
  explicit PlaceNumbers(const LimitMap::Parts&&) = delete;

  /// Returns the number of a corner, a new one if it has none.
  Index add(Index address, const CellCorner& c) { return add(key(address, c)); }
  /// Returns the number of a place that is inside one cell only.
  /// @param which  number of the place in the cell
  Index add_inside(std::int64_t cell, int which) { return add(Key{-2 - cell, which}); }
  /// Returns the number of a corner, or -1 if it has none.
  Index find(Index address, const CellCorner& c) const {
    const auto at = numbers_.find(key(address, c));
    return at == numbers_.end() ? -1 : at->second;
  }
  Index size() const { return static_cast<Index>(numbers_.size()); }

 private:
  struct Key {
    std::int64_t owner, number;  // owner: an address; -1: `number` is shared; -2 - cell: a place inside a cell
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    size_t operator()(const Key& k) const {
      const auto mixed = static_cast<std::uint64_t>(k.number) * 0x9e3779b97f4a7c15u ^
                         static_cast<std::uint64_t>(k.owner) * 0xc2b2ae3d27d4eb4fu;
      return static_cast<size_t>(mixed ^ mixed >> 32);
    }
  };
  Index add(const Key& key) { return numbers_.try_emplace(key, size()).first->second; }
  Key key(Index address, const CellCorner& c) const {
    if (const std::int64_t number = shared_(address, c); number != SharedPlaces::not_shared) return {-1, number};
    return {address, std::int64_t{c.i} << 32 | c.j};
  }

  Shared shared_;
  std::unordered_map<Key, Index, Hash> numbers_;
};

}  // namespace sublimit
