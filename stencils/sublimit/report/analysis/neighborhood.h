// SPDX-License-Identifier: Apache-2.0
#pragma once
// One neighbourhood of a report: what the surface is like at a centre of one kind, alone among regular points.
#include <memory>
#include <optional>
#include <vector>

#include "sublimit/certificates/c1/c1_certificate.h"
#include "sublimit/certificates/spectra/verdict.h"
#include "sublimit/report/analysis/scheme_report.h"
#include "sublimit/stencils/files/numbers.h"
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

/// The centre of such a neighbourhood, alone; that of a dart is open from its sharp edge to that edge.
LocalType local_type(const NeighborhoodKind& kind);
/// Returns the exact local matrix of a neighbourhood; absent if the scheme has no such neighbourhood.
std::optional<LocalPatch<Algebraic>> local_patch(const Scheme<Algebraic>& scheme, const NeighborhoodKind& kind);

/// Data that the neighbourhoods of one scheme share.
struct SharedAnalysis {
  std::optional<C1Prover> prover;     ///< none where the rules on regular meshes are not one mask
  std::shared_ptr<LimitCache> types;  ///< cache of its limit surfaces
};
SharedAnalysis shared_analysis(const ReportedScheme& scheme);

/// The local matrix that verdicts are about: of a closed centre with all rings that influence the surface next to it.
/// @param mask  of regular meshes, if there is one
/// @return  nothing where the scheme has no such place
std::optional<LocalPatch<Algebraic>> analysed_patch(const Scheme<Algebraic>& scheme, const NeighborhoodKind& kind,
                                                    const RegularMask<Algebraic>* mask);

/// Returns the verdicts that the masks of a neighbourhood and their spectrum decide alone: affine invariance,
/// convergence and C^1 of a closed centre, or the tangent plane of an open one or a dart.
/// @param mask  of regular meshes, if there is one
/// @return  none where the scheme has no such place
std::vector<Verdict> spectral_verdicts(const Scheme<Algebraic>& scheme, const NeighborhoodKind& kind,
                                       const RegularMask<Algebraic>* mask);

/// `rows` of a neighbourhood: what its weights show, exactly. `keeps_centre` is null where no point is in the centre.
Json rows_json(const LocalPatch<Algebraic>& patch);

/// NEIGHBORHOOD, or null where the scheme has no such place.
/// @param drawn  with the limit surface of generic data
/// @note  A side of a crease whose matrix is a border's is this one word, `same_as`: see crease_json.
Json neighborhood(const ReportedScheme& scheme, const SharedAnalysis& shared, const NeighborhoodKind& kind, bool drawn);

/// Returns the results for a side of a crease whose matrix is that of the boundary.
Json crease_json(const Json& border);

}  // namespace sublimit::report
