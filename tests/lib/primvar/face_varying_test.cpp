// SPDX-License-Identifier: Apache-2.0
#include "sublimit/primvar/face_varying.h"

#include <gtest/gtest.h>

#include "meshes/face_varying_meshes.h"
#include "meshes/irregular_meshes.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/primvar/linear_scheme.h"
#include "sublimit/schemes/schemes.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using enum FaceVaryingInterpolation;

/// Every scheme, those of several steps that keep edges among them.
std::vector<Scheme<double>> schemes() {
  std::vector<Scheme<double>> result = all_schemes();
  result.push_back(find_scheme("averaging", {{"degree", "5"}}).value());
  return result;
}
bool keeps_edges(const Scheme<double>& scheme) { return keeps_elements(scheme.steps); }

/// Meshes without tags for a scheme, closed and open.
std::vector<Mesh> closed_meshes(const Scheme<double>& scheme) {
  if (scheme.face_size() == 3) return {jittered(icosahedron()), jittered(triangle_torus(5, 4))};
  if (scheme.face_size() == 4) return {jittered(cube()), jittered(torus(5, 4))};
  return {jittered(cube()), jittered(torus(5, 4)), jittered(prism(5))};
}
std::vector<Mesh> open_meshes(const Scheme<double>& scheme) {
  if (scheme.face_size() == 3) return {jittered(triangle_grid(4, 3)), jittered(open_fan(4, 3, 2))};
  if (scheme.face_size() == 4) return {jittered(grid(4, 3)), jittered(open_fan(3, 4, 2))};
  return {jittered(grid(4, 3)), jittered(polygon_ring({5, 4, 3, 6, 4}))};
}
std::vector<Mesh> plain_meshes(const Scheme<double>& scheme) {
  std::vector<Mesh> all = closed_meshes(scheme);
  for (Mesh& mesh : open_meshes(scheme)) all.push_back(std::move(mesh));
  return all;
}

/// A channel whose values are the vertices, in another order.
Mesh with_vertices_as_values(Mesh mesh) {
  Mesh::FaceVarying channel{.name = "p", .values = mesh.positions.colwise().reverse(), .indices = mesh.face_vertices};
  for (Index& i : channel.indices) i = mesh.num_vertices() - 1 - i;
  mesh.face_varying = {channel};
  return mesh;
}

Points values_of_last(const std::vector<FaceVaryingLevel>& levels, const Mesh& mesh) {
  return apply(refinement_matrix(levels, static_cast<Index>(mesh.face_varying[0].values.rows())),
               mesh.face_varying[0].values);
}

double size(const Mesh& mesh) { return mesh.positions.cwiseAbs().maxCoeff(); }

TEST(FaceVarying, RowsSumToOne) {
  for (const Scheme<double>& scheme : schemes()) {
    if (!keeps_edges(scheme)) continue;
    for (const Mesh& plain : plain_meshes(scheme))
      for (const FaceVaryingInterpolation interpolation : all_interpolations) {
        SCOPED_TRACE(scheme.name + ", " + name(interpolation));
        const Mesh mesh = with_random_channel(plain, 0.3);
        const auto levels = refine_face_varying(scheme, interpolation, mesh.face_varying[0], refine(scheme, mesh, 2));
        for (size_t k = 1; k < levels.size(); ++k) {
          const SparseMatrix& S = levels[k].level.S;
          const Eigen::VectorXd sums = S * Eigen::VectorXd::Ones(S.cols());
          EXPECT_LE((sums.array() - 1).abs().maxCoeff(), rounding(100));
        }
      }
  }
}

TEST(FaceVarying, ValuesAreThoseOfTheMatrix) {
  const Mesh mesh = with_random_channel(jittered(cube()), 0.3);
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  const auto levels = refine_face_varying(scheme, corners_plus1, mesh.face_varying[0], refine(scheme, mesh, 3));
  const Points difference = values_of_last(levels, mesh) - refined_values(levels, mesh.face_varying[0].values);
  EXPECT_LE(difference.cwiseAbs().maxCoeff(), rounding(12));
}

