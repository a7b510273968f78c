// SPDX-License-Identifier: Apache-2.0
#pragma once
// Experiments on polynomial curves and patches: joints, maps, interpolation.
#include "sublimit/report/statements/finding.h"

namespace sublimit::report {

/// "A curve that goes on with this factor of its tangent vector is G^2 there": a parabola, run through at another
/// speed from the joint on.
Finding joint_is_g2(double factor);

/// "A joint is continuous if the tangent vectors are dependent", and only then.
Finding continuity_needs_dependent_tangents();

/// "Curves are carried along by linear maps, and by no other": linear, affine and projective maps, of a Bezier curve
/// and of a rational one.
Finding only_linear_maps_commute();

/// "The tensor Lagrange patch has P_kl at (u_k, v_l)"; or at (u_k, u_l), with the nodes of one direction in both.
Finding lagrange_patch_interpolates(bool one_row_of_nodes);

/// "The bicubic Hermite patch approximates the points of its corners."
Finding hermite_patch_approximates();

/// "A bicubic patch has this many twist vectors at every corner."
Finding twists_at_a_corner(int twists);

}  // namespace sublimit::report
