// SPDX-License-Identifier: Apache-2.0
// Limits of meshes with knot intervals: non-uniform B-splines where the mesh is regular, the same surface from every
// level around extraordinary vertices.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <random>

#include "meshes/knot_breaks.h"
#include "meshes/meshes.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/patches/detail/interval_mesh.h"
#include "sublimit/patches/patch_set.h"
#include "sublimit/patches/spline_surface.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

const Scheme<double> levelled = *find_scheme("catmull-clark-intervals");
const Scheme<double> halves = *find_scheme("catmull-clark-intervals", {{"levelling", "off"}});

std::vector<double> random_lengths(std::mt19937& random, Index count) {
  std::uniform_real_distribution<double> positive(0.2, 3);
  std::vector<double> result(count);
  for (double& d : result) d = positive(random);
  return result;
}

/// Intervals of a mesh whose vertex (i,j) has number i * n + j: a[i] from row i on, b[j] from column j on.
void set_intervals(Mesh& mesh, Index n, const std::vector<double>& a, const std::vector<double>& b) {
  for (size_t i = 0; i < a.size(); ++i)
    mesh.knot_intervals.push_back({Index(i) * n, Index((i + 1) * n) % mesh.num_vertices(), a[i]});
  for (size_t j = 0; j < b.size(); ++j) mesh.knot_intervals.push_back({Index(j), Index(j + 1) % n, b[j]});
}

/// A mesh as a spline: the face of the spline and the place in it of a place on the mesh.
struct Twin {
  Mesh mesh;
  SplineSurface spline;
  Points points;                  ///< of the spline
  Index n, m;                     ///< columns (along v of the torus, u of the spline), rows of vertices
  Index first_row, first_column;  ///< of the spline's first face
};

void expect_same_surface(const Scheme<double>& scheme, const Twin& twin, unsigned seed) {
  const LimitMap surface(scheme, twin.mesh);
  const Topology& t = surface.level().topology();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> inside(0, 1);
  std::vector<Place> samples, others;
  std::vector<std::array<double, 4>> turns;  // (u, v) of the mesh's face by those of the spline: rows of the Jacobian
  const Index columns = twin.spline.u().num_faces(), rows = twin.spline.v().num_faces();
  for (int k = 0; k < 400; ++k) {
    const Index face = static_cast<Index>(random() % t.num_faces());
    const auto parameter = [&] { return random() % 5 == 0 ? double(random() % 2) : inside(random); };
    const double u = parameter(), v = parameter();
    const auto corners = t.vertices(Face{face});
    const auto row = [&](Index vertex) { return vertex / twin.n; };
    const auto column = [&](Index vertex) { return vertex % twin.n; };
    // Which corner comes first in rows and columns.
    const auto low = [](Index x, Index y, Index count) { return (x + 1) % count == y ? x : y; };
    const bool u_is_row = row(corners[0]) != row(corners[1]);
    const Index r0 =
        u_is_row ? low(row(corners[0]), row(corners[1]), twin.m) : low(row(corners[0]), row(corners[3]), twin.m);
    const Index c0 = u_is_row ? low(column(corners[0]), column(corners[3]), twin.n)
                              : low(column(corners[0]), column(corners[1]), twin.n);
    const double along_row = u_is_row ? (row(corners[0]) == r0 ? u : 1 - u) : (row(corners[0]) == r0 ? v : 1 - v);
    const double along_column =
        u_is_row ? (column(corners[0]) == c0 ? v : 1 - v) : (column(corners[0]) == c0 ? u : 1 - u);
    const Index spline_row = (r0 - twin.first_row + twin.m) % twin.m,
                spline_column = (c0 - twin.first_column + twin.n) % twin.n;
    if (spline_row >= rows || spline_column >= columns) continue;
    samples.push_back({face, u, v});
    others.push_back({spline_row * columns + spline_column, along_column, along_row});
    const double sr = u_is_row ? (row(corners[0]) == r0 ? 1 : -1) : (row(corners[0]) == r0 ? 1 : -1);
    const double sc = (column(corners[0]) == c0 ? 1 : -1);
    // d/du = u_is_row ? sr d/drow : sc d/dcolumn, and so on.
    turns.push_back(u_is_row ? std::array{0.0, sr, sc, 0.0} : std::array{sc, 0.0, 0.0, sr});
  }
  ASSERT_GT(samples.size(), 100u);
  const LimitSamples own = surface.evaluate(twin.mesh.positions, samples, 2);
  const PatchSet patches({std::make_shared<SplineSurface>(twin.spline)});
  const LimitSamples other = patches.evaluate(twin.points, others, 2);
  double size = 1;
  for (size_t i = 0; i < samples.size(); ++i) {
    const auto at = static_cast<Index>(i);
    Eigen::MatrixXd D(6, 3);
    D << other.position.row(at), other.du.row(at), other.dv.row(at), other.duu.row(at), other.duv.row(at),
        other.dvv.row(at);
    const auto& J = turns[i];
    const Eigen::RowVector3d du = J[0] * D.row(1) + J[1] * D.row(2), dv = J[2] * D.row(1) + J[3] * D.row(2);
    const Eigen::RowVector3d duu = J[0] * J[0] * D.row(3) + 2 * J[0] * J[1] * D.row(4) + J[1] * J[1] * D.row(5);
    const Eigen::RowVector3d duv =
        J[0] * J[2] * D.row(3) + (J[0] * J[3] + J[1] * J[2]) * D.row(4) + J[1] * J[3] * D.row(5);
    const Eigen::RowVector3d dvv = J[2] * J[2] * D.row(3) + 2 * J[2] * J[3] * D.row(4) + J[3] * J[3] * D.row(5);
    size = std::max({size, D.row(0).norm(), du.norm(), dv.norm()});
    EXPECT_LE((own.position.row(at) - D.row(0)).norm(), reference * size) << i;
    EXPECT_LE((own.du.row(at) - du).norm(), reference * size) << i;
    EXPECT_LE((own.dv.row(at) - dv).norm(), reference * size) << i;
    const double bend = std::max({size, duu.norm(), duv.norm(), dvv.norm()});
    EXPECT_LE((own.duu.row(at) - duu).norm(), other_route * bend) << i;
    EXPECT_LE((own.duv.row(at) - duv).norm(), other_route * bend) << i;
    EXPECT_LE((own.dvv.row(at) - dvv).norm(), other_route * bend) << i;
  }
}

