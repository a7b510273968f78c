// SPDX-License-Identifier: Apache-2.0
#pragma once
// Points of limit surfaces by OpenSubdiv in double: by Far's patches and by Bfr's surfaces. They are exact in
// regular patches, and approximate around extraordinary vertices.
#include <memory>
#include <optional>

#include "peers/opensubdiv_reference.h"
#include "sublimit/source/address.h"

namespace sublimit::testing {

/// A point with its derivatives, per unit of the parameter of OpenSubdiv.
struct ReferencePoint {
  Eigen::Vector3d position, du, dv, duu, duv, dvv;
  bool regular = false;  ///< Far: in a regular patch, not an end cap; Bfr: the whole face is regular
  int depth = 0;         ///< Far: depth of the patch, whose side is 2^-depth of the control face's
};

/// Evaluation by Far: PatchTable, PatchMap and EvaluateBasis, from which its limit stencils are made, too.
class FarLimit {
 public:
  struct Options {
    int level = 10;  ///< isolation level
    bool inf_sharp_patches = false;
  };
  FarLimit(const Mesh& mesh, const ReferenceOptions& scheme, const Options& options);
  ~FarLimit();
  FarLimit(FarLimit&&) noexcept;

  /// Returns the limit at a place; absent in a hole. Squares of polygons have u and v half as long as ours, so
  /// that first derivatives are twice ours, second ones four times. The wrong sign of second derivatives in
  /// reversed triangles is corrected.
  std::optional<ReferencePoint> at(const Place& place) const;

  /// Returns positions by limit stencils, row by row; no place may be in a hole.
  Points by_stencils(const std::vector<Place>& places) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Evaluation by Bfr: a Surface per face.
class BfrLimit {
 public:
  struct Options {
    int smooth_level = 2, sharp_level = 6;  ///< defaults of Bfr; at most 10
  };
  BfrLimit(const Mesh& mesh, const ReferenceOptions& scheme, const Options& options);
  ~BfrLimit();
  BfrLimit(BfrLimit&&) noexcept;

  /// Returns the limit at Bfr's parameters of a control face; absent in a hole.
  std::optional<ReferencePoint> at(Index face, const BfrParameter& parameter) const;
  /// Returns the limit at a place of ours; derivatives in polygons differ as above.
  std::optional<ReferencePoint> at(const Place& place) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace sublimit::testing
