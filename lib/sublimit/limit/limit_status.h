// SPDX-License-Identifier: Apache-2.0
#pragma once
// What there is at a point of a limit surface, in one word.

namespace sublimit {

enum class LimitStatus {
  regular,           ///< smooth, of the scheme's regular valence
  extraordinary,     ///< smooth otherwise, darts included: characteristic tangents instead of natural derivatives
  unbounded_second,  ///< the second derivatives are unbounded or not continuous
  crease,            ///< on a crease, boundary or corner: tangents and normal are one-sided
  hole,              ///< all faces of this side are holes
  undefined_normal,  ///< there is no tangent plane, or these control points make it degenerate
  pole,              ///< no point here: of a rational surface, its denominator is 0
  outside,           ///< the parameters are outside the domain
};
constexpr int num_limit_statuses = int(LimitStatus::outside) + 1;
/// The word of a status, as files and messages have it.
const char* name(LimitStatus status);
/// Whether there is a point at all.
constexpr bool has_position(LimitStatus status) {
  return status != LimitStatus::outside && status != LimitStatus::pole;
}

}  // namespace sublimit
