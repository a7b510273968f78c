// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits of curves by refinement alone, in 256 bits: a window of points around a place is refined hundreds of times,
// and differences of its points are the derivatives.
#include <map>

#include "sublimit/curves/detail/curve_levels.h"
#include "support/precise_schemes.h"

namespace sublimit::testing {

/// Limit and derivatives per edge of the control polygon, where they exist.
struct CurveTruth {
  Precise position, first, second;
};

/// A curve of one coordinate, of a scheme without derivatives among its unknowns.
class CurveBruteForce {
 public:
  /// @param stationary  masks are the same at every level: they are made once
  CurveBruteForce(CurveScheme<Precise> scheme, Eigen::VectorXd values, bool closed, bool stationary = true);

  /// @param position  in half edges from the start of the limit (CurveLayout); what has too many digits for a double
  ///                  is the sum of two of them. Derivatives are those from behind, at the end those from before.
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
