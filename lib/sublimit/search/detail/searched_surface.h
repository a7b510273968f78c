// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a search in space asks of a surface with its points, whatever it is: limits of schemes (`SearchedLimit`),
// patches (`SearchedPatches`).
#include <memory>
#include <string>
#include <vector>

#include "sublimit/nets/limit_cells.h"
#include "sublimit/nets/piece_parts.h"
#include "sublimit/surface/limit_surface.h"
#include "sublimit/source/linear_source.h"

namespace sublimit {

class SearchedSurface {
 public:
  virtual ~SearchedSurface() = default;
  SearchedSurface(const SearchedSurface&) = delete;
  SearchedSurface& operator=(const SearchedSurface&) = delete;

  virtual FaceCount faces() const = 0;
  /// Points, derivatives and normals; any thread may ask.
  virtual const BoundSource& samples() const = 0;
  /// Cells of all of it but holes, by faces: where searches begin.
  virtual std::vector<LimitCell> cells() const = 0;
  /// The parts that a face consists of are added to `out`; any thread may ask.
  /// @param cutter  of the calling thread
  virtual void find_parts(Index face, PieceParts& cutter, std::vector<PiecePart>& out) const = 0;
  /// A face that has no parts though it is no hole, and why; empty if all have.
  virtual std::string without_parts() const { return {}; }
  /// Why it bounds no solid; empty if it does.
  virtual std::string why_not_closed() const = 0;

 protected:
  SearchedSurface() = default;
};

class SearchedLimit : public SearchedSurface {
 public:
  /// @throws InvalidParameter  points beyond 1e150
  explicit SearchedLimit(const LimitSurface& surface);
  /// @param points  of the map's level, #V x 3
  /// @throws InvalidParameter  points that do not fit, or beyond 1e150
  SearchedLimit(const LimitMap& map, const Points& points) : SearchedLimit(LimitSurface(map, points)) {}
  FaceCount faces() const override { return surface_.faces(); }
  const BoundSource& samples() const override { return surface_; }
  std::vector<LimitCell> cells() const override { return limit_cells(surface_.map(), surface_.points()); }
  void find_parts(Index face, PieceParts& cutter, std::vector<PiecePart>& out) const override;
  std::string why_not_closed() const override;

 private:
  LimitSurface surface_;
  AddressPieces pieces_;
  int levels_;  // that are looked into at once
};

}  // namespace sublimit
