// SPDX-License-Identifier: Apache-2.0
#pragma once
// Analysis of curve masks: polynomials that are generated and reproduced, support, smoothness, and points per
// mask. All is computed from the symbol, exactly or with enclosures; only samples of the basis function, for
// pictures, are not.
#include <optional>
#include <string>
#include <vector>

#include "sublimit/certificates/regularity/smoothness.h"
#include "sublimit/certificates/regularity/symbol.h"

namespace sublimit {

/// Degrees of polynomials that a mask generates and reproduces.
struct PolynomialDegrees {
  int generates = -1;   ///< polynomials up to this degree are limits; -1: not even constants
  int reproduces = -1;  ///< polynomials up to this degree are limits of their own values at the points
  /// True if degrees above `generates` are not excluded: the factors of the mask are sufficient, but necessary
  /// only if shifts of the basis function are independent.
  bool at_least = false;
  int approximation_order() const { return reproduces + 1; }
};

/// Number of points in the mask of a kind of new point.
struct PointCost {
  std::string kind;
  int points = 0;
};

/// Samples of the basis function (the limit of a single point of height 1) and of its derivative (empty if it
/// does not exist), in floating-point numbers.
struct BasisSamples {
  std::vector<double> x, value, derivative;  ///< x in parameters of the control points, 0 at the point itself
};

/// Result of the analysis.
struct [[nodiscard]] CurveRegularity {
  Symbol mask;
  int sum_rules = 0;             ///< (1+z)^sum_rules divides the symbol
  bool independent = false;      ///< integer shifts of the basis function are linearly independent (proved)
  Rational support[2] = {0, 0};  ///< support of the basis function, in parameters of the control points
  PolynomialDegrees degrees;
  Smoothness smoothness;
  bool positive = false;  ///< no negative weights: the limit stays in the convex hull
  bool interpolates = false;
  std::vector<PointCost> costs;
  std::vector<Verdict> verdicts;  ///< affine invariance, convergence, smoothness
};

/// Returns the analysis of a symbol.
/// @param a  its two masks should sum to 1; otherwise the result only says so
CurveRegularity curve_regularity(const Symbol& a, const JointSpectralRadiusOptions& options = {});

/// Returns whether the child of every point is the point itself, according to the masks; in a Hermite scheme
/// for all derivatives.
/// @return  nothing where masks depend on the level, and some levels keep points and others do not
std::optional<bool> keeps_points(const CurveScheme<double>& scheme);

/// Returns the analysis of a scheme by name. For a non-stationary scheme the limit masks are analysed in double
/// precision: proofs for them are only evidence for the scheme, and notes say so.
/// @return  nothing for Hermite schemes, whose symbols are matrices, and if no curve scheme has this name
/// @throws InvalidOption  see find_curve_scheme
/// @throws AnalysisError  masks that do not converge
std::optional<CurveRegularity> curve_regularity(const std::string& name, const SchemeOptions& options = {});

/// Returns the transition matrices of the differences of order m.
/// @pre  m <= smoothing_factors(a)
DifferenceTransitions curve_transitions(const Symbol& a, int m);

/// Returns the smallest norm of the scheme of differences of order `order` over 1, 2, .. `most_steps` steps;
/// stops at the first norm below 1.
DifferenceNorm difference_norm(const Symbol& a, int order, int most_steps = 10);

/// Returns samples of the basis function.
/// @param levels  2^levels samples per edge
BasisSamples basis_samples(const Symbol& a, int levels = 5);

}  // namespace sublimit
