// SPDX-License-Identifier: Apache-2.0
#pragma once
// Patches of any kind as CAD programs have surfaces: B-splines with their ends interpolated, without jumps inside, of
// positive weights. All of it is exact up to rounding: other knots of the same surface, Bezier pieces of other bases,
// three tensor patches for a triangle (a bilinear map of the square onto a third of it keeps polynomials).
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sublimit/patches/spline_surface.h"

namespace sublimit {

struct NamedPatch {
  std::shared_ptr<const Patch> patch;
  Points columns;
  Coordinates coordinates = Coordinates::plain;
  std::string name = {};    ///< of its faces; empty: none
  std::string place = {};   ///< for messages: "teapot.obj:12: patch 3"
  std::string no_net = {};  ///< why it may be no B-spline, for messages
};

struct ClampedPatch {
  SplineSurface surface;  ///< clamped, inner knots at most `degree` times
  Points columns;
  size_t source = 0;  ///< the patch that it is, or is a part of
};

struct ClampedPatches {
  std::vector<ClampedPatch> patches;             ///< in the order of the sources
  Coordinates coordinates = Coordinates::plain;  ///< homogeneous if those of one source are
};

/// Returns patches with clamped knots. Patches whose knots are clamped stay as they are; those with jumps inside are
/// cut there. Where weights are not positive, spans are halved until they are.
/// @throws UnsupportedTopology  a patch that is no B-spline, of degree 0, or whose denominator is not positive
/// @throws InvalidParameter     columns of another size
ClampedPatches clamped_patches(std::span<const NamedPatch> patches);

}  // namespace sublimit
