// SPDX-License-Identifier: Apache-2.0
// Limits against brute force: the mesh around a vertex, refined again and again in 256-bit floats, without eigenvectors
// and without unfolding. Every kind of vertex, semi-sharp ones from level 0 included.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <map>

#include "meshes/meshes.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/limit/detail/limit_points.h"
#include "support/tolerance.h"
#include "truth/brute_force.h"

namespace sublimit::testing {
namespace {

using PreciseVector = Eigen::Matrix<Precise, 3, 1>;

PreciseVector row(const PrecisePoints& points, Vertex v) { return points.row(index(v)).transpose(); }

PreciseVector cross(const PreciseVector& a, const PreciseVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Normal of a side from its refined ring, of any length: for a side between sharp edges the edge and the way inwards,
/// for a ring the area that it sweeps.
PreciseVector ring_normal(const RefinedRing& ring, const std::vector<HalfEdge>& side, bool between_edges) {
  const Topology& t = ring.level.topology();
  const PreciseVector centre = row(ring.points, ring.vertex);
  const auto spoke = [&](HalfEdge h) { return PreciseVector(row(ring.points, t.head(h)) - centre); };
  const auto before = [&](HalfEdge h) { return PreciseVector(row(ring.points, t.tail(t.prev(h))) - centre); };
  PreciseVector normal(0, 0, 0);
  if (between_edges && side.size() > 1) {
    normal = cross(spoke(side[0]), before(side[0]));
  } else {
    for (const HalfEdge h : side) normal += cross(spoke(h), before(h));
  }
  return normal;
}

Eigen::Vector3d direction(const PreciseVector& v) {
  const Precise length = sqrt(Precise(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
  Eigen::Vector3d result;
  for (int c = 0; c < 3; ++c) result[c] = static_cast<double>(Precise(v[c] / length));
  return result;
}

struct Worst {
  double position = 0, normal = 0;
  int positions = 0, normals = 0;
};

/// Normals of the refined ring after enough steps for the next mode to die out.
constexpr double brute_angle = 1e-6;

void compare(const NamedMesh& tested, const std::string& scheme_name, Worst& worst) {
  SchemeOptions options;
  if (scheme_name == "catmull-clark" && tested.mesh.triangles == Triangles::smooth) options["triangles"] = "smooth";
  const Scheme<double> scheme = find_scheme(scheme_name, options).value();
  const Scheme<Precise> precise = find_scheme<Precise>(scheme_name, options).value();
  const Level level = control_level(scheme, tested.mesh);
  const Topology& t = level.topology();
  LimitCache cache(scheme);
  const LimitMatrices limit = limit_matrices(level, cache);
  const LimitPoints ours = limit_points(limit, t, tested.mesh.positions);
  const double size = diagonal(tested.mesh.positions);
  std::map<std::vector<std::uint32_t>, int> seen;
  for (Index v = 0; v < t.num_vertices(); ++v) {
    if (t.is_isolated(Vertex{v}) || t.num_faces(Vertex{v}) > 12) continue;
    if (seen[neighborhood(t, level.sharpness, Vertex{v}).type.signature()]++ > 0) continue;  // one of each kind
    // A second mode dies out like (mu_2/mu_1)^k, the slower the more faces a side has.
    const int depth = 60 + 50 * static_cast<int>(t.num_faces(Vertex{v}));
    const std::vector<RefinedRing> rings =
        brute_force(precise, level, tested.mesh.positions, Vertex{v}, {50, 100, 200, std::max(201, depth)});
    const RefinedRing& ring = rings[3];
    Eigen::Vector3d expected;
    for (int c = 0; c < 3; ++c) expected[c] = static_cast<double>(ring.position[c]);
    const double error = (ours.position.row(v).transpose() - expected).norm() / size;
    EXPECT_LE(error, reference) << tested.name << " vertex " << v;
    worst.position = std::max(worst.position, error);
    ++worst.positions;

    // Corners by side; those of the rings stand in the same order.
    std::map<Index, std::vector<size_t>> sides;
    std::map<Index, HalfEdge> corner_of;  // any of each side
    size_t corner = 0;
    for (const HalfEdge start : t.fans(Vertex{v})) {
      HalfEdge h = start;
      do {
        sides[limit.corner_side[index(h)]].push_back(corner++);
        corner_of[limit.corner_side[index(h)]] = h;
        h = t.ccw(h);
      } while (exists(h) && h != start);
    }
    const NeighborhoodAt at = neighborhood(t, level.sharpness, Vertex{v});
    const LimitMasks& masks = cache.masks(at.type);
    // Sides of a mesh and of a type are numbered each in an order of their own.
    const auto side_at = [&](HalfEdge h) {
      return *std::find_if(masks.sides.begin(), masks.sides.end(), [&](const LimitMasks::Side& side) {
        const std::vector<HalfEdge>& all = at.corners[side.fan];
        const auto place = std::find(all.begin(), all.end(), h) - all.begin();
        const auto n = std::ssize(all);
        return place < n && (place - side.first_corner + n) % n < side.num_corners;
      });
    };
    for (auto& [side, corners] : sides) {
      if (ours.status[side] == LimitStatus::undefined_normal || ours.normal.row(side).isZero()) continue;
      const LimitMasks::Side generic = side_at(corner_of.at(side));
      const auto normal = [&](const RefinedRing& at) {
        const auto sharp = [&](size_t i) {
          const Edge e = at.level.topology().edge(at.corners.at(i));
          return is_infinite(at.level.sharpness.edge[index(e)]);
        };
        std::vector<HalfEdge> halves;
        bool between = false;
        for (size_t i = 0; i < corners.size(); ++i)
          if (sharp(corners[i])) {  // a side of a closed fan may begin in the middle of the list
            std::rotate(corners.begin(), corners.begin() + Eigen::Index(i), corners.end());
            between = true;
            break;
          }
        for (const size_t i : corners) halves.push_back(at.corners[i]);
        return ring_normal(at, halves, between);
      };
      // At a single quad of a crease the moduli differ so much that more depth would cost all digits.
      const bool flat = corners.size() == 1 && generic.lambda2 < 0.3;
      Eigen::Vector3d brute = direction(normal(flat ? rings[1] : ring));
      // A Jordan block makes directions turn like 1/k: normals of depth k are (lambda1 lambda2)^k (k a + b) + ...,
      // where what follows dies out, so that two depths give a. Where they come to rest a is zero, and the direction is
      // b.
      const bool slow = generic.plane == LimitMasks::Plane::slow;
      if (slow) {
        const Precise shrink = Precise(generic.lambda1) * Precise(generic.lambda2);
        const auto scaled = [&](size_t i, int depth) { return PreciseVector(normal(rings[i]) / pow(shrink, depth)); };
        const PreciseVector at100 = scaled(1, 100), before = at100 - scaled(0, 50), after = scaled(2, 200) - at100;
        const Precise moved = before.dot(before);
        if (moved > Precise(1e-20) * at100.dot(at100) && after.dot(after) > moved) brute = direction(after);
      }
      const Eigen::Vector3d limit_normal = ours.normal.row(side);
      const double angle = std::atan2(brute.cross(limit_normal).norm(), brute.dot(limit_normal));
      EXPECT_LE(angle, brute_angle) << tested.name << " vertex " << v << " side of " << corners.size()
                                    << " faces, status " << name(ours.status[side]) << (slow ? ", slow" : "");
      worst.normal = std::max(worst.normal, angle);
      ++worst.normals;
    }
  }
}

class BruteForce : public ::testing::TestWithParam<NamedMesh> {};

TEST_P(BruteForce, AgreesWithLimits) {
  Worst worst;
  for (const std::string& scheme : GetParam().schemes) {
    SCOPED_TRACE(scheme);
    if (scheme != "bilinear") compare(GetParam(), scheme, worst);
  }
  RecordProperty("positions", worst.positions);
  RecordProperty("normals", worst.normals);
}
INSTANTIATE_TEST_SUITE_P(Tagged, BruteForce, ::testing::ValuesIn(tagged_meshes()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace sublimit::testing
