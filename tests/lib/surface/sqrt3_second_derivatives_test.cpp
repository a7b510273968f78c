// SPDX-License-Identifier: Apache-2.0
// The limit of sqrt3 is C^2 but at extraordinary vertices, and no polynomial. At a vertex of valence 6 second
// derivatives are second differences: with neighbours p_j at d_j, j = 0 ... 5 counter-clockwise, the ring of two steps
// has the left eigenvectors p_j + p_(j+3) - 2 p of 1/9 (a mean less the centre, and the Fourier modes 2 and 4), and for
// the points of a quadratic form, which differ from those of the limit by a constant, they are its values 2 q(d_j).
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <random>

#include "meshes/hard_meshes.h"
#include "meshes/meshes.h"
#include "meshes/places.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/scheme/detail/refine_impl.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"
#include "support/tolerance.h"
#include "truth/precise_schemes.h"

namespace sublimit::testing {
namespace {

/// Second derivatives over 35 steps back, each of which keeps quadratics up to rounding.
constexpr double second_rounding = 1e-9;

RowMatrix dense(const LimitMap& surface, const Place& s, int order = 2) {
  const LimitStencil stencil = surface.stencil(s, order);
  RowMatrix rows = RowMatrix::Zero(stencil.weights.rows(), surface.level().topology().num_vertices());
  for (size_t j = 0; j < stencil.vertices.size(); ++j) rows.col(stencil.vertices[j]) = stencil.weights.col(Index(j));
  return rows;
}

double norm1(const RowMatrix& row) { return row.cwiseAbs().sum(); }

Scheme<double> sqrt3() { return find_scheme("sqrt3").value(); }

std::string words(const Place& s) {
  return "triangle " + std::to_string(s.face) + " (" + std::to_string(s.u) + ", " + std::to_string(s.v) + ")";
}

/// Inside, on sides, and towards corners down to 2^-50.
std::vector<Place> places(const Addresses& addresses, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Place> result;
  for (int i = 0; i < count; ++i) {
    Place s{Index(random() % std::uint32_t(addresses.size())), unit(random), unit(random)};
    if (s.u + s.v > 1) s.u = 1 - s.u, s.v = 1 - s.v;
    if (i % 4 == 1) s.v = 0;
    if (i % 4 == 2) s.v = 1 - s.u;
    if (i % 3 == 2) {
      const double d = std::ldexp(1.0, -int(random() % 51));
      s = {s.face, s.u * d, s.v * d};
    }
    result.push_back(s);
  }
  return result;
}

/// Six neighbours on all sides.
bool is_regular(const Topology& t, Vertex v) {
  const HalfEdge h = t.outgoing(v);
  return exists(h) && exists(t.twin(h)) && t.num_faces(v) == 6;
}

/// uu, uv and vv at the tail of h, from there on: the second differences along its triangle's sides.
RowMatrix second_differences(const Topology& t, HalfEdge h) {
  RowMatrix D = RowMatrix::Zero(3, t.num_vertices());
  const Index v = index(t.tail(h));
  Index ring[6];
  for (Index& neighbor : ring) {
    neighbor = index(t.head(h));
    h = t.ccw(h);
  }
  // Along u, along v, and along v - u, which is uu - 2 uv + vv.
  const int at[3] = {0, 1, 2}, row[3] = {0, 2, 1};
  for (int k = 0; k < 3; ++k) {
    D(row[k], ring[at[k]]) += 1;
    D(row[k], ring[at[k] + 3]) += 1;
    D(row[k], v) -= 2;
  }
  D.row(1) = (D.row(0) + D.row(2) - D.row(1)) / 2;
  return D;
}

/// Vertices of level 2 k that children of children of random triangles begin with.
TEST(SecondDerivativesOfSqrt3, AreSecondDifferencesAtRegularVertices) {
  for (const bool open : {false, true}) {
    const Mesh mesh = hard_triangles(open ? 2 : 1, {.open = open});
    const LimitMap surface(sqrt3(), mesh);
    const std::vector<Level> levels = refine(sqrt3(), mesh, 4);
    std::mt19937 random(4);
    int compared = 0;
    for (const int periods : {0, 1, 2}) {
      const Topology& fine = levels[2 * size_t(periods)].topology();
      RowMatrix P = RowMatrix::Identity(mesh.positions.rows(), mesh.positions.rows());
      for (int k = 0; k < 2 * periods; ++k) P = levels[size_t(k) + 1].S * P;
      for (int i = 0; i < 40; ++i) {
        const Index face = Index(random() % std::uint32_t(surface.addresses().size()));
        Piece piece{Piece::Kind::triangle, surface.level().topology().first(Face{face})};
        // Barycentric coordinates in the root of corners of the piece.
        Eigen::Matrix3d corners = Eigen::Matrix3d::Identity();
        for (int k = 0; k < periods; ++k) {
          const LevelStep steps[] = {{&levels[2 * size_t(k) + 1].steps[0], 2 * k},
                                     {&levels[2 * size_t(k) + 2].steps[0], 2 * k + 1}};
          const std::vector<PieceChild> all = children(piece, levels[2 * size_t(k)].topology(), steps);
          ASSERT_EQ(all.size(), 9u);
          const PieceChild& child = all[random() % 9];
          Eigen::Matrix3d to_child;
          for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b) to_child(a, b) = child.map.barycentric[size_t(a)][size_t(b)];
          corners = corners * to_child.inverse();
          piece = child.piece;
        }
        if (!is_regular(fine, fine.tail(piece.start))) continue;
        const Place s{face, std::max(0.0, corners(1, 0)), std::max(0.0, corners(2, 0))};
        const RowMatrix ours = dense(surface, s);
        ASSERT_EQ(ours.rows(), 6) << words(s);
        const RowMatrix truth = std::pow(9, periods) * second_differences(fine, piece.start) * P;
        for (int k = 0; k < 3; ++k)
          EXPECT_LE(norm1(ours.row(3 + k) - truth.row(k)), second_rounding * norm1(truth.row(k)))
              << words(s) << " row " << k << " after " << periods;
        ++compared;
      }
    }
    EXPECT_GE(compared, 40);
  }
}

/// The faces around the tail of a half-edge, again and again refined by one period in 256-bit floats.
struct Surroundings {
  Level level;
  Eigen::Matrix<Precise, Eigen::Dynamic, 3> points;
  HalfEdge start;

