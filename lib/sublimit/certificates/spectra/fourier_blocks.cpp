// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/fourier_blocks.h"

#include "sublimit/certificates/spectra/mirror.h"

namespace sublimit {
namespace {

/// Rows of the symmetry that the neighbourhood has, or of all points by themselves.
ExactRows rows_by_symmetry(const LocalPatch<Algebraic>& patch) {
  std::string why = "the sectors of a closed neighbourhood do not hold all of its points";
  if (!patch.orbits.empty()) {
    auto rows = exact_rows(patch.A, patch.orbits, [&](const Algebraic& a, const Algebraic& b) {
      why =
          "the local matrix does not commute with the rotation: " + a.text() + " and " + b.text() + " should be equal";
    });
    if (!rows) throw AnalysisError(why);
    return std::move(*rows);
  }
  if (patch.type.open)
    if (auto rows = mirror_rows(patch)) return std::move(*rows);
  Orbits points;
  for (Index i = 0; i < patch.A.rows(); ++i) points.push_back({i});
  return exact_rows(patch.A, std::move(points)).value();
}

}  // namespace

std::optional<ExactRows> exact_rows(const DenseMatrix<Algebraic>& A, Orbits orbits,
                                    const std::function<void(const Algebraic&, const Algebraic&)>& unequal) {
  return sector_rows_of<Algebraic, Algebraic>(
      A.rows(), std::move(orbits),
      [&](Index i, const auto& visit) {
        for (Eigen::Index j = 0; j < A.cols(); ++j)
          if (!A(i, j).is_zero()) visit(j, A(i, j));
      },
      [&](const Algebraic& a, const Algebraic& b) { return a == b || (unequal(a, b), false); });
}

ExactBlocks exact_blocks(const LocalPatch<Algebraic>& patch) {
  for (const Algebraic& weight : patch.A.reshaped())
    if (!weight.is_real()) throw AnalysisError("a weight is not real: " + weight.text());
  ExactBlocks result{.sectors = 0, .rows = rows_by_symmetry(patch)};
  const ExactRows& rows = result.rows;
  if (!patch.orbits.empty()) result.sectors = rows.n;
  for (int k = 0; 2 * k <= rows.n; ++k) {
    result.blocks.push_back(rows.block(k));
    Orbits& orbits = result.orbits.emplace_back();
    for (const int i : rows.places(k)) orbits.push_back(rows.orbits[size_t(i)]);
  }
  return result;
}

}  // namespace sublimit
