// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits of centres that are not alone among regular points, nor ever will be, but have the same points around them after
// every period: two faces back to back under a dual scheme, for one. Positions only: what their tangents are is not known.
#include <optional>

#include "sublimit/limit/limit_rows.h"

namespace sublimit {

/// @return  nothing where the points around the centre change with the level, or their number grows
/// @throws AnalysisError  they repeat themselves, but do not converge
std::optional<LimitRows> stationary_rows(const Level& level, const Scheme<double>& scheme, const Centre& centre);

}  // namespace sublimit
