// SPDX-License-Identifier: Apache-2.0
#pragma once
// Surfaces whose closed form is known, as B-splines and as the text of an OBJ file, made from published data.
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

/// |x| = 1, biquadratic: the circle of nine points times half a circle (Piegl, Tiller 1997). Outwards is du x dv.
RationalShape unit_sphere();
/// Radii 3 and 1 about z, biquadratic.
RationalShape torus();
/// Of radius 1/2 along x from 0 to 4, degrees 2 and 1: a swept circle.
RationalShape pipe();
/// One degree more in both directions.
RationalShape elevated(const RationalShape& shape);

/// As `rat bspline` surfaces of a file, each with vertices of its own.
FreeForm free_form_of(const std::vector<RationalShape>& shapes);

/// M. Newell's teapot (1975) in the 32 bicubic Bezier patches that GLUT draws: rim, body, lid, bottom, handle, spout.
FreeForm teapot();

}  // namespace sublimit::testing
