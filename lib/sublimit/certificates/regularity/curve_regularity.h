// SPDX-License-Identifier: Apache-2.0
#pragma once
// A curve mask, analysed: what it generates and reproduces, how far a point reaches, how smooth the limits are, what a
// new point costs. All of it is computed from the symbol, exactly or with enclosures; samples of the basis function are
// for pictures.
#include <optional>
#include <string>
#include <vector>

#include "sublimit/certificates/regularity/smoothness.h"
#include "sublimit/certificates/regularity/symbol.h"

namespace sublimit {

struct PolynomialDegrees {
  int generates = -1;   ///< polynomials up to this degree are limits; -1: not even constants
  int reproduces = -1;  ///< and limits of their own values at the points
  /// Higher degrees than `generates` are not excluded: what the mask is divided by is sufficient, and necessary only
  /// where shifts of the basis function are independent.
  bool at_least = false;
  int approximation_order() const { return reproduces + 1; }
};

/// Points that enter a new point of one kind.
struct PointCost {
  std::string kind;
  int points = 0;
};

/// The limit of a single point of height 1, and its derivative (empty where there is none); floating numbers.
struct BasisSamples {
  std::vector<double> x, value, derivative;  ///< x in parameters of the control points, 0 at the point itself
};

struct [[nodiscard]] CurveRegularity {
  Symbol mask;
  int sum_rules = 0;             ///< (1+z)^sum_rules divides the symbol
  bool independent = false;      ///< integer shifts of the basis function are linearly independent (shown)
  Rational support[2] = {0, 0};  ///< of the basis function, in parameters of the control points
  PolynomialDegrees degrees;
  Smoothness smoothness;
  bool positive = false;  ///< no negative weights: the limit stays in the convex hull
  bool interpolates = false;
  std::vector<PointCost> costs;
  std::vector<Verdict> verdicts;  ///< affine invariance, convergence, smoothness
};

/// @param a  exact; its two masks should sum to 1, else that is what is reported
CurveRegularity curve_regularity(const Symbol& a, const JointSpectralRadiusOptions& options = {});

/// Returns whether the child of every point is the point itself, by the mask; in a Hermite scheme whatever its
/// derivative is.
/// @return  nothing where masks depend on the level, and some levels keep points and others do not
std::optional<bool> keeps_points(const CurveScheme<double>& scheme);

/// A scheme by name. Of a non-stationary one the masks that it settles to are analysed, in double precision: what was
/// proved of them is evidence for the scheme, and notes say so.
/// @return  nothing for Hermite schemes, whose symbols are matrices, and where there is no curve scheme of that name
/// @throws InvalidOption  as find_curve_scheme
/// @throws AnalysisError  masks that do not settle
std::optional<CurveRegularity> curve_regularity(const std::string& name, const SchemeOptions& options = {});

/// Transition matrices of the differences of order m.
/// @pre  m <= smoothing_factors(a)
DifferenceTransitions curve_transitions(const Symbol& a, int m);

/// Norms of the scheme of differences of order `order`, up to the number of steps where it falls below 1.
DifferenceNorm difference_norm(const Symbol& a, int order, int most_steps = 10);

/// @param levels  2^levels samples per edge
BasisSamples basis_samples(const Symbol& a, int levels = 5);

}  // namespace sublimit
