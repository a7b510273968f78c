// SPDX-License-Identifier: Apache-2.0
#pragma once
// REGULAR, SWEEP and CURVE of report.json.
#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/certificates/regularity/curve_joints.h"
#include "sublimit/certificates/regularity/surface_regularity.h"
#include "sublimit/certificates/regularity/sweep.h"
#include "sublimit/certificates/regularity/typed_mask.h"
#include "sublimit/stencils/json/numbers.h"

namespace sublimit::report {

Json to_json(const CurveRegularity& regularity);
Json to_json(const SurfaceRegularity& regularity);
/// Returns SWEEP. Values that the scheme does not accept are null in every series.
Json to_json(const Sweep& sweep);
/// Returns CURVE.
/// @throws InvalidMesh  as curve_joints
Json curve_json(const BezierCurve& curve, double tolerance = 1e-9);

/// Returns `regular` of a registered surface or curve scheme; null for Hermite schemes.
/// @throws InvalidOption  as find_scheme; no scheme of that name
Json regular_json(const std::string& scheme, const SchemeOptions& options = {});

/// Returns the results for a scheme that need not be registered; null if its regular mask has irrational weights.
Json regular_json(const Scheme<Algebraic>& scheme);

/// Returns SCHEME for a curve scheme, with verdicts on its claims.
/// @throws InvalidOption  no curve scheme of that name
Json curve_scheme_json(const std::string& scheme, const SchemeOptions& options = {});
/// Returns SCHEME for a mask given as text, which has no claims.
/// @throws InvalidOption  as typed_mask
Json mask_scheme_json(const std::string& mask);

}  // namespace sublimit::report
