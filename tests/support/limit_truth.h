// SPDX-License-Identifier: Apache-2.0
#pragma once
// The limit surface anywhere, as truth for tests: the faces around a place, refined in 256-bit floats until the place
// lies in a polynomial piece, whose spline is evaluated by recursion; without such pieces, until a face is smaller than
// what matters. No limit masks, no eigenvectors, no blocks of S; only `next_level` and `subset`.
#include "sublimit/source/address.h"
#include "sublimit/scheme/refine.h"
#include "support/brute_force.h"
#include "support/precise.h"

namespace sublimit::testing {

/// Rounding of values of polynomial pieces, relative to the points: 256 bits are 77 digits, refinements take some.
inline constexpr double exact_digits = 1e-60;

struct TruePoint {
  using Vector = Eigen::Matrix<Precise, Eigen::Dynamic, 1>;
  Vector position;  ///< one entry per column of the points
  Vector du, dv;    ///< per unit of the address
  Vector duu, duv, dvv;
  /// The dual schemes have no natural parameter beside irregular borders, but for the limits of bidegree 2 on level 0.
  bool has_position = true;
  /// One-sided ones on borders and creases, on the side of the face given. Not at irregular vertices.
  bool has_first = false;
  /// Not where they jump inside the square: between pieces of the C^1 schemes.
  bool has_second = false;
  bool is_exact = false;   ///< a polynomial piece: right to `exact_digits`
  double error = 0;        ///< else: the last change of the position, more than what is left
  double first_error = 0;  ///< and of the first derivatives
  int levels = 0;          ///< refinements that were taken
};

struct TruthOptions {
  int least_levels = 0;  ///< go on where a piece is found before, to compare
  int more_rings = 0;    ///< keep more faces around the place than are needed, to compare
  int most_levels = 160;
  // Where there is no piece:
  double accuracy = 1e-24;        ///< of positions, relative to the points
  double first_accuracy = 1e-14;  ///< of first derivatives, relative to themselves; infinity where they are not wanted
};

/// @param level   control level: its topology and sharpness; its number must be even for schemes of period 2
/// @param points  of the level
/// @throws InvalidParameter     an address that does not exist, or a place outside it
/// @throws UnsupportedTopology  as refinement does
TruePoint true_limit(const Scheme<Precise>& scheme, const Level& level, const Points& points, const Place& place,
                     const TruthOptions& options = {});

}  // namespace sublimit::testing
