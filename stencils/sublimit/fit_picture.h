// SPDX-License-Identifier: Apache-2.0
#pragma once
// A fit as a picture: what was given, what its limit would have been, and the limit that was fitted, with the targets
// as dots and their normals as needles.
#include <string>

#include "sublimit/fit/interpolate.h"

namespace sublimit {

struct FitPicture {
  Points targets;  ///< #targets x 3
  Points normals;  ///< #targets x 3, zero where there is none; or no rows
  std::string before, before_note, between, between_note, after, after_note;  ///< captions
};

/// @param given   the control mesh as it was, level 0, and its points
/// @param fitted  the level whose limit was fitted, and its points
std::string fit_picture(const Scheme<double>& scheme, const Level& given, const Points& given_points,
                        const Level& fitted, const Points& fitted_points, const FitPicture& words);

}  // namespace sublimit
