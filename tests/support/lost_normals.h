// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where limits have no normal for generic control points: a table with reasons. Exact verdicts prove rows about centres
// that are their own children (certificates/c1/lost_normals_test.cpp); laws expect no normals there, and normals
// everywhere else.
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
  bool exact = true;    ///< exact verdicts prove it; otherwise they have evidence, and LimitMasks::Plane says it
  std::string why;
};

const std::vector<LostNormals>& lost_normals();

/// Whether some row is about this place.
bool has_no_normal(const Scheme<double>& scheme, const NormalPlace& place);

}  // namespace sublimit::testing