Twin torus_twin(std::mt19937& random, Index m, Index n) {
  const std::vector<double> a = random_lengths(random, m), b = random_lengths(random, n);
  Mesh mesh = jittered(torus(m, n), 0.2, unsigned(random()));
  set_intervals(mesh, n, a, b);
  using K = Knots<double>;
  SplineSurface spline(K::closed(3, breaks_of(b)), K::closed(3, breaks_of(a)));
  Points points(m * n, 3);
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < n; ++j) points.row((i + 1) % m * n + (j + 1) % n) = mesh.positions.row(i * n + j);
  return {std::move(mesh), std::move(spline), std::move(points), n, m, 0, 0};
}

TEST(KnotIntervalLimits, OfATorusAreTheBSplineOfItsKnots) {
  std::mt19937 random(3);
  for (int run = 0; run < 2; ++run) {
    const Twin twin = torus_twin(random, 4 + run, 6 - run);
    expect_same_surface(levelled, twin, unsigned(run));
    expect_same_surface(halves, twin, unsigned(run));
  }
}

/// Limits of vertices are those of the surface there, with normals.
TEST(KnotIntervalLimits, OfVerticesHaveNormals) {
  std::mt19937 random(17);
  const Twin twin = torus_twin(random, 5, 6);
  LimitCache types(levelled);
  const Level control = control_level(levelled, twin.mesh);
  const Topology& t = control.topology();
  const LimitPoints limit = limit_points(limit_matrices(control, types), t, twin.mesh.positions);
  const LimitMap surface(levelled, control);
  ASSERT_EQ(limit.normal.rows(), t.num_vertices());
  for (Index f = 0; f < t.num_faces(); ++f) {
    const Place corner{f, 0, 0};
    const LimitSamples there = surface.evaluate(twin.mesh.positions, std::span(&corner, 1), 1);
    const Index v = t.vertices(Face{f})[0];
    EXPECT_EQ(limit.status[size_t(v)], LimitStatus::regular) << v;
    EXPECT_LE((limit.position.row(v) - there.position.row(0)).norm(), reference) << v;
    const Eigen::RowVector3d du = there.du.row(0), dv = there.dv.row(0);
    EXPECT_LE((limit.normal.row(v) - du.cross(dv).normalized()).norm(), other_route) << v;
  }
}

