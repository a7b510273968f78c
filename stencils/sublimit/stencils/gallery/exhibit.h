// SPDX-License-Identifier: Apache-2.0
#pragma once
// One scheme on one cage: its first levels and its limit, as pictures and as numbers.
#include <string>
#include <vector>

#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/stencils/gallery/cages.h"
#include "sublimit/stencils/picture/picture.h"

namespace sublimit::gallery {

/// Measures of a limit. Lengths are relative to the cage's diameter.
struct Measured {
  std::string scheme, cage;
  int level = 0;                               ///< level whose vertices, moved to the limit, are measured
  Index faces = 0;                             ///< faces of that level
  double volume = 0;                           ///< volume, relative to the cage's
  double mean_distance = 0, max_distance = 0;  ///< distances of the limit from the control mesh
  double symmetry_defect = 0;                  ///< largest over all symmetries of the cage's points
  double roundness = 0;                        ///< least distance to the centre over the largest: 1 for a sphere
  struct Bending {
    int level = 0;
    Index faces = 0;
    double energy = 0;
  };
  /// Bending energy relative to a sphere's, on levels of about a sixteenth, a fourth and all of the faces.
  std::vector<Bending> bending = {};
};

struct Exhibit {
  Measured measured;
  std::vector<Panel> panels;  ///< levels 0, 1, ..., then the limit
  Panel small;                ///< the limit in fewer faces
};

struct ExhibitOptions {
  int levels = 3;      ///< number of levels drawn
  Index faces = 3000;  ///< least number of faces of the level that is measured and drawn as the limit
};

/// Refines a cage, draws and measures it.
/// @throws AnalysisError  the scheme has no limit
Exhibit exhibit(const Cage& cage, LimitCache& cache, const ExhibitOptions& options);

}  // namespace sublimit::gallery
