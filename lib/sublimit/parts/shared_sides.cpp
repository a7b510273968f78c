// SPDX-License-Identifier: Apache-2.0
#include "sublimit/parts/shared_sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "sublimit/patches/joins/line_search.h"
#include "sublimit/surface/detail/shared_places.h"

namespace sublimit {
namespace {

/// The place t on side k of a face, counter-clockwise from (0, 0).
Place on_side(Index face, size_t k, double t, bool triangles) {
  if (k == 0) return {face, t, 0};
  if (k == 1) return {face, triangles ? 1 - t : 1, t};
  if (k == 2 && !triangles) return {face, 1 - t, 1};
  return {face, 0, 1 - t};
}

/// Points of a side at equal steps; not finite where there are none, so that they are the same as no others.
class SidePoints {
 public:
  SidePoints(const BoundSource& surface, bool triangles) : surface_(surface), triangles_(triangles) {}
  Points of(Index face, size_t k, int steps) {
    places_.clear();
    for (int i = 0; i <= steps; ++i) places_.push_back(on_side(face, k, double(i) / steps, triangles_));
    surface_.evaluate(places_, 0, false, samples_);
    Points points = samples_.position;
    for (size_t i = 0; i < samples_.status.size(); ++i)
      if (!has_position(samples_.status[i])) points.row(Eigen::Index(i)).setConstant(std::nan(""));
    return points;
  }

 private:
  const BoundSource& surface_;
  bool triangles_;
  std::vector<Place> places_;
  LimitSamples samples_;
};

/// Lines by where their middles are, in cubes so large that those of the same are in neighbouring ones.
class LinesByMiddle {
 public:
  explicit LinesByMiddle(double same) : width_(4 * same) {}
  void add(const Eigen::RowVector3d& middle, size_t line) { lines_[cube(middle)].push_back(line); }
  template <class Visit>
  void for_each_near(const Eigen::RowVector3d& middle, const Visit& visit) const {
    const Cube own = cube(middle);
    for (int k = 0; k < 27; ++k) {
      const auto at = lines_.find({own[0] + k % 3 - 1, own[1] + k / 3 % 3 - 1, own[2] + k / 9 - 1});
      if (at == lines_.end()) continue;
      for (const size_t line : at->second)
        if (visit(line)) return;
    }
  }

 private:
  using Cube = std::array<double, 3>;  // whole numbers
  struct Hash {
    size_t operator()(const Cube& c) const {
      const std::hash<double> hash;
      return hash(c[0]) ^ hash(c[1]) * 0x9e3779b97f4a7c15u ^ hash(c[2]) * 0xc2b2ae3d27d4eb4fu;
    }
  };
  Cube cube(const Eigen::RowVector3d& x) const {
    return {std::floor(x[0] / width_) + 0.0, std::floor(x[1] / width_) + 0.0, std::floor(x[2] / width_) + 0.0};
  }

