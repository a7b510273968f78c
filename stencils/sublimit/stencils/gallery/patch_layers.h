// SPDX-License-Identifier: Apache-2.0
#pragma once
// Layers of the gallery's panels of classical surfaces: the surface, its control net, its data.
#include <functional>
#include <vector>

#include "sublimit/patches/constructions/spline_net.h"
#include "sublimit/source/linear_source.h"
#include "sublimit/stencils/gallery/patch_data.h"
#include "sublimit/stencils/picture/picture.h"

namespace sublimit::gallery {

/// A surface that can be sampled, whatever it is made of.
struct SampledSurface {
  FaceCount faces;
  /// Evaluates places, with normals.
  std::function<LimitSamples(const std::vector<Place>&)> at;
};

/// Grids of points on every face, some 800 squares in all; sides of faces as lines.
PictureMesh surface_layer(const SampledSurface& surface);

PictureMesh net_layer(const SplineNet& net);
/// The lattice of a triangle's control points (triangle_patch.h).
PictureMesh triangle_net_layer(Index degree, const Points& columns, Coordinates coordinates);

/// @param normal_length  of normals
PictureMesh data_layer(const PatchData& data, double normal_length);

/// Moves and scales what a panel shows so that it fills the same window as all others do.
void fit_window(std::vector<PictureMesh>& layers, const PictureOptions& view);

}  // namespace sublimit::gallery