  Surroundings refined(const Scheme<Precise>& scheme) const {
    const Topology& t = level.topology();
    std::vector<Index> faces;
    HalfEdge h = start;
    do {
      faces.push_back(index(t.face(h)));
      h = t.ccw(h);
    } while (h != start);
    std::sort(faces.begin(), faces.end());
    const Subset part = subset(level, faces, 4);
    const auto face = std::lower_bound(part.parents.begin(), part.parents.end(), index(t.face(start)));
    const Topology& cut = part.level.topology();
    h = cut.corner(Face{Index(face - part.parents.begin())}, t.corner_index(start));
    LevelOf<Precise> whole;
    whole.number = level.number;
    whole.steps = part.level.steps;
    whole.sharpness = part.level.sharpness;
    whole.holes = part.level.holes;
    const LevelOf<Precise> one = next_level(scheme, whole), two = next_level(scheme, one);
    Surroundings result;
    result.points = two.S * (one.S * (part.level.S.cast<Precise>() * points).eval()).eval();
    result.level.number = two.number;
    result.level.steps = two.steps;
    result.level.sharpness = two.sharpness;
    result.level.holes = two.holes;
    result.start = HalfEdge{9 * index(cut.twin(cut.prev(h)))};  // the child at the same corner
    return result;
  }
};

/// 3^-k along an edge from an extraordinary vertex, where they grow or vanish like powers of the distance, relative to
/// themselves.
TEST(SecondDerivativesOfSqrt3, AreSecondDifferencesTowardsExtraordinaryVertices) {
  const Scheme<Precise> precise = find_scheme<Precise>("sqrt3").value();
  for (const Index n : {3, 4, 5, 7, 8, 12}) {
    const Mesh mesh = jittered(fan(n, 3, 3), 0.2, 3);
    const LimitMap surface(sqrt3(), mesh);
    const Topology& t = surface.level().topology();
    const HalfEdge corner = t.outgoing(Vertex{0});
    Surroundings around{surface.level(), mesh.positions.cast<Precise>(), corner};
    for (int k = 1; k <= 26; ++k) {
      around = around.refined(precise);
      const Topology& fine = around.level.topology();
      const Vertex beside = fine.head(around.start);
      ASSERT_TRUE(is_regular(fine, beside));
      // Clockwise around the neighbour, to what lies as the triangle at the corner.
      HalfEdge h = fine.next(around.start);  // along v - u
      h = fine.next(fine.twin(h));           // along v
      h = fine.next(fine.twin(h));           // along u
      const Eigen::Matrix<Precise, 3, 3> truth =
          second_differences(fine, h).cast<Precise>() * around.points * pow(Precise(9), k);
      const Place s = from_corner(t, surface.addresses(), corner, std::pow(3.0, -k), 0);
      const RowMatrix rows = dense(surface, s);
      ASSERT_EQ(rows.rows(), 6) << words(s);
      // By the parameters from the corner.
      const Place a = from_corner(t, surface.addresses(), corner, 1, 0),
                  b = from_corner(t, surface.addresses(), corner, 0, 1),
                  o = from_corner(t, surface.addresses(), corner, 0, 0);
      const auto second = [&](const Place& p, const Place& q) {
        const double pu = p.u - o.u, pv = p.v - o.v, qu = q.u - o.u, qv = q.v - o.v;
        return RowMatrix(pu * qu * rows.row(3) + (pu * qv + pv * qu) * rows.row(4) + pv * qv * rows.row(5));
      };
      RowMatrix ours(3, 3);
      ours << second(a, a) * mesh.positions, second(a, b) * mesh.positions, second(b, b) * mesh.positions;
      const RowMatrix expected = truth.cast<double>();
      EXPECT_LE((ours - expected).norm(), second_rounding * expected.norm()) << "valence " << n << " at 3^-" << k;
    }
  }
}

/// On a regular mesh, also where places are no multiples of 3^-k.
TEST(SecondDerivativesOfSqrt3, ReproduceQuadratics) {
  const Index n = 10;
  const LimitMap surface(sqrt3(), triangle_torus(n, n));
  const Topology& t = surface.level().topology();
  for (const Place& s : places(surface.addresses(), 300, 1)) {
    // Lattice coordinates of all vertices by the triangle's corners, cut where the torus is closed.
    const auto corners = t.vertices(Face{s.face});
    const auto from_first = [&](Index v) {
      const auto wrapped = [&](Index d) { return double((d + n + n / 2) % n - n / 2); };
      return Eigen::Vector2d(wrapped(v / n - corners[0] / n), wrapped(v % n - corners[0] % n));
    };
    Eigen::Matrix2d sides;
    sides << from_first(corners[1]), from_first(corners[2]);
    RowMatrix data(t.num_vertices(), 3);
    for (Index v = 0; v < t.num_vertices(); ++v) {
      const Eigen::Vector2d p = sides.inverse() * from_first(v);
      data.row(v) << p[0] * p[0] / 2, p[0] * p[1], p[1] * p[1] / 2;
    }
    const RowMatrix rows = dense(surface, s);
    ASSERT_EQ(rows.rows(), 6) << words(s);
    EXPECT_EQ(surface.stencil(s, 2).status, LimitStatus::regular) << words(s);
    const RowMatrix second = rows.bottomRows(3) * data, first = rows.middleRows(1, 2) * data;
    EXPECT_LE((second - RowMatrix::Identity(3, 3)).cwiseAbs().maxCoeff(), second_rounding) << words(s);
    RowMatrix expected(2, 3);
    expected << s.u, s.v, 0, 0, s.u, s.v;
    EXPECT_LE((first - expected).cwiseAbs().maxCoeff(), second_rounding) << words(s);
  }
}

/// Across the edges of hard meshes, where the parameters of both sides go on in each other.
TEST(SecondDerivativesOfSqrt3, AgreeAcrossEdges) {
  const Mesh mesh = hard_triangles(3);
  const LimitMap surface(sqrt3(), mesh);
  const Topology& t = surface.level().topology();
  // From derivatives by u and v to those by a along a half-edge, b along the one before, of its triangle.
  const auto turned = [&](HalfEdge h, const RowMatrix& rows) {
    const Place a = from_corner(t, surface.addresses(), h, 1, 0), b = from_corner(t, surface.addresses(), h, 0, 1),
                o = from_corner(t, surface.addresses(), h, 0, 0);
    const Eigen::Vector2d along(a.u - o.u, a.v - o.v), up(b.u - o.u, b.v - o.v);
    const auto second = [&](const Eigen::Vector2d& x, const Eigen::Vector2d& y) {
      return RowMatrix(x[0] * y[0] * rows.row(3) + (x[0] * y[1] + x[1] * y[0]) * rows.row(4) +
                       x[1] * y[1] * rows.row(5));
    };
    RowMatrix result(3, rows.cols());
    result << second(along, along), second(along, up), second(up, up);
    return result;
  };
  int compared = 0;
  for (Index i = 0; i < t.num_half_edges(); ++i) {
    const HalfEdge h{i}, g = t.twin(h);
    for (const double s : {0.3125, 0.5, 0.6875}) {
      const RowMatrix x = dense(surface, on_edge(t, surface.addresses(), h, s)),
                      y = dense(surface, on_edge(t, surface.addresses(), g, 1 - s));
      ASSERT_EQ(x.rows(), 6);
      ASSERT_EQ(y.rows(), 6);
      // The other triangle is this one turned by half.
      const RowMatrix ours = turned(h, x), theirs = turned(g, y);
      for (int k = 0; k < 3; ++k)
        EXPECT_LE(norm1(ours.row(k) - theirs.row(k)), second_rounding * (norm1(ours.row(0)) + norm1(ours.row(2))))
            << "half-edge " << i << " at " << s << " row " << k;
      ++compared;
    }
  }
  EXPECT_GE(compared, 100);
}

/// On borders parameters across are not differentiable: derivatives grow like 1 / distance. So a place whose u + v is 1
/// but for rounding is on the border, not 2^-54 inside, where second derivatives are 1e14 and their rounding 1e-2.
TEST(SecondDerivativesOfSqrt3, DoNotExistWhereSumsRoundToABorder) {
  for (const char* name : {"sqrt3", "interpolatory-sqrt3"}) {
    const auto types = std::make_shared<LimitCache>(find_scheme(name).value());
    for (const Index faces : {1, 2, 4, 5}) {
      const Mesh mesh = jittered(open_fan(faces, 3, 1));
      const LimitMap surface(types->pieces().scheme(), mesh, {}, types);
      const Topology& t = surface.level().topology();
      int borders = 0;
      for (Index i = 0; i < t.num_half_edges(); ++i) {
        if (exists(t.twin(HalfEdge{i})) || t.corner_index(HalfEdge{i}) != 1) continue;  // the side from (1,0) to (0,1)
        ++borders;
        const Index face = index(t.face(HalfEdge{i}));
        for (const auto& [u, v] : {std::pair{2.0 / 3, 1.0 / 3}, {1.0 / 3, 2.0 / 3}}) {
          ASSERT_NE(1 - u - v, 0);
          const LimitStencil stencil = surface.stencil({face, u, v}, 2);
          EXPECT_EQ(stencil.status, LimitStatus::crease) << name << ", " << faces << " faces";
          EXPECT_EQ(stencil.weights.rows(), 1);
          EXPECT_EQ(stencil.tangents.rows(), 2);
          const LimitSamples sample = surface.evaluate(mesh.positions, std::vector<Place>{{face, u, v}}, 2);
          EXPECT_EQ(sample.status[0], LimitStatus::crease);
          EXPECT_EQ(sample.order[0], 0);
        }
      }
      EXPECT_GE(borders, 1);
    }
  }
}

/// Beside it they are large, and what a table multiplies is what is sampled: to the digits of their own size.
TEST(SecondDerivativesOfSqrt3, AreTheSameBySampleAndByStencilBesideBorders) {
  for (const Index faces : {1, 2, 3, 4, 5}) {
    const Mesh mesh = jittered(open_fan(faces, 3, 1));
    const LimitMap surface(sqrt3(), mesh);
    for (Index face = 0; face < surface.addresses().size(); ++face)
      for (const auto& [u, v] : {std::pair{2.0 / 3, 1.0 / 3}, {1.0 / 3, 2.0 / 3}, {1.0 / 3, 1.0 / 3}})
        for (const double d : {1e-3, 1e-6, 1e-9, 1e-12}) {
          const Place s{face, u - d, v};
          const LimitStencil stencil = surface.stencil(s, 2);
          const LimitSamples sample = surface.evaluate(mesh.positions, std::vector<Place>{s}, 2);
          ASSERT_EQ(stencil.weights.rows(), 6) << words(s);
          ASSERT_EQ(sample.order[0], 2) << words(s);
          Points local(std::ssize(stencil.vertices), 3);
          for (Index j = 0; j < local.rows(); ++j) local.row(j) = mesh.positions.row(stencil.vertices[j]);
          const Points* parts[] = {&sample.position, &sample.du, &sample.dv, &sample.duu, &sample.duv, &sample.dvv};
          for (int k = 0; k < 6; ++k) {
            const double size = norm1(stencil.weights.row(k)) * local.cwiseAbs().maxCoeff();
            EXPECT_LE((parts[k]->row(0) - stencil.weights.row(k) * local).norm(), rounding(double(local.rows()), size))
                << words(s) << " row " << k;
          }
        }
  }
}

/// The status is that they are missing at extraordinary vertices alone, not on the edges to them.
TEST(SecondDerivativesOfSqrt3, ExistBesideExtraordinaryVertices) {
  const LimitMap surface(sqrt3(), icosahedron());
  EXPECT_EQ(surface.stencil({3, 0, 0}, 2).status, LimitStatus::extraordinary);
  EXPECT_EQ(surface.stencil({3, 0, 0}, 2).weights.rows(), 1);
  for (const Place& s : places(surface.addresses(), 60, 2)) {
    if ((s.u == 0 && s.v == 0) || s.u == 1 || s.v == 1) continue;
    EXPECT_EQ(surface.stencil(s, 2).status, LimitStatus::regular) << words(s);
    EXPECT_EQ(surface.stencil(s, 2).weights.rows(), 6) << words(s);
    EXPECT_EQ(surface.stencil(s, 1).weights.rows(), 3) << words(s);
  }
  const LimitMap interpolating(find_scheme("interpolatory-sqrt3").value(), icosahedron());
  EXPECT_EQ(interpolating.stencil({3, 0.25, 0.25}, 2).status, LimitStatus::unbounded_second);
}

}  // namespace
}  // namespace sublimit::testing
