// SPDX-License-Identifier: Apache-2.0
// Boxes around parts of the limit.
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/finite_points.h"
#include "sublimit/nets/piece_hull.h"
#include "sublimit/surface/detail/limit_map_parts.h"

namespace sublimit {
namespace {

/// Levels that are looked into before the points themselves bound a piece.
constexpr int depth = 3;

class Boxes {
 public:
  void extend(Eigen::AlignedBox3d& box, const PieceType& type, const Points& points, int levels) const {
    if (const PiecePolynomial* p = type.polynomial()) {
      for (const Points& net : polynomial_nets(*p, bernstein_from(p->basis), points))
        for (Eigen::Index i = 0; i < net.rows(); ++i) box.extend(Eigen::Vector3d(net.row(i)));
      return;
    }
    if (levels > 0) {
      for (const PieceLink& link : type.children()) extend(box, *link.type, child_points(link, points), levels - 1);
      return;
    }
    const Eigen::RowVector3d low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
    const Eigen::RowVector3d margin = type.reach() * (high - low);
    box.extend(Eigen::Vector3d(low - margin));
    box.extend(Eigen::Vector3d(high + margin));
  }
};

}  // namespace

std::vector<Eigen::AlignedBox3d> LimitMap::bounding_boxes(const Points& points) const {
  const Parts& parts = *parts_;
  const Points x = parts.points_of_pieces(points, "boxes");
  check_finite_control(points);
  const Parts::Pieces& pieces = parts.pieces();
  const Boxes boxes;
  std::vector<Eigen::AlignedBox3d> of_piece(parts.num_pieces());
  parallel_for_blocks(
      parts.num_pieces(),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
          const Points local = pieces.points_of(Index(i), x);
          boxes.extend(of_piece[i], *pieces.types[i], local, depth);
          // The hull is rounded as points of the surface are.
          const Eigen::Vector3d size = of_piece[i].min().cwiseAbs().cwiseMax(of_piece[i].max().cwiseAbs());
          of_piece[i].min() -= 1e-14 * size;
          of_piece[i].max() += 1e-14 * size;
        }
      },
      64);
  std::vector<Eigen::AlignedBox3d> result(parts.addresses.size());
  for (Index a = 0; a < parts.addresses.size(); ++a)
    for (const double u : {0.25, 0.75})
      for (const double v : {0.25, 0.75}) {  // the pieces of an address
        if (parts.addresses.triangles() && u + v > 1) continue;
        const Place s{a, u, v};
        result[a].extend(of_piece[parts.number(s, parts.target(s))]);
      }
  return result;
}

}  // namespace sublimit