  double width_;
  std::unordered_map<Cube, std::vector<size_t>, Hash> lines_;
};

}  // namespace

SharedSides::SharedSides(const BoundSource& surface, FaceCount faces, const SideOptions& options)
    : corners_(faces.triangles ? 3 : 4), sides_(size_t(faces.size) * corners_), corner_(sides_.size()) {
  constexpr int few = 4;  // steps at which sides are compared first
  const int steps = std::max(few, 2 * options.degree);
  SidePoints points(surface, faces.triangles);
  struct Line {
    Index face;
    size_t side;
    Points points;
    size_t count = 1;
  };
  std::vector<Line> lines;
  LinesByMiddle by_middle(options.same);
  std::iota(corner_.begin(), corner_.end(), std::int64_t{0});
  const auto first_of = [&](std::int64_t corner) {
    while (corner_[size_t(corner)] != corner) {
      corner_[size_t(corner)] = corner_[size_t(corner_[size_t(corner)])];
      corner = corner_[size_t(corner)];
    }
    return corner;
  };
  // Corners are one as far as all of them are the same as the first one: chains of corners, each the same as the next,
  // would lead anywhere.
  Points at = Points::Zero(Eigen::Index(corner_.size()), 3);
  std::vector<double> radius(corner_.size(), 0);  // of the corners that a first one stands for
  const auto joined_radius = [&](std::int64_t first, std::int64_t second) {
    return std::max(radius[size_t(first)], (at.row(first) - at.row(second)).norm() + radius[size_t(second)]);
  };
  const auto ends = [&](size_t a, size_t b) {
    const std::int64_t first = first_of(std::int64_t(a)), second = first_of(std::int64_t(b));
    return std::pair(std::min(first, second), std::max(first, second));
  };
  const auto may_join = [&](size_t a, size_t b) {
    const auto [first, second] = ends(a, b);
    return first == second || joined_radius(first, second) <= options.same;
  };
  const auto join = [&](size_t a, size_t b) {
    const auto [first, second] = ends(a, b);
    if (first == second || !(joined_radius(first, second) <= options.same)) return;
    radius[size_t(first)] = joined_radius(first, second);
    corner_[size_t(second)] = first;
    gap_ = std::max(gap_, radius[size_t(first)]);
  };
  const auto corner = [&](Index face, size_t k) { return size_t(face) * corners_ + k % corners_; };
  for (Index face = 0; face < faces.size; ++face)
    for (size_t k = 0; k < corners_; ++k) at.row(Eigen::Index(corner(face, k))) = points.of(face, k, 1).row(0);
  for (Index face = 0; face < faces.size; ++face)
    for (size_t k = 0; k < corners_; ++k) {
      Side& side = sides_[corner(face, k)];
      Points own = points.of(face, k, few);
      if (!own.allFinite()) continue;
      const auto from_start = [](const Points& x) { return curve_distance(x, x.row(0).replicate(x.rows(), 1), false); };
      if (from_start(own) <= options.same) {
        const double length = from_start(points.of(face, k, steps));
        if (length <= options.same && may_join(corner(face, k), corner(face, k + 1))) {
          side.is_point = true;
          join(corner(face, k), corner(face, k + 1));
          gap_ = std::max(gap_, length + radius[size_t(first_of(std::int64_t(corner(face, k))))]);
          continue;
        }
      }
      by_middle.for_each_near(own.row(few / 2), [&](size_t which) {
        Line& line = lines[which];
        for (const bool reversed : {true, false}) {  // neighbours of one orientation go there in opposite directions
          if (!(curve_distance(line.points, own, reversed) <= options.same)) continue;
          const double gap =
              curve_distance(points.of(line.face, line.side, steps), points.of(face, k, steps), reversed);
          const size_t start = corner(line.face, line.side + (reversed ? 1 : 0)),
                       end = corner(line.face, line.side + (reversed ? 0 : 1));
          if (!(gap <= options.same) || !may_join(corner(face, k), start) || !may_join(corner(face, k + 1), end))
            continue;
          gap_ = std::max(gap_, gap);
          side.line = std::int64_t(which);
          side.reversed = reversed;
          ++line.count;
          join(corner(face, k), start);
          join(corner(face, k + 1), end);
          return true;
        }
        return false;
      });
      if (side.line >= 0) continue;
      side.line = std::int64_t(lines.size());
      by_middle.add(own.row(few / 2), lines.size());
      lines.push_back({face, k, std::move(own)});
    }
  for (Side& side : sides_)
    if (side.line >= 0 && lines[size_t(side.line)].count == 1) side.line = -1;
  for (size_t c = 0; c < corner_.size(); ++c) corner_[c] = first_of(std::int64_t(c));
}

bool SharedSides::has_loop(Index face) const {
  const size_t first = size_t(face) * corners_;
  for (size_t k = 0; k < corners_; ++k)
    if (!sides_[first + k].is_point && corner_[first + k] == corner_[first + (k + 1) % corners_]) return true;
  return false;
}

std::string SharedSides::why_not_closed() const {
  std::unordered_map<std::int64_t, std::array<int, 2>> along;  // how many sides go along each line, and against it
  for (const Side& side : sides_)
    if (side.line >= 0) ++along[side.line][side.reversed ? 1 : 0];
  for (size_t k = 0; k < sides_.size(); ++k) {
    const Side& side = sides_[k];
    if (side.is_point) continue;
    const std::string where = "face " + std::to_string(k / corners_) + " has a side that is ";
    if (side.line < 0) return where + "no other one's";
    const auto [forth, back] = along.at(side.line);
    if (forth + back > 2) return where + "that of two others or more";
    if (forth != back) return where + "another one's, whose normals look to the other side; turn one of them over";
  }
  return {};
}

std::int64_t SharedSides::number(Index face, const CellCorner& c) const {
  const size_t first = size_t(face) * corners_;
  const bool triangles = corners_ == 3;
  for (size_t k = 0; k < corners_; ++k) {
    if (!is_on_side(c, k, triangles)) continue;
    const std::int32_t t = k == 0 ? c.i : k == 1 ? c.j : k == 2 && !triangles ? cell_steps - c.i : cell_steps - c.j;
    const Side& side = sides_[first + k];
    if (t == 0 || side.is_point) return corner_[first + k];
    if (t == cell_steps) return corner_[first + (k + 1) % corners_];
    if (side.line < 0) return SharedPlaces::not_shared;
    return std::int64_t(corner_.size()) + side.line * cell_steps + (side.reversed ? cell_steps - t : t);
  }
  return SharedPlaces::not_shared;
}

}  // namespace sublimit
