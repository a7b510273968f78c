// SPDX-License-Identifier: Apache-2.0
#pragma once
// Conversion of patches of any kind to surfaces for CAD programs: B-splines with interpolated ends and positive
// weights, without jumps inside. It is exact up to rounding: other knots of the same surface, Bezier pieces of
// other bases, and three tensor-product patches for a triangle (a bilinear map of the square onto a third
// preserves polynomials).
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sublimit/patches/spline_surface.h"

namespace sublimit {

/// A patch with its control points and names.
struct NamedPatch {
  std::shared_ptr<const Patch> patch;
  Points columns;
  Coordinates coordinates = Coordinates::plain;
  std::string name = {};    ///< name of its faces; empty: none
  std::string place = {};   ///< its place for messages: "teapot.obj:12: patch 3"
  std::string no_net = {};  ///< possible reason why it is no B-spline, for messages
};

/// A converted patch.
struct ClampedPatch {
  SplineSurface surface;  ///< clamped; inner knots have at most multiplicity `degree`
  Points columns;
  size_t source = 0;  ///< index of the given patch that it is, or is a part of
};

/// Converted patches.
struct ClampedPatches {
  std::vector<ClampedPatch> patches;             ///< in the order of the sources
  Coordinates coordinates = Coordinates::plain;  ///< homogeneous if those of a source are
};

/// Returns patches with clamped knots. Clamped patches are returned unchanged; patches with jumps are cut
/// there. Spans with weights that are not positive are halved until all weights are.
/// @throws UnsupportedTopology  a patch that is no B-spline, of degree 0, or whose denominator is not positive
/// @throws InvalidParameter     columns of another size
ClampedPatches clamped_patches(std::span<const NamedPatch> patches);

}  // namespace sublimit
