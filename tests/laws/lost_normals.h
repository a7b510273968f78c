// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table of the places where limits have no normal for generic control points, with reasons. Exact verdicts
// prove the rows on centres that are their own children (certificates/c1/lost_normals_test.cpp). Laws expect no
// normals there, and normals everywhere else.
#include <string>
#include <vector>

#include "laws/laws.h"

namespace sublimit::testing {

struct LostNormals {
  enum class Where { inside, border, corner };
  std::string scheme;
  Where where;
  Index least, most;    ///< range of the number of faces at the vertex; most = 0: no upper bound
  bool before = false;  ///< true: faces at its ancestor vertex on level 0, since later levels cut faces off
  bool exact = true;    ///< true: proved exactly; false: evidence only, and LimitMasks::Plane
  std::string why;
};

const std::vector<LostNormals>& lost_normals();

/// Returns true if some row applies to this place.
bool has_no_normal(const Scheme<double>& scheme, const NormalPlace& place);

}  // namespace sublimit::testing
