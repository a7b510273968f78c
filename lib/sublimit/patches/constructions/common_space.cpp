// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/common_space.h"

#include <algorithm>
#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/patches/detail/finer_knots.h"
#include "sublimit/patches/detail/spline_rows.h"

namespace sublimit {
namespace {

bool same_knots(const Knots<double>& a, const Knots<double>& b) {
  return a.degree() == b.degree() && a.is_closed() == b.is_closed() && std::ranges::equal(a.all(), b.all());
}

std::string domain_in_words(const Knots<double>& knots) {
  return format_number(knots.begin()) + " to " + format_number(knots.end());
}

}  // namespace

Knots<double> common_knots(std::span<const Knots<double>> all, int degree, bool clamped) {
  const Knots<double>& first = all[0];
  for (size_t i = 1; i < all.size(); ++i)
    if (!(all[i].begin() == first.begin() && all[i].end() == first.end()))
      throw InvalidParameter("the domain of curve " + format_number(i) + " is " + domain_in_words(all[i]) +
                             ", that of curve 0 is " + domain_in_words(first) + ": both must be the same");
  for (const Knots<double>& knots : all) degree = std::max(degree, knots.degree());
  const bool are_same = std::ranges::all_of(all, [&](const Knots<double>& k) { return same_knots(k, first); });
  if (are_same && degree == first.degree() && !clamped) return first;
  check_degree(degree);
  std::vector<double> merged;
  for (Knots<double> knots : all) {
    knots = clamped_knots(knots);
    while (knots.degree() < degree) knots = elevated_knots(knots);
    std::vector<double> both;
    std::ranges::set_union(merged, knots.all(), std::back_inserter(both));  // as often as in the one that has more
    merged = std::move(both);
  }
  const auto points = static_cast<Index>(merged.size()) - degree - 1;
  return Knots<double>::open(degree, points, std::move(merged));
}

SparseMatrix embedding(const Knots<double>& coarse, const Knots<double>& fine) {
  if (same_knots(coarse, fine)) return refinement_matrix(coarse, fine);
  Knots<double> knots = clamped_knots(coarse);
  SparseMatrix S = refinement_matrix(coarse, knots);
  while (knots.degree() < fine.degree()) {
    const Knots<double> higher = elevated_knots(knots);
    S = product(refinement_matrix(knots, higher), S);
    knots = higher;
  }
  return same_knots(knots, fine) ? S : product(refinement_matrix(knots, fine), S);
}

CurveNet in_space(const CurveNet& curve, const Knots<double>& fine) {
  if (same_knots(curve.knots, fine)) return curve;
  return {fine, apply(embedding(curve.knots, fine), curve.columns), curve.coordinates};
}

Coordinates make_compatible(std::span<CurveNet* const> curves) {
  const Coordinates coordinates = make_alike(curves);
  std::vector<Knots<double>> all;
  for (const CurveNet* const curve : curves) all.push_back(curve->knots);
  const Knots<double> common = common_knots(all);
  for (CurveNet* const curve : curves) *curve = in_space(*curve, common);
  return coordinates;
}

}  // namespace sublimit