/// Points of a level-0 place from the surface of the control mesh, and from that of level 1, which is read as a mesh.
TEST(KnotIntervalLimits, AreTheSameFromTheNextLevel) {
  std::mt19937 random(9);
  for (Mesh mesh : {jittered(cube(), 0.2), jittered(quads_from_triangles(octahedron()), 0.1),
                    jittered(fan(5, 4, 3), 0.2), jittered(prism(5), 0.1), jittered(grid(3, 3), 0.1)}) {
    const Topology t(view(mesh));
    std::vector<std::uint8_t> known(t.num_edges(), 0);
    for (Index e = 0; e < t.num_edges(); ++e) {
      if (known[e]) continue;
      bool whole = true;
      std::vector<Index> strip{e};
      for (size_t i = 0; i < strip.size(); ++i) {
        if (known[strip[i]]) continue;
        known[strip[i]] = 1;
        for (const HalfEdge h : t.half_edges(Edge{strip[i]})) {
          whole &= t.size(t.face(h)) == 4;
          if (t.size(t.face(h)) == 4) strip.push_back(index(t.edge(t.next(t.next(h)))));
        }
      }
      if (whole || t.uniform_face_size() == 4)
        mesh.knot_intervals.push_back({index(t.tail(Edge{e})), index(t.head(Edge{e})), 1.0 + double(random() % 4)});
    }
    const Level control = control_level(levelled, mesh);
    if (control.intervals.empty()) continue;
    const Level next = next_level(levelled, control);
    const LimitMap coarse(levelled, control), fine(levelled, next);
    const Points points = mesh.positions, fine_points = next.S * mesh.positions;
    const KnotSplit split = *control.knots();
    std::uniform_real_distribution<double> inside(0, 1);
    for (int k = 0; k < 200; ++k) {
      const Index f = static_cast<Index>(random() % t.num_faces());
      if (t.size(Face{f}) != 4 || t.uniform_face_size() != 4) continue;
      const Index quarter = static_cast<Index>(random() % 4);
      const double x = random() % 4 == 0 ? double(random() % 2) : inside(random),
                   y = random() % 4 == 0 ? double(random() % 2) : inside(random);
      const HalfEdge h = t.corner(Face{f}, 0), p = t.prev(h);
      const auto cut = [&](HalfEdge g, bool from_tail) {
        const Index e = index(t.edge(g));
        const double at = split.distance[e] / split.length[e];
        return t.forward(g) == from_tail ? at : 1 - at;
      };
      const double cu = cut(h, true), cv = cut(p, false);
      const bool right = quarter == 1 || quarter == 2, up = quarter >= 2;
      const double u = right ? cu + (1 - cu) * x : cu * x, v = up ? cv + (1 - cv) * y : cv * y;
      const LimitStencil a = coarse.stencil({f, u, v}, 1), b = fine.stencil({4 * f + quarter, x, y}, 1);
      const auto value = [](const LimitStencil& stencil, const Points& at, Index q) {
        Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
        for (size_t i = 0; i < stencil.vertices.size(); ++i)
          sum += stencil.weights(q, Index(i)) * at.row(stencil.vertices[i]);
        return sum;
      };
      EXPECT_LE((value(a, points, 0) - value(b, fine_points, 0)).norm(), reference);
      if (a.weights.rows() < 3 || b.weights.rows() < 3) continue;
      const double lu = right ? 1 - cu : cu, lv = up ? 1 - cv : cv;
      EXPECT_LE((value(a, points, 1) * lu - value(b, fine_points, 1)).norm(), other_route);
      EXPECT_LE((value(a, points, 2) * lv - value(b, fine_points, 2)).norm(), other_route);
    }
    // Vertices too: their limits are those of their children.
    LimitCache types(levelled);
    const LimitPoints own = limit_points(limit_matrices(control, types), t, points),
                      child = limit_points(limit_matrices(next, types), next.topology(), fine_points);
    for (Index v = 0; v < t.num_vertices(); ++v)
      EXPECT_LE((own.position.row(v) - child.position.row(v)).norm(), reference);
  }
}

