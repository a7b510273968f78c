// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a search in space asks of a surface with its points, whatever it is: limits of schemes (`SearchedLimit`),
// patches
// (`SearchedPatches`).
#include <memory>
#include <string>
#include <vector>

#include "sublimit/limit/limit_cells.h"
#include "sublimit/limit/linear_source.h"
#include "sublimit/limit/piece_parts.h"

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
  /// @param surface  which must stay
  /// @param points   of its level, #V x 3
  /// @throws InvalidParameter  points that do not fit
  SearchedLimit(const LimitSurface& surface, const Points& points);
  SearchedLimit(const LimitSurface&&, const Points&) = delete;
  FaceCount faces() const override { return surface_.faces(); }
  const BoundSource& samples() const override { return samples_; }
  std::vector<LimitCell> cells() const override { return limit_cells(surface_, points_); }
  void find_parts(Index face, PieceParts& cutter, std::vector<PiecePart>& out) const override;
  std::string why_not_closed() const override;

 private:
  const LimitSurface& surface_;
  Points points_;
  AddressPieces pieces_;
  BoundLimitSurface samples_;
  int levels_;  // that are looked into at once
};

}  // namespace sublimit
