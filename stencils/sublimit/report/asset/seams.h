// SPDX-License-Identifier: Apache-2.0
#pragma once
// Deviations of patches where they meet.
#include "sublimit/report/asset/seam_samples.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit::asset {

/// Measures the deviations at all seams.
/// @param surface   limit of the mesh
/// @param diagonal  diagonal of the bounding box of the control points
/// @param tick      called with the fraction of the work done
AssetSeams measure_seams(const SeamPlaces& places, const Topology& topology, const LimitSurface& surface,
                         double diagonal, const SeamTolerance& tolerance, Index listed,
                         const std::function<void(double)>& tick);

}  // namespace sublimit::asset
