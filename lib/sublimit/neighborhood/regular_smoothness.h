// SPDX-License-Identifier: Apache-2.0
#pragma once
// How smooth the limit over a regular mesh is, by the spectrum at one of its vertices.
#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// Derivatives that the limit over a regular mesh has everywhere: 0, 1, or 2 for two and more.
///
/// Around a regular vertex eigenvectors of A have homogeneous limits, f(x/d) = lambda f(x) where a step is finer by d:
/// of degree k where |lambda| = d^-k. The linear functions are two, the quadratic ones three; what decays as slowly and
/// is none of these has a kink there, or a jump of its second derivatives. For limits made of polynomials this decides:
/// every jump along an edge is seen at a vertex of some level. For others it is a bound from above, and an answer for
/// the places where limits are taken, which are vertices of some level to the last bit.
/// Source: Peters, Reif 2008, "Subdivision Surfaces", chapter 4.
///
/// 0 where a regular vertex has no spectrum: it is in no neighbourhood that repeats itself.
int regular_smoothness(const Scheme<double>& scheme);

}  // namespace sublimit
