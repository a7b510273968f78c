// SPDX-License-Identifier: Apache-2.0
#pragma once
// Data for drawings of a neighbourhood: the characteristic map with images of parameter lines, eigenfunctions, a limit
// surface of generic data and the convergence of its normals.
#include <memory>

#include "sublimit/certificates/spectra/local_modes.h"
#include "sublimit/stencils/json/numbers.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit::report {

/// Returns `characteristic_map` of a neighbourhood; null if the leading mode is not in Fourier block 1.
/// @param pieces  types of the scheme's surfaces, shared between calls
Json characteristic_map_json(const std::shared_ptr<LimitCache>& pieces, const LocalModes& modes);
Json eigenfunctions_json(const LocalModes& modes);

/// `surface` and `normals` of an isolated neighbourhood of n sectors.
struct SampleSurface {
  Json surface, normals;
};
/// Returns the limit surface of generic data around a centre.
/// @param drawn  true: also make `surface`, which is large
/// @param dart   true: a closed fan whose first spoke is sharp, whatever `type.open` is
SampleSurface sample_surface(const std::shared_ptr<LimitCache>& pieces, const LocalType& type, bool drawn,
                             bool dart = false);

}  // namespace sublimit::report
