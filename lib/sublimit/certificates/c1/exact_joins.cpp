// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/c1/exact_joins.h"

namespace sublimit {
namespace {

std::vector<Rational> ratios_of(const std::vector<double>& numbers) {
  std::vector<Rational> result;
  for (const double x : numbers) result.emplace_back(x);
  return result;
}

/// Homogeneous if that is asked for.
SeamNet<Rational> with_weights(SeamNet<Rational> net, Coordinates coordinates) {
  if (net.coordinates == coordinates) return net;
  std::vector<Rational> columns;
  for (size_t at = 0; at < net.columns.size(); at += 3) {
    columns.insert(columns.end(), net.columns.begin() + std::ptrdiff_t(at),
                   net.columns.begin() + std::ptrdiff_t(at + 3));
    columns.emplace_back(1);
  }
  net.columns = std::move(columns);
  net.coordinates = coordinates;
  return net;
}

}  // namespace

BezierPiece<Rational> in_ratios(const BezierPiece<double>& piece) {
  return {.degree = piece.degree,
          .columns = ratios_of(piece.columns),
          .coordinates = piece.coordinates,
          .length = Rational(piece.length)};
}

BezierPatch<Rational> in_ratios(const BezierPatch<double>& patch) {
  return {.degree_u = patch.degree_u,
          .degree_v = patch.degree_v,
          .columns = ratios_of(patch.columns),
          .coordinates = patch.coordinates,
          .length = Rational(patch.length)};
}

CurveJoin exact_curve_join(const BezierPiece<Rational>& left, const BezierPiece<Rational>& right) {
  return curve_join(left, right);
}

SurfaceJoin exact_surface_join(const BezierPatch<Rational>& left, const BezierPatch<Rational>& right,
                               const JoinTolerance& tolerance) {
  return surface_join(left, right, tolerance);
}

std::vector<std::optional<JoinOrders>> exact_seams(std::span<const PatchColumns> patches, Coordinates coordinates,
                                                   std::span<const PatchSeam> seams,
                                                   std::span<const std::optional<SeamNet<Rational>>> exact) {
  std::vector<SeamNet<Rational>> nets;
  for (size_t p = 0; p < patches.size(); ++p)
    if (p < exact.size() && exact[p])
      nets.push_back(with_weights(*exact[p], coordinates));
    else
      nets.emplace_back(patches[p], coordinates);
  std::vector<std::optional<JoinOrders>> result;
  for (const PatchSeam& seam : seams) {
    std::optional<JoinOrders>& all = result.emplace_back();
    if (seam.kind != SeamKind::knot && seam.kind != SeamKind::period && seam.kind != SeamKind::sides) continue;
    for_each_strip(nets[seam.lines[0].patch], nets[seam.lines[1].patch], seam, Rational(0),
                   [&](const BezierPatch<Rational>& left, const BezierPatch<Rational>& right, const auto&) {
                     const JoinOrders part = exact_orders(left, right);
                     all = all ? worst(*all, part) : part;
                   });
  }
  return result;
}

}  // namespace sublimit
