// SPDX-License-Identifier: Apache-2.0
// What interpolation owes to every scheme: limits that LimitMap finds on the targets, control points that come back
// from their own limits, and no preference for an order, a place or a size.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <random>

#include "laws/tested_schemes.h"
#include "meshes/places.h"
#include "sublimit/fit/detail/interpolate.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/neighborhood/centre.h"
#include "sublimit/surface/limit_map.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Eigen::Vector3d;

/// What `interpolate` promises: of the box, radians, and of the box where the system is well posed.
constexpr double on_target = 1e-12, along_target = 1e-10, round_trip = 1e-9;
/// Systems worse conditioned than this are not well posed: 1e-9 would be beyond double.
constexpr double well_posed = 1e5;

/// Small meshes with all that the scheme may have: closed, borders, creases that close or end in darts, corners.
std::vector<NamedMesh> meshes(const Scheme<double>& scheme) {
  const bool triangles = takes_triangles(scheme);
  std::vector<NamedMesh> list;
  list.push_back({"closed", {}, jittered(triangles ? icosahedron() : prism(5), 0.05)});
  list.push_back({"open", {}, jittered(triangles ? triangle_grid(4, 3) : grid(4, 3), 0.05)});
  if (!triangles) list.push_back({"strip", {}, jittered(mobius_strip(6), 0.05)});  // two sheets at an edge
  if (scheme.sharpening == Sharpening::boundary) return list;
  Mesh creased = jittered(triangles ? triangle_torus(5, 4) : torus(5, 4), 0.05);
  const float sharp = 10;
  add_crease(creased, {1, 5, 9, 13, 17, 1}, sharp);
  add_crease(creased, {4, 5, 6, 7, 4}, sharp);  // vertex 5 is a corner of four sides
  if (scheme.sharpening == Sharpening::semi_sharp) add_crease(creased, {18, 19}, 1.5f);  // two darts
  creased.corners.push_back({10, sharp});
  list.push_back({"creased", {}, creased});
  return list;
}

Vector3d random_vector(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const double x = unit(random), y = unit(random), z = unit(random);
  return {x, y, z};
}

class InterpolationLaws : public ::testing::TestWithParam<TestedScheme> {
 protected:
  const Scheme<double> scheme_ = GetParam().scheme();
  const std::shared_ptr<LimitCache> types_ = std::make_shared<LimitCache>(scheme_);

  /// The places of a vertex on a level: corners of its faces, or the middle of the face (border edge) that it becomes.
  struct Limit {
    std::vector<Vector3d> position, normal;
  };
  Limit limit_of(const std::vector<Level>& levels, const LimitMap& surface, const Points& points, Index v) const {
    std::vector<Place> places;
    const Topology& last = levels.back().topology();
    for (const HalfEdge start : levels[0].topology().fans(Vertex{v})) {
      Centre centre{Centre::Kind::vertex, start};
      for (size_t k = 1; k < levels.size(); ++k) {
        const Topology* before = &levels[k - 1].topology();
        for (const Refinement& step : levels[k].steps) {
          centre = child(centre, *before, step, levels[k - 1].number);
          before = &step.topology;
        }
      }
      const Face face = last.face(centre.start);
      const Index first = surface.addresses().first(face);
      if (centre.kind == Centre::Kind::face) {
        places.push_back(last.size(face) == 4 ? Place{first, 0.5, 0.5} : Place{first, 1, 1});
      } else if (centre.kind == Centre::Kind::border) {
        places.push_back(on_edge(last, surface.addresses(), centre.start, 0.5));
      } else {
        HalfEdge h = centre.start;
        do {
          places.push_back(from_corner(last, surface.addresses(), h, 0, 0));
          h = last.ccw(h);
        } while (exists(h) && h != centre.start);
      }
    }
    const LimitSamples samples = surface.evaluate(points, places, 1);
    Limit limit;
    for (size_t i = 0; i < places.size(); ++i) {
      limit.position.push_back(samples.position.row(Index(i)));
      // Along borders of higher averages LimitMap finds normals at vertices only.
      if (scheme_.name == "averaging" && samples.status[i] == LimitStatus::undefined_normal) continue;
      limit.normal.push_back(samples.normal.row(Index(i)));
    }
    return limit;
  }

