// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/analysis/masks_json.h"

#include <algorithm>
#include <cmath>

#include "sublimit/limit/detail/eigen_structure.h"
#include "sublimit/limit/detail/limit_rows.h"
#include "sublimit/neighborhood/vertex_sides.h"

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

/// Left eigenvectors of the next modes where these are bounded: mu = lambda^2 with as many eigenvectors as its
/// multiplicity, from blocks 0 and 2. Scaled to a largest weight of 1.
Json second_order_masks(const Scheme<double>& scheme, const LocalType& type) {
  const auto patch = local_patch(scheme, type, 2);
  const auto fourier = patch ? fourier_blocks(patch->A, patch->orbits) : std::nullopt;
  if (!fourier || fourier->n < 3) return nullptr;
  std::vector<EigenCluster> clusters;
  for (int k = 0; 2 * k <= fourier->n; ++k)
    for (EigenCluster& c : eigen_structure(fourier->blocks[k], k, 3).clusters)
      if (std::abs(c.value) < 1 - 1e-9) clusters.push_back(std::move(c));
  double lambda = 0, mu = 0;
  for (const EigenCluster& c : clusters) lambda = std::max(lambda, std::abs(c.value));
  for (const EigenCluster& c : clusters)
    if (std::abs(c.value) < lambda * (1 - 1e-9)) mu = std::max(mu, std::abs(c.value));
  if (std::abs(mu - lambda * lambda) > 1e-9) return nullptr;
  Json masks = Json::array();
  for (const EigenCluster& c : clusters) {
    if (std::abs(std::abs(c.value) - mu) > 1e-9 || (c.block != 0 && c.block != 2)) continue;
    if (c.is_jordan()) return nullptr;
    for (Eigen::Index i = 0; i < c.left.cols(); ++i) {
      const Eigen::VectorXcd mask = fourier->mask(c.block, c.left.col(i));
      for (Eigen::VectorXd part : {Eigen::VectorXd(mask.real()), Eigen::VectorXd(mask.imag())}) {
        const double largest = part.cwiseAbs().maxCoeff();
        if (largest <= 1e-9 * mask.norm()) continue;
        part /= largest;
        masks.push_back(mask_json(patch->labels, part, nullptr));
      }
    }
  }
  return masks.empty() ? Json(nullptr) : masks;
}

}  // namespace

Json masks_json(const Scheme<double>& scheme, const LocalPatch<Algebraic>* exact, const LocalType& type,
                const std::optional<Algebraic>& lambda, std::string& why) {
  std::optional<IsolatedLimit> limit;
  std::optional<LocalPatch<double>> patch;
  try {
    limit = isolated_limit(scheme, type);
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
  json["second"] = type.open ? Json(nullptr) : second_order_masks(scheme, type);
  return json;
}

Json dart_masks_json(const Scheme<double>& scheme, const LocalPatch<Algebraic>& exact, std::string& why) try {
  const Index n = exact.type.faces, size = scheme.face_size() == 3 ? 3 : 4;
  SubdivisionOptions options;
  options.boundary = Boundary::edge_only;
  const Level level = control_level(scheme, creased_fan(n, n, size), options);
  LimitCache cache(scheme);
  const LimitRows rows = limit_rows(level, cache, side_of(level, level.topology().outgoing(Vertex{0})));
  if (rows.tangent1().empty()) return nullptr;
  // Points of the fan, by the labels of the patch.
  const auto by_label = [&](LimitRows::Row row) {
    Eigen::VectorXd sorted = Eigen::VectorXd::Zero(Eigen::Index(exact.labels.size()));
    for (const auto& [v, weight] : row) {
      const Index spoke = (v - 1) / (size - 2);
      const bool is_diagonal = size == 4 && v > 0 && (v - 1) % 2 == 1;
      const SectorLabel label = v == 0 ? SectorLabel{} : SectorLabel{spoke, 2, is_diagonal ? 2 : 0};
      const auto at = std::find(exact.labels.begin(), exact.labels.end(), label);
      if (at == exact.labels.end())
        throw AnalysisError(scheme.name + ": a dart's limit depends on points beyond its ring");
      sorted[at - exact.labels.begin()] = weight;
    }
    return sorted;
  };
  const ExactMasks exactly = exact_masks(exact);
  return {{"position", mask_json(exact.labels, by_label(rows.position()), &exactly.position)},
          {"tangent1", mask_json(exact.labels, by_label(rows.tangent1()), nullptr)},
          {"tangent2", mask_json(exact.labels, by_label(rows.tangent2()), nullptr)},
          {"second", nullptr}};
} catch (const AnalysisError& error) {
  why = error.what();
  return nullptr;
}

}  // namespace sublimit::report
