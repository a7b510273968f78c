// SPDX-License-Identifier: Apache-2.0
#pragma once
// Several curves as one linear source: segments and control points one curve after the other.
#include <memory>
#include <vector>

#include "sublimit/patches/linear_curve.h"

namespace sublimit {

class CurveSet : public CurveSource {
 public:
  /// @throws ResourceError  more segments or control points than 32-bit indices count
  explicit CurveSet(std::vector<std::shared_ptr<const LinearCurve>> curves);

  Index num_curves() const { return static_cast<Index>(curves_.size()); }
  const LinearCurve& curve(Index curve) const { return *curves_[size_t(curve)]; }
  Index first_segment(Index curve) const { return first_segment_[size_t(curve)]; }
  Index first_point(Index curve) const { return first_point_[size_t(curve)]; }
  Index num_segments() const override { return first_segment_.back(); }
  Index num_points() const override { return first_point_.back(); }
  CurveStencil stencil(const CurveSample& sample, int order = 0) const override;

 private:
  std::vector<std::shared_ptr<const LinearCurve>> curves_;
  std::vector<Index> first_segment_{0}, first_point_{0};  // by curve, and the end
};

}  // namespace sublimit
