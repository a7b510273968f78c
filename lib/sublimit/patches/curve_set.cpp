// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/curve_set.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {

CurveSet::CurveSet(std::vector<std::shared_ptr<const LinearCurve>> curves) : curves_(std::move(curves)) {
  constexpr std::int64_t most = std::numeric_limits<Index>::max();
  for (const auto& curve : curves_) {
    const std::int64_t segments = std::int64_t{first_segment_.back()} + curve->num_segments(),
                       points = std::int64_t{first_point_.back()} + curve->num_points();
    if (segments > most || points > most)
      throw ResourceError(format_number(curves_.size()) +
                          " curves: more segments or control points than 32-bit indices count");
    first_segment_.push_back(static_cast<Index>(segments));
    first_point_.push_back(static_cast<Index>(points));
  }
}

CurveStencil CurveSet::stencil(const CurvePlace& place, int order) const {
  check_place(place, num_segments());
  const auto curve =
      size_t(std::upper_bound(first_segment_.begin(), first_segment_.end(), place.segment) - first_segment_.begin()) -
      1;
  CurveStencil result = curves_[curve]->stencil({place.segment - first_segment_[curve], place.t}, order);
  for (Index& point : result.unknowns) point += first_point_[curve];
  return result;
}

}  // namespace sublimit
