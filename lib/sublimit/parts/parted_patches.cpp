// SPDX-License-Identifier: Apache-2.0
#include "sublimit/parts/parted_patches.h"

#include <algorithm>
#include <cfloat>
#include <optional>
#include <utility>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/binomial.h"
#include "sublimit/core/detail/finite_points.h"
#include "sublimit/nets/hull_cell.h"
#include "sublimit/parts/shared_sides.h"
#include "sublimit/patches/joins/patch_seams.h"

namespace sublimit {
namespace {

/// Bernstein coefficients of a higher degree.
WeightRows raising_rows(int from, int to) {
  WeightRows rows = WeightRows::Zero(to + 1, from + 1);
  for (int k = 0; k <= to; ++k)
    for (int i = std::max(0, k - (to - from)); i <= std::min(from, k); ++i)
      rows(k, i) = double(binomial(from, i)) * double(binomial(to - from, k - i)) / double(binomial(to, k));
  return rows;
}

/// As parts have it: of one degree, v fastest.
PiecePart whole_part(const Patch::BezierRows& bezier, bool triangle, const Points& columns) {
  const int degree = std::max({bezier.degree_u, bezier.degree_v, 1});
  PiecePart part{whole_cell(triangle), 0, PolynomialBasis(degree, triangle), {}, nullptr, {}};
  Points net = bezier.rows * columns;
  if (!triangle && (bezier.degree_u < degree || bezier.degree_v < degree))
    net = outer_product(raising_rows(bezier.degree_v, degree), raising_rows(bezier.degree_u, degree)) * net;
  Points& ordered = part.nets.emplace_back(net.rows(), net.cols());
  for_each_net_row(*part.basis,
                   [&](int i, int j, Eigen::Index row) { ordered.row(row) = net.row(net_row(*part.basis, j, i)); });
  return part;
}

/// Cuts a rational part until all weights have one sign. Weights that are 0 but for rounding would be points far away.
/// @param near_poles  gets the cells where they have not
void add_positive(PiecePart&& part, PieceParts& cutter, std::vector<PiecePart>& out,
                  std::vector<CellCorners>& near_poles) {
  constexpr int most_quarterings = 5;
  constexpr double smallest = 1e-12;  // of the largest
  Points& net = part.nets[0];
  if (net.col(3).sum() < 0) net = -net;
  if (net.col(3).minCoeff() > smallest * net.col(3).maxCoeff())
    out.push_back(std::move(part));
  else if (part.depth == most_quarterings)
    near_poles.push_back(part.corners);
  else
    for (int k = 0; k < 4; ++k) add_positive(cutter.quarter(part, k), cutter, out, near_poles);
}

void add_parts(PiecePart&& whole, PieceParts& cutter, std::vector<PiecePart>& out,
               std::vector<CellCorners>& near_poles) {
  Points& net = whole.nets[0];
  if (net.cols() == 4 && net(0, 3) != 0 && (net.col(3).array() == net(0, 3)).all())
    net = Points(net.leftCols(3) / net(0, 3));
  if (net.cols() == 4)
    add_positive(std::move(whole), cutter, out, near_poles);
  else
    out.push_back(std::move(whole));
}

}  // namespace

PartedPatches::PartedPatches(const PatchSet& patches, const Points& columns)
    : patches_(patches),
      columns_(columns),
      samples_(patches.bound(columns)),
      parts_(size_t(patches.faces().size)),
      sampled_(parts_.size()) {
  check_columns(columns, patches.num_points(), patches.coordinates());
  check_measurable_control(columns);
  std::vector<std::string> without(parts_.size()), poles(parts_.size());
  parallel_for_blocks(
      faces().size,
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        PieceParts cutter;
        for (std::int64_t face = begin; face < end; ++face) {
          const size_t patch = patches_.patch_of(static_cast<Index>(face));
          const Index own = static_cast<Index>(face) - patches_.first_face(patch);
          std::vector<CellCorners>& sampled = sampled_[size_t(face)];
          const std::optional<Patch::BezierRows> bezier = patches_.members()[patch].patch->bezier(own);
          const auto refuse = [&](const char* why) {
            without[size_t(face)] = "face " + std::to_string(face) + ", of patch " + std::to_string(patch) + ", " + why;
          };
          if (!bezier) {
            sampled.push_back(whole_cell(faces().triangles));
            refuse("is no polynomial, and no quotient of polynomials that is known");
            continue;
          }
          add_parts(
              whole_part(*bezier, faces().triangles, columns_(patches_.slots(static_cast<Index>(face)), Eigen::all)),
              cutter, parts_[size_t(face)], sampled);
          if (sampled.empty()) continue;
          refuse("has a denominator that is 0 or below somewhere, or very near to that");
          poles[size_t(face)] = without[size_t(face)];
        }
      },
      32);
  const auto first_of = [](std::vector<std::string>& all) {
    const auto first = std::ranges::find_if(all, [](const std::string& why) { return !why.empty(); });
    return first == all.end() ? std::string() : std::move(*first);
  };
  without_parts_ = first_of(without);
  with_pole_ = first_of(poles);
}

void PartedPatches::find_parts(Index face, PieceParts&, std::vector<PiecePart>& out) const {
  const std::vector<PiecePart>& parts = parts_[size_t(face)];
  out.insert(out.end(), parts.begin(), parts.end());
}

int PartedPatches::degree(Index face) const {
  int largest = 0;
  for (const PiecePart& part : parts_[size_t(face)]) largest = std::max(largest, part.basis->degree());
  return largest;
}

