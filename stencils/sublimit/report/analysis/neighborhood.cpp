// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/analysis/neighborhood.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "sublimit/analysis/eigen_structure.h"
#include "sublimit/base/error.h"
#include "sublimit/certificates/spectral_verdicts.h"
#include "sublimit/report/analysis/masks_json.h"
#include "sublimit/report/analysis/modes_json.h"
#include "sublimit/report/analysis/spectrum_json.h"

namespace sublimit::report {
namespace {

using Kind = NeighborhoodKind::Kind;

constexpr int spectrum_rings = 3;

LocalType local_type(const NeighborhoodKind& kind) {
  LocalType type{.faces = kind.n};
  switch (kind.kind) {
    case Kind::face:
      type.kind = Centre::Kind::face;
      break;
    case Kind::border:
    case Kind::crease:
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

std::vector<Verdict> verdicts(const ExactAnalysis& analysis, bool closed) {
  std::vector<Verdict> all{affine_invariance(analysis), convergence(analysis)};
  if (!closed) {
    all.push_back(tangent_plane(analysis));
    return all;
  }
  SecondOrderGiven given;
  const Verdict c1 = spectral_c1(analysis);
  all.push_back(c1);
  all.push_back(curvature(analysis, given));
  all.push_back(shapes(analysis, given));
  all.push_back(curvature_integrability(analysis, given));
  all.push_back(spectral_c2(analysis, given));
  return all;
}

}  // namespace

std::string NeighborhoodKind::name() const {
  constexpr const char* names[] = {"vertex", "face", "border", "crease", "corner", "dart"};
  return names[static_cast<int>(kind)];
}

std::vector<NeighborhoodKind> neighborhoods(const Scheme<double>& scheme, const std::vector<int>& valences) {
  std::vector<NeighborhoodKind> kinds;
  for (const int n : valences) kinds.push_back({scheme.is_dual() ? Kind::face : Kind::vertex, n});
  if (scheme.is_dual()) return kinds;
  // As many faces on a side as a vertex of the least valences has; more of them repeat the verdict.
  const int most = std::min(8, valences.empty() ? 0 : valences.back());
  for (int m = 1; m <= most; ++m) kinds.push_back({Kind::border, m});
  for (int m = 1; m <= std::min(most, 6); ++m) kinds.push_back({Kind::corner, m});
  return kinds;
}

Json neighborhood_json(const ReportedScheme& scheme, const NeighborhoodKind& kind, bool is_drawn) {
  const LocalType type = local_type(kind);
  const bool closed = kind.kind == Kind::vertex || kind.kind == Kind::face;
  const std::optional<LocalPatch<Algebraic>> patch = local_patch(scheme.exact, type);
  if (!patch) return nullptr;
  Json json{{"kind", kind.name()}, {"n", kind.n}, {"points", patch->slots.size()}, {"labels", Json::array()}};
  for (const SectorLabel& label : patch->labels) json["labels"].push_back(to_json(label));
  // Moduli below lambda^2 may come from rings that the limit itself does not need.
  const ExactAnalysis analysis = *exact_analysis(scheme.exact, type, closed ? spectrum_rings : -1);
  add_spectrum(json, analysis.spectrum);
  std::string why;
  json["masks"] = masks_json(scheme.scheme, &*patch, type, subdominant_in_field(analysis.spectrum), why);
  if (closed) {
    const std::optional<LocalModes> modes = local_modes(scheme.scheme, type);
    if (modes) {
      json["characteristic_map"] = characteristic_map_json(scheme.scheme, *modes);
      json["eigenfunctions"] = eigenfunctions_json(*modes);
    }
  }
  SampleSurface sample = sample_surface(scheme.scheme, type, is_drawn);
  json["surface"] = std::move(sample.surface);
  json["normals"] = std::move(sample.normals);
  json["verdicts"] = Json::array();
  for (const Verdict& verdict : verdicts(analysis, closed)) json["verdicts"].push_back(to_json(verdict));
  return json;
}

}  // namespace sublimit::report
