// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/analysis/spectrum_json.h"

#include <cmath>
#include <set>

namespace sublimit::report {
namespace {

double modulus(const AlgebraicRoot& value) {
  return std::hypot(value.enclosure().re().mid(), value.enclosure().im().mid());
}

bool is_zero(const AlgebraicRoot& value) { return value.exact() && value.exact()->is_zero(); }

}  // namespace

void add_spectrum(Json& neighborhood, const ExactSpectrum& spectrum) {
  Json list = Json::array();
  std::vector<double> by_rank;
  for (const ExactEigenvalue& e : spectrum.values) {
    if (static_cast<int>(by_rank.size()) <= e.rank) by_rank.push_back(modulus(e.value));
    const ComplexBall& ball = e.value.enclosure();
    const std::string text = e.value.text();
    list.push_back({{"block", e.block < 0 ? Json(nullptr) : Json(e.block)},
                    {"value", {ball.re().mid(), ball.im().mid()}},
                    {"modulus", modulus(e.value)},
                    {"enclosure", ball.text()},
                    {"exact", text.size() > 80 || text.starts_with("[") ? Json(nullptr) : Json(text)},
                    {"copies", e.copies},
                    {"multiplicity", e.multiplicity},
                    {"geometric", e.geometric()},
                    {"jordan", e.jordan}});
  }
  neighborhood["spectrum"] = std::move(list);
  for (const char* key : {"lambda", "mu", "ratio"}) neighborhood[key] = nullptr;
  neighborhood["mu_blocks"] = Json::array();
  // Between sharp edges two different eigenvalues lead, and this ratio says nothing.
  if (by_rank.size() < 2 || spectrum.blocks.sectors == 0) return;
  neighborhood["lambda"] = by_rank[1];
  // What decides on curvature is the next modulus; where the leading one is a Jordan case or a tie it is still the
  // next.
  if (by_rank.size() < 3 || is_zero(spectrum.of_rank(2)[0].value)) return;
  neighborhood["mu"] = by_rank[2];
  neighborhood["ratio"] = by_rank[2] / (by_rank[1] * by_rank[1]);
  std::set<int> blocks;
  for (const ExactEigenvalue& e : spectrum.of_rank(2))
    if (e.block >= 0) {
      blocks.insert(e.block);
      if (e.copies > 1) blocks.insert(spectrum.blocks.sectors - e.block);
    }
  for (const int k : blocks) neighborhood["mu_blocks"].push_back(k);
}

std::optional<Algebraic> subdominant_in_field(const ExactSpectrum& spectrum) {
  if (spectrum.num_ranks() < 2) return std::nullopt;
  const std::vector<ExactEigenvalue> leading = spectrum.of_rank(1);
  if (leading.size() != 1 || leading[0].block != 1 || !leading[0].value.exact() || !leading[0].value.exact()->is_real())
    return std::nullopt;
  return leading[0].value.exact();
}

}  // namespace sublimit::report
