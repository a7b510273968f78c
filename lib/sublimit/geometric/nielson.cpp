// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/nielson.h"

#include "sublimit/geometric/patch_surface.h"

namespace sublimit {

GeometricNormalScheme nielson(const SchemeOptions& options) {
  GeometricNormalScheme scheme = patch_scheme(options);
  scheme.name = "nielson";
  scheme.source = "Nielson 1987, side-vertex interpolant, with cubics as long as arcs";
  scheme.surface = patch_surface<NielsonPatch<double>>;
  scheme.limit = patch_level<NielsonPatch<double>>;
  scheme.claims.limit = "rational blends of three cubics a triangle";
  return scheme;
}

}  // namespace sublimit
