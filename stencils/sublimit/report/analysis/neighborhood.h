// SPDX-License-Identifier: Apache-2.0
#pragma once
// One neighbourhood of a report: the behaviour of the surface at an isolated centre of some kind among regular
// points.
#include <memory>
#include <optional>
#include <vector>

#include "sublimit/certificates/c1/c1_certificate.h"
#include "sublimit/certificates/spectra/verdict.h"
#include "sublimit/report/analysis/scheme_report.h"
#include "sublimit/stencils/json/numbers.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit::report {

struct NeighborhoodKind {
  enum class Kind { vertex, face, border, crease, corner, dart };
  Kind kind = Kind::vertex;
  int n = 4;  ///< valence, corners of the face, or faces on this side

  std::string name() const;
};

/// Returns the neighbourhoods of a scheme: interior ones (and darts) of each valence, and open ones of 1 to some faces.
/// A side of a crease follows the boundary with as many faces.
std::vector<NeighborhoodKind> neighborhoods(const Scheme<double>& scheme, const std::vector<int>& valences);

/// Returns the type of the isolated centre of a neighbourhood. A dart has an open type, cut along its sharp
/// edge.
LocalType local_type(const NeighborhoodKind& kind);
/// Returns the exact local matrix of a neighbourhood; absent if the scheme has no such neighbourhood.
std::optional<LocalPatch<Algebraic>> local_patch(const Scheme<Algebraic>& scheme, const NeighborhoodKind& kind);

/// Data that the neighbourhoods of one scheme share.
struct SharedAnalysis {
  std::optional<C1Prover> prover;     ///< absent if the rules on regular meshes are not one mask
  std::shared_ptr<LimitCache> types;  ///< cache of its limit surfaces
};
SharedAnalysis shared_analysis(const ReportedScheme& scheme);

/// Returns the local matrix that verdicts refer to: for a closed centre with all rings that influence the
/// surface next to it.
/// @param mask  mask of regular meshes, or null
/// @return  absent if the scheme has no such neighbourhood
std::optional<LocalPatch<Algebraic>> analysed_patch(const Scheme<Algebraic>& scheme, const NeighborhoodKind& kind,
                                                    const RegularMask<Algebraic>* mask);

/// Returns the verdicts that the masks of a neighbourhood and their spectrum decide alone: affine invariance,
/// convergence and C^1 of a closed centre, or the tangent plane of an open one or a dart.
/// @param mask  mask of regular meshes, or null
/// @return  empty if the scheme has no such neighbourhood
std::vector<Verdict> spectral_verdicts(const Scheme<Algebraic>& scheme, const NeighborhoodKind& kind,
                                       const RegularMask<Algebraic>* mask);

/// Returns `rows` of a neighbourhood, exact properties of its weights. `keeps_centre` is null if no point is in
/// the centre.
Json rows_json(const LocalPatch<Algebraic>& patch);

/// Returns NEIGHBORHOOD; null if the scheme has no such neighbourhood.
/// @param drawn  true: include the limit surface of generic data
/// @note  The result for a side of a crease whose matrix is that of the boundary is only `same_as`, see
///        crease_json.
Json neighborhood(const ReportedScheme& scheme, const SharedAnalysis& shared, const NeighborhoodKind& kind, bool drawn);

/// Returns the results for a side of a crease whose matrix is that of the boundary.
Json crease_json(const Json& border);

}  // namespace sublimit::report
