// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/piper.h"

#include "sublimit/geometric/patch_surface.h"

namespace sublimit {

GeometricNormalScheme piper(const SchemeOptions& options) {
  GeometricNormalScheme scheme = patch_scheme(options);
  scheme.name = "piper";
  scheme.source = "Piper 1987; Shirman, Sequin 1987; spokes are cubics";
  scheme.surface = patch_surface<PiperPatch<double>>;
  scheme.limit = patch_level<PiperPatch<double>>;
  scheme.claims.limit = "three quartic Bezier triangles a triangle";
  return scheme;
}

}  // namespace sublimit
