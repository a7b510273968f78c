// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where limits have no normal for generic control points: a table with reasons. Exact verdicts prove each row
// (certificates/lost_normals_test.cpp), and laws expect normals everywhere else.
#include <string>
#include <vector>

#include "support/laws.h"

namespace sublimit::testing {

struct LostNormals {
  enum class Where { inside, border, corner };
  std::string scheme;
  Where where;
  Index least, most;    ///< faces at the vertex; 0: any more
  bool before = false;  ///< at the vertex of level 0 that it comes from: later levels cut faces off
  std::string why;
};

const std::vector<LostNormals>& lost_normals();

/// Whether some row is about this place.
bool has_no_normal(const Scheme<double>& scheme, const NormalPlace& place);

}  // namespace sublimit::testing
