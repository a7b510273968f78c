// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/surface_parts.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "sublimit/base/parallel_for.h"

namespace sublimit {

Eigen::AlignedBox3d box_of(const PiecePart& part) {
  Eigen::AlignedBox3d box;
  for (const Points& net : part.nets)
    for (Eigen::Index i = 0; i < net.rows(); ++i) box.extend(net_point(net, i));
  for (Eigen::Index i = 0; i < part.points.rows(); ++i) box.extend(Eigen::Vector3d(part.points.row(i)));
  const double reach = part.basis ? 0 : part.type->reach();
  const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  const Eigen::Vector3d margin = reach * box.sizes() + Eigen::Vector3d::Constant(1e-14 * largest);
  return {box.min() - margin, box.max() + margin};
}

SurfaceParts::SurfaceParts(const SearchedSurface& surface) {
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
            blocks[size_t(block)].push_back({static_cast<Index>(face), std::move(part), true});
        }
      },
      faces_a_block);
  for (std::vector<SurfacePart>& block : blocks) std::move(block.begin(), block.end(), std::back_inserter(parts_));
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(parts_.size());
  for (const SurfacePart& part : parts_) boxes.push_back(box_of(part.part));
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
