// SPDX-License-Identifier: Apache-2.0
// Limits of vertices and samples at the corners of faces are the same places: the same position, normal and status, on
// every side of a vertex. Beside vertices, samples on borders have the normals that come to them from inside.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "laws/laws.h"
#include "laws/tested_schemes.h"
#include "meshes/places.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/surface/limit_map.h"
#include "support/tolerance.h"
#include "truth/limit_truth.h"

namespace sublimit::testing {
namespace {

using Eigen::Vector3d;
using Status = LimitStatus;
using Variant = std::pair<std::string, SchemeOptions>;

/// Radians between normals that are different ones: far more than rounding.
constexpr double clear_angle = 1e-3;

double angle(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// Types of high degrees take a minute: there are others with the same rules.
std::vector<Variant> quick_variants() {
  std::vector<Variant> all = scheme_names_and_options();
  std::erase_if(all, [](const Variant& v) {
    return v.first == "averaging" && !v.second.empty() && std::stoi(v.second.begin()->second) > 4;
  });
  return all;
}

/// Borders of 1 to 5 faces, corners, an extraordinary vertex; creases, darts and sharp vertices, where the scheme has
/// them.
std::vector<Mesh> meshes_to_sample(const Scheme<double>& scheme) {
  const Index size = scheme.face_size() == 3 ? 3 : 4, step = size == 3 ? 1 : 2;
  std::vector<Mesh> meshes{jittered(open_fan(1, size, 1)), jittered(fan(5, size, 2)),
                           jittered(size == 3 ? triangle_grid(3, 3) : grid(3, 3))};
  for (const Index n : {2, 3, 4, 5}) meshes.push_back(jittered(open_fan(n, size, 1)));
  if (scheme.preparation.empty() && size == 4) meshes.push_back(jittered(polygon_ring({3, 5, 4})));
  if (scheme.sharpening != Sharpening::semi_sharp) return meshes;
  for (const Index width : {1, 2, 5}) {  // faces on one side of a crease; one edge is a dart
    for (const bool corner : {false, true}) {
      Mesh mesh = jittered(fan(7, size, 2));
      add_crease(mesh, width == 5 ? std::vector<Index>{1, 0} : std::vector<Index>{1, 0, 1 + width * step}, 10);
      if (corner) mesh.corners = {{0, 10}};
      meshes.push_back(std::move(mesh));
    }
  }
  for (const Hardness& kind : {Hardness{.open = true, .sharp = true}, Hardness{.open = true, .semi_sharp = true}})
    meshes.push_back(size == 3 ? hard_triangles(3, kind) : hard_polygons(3, kind));
  return meshes;
}

class LimitAndSample : public ::testing::TestWithParam<Variant> {};

TEST_P(LimitAndSample, SayTheSameOfVertices) {
  const Scheme<double> scheme = find_scheme(GetParam().first, GetParam().second).value();
  LimitCache cache(scheme);
  const auto types = std::make_shared<LimitCache>(scheme);
  int compared = 0;
  for (const Mesh& mesh : meshes_to_sample(scheme)) {
    if (!scheme.preparation.empty() && GetParam().second.contains("quads") &&
        control_level(scheme, mesh).topology().uniform_face_size() != scheme.corners)
      continue;  // limits are known at its vertices only
    const LimitMap surface(scheme, mesh, {}, types);
    const Topology& t = surface.level().topology();
    const LimitMatrices matrices = limit_matrices(surface.level(), cache);
    const LimitPoints limit = limit_points(matrices, t, mesh.positions);
    std::vector<Index> faces_of(matrices.side_vertex.size(), 0);
    for (const Index side : matrices.corner_side) ++faces_of[side];
    std::vector<Place> corners;
    for (Index i = 0; i < t.num_half_edges(); ++i)
      corners.push_back(from_corner(t, surface.addresses(), HalfEdge{i}, 0, 0));
    const LimitSamples samples = surface.evaluate(mesh.positions, corners, 1);
    for (Index i = 0; i < t.num_half_edges(); ++i) {
      const Index v = index(t.tail(HalfEdge{i})), side = matrices.corner_side[i];
      SCOPED_TRACE(described(GetParam()) + ": vertex " + std::to_string(v) + " of " + std::to_string(t.num_vertices()) +
                   ", face " + std::to_string(index(t.face(HalfEdge{i}))) + ", side of " +
                   std::to_string(faces_of[side]) + " faces");
      EXPECT_LE((limit.position.row(v) - samples.position.row(i)).norm(), other_route * diagonal(mesh.positions));
      ++compared;
      if (scheme.claims.regular == 0 && faces_of[side] > 1) {
        // Faces meet at an angle: the side of a vertex has no tangent plane, each of its faces has one.
        EXPECT_EQ(limit.status[side], Status::undefined_normal);
        EXPECT_EQ(samples.status[i], Status::crease);
        continue;
      }
      EXPECT_EQ(limit.status[side], samples.status[i])
          << name(limit.status[side]) << " by limit, " << name(samples.status[i]) << " by sample";
      if (limit.status[side] == Status::undefined_normal || samples.status[i] == Status::undefined_normal) continue;
      EXPECT_LE(angle(limit.normal.row(side), samples.normal.row(i)), reference_angle);
    }
  }
  EXPECT_GE(compared, 100);
}

INSTANTIATE_TEST_SUITE_P(Registry, LimitAndSample, ::testing::ValuesIn(quick_variants()), [](const auto& parameter) {
  std::string name = described(parameter.param);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
  return name;
});

struct Border {
  Mesh mesh;
  LimitMap surface;
  HalfEdge edge = no_half_edge;  ///< of its border

  Border(const Scheme<double>& scheme, Mesh m, Index tail) : mesh(std::move(m)), surface(scheme, mesh) {
    const Topology& t = surface.level().topology();
    for (Index i = 0; i < t.num_half_edges(); ++i)
      if (!exists(t.twin(HalfEdge{i})) && index(t.tail(HalfEdge{i})) == tail) edge = HalfEdge{i};
  }
  Place place(double s, double inwards) const {
    const Topology& t = surface.level().topology();
    return s <= 0.5 ? from_corner(t, surface.addresses(), edge, s, inwards)
                    : from_corner(t, surface.addresses(), t.next(edge), inwards, 1 - s);
  }
  LimitSamples at(double s, double inwards) const {
    return surface.evaluate(mesh.positions, std::vector<Place>{place(s, inwards)}, 1);
  }
  Vector3d normal(double s, double inwards) const { return at(s, inwards).normal.row(0); }
};

/// The middle edge of the lower border of a grid: at the middle of an edge, at other binary fractions, at none.
Border lower_border(const Scheme<double>& scheme) {
  return {scheme, jittered(scheme.face_size() == 3 ? triangle_grid(3, 3) : grid(3, 3)), 1};
}

TEST(NormalsOnBorders, AreThoseThatComeFromInside) {
  const Variant variants[] = {{"averaging", {{"degree", "2"}}},
                              {"averaging", {{"degree", "4"}}},
                              {"doo-sabin", {}},
                              {"mid-edge", {}},
                              {"mid-edge-habib-warren", {}},
                              {"sqrt3", {}},
                              {"interpolatory-sqrt3", {}},
                              {"loop", {}},
                              {"butterfly", {}},
                              {"kobbelt", {}},
                              {"catmull-clark", {}}};
  for (const Variant& variant : variants) {
    const Scheme<double> scheme = find_scheme(variant.first, variant.second).value();
    const Border border = lower_border(scheme);
    for (const double s : {0.1, 0.25, 1.0 / 3, 0.5, 0.625, 0.8}) {
      if (s == 0.5 && scheme.steps[0].split == Split::mid_edge) continue;  // below
      SCOPED_TRACE(described(variant) + " at " + std::to_string(s));
      const LimitSamples there = border.at(s, 0);
      EXPECT_EQ(there.status[0], Status::crease) << name(there.status[0]);
      // Normals inside differ by less than a root of the distance; this one is of the same side.
      double last = 1;
      for (const double d : {1e-3, 1e-6, 1e-9}) {
        const double off = angle(there.normal.row(0), border.normal(s, d));
        EXPECT_LE(off, 0.1 * std::sqrt(d)) << d << " inside";
        EXPECT_LE(off, std::max(last, reference_angle));
        last = off;
      }
    }
  }
}

/// The same by refinement in 256-bit floats, without masks or blocks.
TEST(NormalsOnBorders, AgreeWithTheTruthBesideThem) {
  for (const Variant& variant : {Variant{"sqrt3", {}}}) {  // others have no derivatives across borders, or have splines
    const Scheme<double> scheme = find_scheme(variant.first, variant.second).value();
    const Border border = lower_border(scheme);
    // Second derivatives are unbounded there: normals turn faster than the distance, less than a hundred times.
    constexpr double distance = 1e-8, turned = 100 * distance;
    for (const double s : {0.25, 0.3}) {
      const TruePoint truth = true_limit(find_scheme<Precise>(variant.first, variant.second).value(),
                                         border.surface.level(), border.mesh.positions, border.place(s, distance));
      ASSERT_TRUE(truth.has_first) << described(variant);
      const Vector3d du = truth.du.cast<double>(), dv = truth.dv.cast<double>();
      EXPECT_LE(angle(border.normal(s, 0), du.cross(dv)), turned) << described(variant) << " at " << s;
    }
  }
}

/// In the middle of an edge the pieces of mid-edge that meet on the border have different normals.
TEST(NormalsOnBorders, JumpWhereMidEdgeSaysThereIsNone) {
  for (const char* scheme : {"mid-edge", "mid-edge-habib-warren"}) {
    const Border border = lower_border(find_scheme(scheme).value());
    EXPECT_EQ(border.at(0.5, 0).status[0], Status::undefined_normal);
    const double before = angle(border.normal(0.5 - 1e-6, 0), border.normal(0.5 - 1e-4, 0)),
                 across = angle(border.normal(0.5 - 1e-6, 0), border.normal(0.5 + 1e-6, 0));
    EXPECT_LE(before, clear_angle) << scheme;
    EXPECT_GE(across, 2 * clear_angle) << scheme;
  }
}

/// At border vertices of one or two faces there is one, from wherever one comes; at those of more there is none.
TEST(NormalsOnBorders, ExistAtVerticesOfMidEdgeWithFewFaces) {
  constexpr double near = 1e-5;  // of the vertex; normals differ by less times the curvature
  for (const char* name : {"mid-edge", "mid-edge-habib-warren"})
    for (const Index faces : {1, 2, 3, 4}) {
      SCOPED_TRACE(std::string(name) + ", " + std::to_string(faces) + " faces");
      const Mesh mesh = jittered(open_fan(faces, 4, 2));
      const LimitMap surface(find_scheme(name).value(), mesh);
      const Topology& t = surface.level().topology();
      std::vector<Vector3d> around;
      Vector3d own = Vector3d::Zero();
      HalfEdge h = t.outgoing(Vertex{0});
      for (Index k = 0; k < faces; ++k, h = t.ccw(h)) {
        std::vector<Place> places;
        for (const auto& [a, b] : {std::pair{0.0, 0.0}, {near, 1e-13}, {near, near}, {1e-13, near}})
          places.push_back(from_corner(t, surface.addresses(), h, a, b));
        const LimitSamples samples = surface.evaluate(mesh.positions, places, 1);
        EXPECT_EQ(samples.status[0], faces <= 2 ? Status::crease : Status::undefined_normal);
        own = samples.normal.row(0);
        for (Index i = 1; i < std::ssize(places); ++i) around.push_back(samples.normal.row(i));
      }
      double widest = 0;
      for (const Vector3d& a : around) widest = std::max(widest, angle(a, around[0]));
      if (faces <= 2) {
        EXPECT_LE(widest, near);
        EXPECT_LE(angle(own, around[0]), near);
      } else {
        EXPECT_GE(widest, clear_angle);
      }
    }
}

/// Edges of a corner that stays: a side of two faces or more bends at every edge.
TEST(LimitStatus, BilinearSidesOfSeveralFacesHaveNoNormal) {
  const Scheme<double> scheme = find_scheme("bilinear").value();
  for (const Boundary boundary : {Boundary::edge_only, Boundary::edge_and_corner}) {
    const Mesh mesh = jittered(grid(3, 3));
    const Level level = control_level(scheme, mesh, {.boundary = boundary, .creasing = {}});
    LimitCache cache(scheme);
    const LimitMatrices matrices = limit_matrices(level, cache);
    const LimitPoints points = limit_points(matrices, level.topology(), mesh.positions);
    for (Index s = 0; s < std::ssize(matrices.side_vertex); ++s) {
      const Vertex v{matrices.side_vertex[s]};
      const bool alone = level.topology().num_faces(v) == 1;
      EXPECT_EQ(points.status[s], alone ? Status::crease : Status::undefined_normal) << "vertex " << index(v);
    }
  }
}

}  // namespace
}  // namespace sublimit::testing
