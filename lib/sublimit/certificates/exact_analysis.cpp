// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/exact_analysis.h"

#include <algorithm>
#include <map>

#include "sublimit/certificates/exact_masks.h"

namespace sublimit {
namespace {

struct Place {
  int x2 = 0, y2 = 0;  ///< in the chart of sector 0, doubled
};

/// Of a label, in the plane of its own regular centre: sector s is sector 0 turned s times.
Place in_plane(const SectorLabel& label, bool triangles) {
  Place p{label.x2, label.y2};
  for (int s = 0; s < label.sector; ++s) p = triangles ? Place{-p.y2, p.x2 + p.y2} : Place{-p.y2, p.x2};
  return p;
}

/// The other way round near an extraordinary centre, one sector to either side of sector 0.
std::optional<SectorLabel> label_at(Place p, int n, bool triangles, bool is_face) {
  const int least = is_face ? 1 : 0;
  if (p.x2 == 0 && p.y2 == 0) return SectorLabel{};
  if (p.x2 > 0 && p.y2 >= least) return SectorLabel{0, p.x2, p.y2};
  const int sum = triangles ? p.x2 + p.y2 : 0;
  if (p.x2 <= 0 && p.y2 > 0 && (!triangles || sum > 0)) return SectorLabel{1, triangles ? sum : p.y2, -p.x2};
  if (p.y2 < 0 && p.x2 > 0 && (!triangles || sum >= 0)) return SectorLabel{n - 1, -p.y2, triangles ? sum : p.x2};
  return std::nullopt;
}

}  // namespace

std::optional<ExactAnalysis> exact_analysis(const Scheme<Algebraic>& scheme, const LocalType& type, int rings) {
  std::optional<LocalPatch<Algebraic>> patch = local_patch(scheme, type, rings);
  if (!patch) return std::nullopt;
  ExactAnalysis analysis;
  analysis.scheme = scheme;
  analysis.patch = std::move(*patch);
  analysis.spectrum = exact_spectrum(analysis.patch);
  const bool is_face = scheme.is_dual();
  const LocalType regular{.kind = is_face ? Centre::Kind::face : Centre::Kind::vertex,
                          .faces = scheme.face_size() == 3 ? 6 : 4};
  try {
    if (const auto there = local_patch(scheme, regular)) {
      const std::vector<Algebraic> mask = exact_masks(*there).position;
      for (size_t i = 0; i < mask.size(); ++i)
        if (!mask[i].is_zero()) analysis.regular_mask.emplace_back(there->labels[i], mask[i]);
    }
  } catch (const AnalysisError&) {  // no limit there: nothing will be seen
  }
  return analysis;
}

std::vector<ComplexBall> mode(const ExactAnalysis& analysis, int block, const ExactKernel& kernel, int vector,
                              long bits) {
  const PrecisionScope scope(bits);
  const std::vector<ComplexBall> amplitudes = kernel.enclosure(vector, bits);
  std::vector<ComplexBall> values(analysis.patch.A.rows());
  const auto& orbits = analysis.spectrum.blocks.orbits.at(std::max(0, block));
  for (size_t i = 0; i < orbits.size(); ++i)
    for (size_t s = 0; s < orbits[i].size(); ++s)
      values[orbits[i][s]] =
          block > 0 ? amplitudes[i] * ComplexBall::root_of_unity(block * static_cast<long>(s), analysis.n())
                    : amplitudes[i];
  return values;
}

std::optional<bool> is_seen(const ExactAnalysis& analysis, const ExactEigenvalue& value) {
  if (analysis.n() < 3 || analysis.regular_mask.empty()) return std::nullopt;
  const ExactKernel kernel =
      exact_chain_ends(analysis.spectrum.blocks.blocks.at(value.block), value.value, value.largest_jordan());
  const bool triangles = analysis.scheme.face_size() == 3, is_face = analysis.patch.type.kind == Centre::Kind::face;
  std::map<SectorLabel, size_t> position;
  for (size_t i = 0; i < analysis.patch.labels.size(); ++i) position[analysis.patch.labels[i]] = i;
  const PrecisionScope scope(128);
  for (int v = 0; v < static_cast<int>(kernel.vectors.size()); ++v) {
    const std::vector<ComplexBall> values = mode(analysis, value.block, kernel, v);
    for (const Place centre : {Place{2, 0}, Place{2, 2}, Place{4, 0}, Place{4, 2}, Place{2, 4}, Place{4, 4}}) {
      ComplexBall limit;
      bool known = true;
      for (const auto& [label, weight] : analysis.regular_mask) {
        const Place offset = in_plane(label, triangles);
        const auto at = label_at({centre.x2 + offset.x2, centre.y2 + offset.y2}, analysis.n(), triangles, is_face);
        const auto found = at ? position.find(*at) : position.end();
        known = known && found != position.end();
        if (!known) break;
        limit += weight.enclosure() * values[found->second];
      }
      if (known && !limit.contains_zero()) return true;
    }
  }
  return std::nullopt;
}

}  // namespace sublimit
