// SPDX-License-Identifier: Apache-2.0
#pragma once
// What lecture notes say of the schemes, and whether the numbers agree. No verdict is written down here: each is
// computed from measurements by a criterion that the gallery prints beside it.
#include <span>
#include <string>
#include <vector>

#include "sublimit/gallery/exhibit.h"

namespace sublimit::gallery {

struct Statement {
  std::string sentence;   ///< as the notes have it
  std::string criterion;  ///< when we call it confirmed
  std::string measured;   ///< the numbers that decide
  bool confirmed = false;
};

/// Statements that can be decided: whose schemes and cages are among `all`.
std::vector<Statement> statements(std::span<const Measured> all);

}  // namespace sublimit::gallery
