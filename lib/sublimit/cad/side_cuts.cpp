// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/side_cuts.h"

#include <algorithm>
#include <optional>

#include "sublimit/patches/joins/line_samples.h"
#include "sublimit/patches/joins/line_search.h"

namespace sublimit {
namespace {

constexpr int samples_of_part = 33;

/// Evenly spaced, 0 to 1.
std::vector<double> even_steps() {
  std::vector<double> steps;
  for (int i = 0; i < samples_of_part; ++i) steps.push_back(i / (samples_of_part - 1.0));
  return steps;
}

/// A side as a curve over 0 .. 1.
class SideOfPatch {
 public:
  SideOfPatch(std::span<const PatchColumns> patches, Coordinates coordinates, const PatchLine& line)
      : patch_(patches[line.patch]), coordinates_(coordinates), line_(line) {}

  Points points(std::span<const double> s) const { return line_samples(patch_, coordinates_, line_, s, 0).position; }
  Eigen::RowVector3d point(double s) const { return points({&s, 1}).row(0); }
  const Knots<double>& along() const { return patch_.along(line_); }
  double parameter(double s) const { return s == 1 ? along().end() : along().begin() + s * length(); }
  double fraction(double t) const { return (t - along().begin()) / length(); }

  /// Where a point is on the side, if it is not at its ends.
  std::optional<double> place(const Eigen::RowVector3d& x, double same) const {
    const double s = polished(nearest_on_line([this](double at) { return point(at); }, points(even_steps()), x).s, x);
    const bool is_end = (point(0) - x).norm() <= same || (point(1) - x).norm() <= same;
    if (is_end || (point(s) - x).norm() > same) return std::nullopt;
    return s;
  }

 private:
  double length() const { return along().end() - along().begin(); }

  /// Distances are least to half of the digits: Newton's steps find the others.
  double polished(double s, const Eigen::RowVector3d& x) const {
    for (int step = 0; step < 4; ++step) {
      const LimitSamples at = line_samples(patch_, coordinates_, line_, {&s, 1}, 1);
      const Index face = along().place(parameter(s)).face;
      const Eigen::RowVector3d slope = (line_.along_v ? at.dv : at.du).row(0) * (length() / along().length(face));
      if (slope.squaredNorm() == 0) break;
      s = std::clamp(s + (x - at.position.row(0)).dot(slope) / slope.squaredNorm(), 0.0, 1.0);
    }
    return s;
  }

  const PatchColumns& patch_;
  Coordinates coordinates_;
  PatchLine line_;
};

/// A knot, or the middle, where it is that but for rounding.
double snapped(const Knots<double>& knots, double t) {
  const double rounding = 1e-12 * (knots.end() - knots.begin()), middle = (knots.begin() + knots.end()) / 2;
  for (const double knot : knots.in_domain())
    if (std::abs(knot - t) <= rounding) return knot;
  return std::abs(middle - t) <= rounding ? middle : t;
}

}  // namespace

PatchSide side_of(const PatchLine& line) {
  const bool at_end = line.end == KnotSide::right;
  if (line.along_v) return at_end ? PatchSide::u_end : PatchSide::u_begin;
  return at_end ? PatchSide::v_end : PatchSide::v_begin;
}

std::vector<std::vector<double>> side_cuts(std::span<const PatchColumns> patches, Coordinates coordinates,
                                           const PatchSeams& seams, double same) {
  std::vector<std::vector<double>> cuts;
  for (size_t p = 0; p < patches.size(); ++p)
    for (const PatchSide side : {PatchSide::u_begin, PatchSide::u_end, PatchSide::v_begin, PatchSide::v_end}) {
      const Knots<double>& along = patches[p].along(side_line(patches, p, side));
      cuts.push_back({along.begin(), along.end()});
    }
  for (const PatchSeam& seam : seams.seams) {
    if (seam.kind != SeamKind::partial) continue;
    for (const size_t longer : {size_t{0}, size_t{1}}) {
      const SideOfPatch cut(patches, coordinates, seam.lines[longer]),
          other(patches, coordinates, seam.lines[1 - longer]);
      std::vector<double>& own = cuts[side_number(seam.lines[longer])];
      for (const double end : {0.0, 1.0}) {
        const std::optional<double> s = cut.place(other.point(end), same);
        if (!s) continue;
        const bool is_known = std::ranges::any_of(
            own, [&](double t) { return (cut.point(cut.fraction(t)) - cut.point(*s)).norm() <= same; });
        if (!is_known)
          own.insert(std::ranges::upper_bound(own, cut.parameter(*s)), snapped(cut.along(), cut.parameter(*s)));
      }
    }
  }
  return cuts;
}

PartDistance part_distance(std::span<const PatchColumns> patches, Coordinates coordinates, const SidePart& a,
                           const SidePart& b) {
  const auto points = [&](const SidePart& part) {
    const SideOfPatch side(patches, coordinates, part.line);
    std::vector<double> s;
    for (const double x : even_steps()) s.push_back(side.fraction(part.begin + x * (part.end - part.begin)));
    return side.points(s);
  };
  const Points of_a = points(a), of_b = points(b);
  const double along = (of_a - of_b).rowwise().norm().maxCoeff(),
               against = (of_a - of_b.colwise().reverse()).rowwise().norm().maxCoeff();
  return {against < along, std::min(along, against)};
}

}  // namespace sublimit
