// SPDX-License-Identifier: Apache-2.0
#pragma once
// Points of the limit surface as OpenSubdiv has them, in double: by Far's patches and by Bfr's surfaces. Exact where
// the patch is regular, and approximate around extraordinary vertices.
#include <memory>
#include <optional>

#include "sublimit/source/address.h"
#include "support/opensubdiv_reference.h"

namespace sublimit::testing {

/// A point with its derivatives, per unit of what the library holds to be the parameter.
struct ReferencePoint {
  Eigen::Vector3d position, du, dv, duu, duv, dvv;
  bool regular = false;  ///< of a regular patch, not of an end cap; Bfr: the whole face is one
  int depth = 0;         ///< of the patch: its side is 2^-depth of the control face's; Far only
};

/// Far: PatchTable, PatchMap and EvaluateBasis, which is what its limit stencils are made of.
class FarLimit {
 public:
  struct Options {
    int level = 10;  ///< of isolation
    bool inf_sharp_patches = false;
  };
  FarLimit(const Mesh& mesh, const ReferenceOptions& scheme, const Options& options);
  ~FarLimit();
  FarLimit(FarLimit&&) noexcept;

  /// Nothing in a hole. The squares of polygons of n sides have u and v half as long as ours: derivatives are twice
  /// ours, second ones four times. The sign of its second derivatives in triangles upside down is put right.
  std::optional<ReferencePoint> at(const Place& place) const;

  /// Positions by limit stencils, row by row; there must be none for holes.
  Points by_stencils(const std::vector<Place>& places) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Bfr: a Surface per face.
class BfrLimit {
 public:
  struct Options {
    int smooth_level = 2, sharp_level = 6;  ///< its defaults; 10 at most
  };
  BfrLimit(const Mesh& mesh, const ReferenceOptions& scheme, const Options& options);
  ~BfrLimit();
  BfrLimit(BfrLimit&&) noexcept;

  /// In Bfr's own parameters of a control face; nothing in a hole.
  std::optional<ReferencePoint> at(Index face, const BfrParameter& parameter) const;
  /// At ours; derivatives in polygons as above.
  std::optional<ReferencePoint> at(const Place& place) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace sublimit::testing
