// SPDX-License-Identifier: Apache-2.0
// The way to the limit at a place.
#include <algorithm>
#include <array>
#include <cmath>

#include "sublimit/limit/detail/eigen_structure.h"
#include "sublimit/surface/detail/limit_map_parts.h"

namespace sublimit {
namespace {

const char* name(Piece::Kind kind) {
  constexpr std::array names{"quadrilateral", "triangle", "corner of a face", "corner of a polygon"};
  return names[size_t(kind)];
}

const char* name(Rule rule) {
  constexpr std::array names{"smooth", "dart", "crease", "corner"};
  return names[size_t(rule)];
}

/// Eigenvalues of the rows of S from a piece to its child, by descending modulus: 1, and those of differences.
/// Eigenvalues that rounding has split are made equal, and keep their multiplicity.
std::vector<std::complex<double>> spectrum_of(const PieceLink& link) {
  if (!link.repeats || link.block.is_large()) return {};
  const EigenStructure structure =
      eigen_structure(Eigen::MatrixXd(link.block.differences()).cast<std::complex<double>>());
  std::vector<std::complex<double>> all{1.0};
  for (const EigenCluster& cluster : structure.clusters) {
    const bool is_real = std::abs(cluster.value.imag()) <= std::max(1e-9, cluster_tolerance * std::abs(cluster.value));
    all.insert(all.end(), size_t(cluster.multiplicity), is_real ? cluster.value.real() : cluster.value);
  }
  return all;
}

}  // namespace

LimitPath LimitMap::explain(const Place& place, int order) const {
  LimitPath path;
  path.stencil = stencil(place, order);
  const Parts::Target target = parts_->target(place);
  std::vector<Index> vertices;
  const PieceDescent way = descend(*parts_->type_of(target.piece, vertices), target.place);
  int level = parts_->base().number;
  const auto add = [&](const PieceType& type, const PieceCoordinates& at) -> LimitPath::Step& {
    LimitPath::Step& step = path.steps.emplace_back();
    step.level = level;
    step.piece = name(type.kind());
    step.u = at.u;
    step.v = at.v;
    step.num_points = type.num_slots();
    return step;
  };
  for (const PieceDescent::Step& down : way.steps) {
    LimitPath::Step& step = add(*down.from, down.place);
    while (&down.from->children()[size_t(step.child + 1)] != down.link) ++step.child;
    ++step.child;
    step.times = down.times;
    level += down.times * parts_->scheme.period;
  }
  add(*way.type, way.place);
  if (way.polynomial) {
    path.degree = way.polynomial->basis.degree();
    path.is_total = way.polynomial->basis.total();
  } else {
    path.end = LimitPath::End::corner;
    path.spectrum = spectrum_of(way.type->child(corner_place(way.type->kind(), way.corner)));
  }
  const std::optional<Centre> centre = parts_->centre(target);
  if (!centre || centre->kind != Centre::Kind::vertex || !parts_->vertex_position(target)) return path;
  const Vertex vertex = parts_->base().topology().tail(centre->start);
  path.vertex = parts_->prepared ? parts_->prepared->steps[0].parent(vertex) : index(vertex);
  if (const LimitRows* const limit = parts_->corners.at(*centre)) path.rule = name(limit->rule);
  return path;
}

}  // namespace sublimit
