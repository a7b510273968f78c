// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reference values of limit surfaces at any place. The faces around the place are refined in 256-bit floats
// until it is in a polynomial piece, whose spline is evaluated by recursion; without such pieces, until faces
// are smaller than the accuracy. Uses no limit masks, eigenvectors or blocks of S, only `next_level` and
// `subset`.
#include "sublimit/scheme/refine.h"
#include "sublimit/source/address.h"
#include "truth/brute_force.h"
#include "truth/precise.h"

namespace sublimit::testing {

/// Tolerance of values of polynomial pieces, relative to the points: 256 bits are 77 digits, of which
/// refinement loses some.
inline constexpr double exact_digits = 1e-60;

struct TruePoint {
  using Vector = Eigen::Matrix<Precise, Eigen::Dynamic, 1>;
  Vector position;  ///< one entry per column of the points
  Vector du, dv;    ///< per unit of the address
  Vector duu, duv, dvv;
  /// False for dual schemes next to irregular borders, where they have no natural parameter (except for limits
  /// of bidegree 2 on level 0).
  bool has_position = true;
  /// True if first derivatives exist: not at irregular vertices. On borders and creases they are one-sided, on
  /// the side of the given face.
  bool has_first = false;
  /// True if second derivatives exist: not where they jump inside the square, between pieces of C^1 schemes.
  bool has_second = false;
  bool is_exact = false;   ///< true in a polynomial piece: correct to `exact_digits`
  double error = 0;        ///< otherwise: last change of the position, an upper bound of its error
  double first_error = 0;  ///< the same of first derivatives
  int levels = 0;          ///< number of refinements
};

struct TruthOptions {
  int least_levels = 0;  ///< least number of refinements even if a piece is reached, to compare
  int more_rings = 0;    ///< additional rings of faces around the place, to compare
  int most_levels = 160;
  // For places without a polynomial piece:
  double accuracy = 1e-24;        ///< accuracy of positions, relative to the points
  double first_accuracy = 1e-14;  ///< relative accuracy of first derivatives; infinity: not needed
};

/// Returns the limit at a place.
/// @param level   control level, of which topology and sharpness are used; its number must be even for schemes
///                of period 2
/// @param points  points of the level
/// @throws InvalidParameter     an address that does not exist, or a place outside it
/// @throws UnsupportedTopology  as refinement does
TruePoint true_limit(const Scheme<Precise>& scheme, const Level& level, const Points& points, const Place& place,
                     const TruthOptions& options = {});

}  // namespace sublimit::testing
