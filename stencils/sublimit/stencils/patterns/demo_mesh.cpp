// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/patterns/demo_mesh.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace sublimit {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr float infinite = 10;  // sharpness from which a crease never decays
constexpr int columns = 12;     // faces around the body
constexpr int none = -1;        // a place of the grid where a tube leaves the body

using Loop = std::vector<Index>;  // vertices of a closed polygon

class Builder {
 public:
  /// Coordinates are rounded to four decimals: readable in a file, and the same on every platform.
  Index vertex(const Vector3d& p) {
    points_.push_back(p.unaryExpr([](double x) { return std::round(1e4 * x) / 1e4 + 0.; }));  // + 0: no -0
    return static_cast<Index>(points_.size()) - 1;
  }
  const Vector3d& position(Index vertex) const { return points_[vertex]; }
  void face(const Loop& corners) {
    mesh_.face_sizes.push_back(static_cast<Index>(corners.size()));
    mesh_.face_vertices.insert(mesh_.face_vertices.end(), corners.begin(), corners.end());
  }
  /// Quads between two loops of the same length, both counter-clockwise seen from where `to` lies.
  void bridge(const Loop& from, const Loop& to) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      const std::size_t j = (i + 1) % from.size();
      face({from[i], from[j], to[j], to[i]});
    }
  }
  void crease(Index tail, Index head, float sharpness) { mesh_.creases.push_back({tail, head, sharpness}); }
  void crease(const Loop& loop, float sharpness) {
    for (std::size_t i = 0; i < loop.size(); ++i) crease(loop[i], loop[(i + 1) % loop.size()], sharpness);
  }
  void corner(Index vertex, float sharpness) { mesh_.corners.push_back({vertex, sharpness}); }

  Mesh take() {
    mesh_.positions.resize(static_cast<Eigen::Index>(points_.size()), 3);
    for (std::size_t i = 0; i < points_.size(); ++i) mesh_.positions.row(static_cast<Eigen::Index>(i)) = points_[i];
    return std::move(mesh_);
  }

 private:
  Mesh mesh_;
  std::vector<Vector3d> points_;
};

/// A point of the surface of revolution; the angle runs counter-clockwise seen from above, 0 is the spout's side.
Vector3d revolve(double radius, double height, double angle) {
  return {radius * std::cos(angle), height, -radius * std::sin(angle)};
}

/// One ring of the body. `pinch` (radians) draws columns together under the spout and the handle, which are slimmer
/// than two regular columns.
struct Circle {
  double radius, height;
  double pinch = 0;
  float sharpness = 0;
};

double column_angle(int column, double pinch) {
  const double angle = 2 * pi * column / columns;
  return angle - pinch * std::sin(2 * angle);
}

/// A cubic Bezier curve in the plane z = 0.
struct Curve {
  Vector2d p0, p1, p2, p3;
  Vector2d at(double t) const {
    const double s = 1 - t;
    return s * s * s * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t * t * t * p3;
  }
  Vector2d direction(double t) const {
    const double s = 1 - t;
    return (s * s * (p1 - p0) + 2 * s * t * (p2 - p1) + t * t * (p3 - p2)).normalized();
  }
};

/// The point with offsets `across` (in the plane of the curve, to its left), `side` (along z) and `along` from the
/// curve.
Vector3d beside(const Curve& curve, double t, double across, double side, double along = 0) {
  const Vector2d d = curve.direction(t);
  const Vector2d p = curve.at(t) + across * Vector2d(-d.y(), d.x()) + along * d;
  return {p.x(), p.y(), side};
}

/// Closes half of a loop's columns: pentagons between it and a new loop of half as many vertices.
Loop halve(Builder& pot, const Loop& outer, double radius, double height) {
  Loop inner;
  for (std::size_t i = 0; i < outer.size(); i += 2) {
    const Vector3d p = pot.position(outer[i]);
    const double scale = radius / std::hypot(p.x(), p.z());
    inner.push_back(pot.vertex({scale * p.x(), height, scale * p.z()}));
  }
  for (std::size_t i = 0; i < inner.size(); ++i) {
    const std::size_t j = (i + 1) % inner.size();
    pot.face({outer[2 * i], outer[2 * i + 1], outer[(2 * i + 2) % outer.size()], inner[j], inner[i]});
  }
  return inner;
}

// Where the tubes leave the body: rows of faces, and the column of vertices in the middle of each hole.
constexpr int spout_row = 5, handle_end_row = 6, handle_begin_row = 8;
constexpr int front = 0, back = columns / 2;

