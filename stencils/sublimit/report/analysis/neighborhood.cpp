// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/analysis/neighborhood.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "sublimit/analysis/eigen_structure.h"
#include "sublimit/base/error.h"
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
  const std::optional<LocalPatch<Algebraic>> wide =
      closed ? local_patch(scheme.exact, type, spectrum_rings) : local_patch(scheme.exact, type);
  const ExactSpectrum spectrum = exact_spectrum(*wide);
  add_spectrum(json, spectrum);
  std::string why;
  json["masks"] = masks_json(scheme.scheme, &*patch, type, subdominant_in_field(spectrum), why);
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
  return json;
}

}  // namespace sublimit::report
