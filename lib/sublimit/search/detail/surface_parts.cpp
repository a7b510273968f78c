// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/detail/surface_parts.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/parts/parted_surface.h"
#include "sublimit/search/detail/seen_limit.h"

namespace sublimit {
namespace {

/// @param reach  in sizes of the box
Eigen::AlignedBox3d widened(const Eigen::AlignedBox3d& box, double reach) {
  const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  const Eigen::Vector3d margin = reach * box.sizes() + Eigen::Vector3d::Constant(1e-14 * largest);
  return {box.min() - margin, box.max() + margin};
}

}  // namespace

Eigen::AlignedBox3d box_of(const PiecePart& part) {
  Eigen::AlignedBox3d box;
  for (const Points& net : part.nets)
    for (Eigen::Index i = 0; i < net.rows(); ++i) box.extend(net_point(net, i));
  for (Eigen::Index i = 0; i < part.points.rows(); ++i) box.extend(Eigen::Vector3d(part.points.row(i)));
  return widened(box, part.basis ? 0 : part.type->reach());
}

Eigen::AlignedBox3d ray_box_of(const PiecePart& part, const Points& limits) {
  if (part.type->reach() == 0) return box_of(part);
  if (limits.rows() > 0) return estimated_box(PieceGrid{part.is_triangle()}, limits);
  Eigen::AlignedBox3d box;
  for (Eigen::Index i = 0; i < part.points.rows(); ++i) box.extend(Eigen::Vector3d(part.points.row(i)));
  return widened(box, 0);
}

std::array<Eigen::Vector2d, 3> triangle_of(const SurfacePart& part) {
  if (part.turned) return *part.turned;
  std::array<Eigen::Vector2d, 3> corners;
  for (size_t k = 0; k < 3; ++k) {
    const std::array<double, 2> uv = part.part.corners[k].uv();
    corners[k] = {uv[0], uv[1]};
  }
  return corners;
}

std::array<Eigen::Vector2d, 3> child_triangle(const std::array<Eigen::Vector2d, 3>& corners, const PieceMap& map) {
  Eigen::Matrix3d to_child;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) to_child(r, c) = map.barycentric[size_t(r)][size_t(c)];
  const Eigen::Matrix3d own = to_child.inverse();  // columns: corners of the child
  std::array<Eigen::Vector2d, 3> child;
  for (int k = 0; k < 3; ++k)
    child[size_t(k)] = own(0, k) * corners[0] + own(1, k) * corners[1] + own(2, k) * corners[2];
  return child;
}

std::array<SurfacePart, 2> halves_of(const SurfacePart& whole, bool by_u) {
  const PiecePart& part = whole.part;
  const int d = part.basis->degree();
  const auto row = [&](int along, int other) {
    return by_u ? net_row(*part.basis, along, other) : net_row(*part.basis, other, along);
  };
  // De Casteljau's triangle of each line: its sides are the halves.
  Points lower = part.nets[0], upper = part.nets[0];
  for (int other = 0; other <= d; ++other)
    for (int step = 1; step <= d; ++step) {
      for (int along = 0; along <= d - step; ++along)
        upper.row(row(along, other)) = (upper.row(row(along, other)) + upper.row(row(along + 1, other))) / 2;
      lower.row(row(step, other)) = upper.row(row(0, other));
    }
  const auto half = [&](bool is_upper, Points net) {
    CellCorners corners;
    for (size_t k = 0; k < 4; ++k) {
      const CellCorner c = square_corners[k];
      const int i = by_u ? c.i + int(is_upper) : 2 * c.i, j = by_u ? 2 * c.j : c.j + int(is_upper);
      corners[k] = at_halves(part.corners, false, i, j);
    }
    PiecePart own{corners, part.depth + 1, part.basis, {}, part.type, {}};
    own.nets.push_back(std::move(net));
    return SurfacePart{whole.address, std::move(own), whole.placed, {}};
  };
  return {half(false, std::move(lower)), half(true, std::move(upper))};
}

SurfaceParts::SurfaceParts(const PartedSurface& surface, PartBoxes use) {
  const Index faces = surface.faces().size;
  constexpr std::int64_t faces_a_block = 32;
  std::vector<std::vector<SurfacePart>> blocks(size_t(num_blocks(faces, faces_a_block)));
  parallel_for_blocks(
      faces,
      [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        PieceParts cutter;
        std::vector<PiecePart> found;
        for (std::int64_t face = begin; face < end; ++face) {
          found.clear();
          surface.find_parts(static_cast<Index>(face), cutter, found);
          for (PiecePart& part : found)
            blocks[size_t(block)].push_back({static_cast<Index>(face), std::move(part), true, {}});
        }
      },
      faces_a_block);
  for (std::vector<SurfacePart>& block : blocks) std::move(block.begin(), block.end(), std::back_inserter(parts_));
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.resize(parts_.size());
  parallel_for_blocks(
      std::ssize(parts_),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (auto i = size_t(begin); i < size_t(end); ++i) {
          const PiecePart& part = parts_[i].part;
          boxes[i] = use == PartBoxes::for_rays && is_limit_alone(part)
                         ? ray_box_of(part, limits_->at(*part.type, part.points))
                         : box_of(part);
        }
      },
      faces_a_block);
  tree_ = BoxTree(boxes);
  if (!tree_.nodes().empty()) {
    const Eigen::AlignedBox3d& all = tree_.nodes()[0].box;
    largest_ = std::max(all.min().cwiseAbs().maxCoeff(), all.max().cwiseAbs().maxCoeff());
  }
  certain_ = surface.without_parts().empty() && std::ranges::all_of(parts_, [](const SurfacePart& p) {
               return p.part.basis || p.part.type->reach() == 0;
             });
}

}  // namespace sublimit