/// Borders are those of a spline with mirrored intervals and points beyond them, 2 p_0 - p_1.
TEST(KnotIntervalLimits, OfAnOpenGridAreTheBSplineWithPhantomPoints) {
  std::mt19937 random(31);
  constexpr Index m = 5, n = 4;
  const std::vector<double> a = random_lengths(random, m), b = random_lengths(random, n);
  Mesh mesh = jittered(grid(m, n), 0.2);
  for (Index i = 0; i < m; ++i) mesh.knot_intervals.push_back({i, i + 1, a[i]});
  for (Index j = 0; j < n; ++j) mesh.knot_intervals.push_back({j * (m + 1), (j + 1) * (m + 1), b[j]});
  const auto knots = [](const std::vector<double>& lengths) {
    std::vector<double> breaks = breaks_of(lengths);
    const auto count = static_cast<Index>(lengths.size());
    for (Index k = 0; k < 3; ++k) {
      breaks.insert(breaks.begin(), breaks.front() - lengths[k]);
      breaks.push_back(breaks.back() + lengths[count - 1 - k]);
    }
    return Knots<double>::open(3, count + 3, breaks);
  };
  const SplineSurface spline(knots(a), knots(b));
  // Columns first, then rows, so that corners get phantoms of phantoms.
  Points columns((m + 3) * (n + 3), 3);
  const auto at = [&](Index i, Index j) { return columns.row((j + 1) * (m + 3) + i + 1); };
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= m; ++i) at(i, j) = mesh.positions.row(j * (m + 1) + i);
  for (Index j = 0; j <= n; ++j) {
    at(-1, j) = 2 * at(0, j) - at(1, j);
    at(m + 1, j) = 2 * at(m, j) - at(m - 1, j);
  }
  for (Index i = -1; i <= m + 1; ++i) {
    at(i, -1) = 2 * at(i, 0) - at(i, 1);
    at(i, n + 1) = 2 * at(i, n) - at(i, n - 1);
  }
  const PatchSet patches({std::make_shared<SplineSurface>(spline)});
  const LimitMap surface(levelled, mesh);
  const Topology& t = surface.level().topology();
  std::uniform_real_distribution<double> inside(0, 1);
  for (Index f = 0; f < t.num_faces(); ++f)
    for (int k = 0; k < 10; ++k) {
      const double u = k < 4 ? k % 2 : inside(random), v = k < 4 ? k / 2 : inside(random);
      const double weight[] = {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
      double x = 0, y = 0;  // in the grid
      Index i = m, j = n;
      for (size_t c = 0; c < 4; ++c) {
        const Index vertex = t.vertices(Face{f})[c];
        x += weight[c] * double(vertex % (m + 1));
        y += weight[c] * double(vertex / (m + 1));
        i = std::min(i, vertex % (m + 1));
        j = std::min(j, vertex / (m + 1));
      }
      const Place own{f, u, v}, other{j * m + i, x - double(i), y - double(j)};
      const Points p = surface.evaluate(mesh.positions, std::span(&own, 1)).position,
                   q = patches.evaluate(columns, std::span(&other, 1)).position;
      EXPECT_LE((p - q).norm(), reference) << f << ' ' << u << ' ' << v;
    }
}

/// A rational surface as a mesh: the same points at all places, open and closed.
TEST(KnotIntervalLimits, OfAnImportedSurfaceAreTheSurface) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> inside(0, 1), weight(0.5, 2);
  using K = Knots<double>;
  const auto clamped = [&](Index spans) {
    std::vector<double> knots(4, 0.0);
    for (const double d : random_lengths(random, spans)) knots.push_back(knots.back() + d);
    knots.insert(knots.end(), 3, knots.back());
    return K::open(3, spans + 3, knots);
  };
  const auto loop = [&](Index spans) { return K::closed(3, breaks_of(random_lengths(random, spans))); };
  for (int run = 0; run < 6; ++run) {
    const SplineSurface surface(run % 3 == 1 ? loop(4) : clamped(1 + run),
                                run % 3 == 2 ? loop(3) : clamped(5 - run % 4));
    Points columns(surface.num_points(), 4);
    for (Index i = 0; i < columns.rows(); ++i) {
      const double w = weight(random);
      columns.row(i) << w * inside(random), w * inside(random), w * inside(random), w;
    }
    const IntervalMesh imported = interval_mesh(surface);
    const LimitMap limit(levelled, imported.mesh);
    const Points points = imported.from_points * columns;
    const PatchSet patches({std::make_shared<SplineSurface>(surface)}, Coordinates::homogeneous);
    for (int k = 0; k < 100; ++k) {
      const Index face = static_cast<Index>(random() % surface.num_faces());
      const Place at{face, random() % 5 == 0 ? double(random() % 2) : inside(random), inside(random)};
      const LimitStencil stencil = limit.stencil({imported.faces[face], at.u, at.v}, 0);
      Eigen::RowVector4d sum = Eigen::RowVector4d::Zero();
      for (size_t i = 0; i < stencil.vertices.size(); ++i)
        sum += stencil.weights(0, Index(i)) * points.row(stencil.vertices[i]);
      const LimitSamples truth = patches.evaluate(columns, std::span(&at, 1));
      EXPECT_LE((sum.head<3>() / sum[3] - truth.position.row(0)).norm(), reference) << run << ' ' << k;
    }
  }
}

TEST(KnotIntervalLimits, SurfacesThatAreNoMeshAreRefused) {
  using K = Knots<double>;
  const K simple = K::open(3, 5, {0, 0, 0, 0, 1, 2, 2, 2, 2});
  const auto refuses = [](const K& u, const K& v, std::initializer_list<std::string_view> words) {
    expect_error<InvalidParameter>([&] { interval_mesh(SplineSurface(u, v)); }, words);
  };
  refuses(K::open(2, 3, {0, 0, 0, 1, 1, 1}), simple, {"degree 2", "in u"});
  refuses(simple, K::open(3, 6, {0, 0, 0, 0, 1, 1, 2, 2, 2, 2}), {"knot 1 of v", "more than once"});
  refuses(K::closed(3, {0, 1, 2}), simple, {"three or more faces", "u has 2"});
}

}  // namespace
}  // namespace sublimit::testing
