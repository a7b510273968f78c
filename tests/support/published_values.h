// SPDX-License-Identifier: Apache-2.0
#pragma once
// What texts say of schemes, as far as they say it: limit masks and eigenvalues by valence. Closed forms and tables are
// here and nowhere in the library, which computes them from masks.
// Sources: Halstead, Kass, DeRose 1993; Loop 1987; Warren 1995; Doo, Sabin 1978; Peters, Reif 1997; Habib, Warren 1999;
// Zorin, Schroeder, Sweldens 1996; Zorin, Schroeder 2001; Kobbelt 1996, 2000; Labsik, Greiner 2000.
#include <optional>
#include <string>

#include "sublimit/scheme/scheme.h"

namespace sublimit::testing {

struct PublishedValues {
  double centre = 1;             ///< weight of an interior vertex in its limit, or of a corner of a face in the face's
  double border = 1;             ///< the same of smooth border vertices, or of the ends of a border edge
  std::optional<double> lambda;  ///< the largest modulus of block 1; none where no text has it
  double lambda_accuracy;        ///< as many digits as the text prints
  int largest = 12;              ///< valence to compare at
};

/// At valence n; nothing: a scheme that no text here is about.
std::optional<PublishedValues> published_values(const Scheme<double>& scheme, int n);

/// A law: they hold, and there are some. Empty, or what is wrong.
std::string published_values_hold(const Scheme<double>& scheme);

}  // namespace sublimit::testing