void PartedPatches::cut(Index face, const PiecePart& part, int cells, PieceParts& cutter,
                        std::vector<LimitCell>& out) const {
  constexpr int most_cells = 64;
  const bool triangle = part.is_triangle();
  const Points& net = part.nets[0];
  Points points(net.rows(), 3);
  Hull hull;
  for (Eigen::Index i = 0; i < net.rows(); ++i) {
    hull.push_back(net_point(net, i));
    points.row(i) = hull.back();
  }
  const double middle = triangle ? 1. / 3 : 0.5;
  const auto [u, v] = at_place(part.corners, triangle, middle, middle);
  const auto [u0, v0] = at_place(part.corners, triangle, 0, 0);
  const double radius = (triangle ? 2 : 1) * std::max(std::abs(u - u0), std::abs(v - v0));
  const LimitCell cell = hull_cell(hull, {face, u, v}, radius);
  if (4 * cells > most_cells || (cell.is_thin() && !turns({&points, 1}, triangle))) {
    out.push_back(cell);
    return;
  }
  for (int k = 0; k < 4; ++k) cut(face, cutter.quarter(part, k), 4 * cells, cutter, out);
}

void PartedPatches::add_sampled(Index face, const CellCorners& corners, int cells, std::vector<LimitCell>& out) const {
  constexpr int steps_a_cell = 4;
  const bool triangle = faces().triangles;
  const int steps = steps_a_cell * cells;
  std::vector<Place> places;
  const auto place = [&](double i, double j) {
    const auto [u, v] = at_place(corners, triangle, i / steps, j / steps);
    return Place{face, u, v};
  };
  for (int j = 0; j <= steps; ++j)
    for (int i = 0; i <= steps; ++i) places.push_back(place(i, j));
  LimitSamples samples;
  samples_->evaluate(places, 0, false, samples);
  for (int b = 0; b < cells; ++b)
    for (int a = 0; a < cells; ++a) {
      Hull hull;
      for (int j = 0; j <= steps_a_cell; ++j)
        for (int i = 0; i <= steps_a_cell; ++i) {
          const auto at = Eigen::Index(b * steps_a_cell + j) * (steps + 1) + a * steps_a_cell + i;
          const LimitStatus status = samples.status[size_t(at)];
          if (status != LimitStatus::pole && status != LimitStatus::outside) hull.push_back(samples.position.row(at));
        }
      if (hull.empty()) continue;
      const Place middle = place((a + 0.5) * steps_a_cell, (b + 0.5) * steps_a_cell);
      // Twice as wide as what was seen.
      out.push_back(hull_cell(hull, middle,
                              std::max(std::abs(middle.u - place(a * steps_a_cell, 0).u),
                                       std::abs(middle.v - place(0, b * steps_a_cell).v)),
                              0.5, 0.02));
    }
}

std::vector<LimitCell> PartedPatches::cells() const {
  constexpr std::int64_t faces_a_block = 32;
  std::vector<std::vector<LimitCell>> blocks(size_t(num_blocks(faces().size, faces_a_block)));
  parallel_for_blocks(
      faces().size,
      [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        PieceParts cutter;
        for (std::int64_t face = begin; face < end; ++face) {
          const std::vector<PiecePart>& parts = parts_[size_t(face)];
          for (const PiecePart& part : parts)
            cut(static_cast<Index>(face), part, 1 << (2 * std::min(part.depth, 3)), cutter, blocks[size_t(block)]);
          for (const CellCorners& corners : sampled_[size_t(face)])
            add_sampled(static_cast<Index>(face), corners, parts.empty() ? 4 : 1, blocks[size_t(block)]);
        }
      },
      faces_a_block);
  std::vector<LimitCell> cells;
  for (std::vector<LimitCell>& block : blocks) cells.insert(cells.end(), block.begin(), block.end());
  return cells;
}

std::string PartedPatches::why_not_closed() const {
  constexpr double same = 1e-9;  // of the diagonal of all control points
  const bool are_splines = std::ranges::all_of(patches_.members(), [](const PatchSet::Member& member) {
    return dynamic_cast<const SplineSurface*>(member.patch.get()) != nullptr;
  });
  if (!are_splines) {
    const Points points = points_in_space(columns_);
    if (points.rows() == 0) return "there are no faces";
    int largest = 1;
    for (Index face = 0; face < faces().size; ++face) largest = std::max(largest, degree(face));
    const double diagonal = (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
    return SharedSides(*samples_, faces(), {.same = std::max(same * diagonal, DBL_MIN), .degree = largest})
        .why_not_closed();
  }
  const PatchSeams found = patch_seams(patch_columns(patches_, columns_), patches_.coordinates(), {.same = same});
  for (const PatchSeam& seam : found.seams) {
    const std::string where = "patch " + std::to_string(seam.lines[0].patch) + " has a side that is ";
    switch (seam.kind) {
      case SeamKind::boundary:
        return where + "no other one's";
      case SeamKind::partial:
        return where + "a part of one of patch " + std::to_string(seam.lines[1].patch);
      case SeamKind::non_manifold:
        return where + "that of two others or more";
      default:
        if (!seam.same_orientation)
          return "normals of patches " + std::to_string(seam.lines[0].patch) + " and " +
                 std::to_string(seam.lines[1].patch) +
                 " look to different sides where they meet; turn one of them over";
    }
  }
  return {};
}

}  // namespace sublimit
