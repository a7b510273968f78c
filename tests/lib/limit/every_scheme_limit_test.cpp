// SPDX-License-Identifier: Apache-2.0
// Limits of every scheme against refinement: the faces around a place, refined again and again by the scheme's own
// matrices, come to lie at the limit point and in the tangent plane.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "laws/laws.h"
#include "meshes/meshes.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/limit/detail/limit_rows.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit::testing {
namespace {

struct Seen {
  Eigen::Vector3d point, normal;
};

/// What is at the child of a place after so many levels.
Seen refined(const Scheme<double>& scheme, Level level, Points x, Centre centre, int levels) {
  for (int k = 0; k < levels; ++k) {
    const std::vector<Index> face{index(level.topology().face(centre.start))};
    const Part around = part(level, face, 5);
    Points own(std::ssize(around.vertices), 3);
    for (Index v = 0; v < own.rows(); ++v) own.row(v) = x.row(around.vertices[v]);
    centre.start = HalfEdge{static_cast<Index>(
        std::lower_bound(around.halves.begin(), around.halves.end(), index(centre.start)) - around.halves.begin())};
    Level next = next_level(scheme, around.level);
    const Topology* before = &around.level.topology();
    for (const Refinement& step : next.steps) {
      centre = child(centre, *before, step, level.number);
      before = &step.topology;
    }
    x = apply(next.S, own);
    level = std::move(next);
  }
  const Topology& t = level.topology();
  Seen seen{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  const auto at = [&](HalfEdge h) { return Eigen::Vector3d(x.row(index(t.tail(h)))); };
  const auto add_face = [&](Face f) {  // twice its area vector
    const HalfEdge first = t.first(f);
    for (HalfEdge h = t.next(first); t.next(h) != first; h = t.next(h))
      seen.normal += (at(h) - at(first)).cross(at(t.next(h)) - at(first));
  };
  if (centre.kind == Centre::Kind::vertex) {
    seen.point = at(centre.start);
    HalfEdge h = centre.start;
    do {
      add_face(t.face(h));
      const HalfEdge into = t.prev(h);
      h = is_sharp(level.sharpness.edge[index(t.edge(into))]) ? no_half_edge : t.twin(into);
    } while (exists(h) && h != centre.start);
  } else if (centre.kind == Centre::Kind::face) {
    HalfEdge h = centre.start;
    do {
      seen.point += at(h) / t.size(t.face(h));
      h = t.next(h);
    } while (h != centre.start);
    add_face(t.face(centre.start));
  } else {
    seen.point = (at(centre.start) + at(t.next(centre.start))) / 2;
    add_face(t.face(centre.start));
  }
  seen.normal.normalize();
  return seen;
}

std::vector<Mesh> meshes_for(const Scheme<double>& scheme) {
  if (scheme.face_size() == 3) {
    Mesh sharp = jittered(octahedron());
    if (scheme.sharpening != Sharpening::boundary) sharp.creases = {{0, 2, 10}, {2, 1, 10}, {1, 3, 10}, {3, 0, 10}};
    return {jittered(icosahedron()), jittered(tetrahedron()),    jittered(triangle_grid(3, 3)), sharp,
            jittered(fan(7, 3, 2)),  jittered(open_fan(4, 3, 2))};
  }
  Mesh sharp = jittered(cube());
  if (scheme.sharpening != Sharpening::boundary) sharp.creases = {{0, 1, 10}, {1, 3, 10}, {3, 2, 10}, {2, 0, 10}};
  return {jittered(prism(5)),         sharp, jittered(grid(3, 3)), jittered(octahedron()), jittered(fan(7, 4, 2)),
          jittered(open_fan(3, 4, 2))};
}

using Variant = std::pair<std::string, SchemeOptions>;
/// What is known of these meshes' limits.
struct Expected {
  const char* variant;
  int without_normal;      ///< sides
  double points, normals;  ///< what is refined is as close as this to the limits (radians)
  int other_normals;       ///< sides whose normals are known not to be where refinement goes
};
constexpr double digits = 1e-14;  // of points, by rounding alone
constexpr Expected expected[] = {
    {"bilinear", 88, 0, 0, 0},
    {"catmull-clark", 0, 2e-06, 0.02, 0},
    {"catmull-clark-intervals", 0, 2e-06, 0.02, 0},
    {"loop", 0, 4e-08, 0.001, 0},
    {"loop-warren", 0, 7e-08, 0.001, 0},
    {"doo-sabin", 0, digits, 4e-08, 0},
    {"doo-sabin-averaging", 0, digits, 2e-06, 0},
    {"doo-sabin-intervals", 0, digits, 2e-06, 0},
    {"mid-edge", 1, digits, 3e-08, 0},
    {"mid-edge-habib-warren", 1, digits, 4e-08, 0},
    {"averaging", 0, 1e-07, 0.003, 0},
    {"butterfly", 5, 0, 0.0005, 0},
    {"modified-butterfly", 1, 0, 0.0005, 0},
    {"sqrt3", 0, 3e-12, 0.0003, 0},
    {"interpolatory-sqrt3", 0, 0, 0.001, 0},
    {"kobbelt", 1, 0, 0.04, 0},
    {"catmull-clark --option triangles=smooth", 0, 2e-06, 0.02, 0},
    {"catmull-clark-intervals --option levelling=off", 0, 2e-06, 0.02, 0},
    {"doo-sabin-intervals --option levelling=off", 0, digits, 2e-06, 0},
    {"averaging --option degree=2", 0, digits, 2e-06, 0},
    {"averaging --option degree=4", 0, 4e-08, 3e-06, 0},
    {"averaging --option degree=5", 0, 1e-07, 0.001, 0},
    {"averaging --option degree=6", 0, 5e-08, 3e-06, 0},
    {"averaging --option degree=9", 0, 7e-08, 0.0004, 0},
    {"butterfly --option tension=0", 75, 0, 0, 0},
    {"butterfly --option tension=1/2", 5, 0, 0.04, 0},
    {"butterfly --option boundary-rule=virtual-vertex", 9, 0, 0.0005, 0},
    {"modified-butterfly --option t=1/64", 1, 0, 0.0015, 0},
    {"modified-butterfly --option t=-1/64", 0, 0, 0.02, 0},
    {"modified-butterfly --option boundary-rule=virtual-vertex", 5, 0, 0.0005, 0},
    {"kobbelt --option tension=0", 88, 0, 0, 0},
    // At border vertices of a single face the border's bend decays slower than what leaves the border: no tangent
    // plane.
    {"kobbelt --option tension=1/2", 5, 0, 0.003, 0},
    {"kobbelt --option tension=3/2", 5, 0, 1e-4, 0},
    {"kobbelt --option quads=edges", 1, 0, 0.04, 0},
};

class EverySchemeLimit : public ::testing::TestWithParam<Variant> {};

TEST_P(EverySchemeLimit, IsWhereRefinementGoes) {
  const Scheme<double> scheme = find_scheme(GetParam().first, GetParam().second).value();
  const auto known = std::find_if(std::begin(expected), std::end(expected),
                                  [](const Expected& row) { return row.variant == described(GetParam()); });
  ASSERT_NE(known, std::end(expected)) << "what is expected of its limits?";
  double worst_point = 0, worst_normal = 0;
  int undefined = 0, elsewhere = 0;
  // Enough to converge, and not so many that the faces drown in rounding.
  const int levels = (scheme.name == "kobbelt" ? 16 : 12) * scheme.period;
  for (const Mesh& mesh : meshes_for(scheme)) {
    const Level level = control_level(scheme, mesh);
    const Topology& t = level.topology();
    LimitCache cache(scheme);
    const LimitMatrices limit = limit_matrices(level, cache);
    const LimitPoints points = limit_points(limit, t, mesh.positions);
    for (Index s = 0; s < std::ssize(limit.side_vertex); ++s) {
      // The first corner of the side.
      HalfEdge start = no_half_edge;
      for (const HalfEdge fan : t.fans(Vertex{limit.side_vertex[s]})) {
        HalfEdge h = fan;
        do {
          const bool first = is_sharp(level.sharpness.edge[index(t.edge(h))]);
          if (limit.corner_side[index(h)] == s && (first || !exists(start))) start = h;
          h = t.ccw(h);
        } while (exists(h) && h != fan);
      }
      const Centre centre{Centre::Kind::vertex, start};
      const Seen far = refined(scheme, level, mesh.positions, centre, levels);
      // Positions shrink at least like 0.92 a level: mid-edge at a heptagon.
      const double off = (far.point - points.position.row(limit.side_vertex[s]).transpose()).norm();
      worst_point = std::max(worst_point, off);
      undefined += points.status[s] == LimitStatus::undefined_normal;
      if (points.status[s] == LimitStatus::undefined_normal || scheme.claims.regular == 0) continue;
      const Seen near = refined(scheme, level, mesh.positions, centre, levels / 2);
      const Eigen::Vector3d normal = points.normal.row(s);
      const double angle = std::acos(std::clamp(normal.dot(far.normal), -1.0, 1.0));
      const double before = std::acos(std::clamp(normal.dot(near.normal), -1.0, 1.0));
      if (angle >= 1e-4 && angle >= 0.7 * before) {
        EXPECT_LE(++elsewhere, known->other_normals)
            << "vertex " << limit.side_vertex[s] << " with " << t.num_vertices() - 1 << " others: " << before
            << " rad on the way, " << angle << " after " << levels << " levels";
        continue;
      }
      worst_normal = std::max(worst_normal, angle);
    }
  }
  EXPECT_EQ(elsewhere, known->other_normals);
  EXPECT_EQ(undefined, known->without_normal);
  EXPECT_LE(worst_point, known->points);
  EXPECT_LE(worst_normal, known->normals);
}

INSTANTIATE_TEST_SUITE_P(Registry, EverySchemeLimit, ::testing::ValuesIn(scheme_names_and_options()),
                         [](const auto& parameter) {
                           std::string name = described(parameter.param);
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

}  // namespace
}  // namespace sublimit::testing
