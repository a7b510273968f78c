// SPDX-License-Identifier: Apache-2.0
#pragma once
// The status of a place: which position, derivatives and normal a surface or curve has there.
//
//   const LimitSamples samples = surface.evaluate({{.face = 0, .u = 0, .v = 0}}, 1);
//   if (!has_position(samples.status[0])) std::cerr << "no point: " << name(samples.status[0]) << "\n";

namespace sublimit {

/// The status of a place.
enum class LimitStatus {
  regular,           ///< smooth, of the scheme's regular valence
  extraordinary,     ///< smooth otherwise, darts included: characteristic tangents instead of natural derivatives
  unbounded_second,  ///< the second derivatives are unbounded or not continuous
  crease,            ///< on a crease, boundary or corner: tangents and normal are one-sided
  hole,              ///< all faces of this side are holes
  undefined_normal,  ///< there is no tangent plane, or these control points make it degenerate
  pole,              ///< no point: the denominator of a rational surface is 0
  outside,           ///< no point: the parameters are outside the domain
};
/// Number of different statuses.
constexpr int num_limit_statuses = int(LimitStatus::outside) + 1;
/// Returns the name of a status in files and messages, as "unbounded-second".
const char* name(LimitStatus status);
/// True if a place of this status has a point.
constexpr bool has_position(LimitStatus status) {
  return status != LimitStatus::outside && status != LimitStatus::pole;
}

}  // namespace sublimit
