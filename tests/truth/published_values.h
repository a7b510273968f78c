// SPDX-License-Identifier: Apache-2.0
#pragma once
// Published limit masks and eigenvalues of schemes by valence. Closed forms and tables are only here, and not
// in the library, which computes them from masks.
// Sources: Halstead, Kass, DeRose 1993; Loop 1987; Warren 1995; Doo, Sabin 1978; Peters, Reif 1997; Habib, Warren 1999;
// Zorin, Schroeder, Sweldens 1996; Zorin, Schroeder 2001; Kobbelt 1996, 2000; Labsik, Greiner 2000.
#include <optional>
#include <string>

#include "sublimit/scheme/scheme.h"

namespace sublimit::testing {

struct PublishedValues {
  double centre = 1;             ///< weight of a vertex in its limit, or of a corner in the limit of its face (dual)
  double border = 1;             ///< this weight for smooth border vertices, or for the ends of a border edge
  std::optional<double> lambda;  ///< largest modulus of block 1; absent if not published
  double lambda_accuracy;        ///< tolerance, by the number of printed digits
  int largest = 12;              ///< valence to compare at
};

/// Returns the values at valence n; absent for schemes without published values here.
std::optional<PublishedValues> published_values(const Scheme<double>& scheme, int n);

/// Checks the law that the scheme has published values and agrees with them. Returns the violation; empty if
/// there is none.
std::string published_values_hold(const Scheme<double>& scheme);

}  // namespace sublimit::testing
