// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/exact_schemes.h"
#include "sublimit/certificates/plane_mask.h"

#include <algorithm>
#include <optional>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

/// The mask, if all rows are the same one at this dilation.
std::optional<PlaneMask> mask_of(const LocalPatch<Algebraic>& patch, PlaneMask mask) {
  std::vector<LatticePoint> at;
  for (const SectorLabel& label : patch.labels) at.push_back(unrolled(label, mask.triangular));
  for (size_t i = 0; i < at.size(); ++i)
    for (size_t j = 0; j < at.size(); ++j) {
      const Algebraic& weight = patch.A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      const auto [known, is_new] = mask.weights.try_emplace(at[i] - mask.dilation * at[j], weight);
      if (!is_new && !(known->second == weight)) return std::nullopt;
    }
  std::erase_if(mask.weights, [](const auto& w) { return w.second.is_zero(); });
  return mask;
}

}  // namespace

const Algebraic& PlaneMask::operator()(LatticePoint offset) const {
  static const Algebraic zero;
  const auto found = weights.find(offset);
  return found == weights.end() ? zero : found->second;
}

LatticePoint PlaneMask::low() const {
  LatticePoint least = weights.begin()->first;
  for (const auto& [at, weight] : weights) least = {std::min(least.x2, at.x2), std::min(least.y2, at.y2)};
  return least;
}

LatticePoint PlaneMask::high() const {
  LatticePoint greatest = weights.begin()->first;
  for (const auto& [at, weight] : weights) greatest = {std::max(greatest.x2, at.x2), std::max(greatest.y2, at.y2)};
  return greatest;
}

int PlaneMask::recurrent_rings() const {
  // A point r rings away sees points (r + reach)/dilation away, which are further out only for r < reach/(dilation -
  // 1).
  const LatticePoint l = low(), h = high();
  const int reach2 = std::max({-l.x2, -l.y2, h.x2, h.y2}), steps = 2 * (dilation - 1);
  return (reach2 + steps - 1) / steps;
}

LatticePoint unrolled(const SectorLabel& label, bool triangular) {
  LatticePoint p{label.x2, label.y2};
  for (int s = 0; s < label.sector; ++s) p = triangular ? LatticePoint{-p.y2, p.x2 + p.y2} : LatticePoint{-p.y2, p.x2};
  return p;
}

PlaneMask plane_mask(const Scheme<Algebraic>& scheme) {
  PlaneMask mask{.triangular = scheme.face_size() == 3, .dual = scheme.is_dual()};
  const LocalType type{.kind = mask.dual ? Centre::Kind::face : Centre::Kind::vertex, .faces = mask.triangular ? 6 : 4};
  const auto patch = local_patch(scheme, type, mask.dual ? 2 : 3);
  if (patch)
    for (mask.dilation = 2; mask.dilation <= 3; ++mask.dilation)
      if (auto found = mask_of(*patch, mask)) return *found;
  throw AnalysisError(scheme.name + ": the rules of regular meshes are not one mask around a regular centre");
}

}  // namespace sublimit