TEST(FaceVarying, WithoutSeamsValuesMoveAsVertices) {
  for (const Scheme<double>& scheme : schemes()) {
    const auto expect_same = [&](const Mesh& plain, FaceVaryingInterpolation interpolation) {
      SCOPED_TRACE(scheme.name + ", " + name(interpolation));
      const Mesh mesh = with_vertices_as_values(plain);
      const std::vector<Level> levels = refine(scheme, mesh, 2);
      const auto channel = refine_face_varying(scheme, interpolation, mesh.face_varying[0], levels);
      const Points values = values_of_last(channel, mesh), points = apply(refinement_matrix(levels), mesh.positions);
      const Topology &t = levels[2].topology(), &v = channel[2].level.topology();
      ASSERT_EQ(v.num_vertices(), t.num_vertices());
      for (Index h = 0; h < t.num_half_edges(); ++h) {
        EXPECT_EQ(v.twin(HalfEdge{h}), t.twin(HalfEdge{h}));
        const Points difference = values.row(index(v.tail(HalfEdge{h}))) - points.row(index(t.tail(HalfEdge{h})));
        EXPECT_LE(difference.cwiseAbs().maxCoeff(), rounding(100, size(mesh)));
      }
    };
    for (const Mesh& mesh : closed_meshes(scheme))
      for (const FaceVaryingInterpolation interpolation :
           {none, corners_only, corners_plus1, corners_plus2, boundaries})
        if (interpolation != boundaries || keeps_edges(scheme)) expect_same(mesh, interpolation);
    for (const Mesh& mesh : open_meshes(scheme))  // edge-and-corner: single faces are corners of the mesh too
      for (const FaceVaryingInterpolation interpolation : {none, corners_only, corners_plus1, corners_plus2})
        expect_same(mesh, interpolation);
  }
}

// A channel of a mesh without tags is refined as the mesh is that its faces make over the values, seams being its
// boundaries.
TEST(FaceVarying, IsTheMeshOfItsValues) {
  for (const Scheme<double>& scheme : schemes()) {
    if (!keeps_edges(scheme)) continue;
    for (const Mesh& plain : plain_meshes(scheme))
      for (const double seams : {0.1, 0.3, 0.6})
        for (const bool sharp : {false, true}) {
          SCOPED_TRACE(scheme.name + ", seams " + std::to_string(seams) + (sharp ? ", corners" : ""));
          Mesh mesh = with_random_channel(plain, seams);
          mesh.boundary = sharp ? Boundary::edge_and_corner : Boundary::edge_only;
          const auto channel =
              refine_face_varying(scheme, sharp ? corners_only : none, mesh.face_varying[0], refine(scheme, mesh, 2));
          Mesh cut = mesh;
          cut.positions = mesh.face_varying[0].values.leftCols<2>() * Eigen::Matrix<double, 2, 3>::Ones();
          cut.face_vertices = mesh.face_varying[0].indices;
          const std::vector<Level> levels = refine(scheme, cut, 2);
          for (size_t k = 1; k < levels.size(); ++k) {
            ASSERT_EQ(channel[k].level.S.rows(), levels[k].S.rows());
            EXPECT_EQ((channel[k].level.S - levels[k].S).norm(), 0);
          }
        }
  }
}

TEST(FaceVarying, AllIsLinearWithoutSeams) {
  for (const Scheme<double>& scheme : schemes()) {
    if (!keeps_edges(scheme)) continue;
    for (const Mesh& plain : plain_meshes(scheme)) {
      SCOPED_TRACE(scheme.name);
      const Mesh mesh = with_vertices_as_values(plain);
      const std::vector<Level> levels = refine(scheme, mesh, 2);
      const auto channel = refine_face_varying(scheme, all, mesh.face_varying[0], levels);
      const Points values = values_of_last(channel, mesh),
                   points = apply(refinement_matrix(refine(linear_scheme(scheme), mesh, 2)), mesh.positions);
      for (Index p = 0; p < values.rows(); ++p)
        EXPECT_LE((values.row(p) - points.row(channel[2].vertices[p])).norm(), rounding(40, size(mesh)));
    }
  }
}

