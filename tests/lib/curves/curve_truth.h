// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits of curves by refinement only, in 256 bits: a window of points around a place is refined hundreds of
// times, and derivatives are differences of its points.
#include <map>

#include "sublimit/curves/detail/curve_levels.h"
#include "truth/precise_schemes.h"

namespace sublimit::testing {

/// Limit and derivatives per edge of the control polygon, where they exist.
struct CurveTruth {
  Precise position, first, second;
};

/// A curve with one coordinate, under a scheme that is not a Hermite scheme.
class CurveBruteForce {
 public:
  /// @param stationary  true: masks are equal at every level, and so computed once
  CurveBruteForce(CurveScheme<Precise> scheme, Eigen::VectorXd values, bool closed, bool stationary = true);

  /// Returns the limit at `position` + `more`.
  /// @param position  in half edges from the start of the limit (CurveLayout); a position with too many digits
  ///                  for one double is given as a sum of two. Derivatives are those from the right, at the end
  ///                  from the left
  CurveTruth at(double position, double more = 0);

 private:
  using Values = Eigen::Matrix<Precise, Eigen::Dynamic, 1>;
  Index last_before(const CurveOutline& curve, const Precise& shift, const Precise& place) const;
  const CurveMatrix<Precise>& matrix(const CurveOutline& curve, int level);

  CurveScheme<Precise> scheme_;
  CurveLayout layout_;
  Values values_;
  bool closed_, stationary_;
  std::map<std::pair<Index, int>, CurveMatrix<Precise>> matrices_;
};

}  // namespace sublimit::testing
