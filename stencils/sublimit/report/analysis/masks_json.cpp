// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/analysis/masks_json.h"

#include <cmath>

#include "sublimit/analysis/limit_masks.h"

namespace sublimit::report {
namespace {

/// Entries that are not zero; what rounding left of zeros is left out too.
Json mask_json(const std::vector<SectorLabel>& labels, const Eigen::VectorXd& mask,
               const std::vector<Algebraic>* exact) {
  Json json = Json::array();
  const double scale = mask.size() > 0 ? mask.cwiseAbs().maxCoeff() : 0;
  for (size_t i = 0; i < labels.size(); ++i) {
    const double weight = mask[static_cast<Eigen::Index>(i)];
    if (exact ? (*exact)[i].is_zero() : std::abs(weight) <= 1e-14 * scale) continue;
    std::string text = exact ? (*exact)[i].text() : "";
    if (text.size() > 40) text.clear();  // a polynomial of high degree tells nobody anything
    json.push_back(
        {{"label", to_json(labels[i])}, {"weight", weight}, {"exact", text.empty() ? Json(nullptr) : Json(text)}});
  }
  return json;
}

}  // namespace

Json masks_json(const Scheme<double>& scheme, const LocalPatch<Algebraic>* exact, const LocalType& type,
                const std::optional<Algebraic>& lambda, std::string& why) {
  std::optional<LoneLimit> limit;
  std::optional<LocalPatch<double>> patch;
  try {
    limit = lone_limit(scheme, type);
    patch = local_patch(scheme, type);
  } catch (const AnalysisError& error) {
    why = error.what();
    return nullptr;
  }
  if (!limit || !patch) return nullptr;
  std::optional<ExactMasks> exactly;
  if (exact && exact->slots == limit->slots) try {
      exactly = exact_masks(*exact, lambda);
    } catch (const AnalysisError&) {  // no limit: told above
    }
  const LimitMasks::Side& side = limit->masks.sides.at(0);
  const auto exact_or_null = [](const std::optional<std::vector<Algebraic>>& mask) { return mask ? &*mask : nullptr; };
  Json json;
  json["position"] = mask_json(patch->labels, limit->masks.position, exactly ? &exactly->position : nullptr);
  json["tangent1"] = mask_json(patch->labels, side.tangent1, exactly ? exact_or_null(exactly->tangent1) : nullptr);
  json["tangent2"] = mask_json(patch->labels, side.tangent2, exactly ? exact_or_null(exactly->tangent2) : nullptr);
  json["second"] = nullptr;
  return json;
}

}  // namespace sublimit::report
