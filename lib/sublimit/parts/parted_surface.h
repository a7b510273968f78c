// SPDX-License-Identifier: Apache-2.0
#pragma once
// Interface of surfaces for searches in space, implemented by limits of schemes (`PartedLimit`) and patches
// (`PartedPatches`).
#include <memory>
#include <string>
#include <vector>

#include "sublimit/nets/limit_cells.h"
#include "sublimit/nets/piece_parts.h"
#include "sublimit/source/linear_source.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit {

/// A surface with its points.
class PartedSurface {
 public:
  virtual ~PartedSurface() = default;
  PartedSurface(const PartedSurface&) = delete;
  PartedSurface& operator=(const PartedSurface&) = delete;

  virtual FaceCount faces() const = 0;
  /// Returns the evaluator of points, derivatives and normals. Thread-safe.
  virtual const BoundSource& samples() const = 0;
  /// Returns cells that cover the surface except for holes, by face. Searches start from them.
  virtual std::vector<LimitCell> cells() const = 0;
  /// Appends the parts of a face to `out`. Thread-safe.
  /// @param cutter  belongs to the calling thread
  virtual void find_parts(Index face, PieceParts& cutter, std::vector<PiecePart>& out) const = 0;
  /// Returns which face has no parts although it is no hole, and why; empty if all have.
  virtual std::string without_parts() const { return {}; }
  /// Returns why the surface does not bound a solid; empty if it does.
  virtual std::string why_not_closed() const = 0;

 protected:
  PartedSurface() = default;
};

/// A limit surface.
class PartedLimit : public PartedSurface {
 public:
  /// @throws InvalidParameter  points beyond 1e150
  explicit PartedLimit(const LimitSurface& surface);
  /// @param points  points of the map's level, #V x 3
  /// @throws InvalidParameter  points of another shape, or beyond 1e150
  PartedLimit(const LimitMap& map, const Points& points) : PartedLimit(LimitSurface(map, points)) {}
  FaceCount faces() const override { return surface_.faces(); }
  const BoundSource& samples() const override { return surface_; }
  std::vector<LimitCell> cells() const override { return limit_cells(surface_.map(), surface_.points()); }
  void find_parts(Index face, PieceParts& cutter, std::vector<PiecePart>& out) const override;
  std::string why_not_closed() const override;

 private:
  LimitSurface surface_;
  AddressPieces pieces_;
  int levels_;  // levels into which pieces are divided at once
};

}  // namespace sublimit
