// SPDX-License-Identifier: Apache-2.0
#pragma once
// Smoothness of the limit over a regular mesh, from the spectrum at one of its vertices.
#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// Returns the number of derivatives that the limit over a regular mesh has everywhere: 0, 1, or 2 for two and
/// more.
///
/// Around a regular vertex the eigenvectors of A have homogeneous limits, f(x/d) = lambda f(x), where a step
/// refines by a factor d; the degree k is given by |lambda| = d^-k. There are two linear and three quadratic
/// functions. Any other mode that decays as slowly has a kink at the vertex, or a jump of its second
/// derivatives. For limits made of polynomials this is exact, since every jump along an edge meets a vertex of
/// some level. For other limits it is an upper bound; it is right at the places of evaluation, which are
/// vertices of some level in floating-point numbers.
/// Source: Peters, Reif 2008, "Subdivision Surfaces", chapter 4.
///
/// The result is 0 if a regular vertex has no stationary neighbourhood.
int regular_smoothness(const Scheme<double>& scheme);

}  // namespace sublimit