// Two quadrilaterals side by side, a seam between them: each side is a square of its own.
TEST(FaceVarying, ValuesOfOneFaceStayOrMoveAlongItsEdges) {
  const Mesh mesh = with_channel(grid(2, 1), {{1, 4}});
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  const std::vector<Level> levels = refine(scheme, mesh, 1, {.boundary = Boundary::edge_only, .creasing = {}});
  const auto rows = [&](FaceVaryingInterpolation interpolation) {
    const auto channel = refine_face_varying(scheme, interpolation, mesh.face_varying[0], levels);
    return Eigen::MatrixXd(channel[1].level.S);
  };
  ASSERT_EQ(rows(none).cols(), 8);
  for (Index p = 0; p < 8; ++p) {  // cubic B-spline along the boundary of a square: 3/4, and 1/8 for each neighbour
    EXPECT_EQ(rows(none)(p, p), 0.75);
    EXPECT_EQ((rows(none).row(p).array() == 0.125).count(), 2);
    for (const FaceVaryingInterpolation linear : {corners_only, corners_plus1, corners_plus2, boundaries, all})
      EXPECT_EQ(rows(linear)(p, p), 1);
  }
}

// The end of a seam inside: 3/4 and twice 1/8, both along the seam, or it stays.
TEST(FaceVarying, TheEndOfASeam) {
  const Mesh mesh = with_channel(grid(2, 2), {{1, 4}});
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  const std::vector<Level> levels = refine(scheme, mesh, 1);
  for (const FaceVaryingInterpolation interpolation : all_interpolations) {
    SCOPED_TRACE(name(interpolation));
    const auto channel = refine_face_varying(scheme, interpolation, mesh.face_varying[0], levels);
    const Eigen::MatrixXd S(channel[1].level.S);
    Index end = 0;
    std::vector<Index> along;
    for (Index p = 0; p < S.cols(); ++p) {
      if (channel[0].vertices[p] == 4) end = p;
      if (channel[0].vertices[p] == 1) along.push_back(p);
    }
    ASSERT_EQ(along.size(), 2u);
    const bool smooth = interpolation < corners_plus2;
    EXPECT_EQ(S(end, end), smooth ? 0.75 : 1);
    for (const Index p : along) EXPECT_EQ(S(end, p), smooth ? 0.125 : 0);
  }
}

// A semi-sharp crease that ends at a seam sharpens the values of its side, and under plus1 those of the other side as
// well.
TEST(FaceVarying, CreasesThatMeetASeam) {
  Mesh mesh = with_channel(grid(4, 4), {{2, 7}, {7, 12}, {12, 17}, {17, 22}});
  add_crease(mesh, {12, 13, 14}, 1.5f);
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  const std::vector<Level> levels = refine(scheme, mesh, 3);
  for (const FaceVaryingInterpolation interpolation : {none, corners_only, corners_plus1, corners_plus2}) {
    SCOPED_TRACE(name(interpolation));
    const auto channel = refine_face_varying(scheme, interpolation, mesh.face_varying[0], levels);
    for (Index p = 0; p < channel[0].level.topology().num_vertices(); ++p) {
      if (channel[0].vertices[p] != 12) continue;
      bool at_crease = false;
      for (const Edge e : channel[0].level.topology().edges(Vertex{p}))
        at_crease |= channel[0].level.sharpness.edge[index(e)] == 1.5f;
      const bool corner = at_crease || interpolation >= corners_plus1;
      EXPECT_EQ(channel[1].level.S.coeff(p, p), corner ? 1 : 0.75);
      EXPECT_EQ(channel[2].level.S.coeff(p, p), corner ? 0.5 + 0.5 * 0.75 : 0.75);  // half a level is left
      EXPECT_EQ(channel[3].level.S.coeff(p, p), 0.75);
    }
  }
}

// At a vertex of several sheets each has its own values.
TEST(FaceVarying, SheetsHaveValuesOfTheirOwn) {
  const Mesh mesh = glued(grid(2, 2), grid(2, 2), {8}, {0});
  ASSERT_TRUE(Topology(view(mesh)).is_nonmanifold(Vertex{8}));
  Mesh apart = with_channel(mesh, {});
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  const std::vector<Level> levels = refine(scheme, apart, 2);
  for (const FaceVaryingInterpolation interpolation : all_interpolations) {
    const auto channel = refine_face_varying(scheme, interpolation, apart.face_varying[0], levels);
    EXPECT_EQ(channel[2].level.topology().num_vertices(), levels[2].topology().num_vertices() + 1);
    EXPECT_TRUE(channel[2].level.topology().is_manifold());
  }
}

