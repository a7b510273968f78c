// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rules of the values of a face-varying channel, and the resulting sharpness.
#include <vector>

#include "sublimit/primvar/face_varying.h"

namespace sublimit {

/// Returns the rules at level 0.
/// @param values  topology of the channel, cut along its seams
/// @param is_cut  per half-edge of the mesh: true if its edge is a seam
std::vector<ValueRule> value_rules(const Level& mesh, const Topology& values, const std::vector<Index>& vertices,
                                   const std::vector<bool>& is_cut, FaceVaryingInterpolation interpolation);

/// Returns the rules after a split: values inherit them; new values on seams are border values.
std::vector<ValueRule> refine(const std::vector<ValueRule>& rules, const Topology& values, const Refinement& refinement,
                              FaceVaryingInterpolation interpolation);

/// Returns the sharpness of a channel from that of its mesh at the same level. With
/// FaceVaryingInterpolation::all only borders are sharp, since sharpness does not change linear masks.
Sharpness value_sharpness(const Topology& mesh, const Sharpness& sharpness, const Topology& values,
                          const std::vector<Index>& vertices, const std::vector<ValueRule>& rules,
                          FaceVaryingInterpolation interpolation);

}  // namespace sublimit
