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
#include "sublimit/scheme/detail/check_scheme.h"

namespace sublimit {

/// Cache of one scheme's limits. Threads may share it.
class LimitCache {
 public:
  /// @param max_pieces  largest number of types of pieces in the cache; a surface that needs further types then
  ///                    stores them itself
  /// @throws InvalidParameter  an incomplete scheme (`check_scheme`)
  explicit LimitCache(const Scheme<double>& scheme, size_t max_pieces = size_t(1) << 16)
      : scheme_(check_scheme(scheme)), pieces_(scheme, max_pieces) {}

  /// Returns the limit masks of a vertex whose limit depends on its one-ring only. The reference is valid while
  /// this exists.
  /// @throws AnalysisError  no limit
  const LimitMasks& masks(const CanonicalNeighborhood& type);
  /// Returns the limit of an isolated extraordinary centre, or null if a centre of this type has no
  /// child of its own type.
  /// @throws AnalysisError  no limit
  const IsolatedLimit* isolated(const LocalType& type);
  /// Returns the types of the pieces between vertices.
  PieceTypes& pieces() { return pieces_; }

  const Scheme<double>& scheme() const { return scheme_; }
  /// Throws unless the scheme of this cache made a level. Compares masks only when the maker differs from that
  /// of the level checked last.
  /// @throws InvalidParameter  another scheme made it
  void check(const Level& level);
  /// Marks the maker of a level as checked: `check` accepts its levels without comparing masks.
  void trust(const Level& level);
  /// Returns the number of cached types of vertices, faces and borders.
  size_t num_types() const { return types_.size() + isolated_.size(); }

 private:
  Scheme<double> scheme_;
  PieceTypes pieces_;
  std::mutex made_by_mutex_;
  std::weak_ptr<const Scheme<double>> made_by_;  // maker of the level checked last
  FoundByKey<LocalType, std::optional<IsolatedLimit>> isolated_;
  FoundByKey<std::vector<std::uint32_t>, LimitMasks, SignatureHash> types_;
};

}  // namespace sublimit