/// Limits of the values of level k: from there, and from one level on.
TEST(FaceVarying, LimitsAreTheSameFromEveryLevel) {
  for (const char* scheme_name :
       {"catmull-clark", "loop", "loop-warren", "bilinear", "butterfly", "modified-butterfly", "kobbelt"}) {
    const Scheme<double> scheme = find_scheme(scheme_name).value();
    for (Mesh plain : plain_meshes(scheme))
      for (const FaceVaryingInterpolation interpolation : all_interpolations) {
        if (scheme.sharpening == Sharpening::semi_sharp) {
          const Topology t(view(plain));
          const auto edge = [&](Index h) {
            return std::vector<Index>{index(t.tail(HalfEdge{h})), index(t.head(HalfEdge{h}))};
          };
          add_crease(plain, edge(0), 0.7f);
          add_crease(plain, edge(5), 1.5f);
          add_crease(plain, edge(6), 10);
          plain.corners.push_back({plain.num_vertices() - 1, 1.25f});
        }
        SCOPED_TRACE(scheme.name + ", " + name(interpolation));
        const Mesh mesh = with_random_channel(plain, 0.3);
        const std::vector<Level> levels = refine(scheme, mesh, 2);
        const auto channel = refine_face_varying(scheme, interpolation, mesh.face_varying[0], levels);
        LimitCache cache(face_varying_scheme(scheme, interpolation));
        const Points given = control_values(channel[0], mesh.face_varying[0].values);
        const Points one = apply(channel[1].level.S, given), two = apply(channel[2].level.S, one);
        const Points from_0 = apply(limit_matrices(channel[0].level, cache).position, given);
        const Points from_1 = apply(limit_matrices(channel[1].level, cache).position, one);
        const Points from_2 = apply(limit_matrices(channel[2].level, cache).position, two);
        const double bound = eigen(100);
        EXPECT_LE((from_0 - from_1.topRows(from_0.rows())).cwiseAbs().maxCoeff(), bound);
        EXPECT_LE((from_1 - from_2.topRows(from_1.rows())).cwiseAbs().maxCoeff(), bound);
        if (interpolation == all) {
          EXPECT_LE((from_0 - given).cwiseAbs().maxCoeff(), bound);
        }
      }
  }
}

TEST(FaceVarying, SchemesThatCutEdgesTakeNoSeams) {
  const Mesh seam = with_channel(grid(2, 2), {{1, 4}}), triangles = with_channel(triangle_grid(2, 2), {{1, 4}});
  for (const Scheme<double>& scheme : schemes()) {
    if (keeps_edges(scheme)) continue;
    SCOPED_TRACE(scheme.name);
    const Mesh& mesh = scheme.face_size() == 3 ? triangles : seam;
    const Level control = control_level(scheme, mesh);
    const auto channel = [&](FaceVaryingInterpolation interpolation) {
      control_face_varying(scheme, interpolation, mesh.face_varying[0], control);
    };
    expect_error<UnsupportedTopology>([&] { channel(corners_only); },
                                      {"'uv'", "(1,4)", scheme.name, "corners-only", "loop"});
    expect_error<InvalidOption>([&] { channel(all); }, {"'all'", scheme.name});
    expect_error<InvalidOption>([&] { channel(boundaries); }, {"'boundaries'", scheme.name});
  }
}

TEST(FaceVarying, IndicesAreChecked) {
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  const Mesh mesh = with_channel(grid(2, 2), {});
  const Level control = control_level(scheme, mesh);
  Mesh::FaceVarying channel = mesh.face_varying[0];
  const auto try_it = [&] { control_face_varying(scheme, none, channel, control); };
  channel.indices[3] = 9;
  expect_error<InvalidMesh>(try_it, {"'uv'", "corner 3 has value 9", "has 9"});
  channel.indices[3] = -1;
  expect_error<InvalidMesh>(try_it, {"corner 3 has value -1"});
  channel.indices.pop_back();
  expect_error<InvalidMesh>(try_it, {"15 indices", "16 corners"});
  expect_error<InvalidParameter>([&] { refine_face_varying(scheme, none, channel, {}); }, {"no levels"});
}

}  // namespace
}  // namespace sublimit::testing
