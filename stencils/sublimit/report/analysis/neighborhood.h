// SPDX-License-Identifier: Apache-2.0
#pragma once
// One neighbourhood of a report: what the surface is like at a centre of one kind, alone among regular points.
#include "sublimit/report/analysis/numbers.h"
#include "sublimit/report/analysis/scheme_report.h"

namespace sublimit::report {

struct NeighborhoodKind {
  enum class Kind { vertex, face, border, crease, corner, dart };
  Kind kind = Kind::vertex;
  int n = 4;  ///< valence, corners of the face, or faces on this side

  std::string name() const;
};

/// Those that a scheme has: of each valence the interior ones (and darts), of 1 to some faces the open ones.
std::vector<NeighborhoodKind> neighborhoods(const Scheme<double>& scheme, const std::vector<int>& valences);

/// @param drawn  with the limit surface of generic data
/// @return  NEIGHBORHOOD, or null where the scheme has no such place
Json neighborhood_json(const ReportedScheme& scheme, const NeighborhoodKind& kind, bool drawn);

}  // namespace sublimit::report
