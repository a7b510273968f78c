// SPDX-License-Identifier: Apache-2.0
#pragma once
// Several curves as one linear source: segments and control points are numbered one curve after the other.
//
//   const auto spline = std::make_shared<const SplineCurve>(Knots<double>::open(2, 4, {0, 0, 0, 1, 2, 2, 2}));
//   const CurveSet set({spline});
//   const Points control{{0, 0}, {1, 2}, {3, 2}, {4, 0}};
//   const CurveSamples samples = set.evaluate(control, std::vector<CurvePlace>{{.segment = 1, .t = 0.5}}, 1);
#include <memory>
#include <vector>

#include "sublimit/patches/linear_curve.h"

namespace sublimit {

/// Curves without control points. It never changes: threads may share it.
class CurveSet : public CurveSource {
 public:
  /// Makes a set of curves.
  /// @throws ResourceError  more segments or control points than 32-bit indices count
  explicit CurveSet(std::vector<std::shared_ptr<const LinearCurve>> curves);

  Index num_curves() const { return static_cast<Index>(curves_.size()); }
  const LinearCurve& curve(Index curve) const { return *curves_[size_t(curve)]; }
  Index first_segment(Index curve) const { return first_segment_[size_t(curve)]; }
  Index first_point(Index curve) const { return first_point_[size_t(curve)]; }
  Index num_segments() const override { return first_segment_.back(); }
  Index num_points() const override { return first_point_.back(); }
  CurveStencil stencil(const CurvePlace& place, int order = 0) const override;

 private:
  std::vector<std::shared_ptr<const LinearCurve>> curves_;
  std::vector<Index> first_segment_{0}, first_point_{0};  // by curve, and the end
};

}  // namespace sublimit
