// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/analysis/neighborhood.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/certificates/spectra/dart.h"
#include "sublimit/certificates/spectra/for_all.h"
#include "sublimit/certificates/spectra/spectral_verdicts.h"
#include "sublimit/certificates/witness/witness.h"
#include "sublimit/limit/detail/eigen_structure.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/report/analysis/masks_json.h"
#include "sublimit/report/analysis/modes_json.h"
#include "sublimit/report/analysis/spectrum_json.h"
#include "sublimit/report/analysis/verdict_json.h"
#include "sublimit/scheme/detail/check_scheme.h"

namespace sublimit::report {
namespace {

using Kind = NeighborhoodKind::Kind;

constexpr int least_rings = 3;

using Answer = Verdict::Answer;

bool is_decided(const Verdict& v) { return v.answer == Answer::proved || v.answer == Answer::disproved; }

/// C^1 at a closed centre: proved with its map; where that does not work, what the spectrum alone decides, or what a
/// net of the map looks like.
Verdict c1_verdict(const ReportedScheme& scheme, const SharedAnalysis& shared, const ExactAnalysis& analysis, int n,
                   Json& map) {
  Verdict spectral = spectral_c1(analysis);
  if (shared.prover) {
    C1Certificate certificate = shared.prover->certify(n);
    if (certificate.proof && !map.is_null() && certificate.proof->regular == MapProof::Regular::yes)
      map["jacobian"] = {{"sign", 1},
                         {"least", drawn(certificate.proof->least.lower())},
                         {"greatest", drawn(certificate.proof->greatest.upper())},
                         {"by", "enclosure"}};
    Verdict& v = certificate.verdict;
    if (v.answer == Answer::proved) {
      v.because = "1 and lambda lead, and the characteristic map is regular and winds once";
      // Proofs by refined nets have no witness yet.
      if (shared.prover->pieces()) v.witness = c1_witness(scheme.scheme.name, certificate, *shared.prover->pieces());
    }
    if (is_decided(v)) return v;
  }
  if (is_decided(spectral) || spectral.answer == Answer::borderline || map.is_null() || map["jacobian"].is_null())
    return spectral;
  const int sign = map["jacobian"]["sign"];
  spectral.hypotheses.push_back({"the Jacobian determinant of the characteristic map is positive", sign == 1,
                                 Hypothesis::By::floating,
                                 "from " + map["jacobian"]["least"].dump() + " to " +
                                     map["jacobian"]["greatest"].dump() + " on samples of two rings"});
  spectral.answer = sign == 1 ? Answer::evidence_for : Answer::evidence_against;
  spectral.because +=
      sign == 1 ? "; the sampled characteristic map is regular" : "; the sampled characteristic map folds";
  return spectral;
}

/// What is known of the regular surface around, from its polynomial pieces.
SecondOrderGiven second_order(const SharedAnalysis& shared, const Verdict& c1) {
  SecondOrderGiven given;
  if (c1.answer == Answer::proved) given.c1.holds = true, given.c1.by = Hypothesis::By::enclosure;
  if (c1.answer == Answer::disproved) given.c1.holds = false, given.c1.by = Hypothesis::By::enclosure;
  if (c1.answer == Answer::evidence_for) given.c1.holds = true, given.c1.by = Hypothesis::By::floating;
  if (!shared.prover || !shared.prover->pieces()) return given;
  const int continuity = shared.prover->pieces()->continuity;
  given.bounded.by = given.continuous.by = Hypothesis::By::exact;
  given.bounded.holds = continuity >= 1;
  given.bounded.value = "polynomial pieces, C^" + std::to_string(continuity);
  given.continuous.holds = continuity >= 2;
  return given;
}

/// Faces on a side, as far as exact spectra of its points take no more than moments: they have the mirror as their only
/// symmetry.
int most_open_faces(const Scheme<double>& scheme, int valence) {
  constexpr size_t many_points = 30;
  int most = 0;
  while (most < std::min(8, valence)) {
    const auto next = sublimit::local_patch(scheme, {.faces = most + 1, .open = true});
    if (!next || (most > 0 && next->slots.size() > many_points)) break;
    ++most;
  }
  return most;
}

Json decided(const ForAll& all) { return all.holds() ? Json(*all.holds()) : Json(nullptr); }

/// Moduli below lambda^2 may come from rings that the limit itself does not need.
int analysed_rings(const RegularMask<Algebraic>* mask) {
  return std::max(least_rings, mask ? mask->recurrent_rings() : 0);
}

bool is_closed(const NeighborhoodKind& kind) { return kind.kind == Kind::vertex || kind.kind == Kind::face; }

/// What pictures show of a limit; nothing is drawn if some place of the picture has no limit.
struct Drawings {
  Json map, eigenfunctions;
  SampleSurface sample;
};
Drawings drawings(const ReportedScheme& scheme, const SharedAnalysis& shared, const NeighborhoodKind& kind,
                  bool is_drawn) {
  Drawings result;
  const LocalType type = local_type(kind);
  try {
    if (is_closed(kind))
      if (const std::optional<LocalModes> modes = local_modes(scheme.scheme, type)) {
        result.map = characteristic_map_json(shared.types, *modes);
        result.eigenfunctions = eigenfunctions_json(*modes);
      }
    result.sample = sample_surface(shared.types, type, is_drawn, kind.kind == Kind::dart);
  } catch (const AnalysisError&) {  // the verdicts say why
  }
  return result;
}

}  // namespace

LocalType local_type(const NeighborhoodKind& kind) {
  LocalType type{.faces = kind.n};
  switch (kind.kind) {
    case Kind::face:
      type.kind = Centre::Kind::face;
      break;
    case Kind::border:
    case Kind::crease:
    case Kind::dart:
      type.open = true;
      break;
    case Kind::corner:
      type.open = type.corner = true;
      break;
    default:
      break;
  }
  return type;
}

namespace {

template <class T>
std::optional<LocalPatch<T>> patch_of(const Scheme<T>& scheme, const NeighborhoodKind& kind) {
  if (kind.kind == Kind::dart) return dart_patch(scheme, kind.n);
  if (kind.kind == Kind::crease) return crease_patch(scheme, kind.n);
  return sublimit::local_patch(scheme, local_type(kind));
}

}  // namespace

std::optional<LocalPatch<Algebraic>> local_patch(const Scheme<Algebraic>& scheme, const NeighborhoodKind& kind) {
  return patch_of(scheme, kind);
}

std::optional<LocalPatch<Algebraic>> analysed_patch(const Scheme<Algebraic>& scheme, const NeighborhoodKind& kind,
                                                    const RegularMask<Algebraic>* mask) {
  if (!is_closed(kind)) return local_patch(scheme, kind);
  return sublimit::local_patch(scheme, local_type(kind), analysed_rings(mask));
}

std::vector<Verdict> spectral_verdicts(const Scheme<Algebraic>& scheme, const NeighborhoodKind& kind,
                                       const RegularMask<Algebraic>* mask) {
  std::optional<ExactAnalysis> analysis;
  if (is_closed(kind))
    analysis = exact_analysis(scheme, local_type(kind), analysed_rings(mask));
  else if (std::optional<LocalPatch<Algebraic>> patch = local_patch(scheme, kind))
    analysis = open_analysis(scheme, std::move(*patch));
  if (!analysis) return {};
  return {affine_invariance(*analysis), convergence(*analysis),
          is_closed(kind)           ? spectral_c1(*analysis)
          : kind.kind == Kind::dart ? dart_tangent_plane(*analysis)
                                    : tangent_plane(*analysis)};
}

Json rows_json(const LocalPatch<Algebraic>& patch) {
  ForAll weights, centre;
  for (Eigen::Index i = 0; i < patch.A.rows(); ++i) {
    const bool is_centre = patch.labels[static_cast<size_t>(i)] == SectorLabel{};
    for (Eigen::Index j = 0; j < patch.A.cols(); ++j) {
      const Algebraic& w = patch.A(i, j);
      if (is_centre) centre.look(i == j ? w.is_one() : w.is_zero());
      if (w.is_zero()) continue;
      const Ball value = w.real_enclosure();
      weights.look(certainly_positive(value)   ? std::optional(true)
                   : certainly_negative(value) ? std::optional(false)
                                               : std::nullopt);
    }
  }
  const std::optional<bool> sums = rows_sum_to_one(patch).holds;
  return {{"sum_to_one", sums ? Json(*sums) : Json(nullptr)},
          {"non_negative", decided(weights)},
          {"keeps_centre", decided(centre)}};
}

std::string NeighborhoodKind::name() const {
  constexpr const char* names[] = {"vertex", "face", "border", "crease", "corner", "dart"};
  return names[static_cast<int>(kind)];
}

std::vector<NeighborhoodKind> neighborhoods(const Scheme<double>& scheme, const std::vector<int>& valences) {
  std::vector<NeighborhoodKind> kinds;
  for (const int n : valences) kinds.push_back({scheme.is_dual() ? Kind::face : Kind::vertex, n});
  if (scheme.is_dual()) return kinds;
  if (scheme.sharpening == Sharpening::semi_sharp)
    for (const int n : valences) kinds.push_back({Kind::dart, n});
  const int most = most_open_faces(scheme, valences.empty() ? 0 : valences.back());
  for (int m = 1; m <= most; ++m) kinds.push_back({Kind::border, m});
  if (scheme.sharpening != Sharpening::boundary)
    for (int m = 1; m <= most; ++m) kinds.push_back({Kind::crease, m});
  for (int m = 1; m <= std::min(most, 6); ++m) kinds.push_back({Kind::corner, m});
  return kinds;
}

Json crease_json(const Json& border) {
  Json json;
  for (const auto& [key, value] : border.items()) {
    json[key] = key == "kind" ? Json("crease") : value;
    if (key == "n") json["same_as"] = "border";
  }
  return json;
}

SharedAnalysis shared_analysis(const ReportedScheme& scheme) {
  SharedAnalysis shared;
  try {
    shared.prover.emplace(scheme.exact);
  } catch (const AnalysisError&) {  // no mask of regular meshes: evidence is all there is
  }
  shared.types = std::make_shared<LimitCache>(scheme.scheme);
  return shared;
}

/// Checks that the masks in doubles have the weights of those in exact numbers, to rounding.
/// @throws InvalidParameter  a weight differs, or points that one of both does not reach
void check_alike(const ReportedScheme& scheme, const NeighborhoodKind& kind, const LocalPatch<Algebraic>& exact) {
  const std::optional<LocalPatch<double>> rounded = patch_of(scheme.scheme, kind);
  const Eigen::Index points = rounded ? rounded->A.rows() : 0;
  if (points != exact.A.rows())
    throw InvalidParameter(scheme.scheme.name + ": masks reach " + std::to_string(points) + " points in doubles and " +
                           std::to_string(exact.A.rows()) + " in exact numbers; a report needs the same masks in both");
  for (Eigen::Index i = 0; i < exact.A.rows(); ++i)
    for (Eigen::Index j = 0; j < exact.A.cols(); ++j) {
      const double weight = double(exact.A(i, j));
      if (std::abs(rounded->A(i, j) - weight) <= affine_rounding * std::max(1.0, std::abs(weight))) continue;
      throw InvalidParameter(scheme.scheme.name + ": a weight is " + format_number(rounded->A(i, j)) +
                             " in doubles and " + format_number(weight) +
                             " in exact numbers; a report needs the same masks in both");
    }
}

Json neighborhood(const ReportedScheme& scheme, const SharedAnalysis& shared, const NeighborhoodKind& kind,
                  bool is_drawn) {
  const LocalType type = local_type(kind);
  const bool closed = is_closed(kind);
  const bool is_dart = kind.kind == Kind::dart;
  const std::optional<LocalPatch<Algebraic>> patch = local_patch(scheme.exact, kind);
  if (!patch) return nullptr;
  check_alike(scheme, kind, *patch);
  Json json = {{"kind", kind.name()}, {"n", kind.n}};
  if (kind.kind == Kind::crease)
    if (const auto border = sublimit::local_patch(scheme.exact, type); border && is_same_matrix(*border, *patch)) {
      json["same_as"] = "border";
      return json;
    }
  json["points"] = patch->slots.size();
  json["labels"] = Json::array();
  for (const SectorLabel& label : patch->labels) json["labels"].push_back(to_json(label));
  const int rings = analysed_rings(shared.prover ? &shared.prover->mask() : nullptr);
  const ExactAnalysis analysis =
      closed ? *exact_analysis(scheme.exact, type, rings) : open_analysis(scheme.exact, *patch);
  json["rows"] = rows_json(analysis.patch);
  add_spectrum(json, analysis.spectrum);
  std::vector<Verdict> verdicts{affine_invariance(analysis), convergence(analysis)};
  const bool has_limit = verdicts.back().answer != Answer::disproved;
  std::string why;
  json["masks"] = is_dart && has_limit ? dart_masks_json(scheme.scheme, *patch, why)
                  : kind.kind == Kind::crease || !has_limit
                      ? Json(nullptr)  // those of the border are not a crease's own
                      : masks_json(scheme.scheme, &*patch, type, subdominant_in_field(analysis.spectrum), why);
  Drawings pictures;
  if (has_limit) pictures = drawings(scheme, shared, kind, is_drawn);
  Json& map = pictures.map;
  if (!pictures.eigenfunctions.is_null()) json["eigenfunctions"] = std::move(pictures.eigenfunctions);
  if (closed) {
    const Verdict c1 = c1_verdict(scheme, shared, analysis, kind.n, map);
    const SecondOrderGiven given = second_order(shared, c1);
    verdicts.insert(verdicts.end(), {c1, curvature(analysis, given), shapes(analysis, given),
                                     curvature_integrability(analysis, given), spectral_c2(analysis, given)});
  } else {
    verdicts.push_back(is_dart ? dart_tangent_plane(analysis) : tangent_plane(analysis));
  }
  json["characteristic_map"] = std::move(map);
  json["surface"] = std::move(pictures.sample.surface);
  json["normals"] = std::move(pictures.sample.normals);
  json["verdicts"] = Json::array();
  for (const Verdict& verdict : verdicts) json["verdicts"].push_back(to_json(verdict));
  return json;
}

}  // namespace sublimit::report