  /// The points as the control mesh that they are, for meshes without creases.
  static Mesh control_mesh(const Interpolation& found) {
    const Topology& t = found.level.topology();
    Mesh mesh;
    mesh.positions = found.points;
    for (Index f = 0; f < t.num_faces(); ++f) {
      mesh.face_sizes.push_back(t.size(Face{f}));
      for (const Index v : t.vertices(Face{f})) mesh.face_vertices.push_back(v);
    }
    return mesh;
  }

  std::vector<Level> levels(const Mesh& mesh, int count) const { return refine(scheme_, mesh, count); }

  /// All vertices moved; every second one with a normal up to a right angle off.
  std::vector<VertexTarget> targets(const Mesh& mesh, bool normals, unsigned seed = 1) const {
    std::mt19937 random(seed);
    const std::vector<Level> control = levels(mesh, 0);
    const LimitMap surface(scheme_, control[0], types_);
    std::vector<VertexTarget> result;
    for (Index v = 0; v < mesh.num_vertices(); ++v) {
      result.push_back({v, Vector3d(mesh.positions.row(v)) + 0.05 * random_vector(random)});
      if (!normals || v % 2 == 0) continue;
      const Limit own = limit_of(control, surface, mesh.positions, v);
      if (own.normal.empty() || own.normal[0].isZero()) continue;  // no plane
      result.back().normal = 2 * own.normal[0] + random_vector(random);
    }
    return result;
  }

  void expect_on_targets(const Mesh& mesh, const Interpolation& found, const std::vector<VertexTarget>& targets) const {
    EXPECT_TRUE(found.solved()) << why_unsolved(found.attempts.back());
    ASSERT_EQ(found.level.number % scheme_.period, 0);
    const std::vector<Level> all = levels(mesh, found.level.number);
    const LimitMap surface = mesh.creases.empty() ? LimitMap(scheme_, control_mesh(found), {}, types_)
                                                  : LimitMap(scheme_, found.level, types_);
    for (size_t i = 0; i < targets.size(); ++i) {
      const VertexTarget& target = targets[i];
      const Limit limit = limit_of(all, surface, found.points, target.vertex);
      for (const Vector3d& position : limit.position)
        EXPECT_LE((position - target.position).norm(), on_target * diagonal(mesh.positions))
            << "vertex " << target.vertex;
      if (!target.normal || std::count(found.without_plane.begin(), found.without_plane.end(), Index(i))) continue;
      for (const Vector3d& normal : limit.normal) {
        const Vector3d N = target.normal->normalized();
        EXPECT_LE(std::atan2(normal.cross(N).norm(), normal.dot(N)), along_target) << "vertex " << target.vertex;
        EXPECT_GT(normal.norm(), 0.5) << "vertex " << target.vertex;
      }
    }
  }
};
INSTANTIATE_TEST_SUITE_P(All, InterpolationLaws, ::testing::ValuesIn(schemes_and_degrees(4)), test_name);

TEST_P(InterpolationLaws, LimitsAreOnTheTargets) {
  for (const NamedMesh& named : meshes(scheme_))
    for (const bool normals : {false, true}) {
      SCOPED_TRACE(named.name + (normals ? " with normals" : ""));
      if (normals && scheme_.claims.regular < 1) continue;  // bilinear: a normal per face
      const auto wanted = targets(named.mesh, normals);
      expect_on_targets(named.mesh, interpolate(scheme_, named.mesh, wanted), wanted);
    }
}

