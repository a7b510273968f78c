// SPDX-License-Identifier: Apache-2.0
#pragma once
// Layers of the panels of classical surfaces: the surface, its control net, its data.
#include <functional>
#include <vector>

#include "sublimit/patches/constructions/spline_net.h"
#include "sublimit/source/linear_source.h"
#include "sublimit/stencils/gallery/patch_data.h"
#include "sublimit/stencils/picture/picture.h"

namespace sublimit::gallery {

/// A surface of any kind, for sampling.
struct SampledSurface {
  FaceCount faces;
  /// Evaluates places, with normals.
  std::function<LimitSamples(const std::vector<Place>&)> at;
};

/// Returns a surface as grids on its faces, about 800 squares in all, with the sides of faces as lines.
PictureMesh surface_layer(const SampledSurface& surface);

PictureMesh net_layer(const SplineNet& net);
/// Returns the lattice of a triangle's control points (triangle_patch.h).
PictureMesh triangle_net_layer(Index degree, const Points& columns, Coordinates coordinates);

/// Returns the layer of a surface's data.
/// @param normal_length  length of drawn normals
PictureMesh data_layer(const PatchData& data, double normal_length);

/// Moves and scales the layers of a panel so that all panels fill the same window.
void fit_window(std::vector<PictureMesh>& layers, const PictureOptions& view);

}  // namespace sublimit::gallery
