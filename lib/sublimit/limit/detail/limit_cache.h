// SPDX-License-Identifier: Apache-2.0
#pragma once
// Cache of a scheme's limits by type of neighbourhood: each is computed when it is first needed. May be shared between
// meshes, surfaces and threads; its size depends on the number of types, not of vertices.
#include <memory>
#include <mutex>
#include <optional>

#include "sublimit/base/detail/found_once.h"
#include "sublimit/core/detail/signature_hash.h"
#include "sublimit/limit/detail/limit_masks.h"
#include "sublimit/neighborhood/piece_types.h"
#include "sublimit/scheme/check_scheme.h"

namespace sublimit {

class LimitCache {
 public:
  /// @param max_pieces  a surface that needs more types of pieces, when there are so many, keeps them for itself
  /// @throws InvalidParameter  a scheme that is not complete, as `check_scheme`
  explicit LimitCache(const Scheme<double>& scheme, size_t max_pieces = size_t(1) << 16)
      : scheme_(check_scheme(scheme)), pieces_(scheme, max_pieces) {}

  /// Limit masks of a vertex whose one-ring is all that they depend on. The reference stays valid as long as this.
  const LimitMasks& masks(const CanonicalNeighborhood& type);
  /// Limits of an isolated extraordinary centre; null if there are none.
  const IsolatedLimit* isolated(const LocalType& type);
  /// Returns the types of the pieces between vertices.
  PieceTypes& pieces() { return pieces_; }

  const Scheme<double>& scheme() const { return scheme_; }
  /// Throws unless this dictionary is of the scheme that made a level; looks at the masks once for each such scheme.
  /// @throws InvalidParameter  it is of another scheme
  void check(const Level& level);
  /// Skips the check for levels of the maker of this one.
  void trust(const Level& level);
  /// Types of vertices, faces and borders that are known.
  size_t num_types() const { return types_.size() + isolated_.size(); }

 private:
  Scheme<double> scheme_;
  PieceTypes pieces_;
  std::mutex made_by_mutex_;
  std::weak_ptr<const Scheme<double>> made_by_;  // of the level that was checked last
  FoundByKey<LocalType, std::optional<IsolatedLimit>> isolated_;
  FoundByKey<std::vector<std::uint32_t>, LimitMasks, SignatureHash> types_;
};

}  // namespace sublimit