TEST_P(InterpolationLaws, ControlPointsComeBackFromTheirLimits) {
  int posed = 0;
  for (const NamedMesh& named : meshes(scheme_)) {
    SCOPED_TRACE(named.name);
    if (named.name == "strip" && scheme_.is_dual()) continue;  // sheets of a vertex have different limits
    const std::vector<Level> control = levels(named.mesh, 0);
    const LimitMap surface(scheme_, control[0], types_);
    std::vector<VertexTarget> own;
    for (Index v = 0; v < named.mesh.num_vertices(); ++v)
      own.push_back({v, limit_of(control, surface, named.mesh.positions, v).position[0]});
    const Mesh elsewhere = jittered(named.mesh, 0.3, 7);  // another first guess
    const Interpolation found = interpolate(scheme_, elsewhere, own, {.most_refinements = 0});
    EXPECT_TRUE(found.solved()) << why_unsolved(found.attempts.back());
    const Conditioning& C = found.attempts.back().conditioning;
    if (C.rank < named.mesh.num_vertices() || C.condition() > well_posed) continue;
    ++posed;
    EXPECT_LE((found.points - named.mesh.positions).cwiseAbs().maxCoeff(), round_trip * diagonal(named.mesh.positions));
  }
  EXPECT_GT(posed, 0) << "no mesh is well posed: nothing was compared";
}

TEST_P(InterpolationLaws, MoveTurnAndScaleWithTheTargets) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(1.1, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Vector3d shift(30, -10, 20);
  const double scale = 1e-3;
  for (const NamedMesh& named : meshes(scheme_)) {
    SCOPED_TRACE(named.name);
    const auto wanted = targets(named.mesh, true);
    Mesh turned = named.mesh;
    turned.positions = ((scale * named.mesh.positions * R.transpose()).rowwise() + shift.transpose()).eval();
    std::vector<VertexTarget> turned_targets(wanted.rbegin(), wanted.rend());  // in another order, too
    for (VertexTarget& target : turned_targets) {
      target.position = scale * R * target.position + shift;
      if (target.normal) target.normal = 5 * R * *target.normal;
    }
    const Interpolation found = interpolate(scheme_, named.mesh, wanted, {.conditioning = false});
    const Interpolation there = interpolate(scheme_, turned, turned_targets, {.conditioning = false});
    ASSERT_EQ(found.level.number, there.level.number);
    const Points back = (there.points.rowwise() - shift.transpose()) * R / scale;
    EXPECT_LE((back - found.points).cwiseAbs().maxCoeff(), round_trip * diagonal(named.mesh.positions));
  }
}

TEST_P(InterpolationLaws, SidesOfACornerTurnTogether) {
  if (scheme_.sharpening == Sharpening::boundary) return;
  const Mesh mesh = meshes(scheme_).back().mesh;
  std::vector<VertexTarget> wanted = targets(mesh, false);
  const std::vector<Level> control = levels(mesh, 0);
  const Limit own = limit_of(control, LimitMap(scheme_, control[0], types_), mesh.positions, 5);
  for (const Vector3d& side : own.normal) {  // each of them almost turned over
    wanted[5].normal = own.normal[0].cross(side).isZero(0.1)
                           ? Vector3d(-0.9 * own.normal[0] + own.normal[0].unitOrthogonal())
                           : Vector3d(-side);
    const Interpolation found = interpolate(scheme_, mesh, wanted, {.conditioning = false});
    EXPECT_TRUE(found.solution.converged) << found.solution.hard_residual;
    expect_on_targets(mesh, found, wanted);
  }
}

TEST_P(InterpolationLaws, KeepTheGuessWhereNothingIsAsked) {
  const int period = scheme_.period;
  for (const NamedMesh& named : meshes(scheme_)) {
    const Interpolation found = interpolate(scheme_, named.mesh, {}, {.least_refinements = 1});
    const Points refined = refinement_matrix(levels(named.mesh, period)) * named.mesh.positions;
    ASSERT_EQ(found.level.number, period);
    EXPECT_LE((found.points - refined).cwiseAbs().maxCoeff(), rounding(64, 10));
  }
}

TEST_P(InterpolationLaws, AddControlPointsByWholePeriods) {
  const Mesh mesh = meshes(scheme_)[0].mesh;
  const int period = scheme_.period;
  const auto with = [&](int least, int most) {
    return interpolate(scheme_, mesh, {}, {.least_refinements = least, .most_refinements = most}).level.number;
  };
  EXPECT_EQ(with(1, 2), period);
  EXPECT_EQ(with(2, 3), 2);
  if (period == 1) return;
  expect_error<InvalidParameter>([&] { with(1, 1); }, {scheme_.name, "every 2", "allow 2"});
}

}  // namespace
}  // namespace sublimit::testing
