// SPDX-License-Identifier: Apache-2.0
#pragma once
// Surfaces with a known closed form, or from published data, as B-splines and as free-form shapes of a file.
#include <string>
#include <vector>

#include "sublimit/io/free_form.h"
#include "sublimit/patches/spline_surface.h"

namespace sublimit::testing {

/// A rational surface: homogeneous columns.
struct RationalShape {
  SplineSurface surface;
  Points columns;
};

/// Returns the unit sphere, biquadratic: the circle of nine points times half a circle (Piegl, Tiller 1997). du
/// x dv points outwards.
RationalShape unit_sphere();
/// Returns a torus with radii 3 and 1 about the z axis, biquadratic.
RationalShape torus();
/// Returns a pipe of radius 1/2 along x from 0 to 4, degrees 2 and 1.
RationalShape pipe();
/// Returns the shape with degrees elevated by one.
RationalShape elevated(const RationalShape& shape);

/// Returns the shapes as `rat bspline` surfaces of a file, each with its own vertices.
FreeForm free_form_of(const std::vector<RationalShape>& shapes);

/// Returns M. Newell's teapot (1975) as the 32 bicubic Bezier patches of GLUT: rim, body, lid, bottom, handle,
/// spout.
FreeForm teapot();

}  // namespace sublimit::testing