/// Rings of vertices from the underside of the foot to the lid, and the faces between them, less three holes. The foot
/// is sharp for ever, the rim rounds off after 2.5 levels.
std::vector<Loop> add_body(Builder& pot) {
  const std::vector<Circle> profile = {
      {.56, .07},               // underside
      {.74, .00, 0, infinite},  // foot
      {.78, .11, 0, infinite},
      {.66, .20},
      {.98, .42},        // belly
      {1.14, .74, .14},  // spout from here ...
      {1.13, 1.08, .16},
      {1.00, 1.42, .16},  // ... to here; here the handle ends
      {.84, 1.74, .12},
      {.70, 2.06, .12},  // here it begins
      {.61, 2.34},       // neck
      {.66, 2.52},
      {.76, 2.58, 0, 2.5F},  // rim
      {.76, 2.66, 0, 2.5F},
      {.62, 2.67},  // lid
      {.56, 2.80},
      {.34, 2.92},
  };
  std::vector<Loop> rings;
  for (int r = 0; r < static_cast<int>(profile.size()); ++r) {
    const Circle& ring = profile[r];
    Loop loop;
    for (int k = 0; k < columns; ++k) {
      const bool inside_spout = r == spout_row + 1 && k == front;
      loop.push_back(inside_spout ? none : pot.vertex(revolve(ring.radius, ring.height, column_angle(k, ring.pinch))));
    }
    if (ring.sharpness > 0) pot.crease(loop, ring.sharpness);
    rings.push_back(loop);
  }
  for (int r = 0; r + 1 < static_cast<int>(rings.size()); ++r) {
    for (int k = 0; k < columns; ++k) {
      const bool front_face = k == front || k == columns - 1, back_face = k == back || k == back - 1;
      if (front_face && (r == spout_row || r == spout_row + 1)) continue;
      if (back_face && (r == handle_begin_row || r == handle_end_row)) continue;
      const int next = (k + 1) % columns;
      pot.face({rings[r][k], rings[r][next], rings[r + 1][next], rings[r + 1][k]});
    }
  }

  return rings;
}

/// Underside and lid go from twelve columns to six by a ring of pentagons, whose middle vertices have valence 3. The
/// knob's tip is a corner of valence 6.
void add_ends(Builder& pot, const std::vector<Loop>& rings) {
  const Loop bottom = halve(pot, Loop(rings.front().rbegin(), rings.front().rend()), .28, .10);
  pot.face(bottom);
  Loop knob = halve(pot, rings.back(), .14, 2.98);
  for (const Circle& ring : {Circle{.09, 3.05}, Circle{.20, 3.15}, Circle{.19, 3.29}, Circle{.07, 3.37}}) {
    Loop next;
    for (int k = 0; k < 6; ++k) next.push_back(pot.vertex(revolve(ring.radius, ring.height, 2 * pi * k / 6)));
    pot.bridge(knob, next);
    knob = next;
  }
  const Index tip = pot.vertex({0, 3.44, 0});
  for (int k = 0; k < 6; ++k) pot.face({knob[k], knob[(k + 1) % 6], tip});
  pot.corner(tip, infinite);
}

/// A tube of eight sides out of the hole in the belly; its lip is the boundary of the surface.
void add_spout(Builder& pot, const std::vector<Loop>& rings) {
  const Loop &low = rings[spout_row], &middle = rings[spout_row + 1], &high = rings[spout_row + 2];
  constexpr int left = columns - 1, right = 1;
  Loop tube = {low[left], low[front], low[right], middle[right], high[right], high[front], high[left], middle[left]};
  const Curve spout = {{1.00, 1.02}, {1.94, .74}, {1.50, 2.10}, {2.12, 2.58}};
  constexpr int spout_rings = 8;
  for (int i = 1; i <= spout_rings; ++i) {
    const double t = static_cast<double>(i) / spout_rings;
    const double radius = .125 + .24 * (1 - t) * (1 - t) + (i == spout_rings ? .05 : 0);
    const double tilt = i == spout_rings ? .9 : i + 1 == spout_rings ? .3 : 0;  // the lip opens upwards
    Loop next;
    for (int k = 0; k < 8; ++k) {
      const double angle = 2 * pi * (k - 1) / 8;  // 0 is below, as the middle of the hole's lower edge
      const double across = -radius * std::cos(angle);
      next.push_back(pot.vertex(beside(spout, t, across, -radius * std::sin(angle), -tilt * across)));
    }
    pot.bridge(tube, next);
    tube = next;
  }
}

/// A strap of six sides from one hole at the back to the other. The edges of its outside are creases that end on the
/// way (darts), so that it grows softly out of the body.
void add_handle(Builder& pot, const std::vector<Loop>& rings) {
  const auto hole = [&](int row) {  // counter-clockwise from the lower left corner, seen from outside
    return Loop{rings[row][back - 1],     rings[row][back],     rings[row][back + 1],
                rings[row + 1][back + 1], rings[row + 1][back], rings[row + 1][back - 1]};
  };
  const Loop end = hole(handle_end_row);
  const Curve handle = {{-.74, 1.95}, {-1.95, 3.05}, {-2.62, .90}, {-1.08, 1.22}};
  constexpr int handle_rings = 9;
  constexpr double width = .15, thickness = .085;
  Loop tube = hole(handle_begin_row);
  for (int i = 1; i <= handle_rings; ++i) {
    const double t = static_cast<double>(i) / (handle_rings + 1);
    Loop next;
    for (int k = 0; k < 6; ++k) {
      const double across = k < 3 ? thickness : -thickness;  // the outside of the bend is on the curve's right
      const double side = width * (k % 3 - 1) * (k < 3 ? 1 : -1);
      next.push_back(pot.vertex(beside(handle, t, across, side)));
    }
    pot.bridge(tube, next);
    if (i > 2 && i < handle_rings) {
      pot.crease(tube[3], next[3], infinite);
      pot.crease(tube[5], next[5], infinite);
    }
    tube = next;
  }
  pot.bridge(tube, Loop(end.rbegin(), end.rend()));  // the handle's outside comes in from below
}

}  // namespace

Mesh demo_mesh() {
  Builder pot;
  const std::vector<Loop> rings = add_body(pot);
  add_ends(pot, rings);
  add_spout(pot, rings);
  add_handle(pot, rings);
  return pot.take();
}

}  // namespace sublimit
