// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/finite_points.h"
#include "sublimit/integrals/detail/quadrature.h"
#include "sublimit/integrals/detail/unit_box.h"
#include "sublimit/integrals/limit_integrals.h"
#include "sublimit/parts/parted_patches.h"

namespace sublimit {
namespace {

using Numbers = SurfaceSums::Numbers;

/// Largest error of a face's sums, where the control points have an extent near 1.
constexpr double tolerance = 2e-13;
/// Cells that all faces together, and a single one at least, may be quartered into, as for limits.
constexpr std::int64_t most_cells = 1 << 15, least_cells = 1 << 8;

/// Sums over cells of faces, by a Gauss rule in each.
class CellSums {
 public:
  /// @param degree  for which all but the area is exact, where cells are polynomials
  CellSums(const PatchSet& patches, const BoundSource& surface, const UnitBox& box, int degree)
      : patches_(patches),
        surface_(surface),
        box_(box),
        triangles_(patches.faces().triangles),
        rule_(triangles_ ? triangle_rule(nodes(degree)) : square_rule(nodes(degree))) {}

  Numbers of(Index face, const CellCorners& corners, int depth) {
    places_.clear();
    for (const QuadraturePoint& node : rule_) {
      const auto [u, v] = at_place(corners, triangles_, node.u, node.v);
      places_.push_back({face, u, v});
    }
    surface_.evaluate(places_, 1, false, samples_);
    const Points x = box_.to_unit(samples_.position);
    SurfaceSums sums;
    for (size_t k = 0; k < rule_.size(); ++k) {
      const auto row = Eigen::Index(k);
      if (!has_position(samples_.status[k]))
        throw UnsupportedTopology("face " + std::to_string(face) + ", of patch " +
                                  std::to_string(patches_.patch_of(face)) + ", has a pole, and no area");
      const Eigen::Vector3d at = x.row(row), u = samples_.du.row(row) / box_.scale(),
                            v = samples_.dv.row(row) / box_.scale(), normal = u.cross(v);
      const double weight = std::ldexp(rule_[k].weight, -2 * depth), flux = weight * at.dot(normal);
      sums.area += weight * normal.norm();
      sums.of_area += weight * normal.norm() * at;
      sums.volume += flux / 3;
      sums.first += flux / 4 * at;
      sums.second += flux / 5 * at * at.transpose();
    }
    return sums.numbers();
  }

 private:
  /// Returns the nodes in each direction: enough for X X^T (X.N), of degree 5 d - 2 in u and in v; quotients and roots
  /// take some more.
  static int nodes(int degree) { return std::max(12, 5 * degree / 2 + 1); }

  const PatchSet& patches_;
  const BoundSource& surface_;
  const UnitBox& box_;
  bool triangles_;
  std::vector<QuadraturePoint> rule_;
  std::vector<Place> places_;
  LimitSamples samples_;
};

/// A cell and its quarters, whose sum is taken for it.
struct Cell {
  std::array<CellCorners, 4> quarters;
  std::array<Numbers, 4> parts;
  Numbers sum = Numbers::Zero(), error;  ///< error: difference to the sum by the cell itself
  int depth = 0;
  double largest() const { return error.maxCoeff(); }
  bool operator<(const Cell& other) const { return largest() < other.largest(); }
};

/// Quarters the cell of the largest error until all errors together are small, or there are enough cells.
EstimatedSums sums_over_face(CellSums& cells, Index face, bool triangles, std::int64_t most) {
  const auto quartered = [&](const CellCorners& corners, const Numbers& whole, int depth) {
    Cell cell;
    cell.depth = depth + 1;
    for (int k = 0; k < 4; ++k) {
      cell.quarters[size_t(k)] = quarter_of(corners, triangles, k);
      cell.parts[size_t(k)] = cells.of(face, cell.quarters[size_t(k)], depth + 1);
      cell.sum += cell.parts[size_t(k)];
    }
    cell.error = (cell.sum - whole).cwiseAbs();
    return cell;
  };
  const CellCorners all = whole_cell(triangles);
  std::vector<Cell> heap{quartered(all, cells.of(face, all, 0), 0)};
  double error = heap[0].largest();
  while (error > tolerance && std::ssize(heap) + 3 <= most && !is_smallest(heap[0].quarters[0])) {
    std::pop_heap(heap.begin(), heap.end());
    const Cell largest = std::move(heap.back());
    heap.pop_back();
    error -= largest.largest();
    for (size_t k = 0; k < 4; ++k) {
      heap.push_back(quartered(largest.quarters[k], largest.parts[k], largest.depth));
      error += heap.back().largest();
      std::push_heap(heap.begin(), heap.end());
    }
  }
  Numbers value = Numbers::Zero(), of_error = Numbers::Zero();
  for (const Cell& cell : heap) value += cell.sum, of_error += cell.error;
  return {SurfaceSums::of(value), SurfaceSums::of(of_error)};
}

}  // namespace

LimitIntegrals limit_integrals(const Patches& patches) {
  const Index faces = patches.faces().size;
  const Points points = points_in_space(patches.points());
  check_finite_control(points);
  if (faces == 0 || points.rows() == 0) return no_faces();
  const UnitBox box(points);
  const PartedPatches surface(patches.set(), patches.points());
  if (const std::string& pole = surface.with_pole(); !pole.empty())
    throw UnsupportedTopology(pole + ": its area may have no limit");
  const std::int64_t most = std::max(least_cells, most_cells / std::max<std::int64_t>(faces, 1));
  constexpr std::int64_t faces_a_block = 32;
  std::vector<EstimatedSums> blocks(size_t(num_blocks(faces, faces_a_block)));
  int degree = 1;
  for (Index face = 0; face < faces; ++face) degree = std::max(degree, surface.degree(face));
  parallel_for_blocks(
      faces,
      [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        CellSums cells(patches.set(), surface.samples(), box, degree);
        for (std::int64_t face = begin; face < end; ++face)
          blocks[size_t(block)] += sums_over_face(cells, Index(face), patches.faces().triangles, most);
      },
      faces_a_block);
  EstimatedSums sums;
  for (const EstimatedSums& block : blocks) sums += block;
  // Differences that are rounding alone are none: of sums of numbers of at most 1 over the area.
  constexpr double rounding = 1e-15;
  Numbers error = sums.error.numbers();
  error = (error.array() <= rounding * sums.value.area).select(0, error);
  sums.error = SurfaceSums::of(error);
  return box.integrals(sums, surface.why_not_closed(), points);
}

}  // namespace sublimit
