// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which rule each value of a face-varying channel follows, and how sharp that makes it.
#include <vector>

#include "sublimit/primvar/face_varying.h"

namespace sublimit {

/// Rules at level 0.
/// @param values  topology of the channel, cut along its seams
/// @param is_cut  per half-edge of the mesh: its edge is a seam
std::vector<ValueRule> value_rules(const Level& mesh, const Topology& values, const std::vector<Index>& vertices,
                                   const std::vector<bool>& is_cut, FaceVaryingInterpolation interpolation);

/// Rules one split on: inherited, and along seams those of a border.
std::vector<ValueRule> refine(const std::vector<ValueRule>& rules, const Topology& values, const Refinement& refinement,
                              FaceVaryingInterpolation interpolation);

/// Sharpness of a channel from that of its mesh at the same level. Under FaceVaryingInterpolation::all only borders are
/// sharp: no sharpness changes a linear mask.
Sharpness value_sharpness(const Topology& mesh, const Sharpness& sharpness, const Topology& values,
                          const std::vector<Index>& vertices, const std::vector<ValueRule>& rules,
                          FaceVaryingInterpolation interpolation);

}  // namespace sublimit
