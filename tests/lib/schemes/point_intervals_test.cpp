// SPDX-License-Identifier: Apache-2.0
// Doo-Sabin with knot intervals: the rule computed once more from faces alone, in fractions; knot insertion on regular
// meshes for any new knots; after three levels of levelling the rows of equal intervals; what is refused.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <complex>
#include <map>
#include <random>

#include "meshes/knot_breaks.h"
#include "meshes/meshes.h"
#include "meshes/point_intervals.h"
#include "sublimit/mesh/knot_intervals.h"
#include "sublimit/patches/detail/finer_knots.h"
#include "sublimit/patches/spline_surface.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/splits/detail/child_sharpness.h"
#include "support/expect_error.h"
#include "support/tolerance.h"
#include "truth/fraction.h"

namespace sublimit::testing {
namespace {

const Scheme<double> point_levelled = *find_scheme("doo-sabin-intervals");
const Scheme<double> point_halved = *find_scheme("doo-sabin-intervals", {{"levelling", "off"}});
const Scheme<double> point_uniform = *find_scheme("doo-sabin-averaging");

Eigen::MatrixXd all_rows(const SparseMatrix& S) { return Eigen::MatrixXd(S); }
Eigen::RowVectorXd one_row(const SparseMatrix& S, Index row) { return Eigen::RowVectorXd(S.row(row)); }

/// Of weights below 1 whose true value is rounded once, and which are ratios of a few sums.
constexpr double few_bits = 4e-16;

/// Intervals of points and new knots of a closed mesh by pairs (v, w): of v towards w.
struct HandPoints {
  using Pair = std::pair<Index, Index>;
  std::map<Pair, Fraction> d, s;

  /// Weights of the child of corner 0 over the corners of its face.
  std::vector<Fraction> child(const std::vector<Index>& face) const {
    const size_t n = face.size();
    std::vector<Fraction> row(n, Fraction(0)), centre(n);
    Fraction sum = 0;
    for (size_t i = 0; i < n; ++i) {
      const Index v = face[i];
      centre[i] = d.at({face[(i + 1) % n], v}) * d.at({face[(i + n - 1) % n], v});
      sum += centre[i];
    }
    const Index v = face[0], b = face[1], p = face[n - 1];
    const Fraction x = s.at({v, b}) / d.at({v, b}), y = s.at({v, p}) / d.at({v, p});
    const auto add_edge = [&](const Fraction& factor, size_t other, Index w) {
      const Fraction own = d.at({v, w}), its = d.at({w, v});
      row[0] += factor * its / (own + its);
      row[other] += factor * own / (own + its);
    };
    row[0] += x * y;
    add_edge((1 - x) * y, 1, b);
    add_edge(x * (1 - y), n - 1, p);
    for (size_t i = 0; i < n; ++i) row[i] += (1 - x) * (1 - y) * centre[i] / sum;
    return row;
  }
};

/// Faces whose limit is no tensor product, and vertices that become such.
bool is_odd(const Topology& t, Face f) { return t.size(f) != 4; }
bool is_odd(const Topology& t, Vertex v) { return t.num_faces(v) != 4; }

/// The rule of 10.2, once more: whether the knot on this edge, or its point, has something extraordinary.
bool has_odd(const Topology& t, HalfEdge h) {
  return is_odd(t, t.face(h)) || is_odd(t, t.face(t.twin(h))) || is_odd(t, t.tail(h));
}

void expect_hand_children(const Scheme<double>& scheme, const Mesh& mesh, bool levelling) {
  Level level = control_level(scheme, mesh);
  ASSERT_FALSE(level.intervals.empty());
  Fraction least = 0;
  HandPoints hand;
  const auto each = [](const Topology& t, const auto& visit) {
    for (Index i = 0; i < t.num_half_edges(); ++i)
      visit(HalfEdge{i}, HandPoints::Pair{index(t.tail(HalfEdge{i})), index(t.head(HalfEdge{i}))});
  };
  each(level.topology(), [&](HalfEdge h, const auto& pair) {
    const Topology& t = level.topology();
    hand.d[pair] = Fraction(level.intervals.length[knot_entry(KnotOwner::point, t, h)]);
    if (levelling && has_odd(t, h)) least = least == 0 ? hand.d[pair] : std::min(least, hand.d[pair]);
  });
  for (int k = 0; k < 3; ++k, least /= 2) {
    const Topology& t = level.topology();
    each(t, [&](HalfEdge h, const auto& pair) {
      const Fraction d = hand.d.at(pair);
      const bool own = has_odd(t, h), beyond = t.num_faces(t.tail(h)) == 4 && has_odd(t, t.ccw(t.ccw(h)));
      hand.s[pair] = least == 0 || own == beyond || d == least ? Fraction(d / 2)
                     : own                                     ? Fraction(least / 2)
                                                               : Fraction(d - least / 2);
    });
    Level next = next_level(scheme, level);
    const Topology& fine = next.topology();
    HandPoints children;
    for (Index i = 0; i < t.num_half_edges(); ++i) {
      const HalfEdge h{i};
      std::vector<Index> face;
      for (HalfEdge g = h; face.empty() || g != h; g = t.next(g)) face.push_back(index(t.tail(g)));
      const std::vector<Fraction> weights = hand.child(face);
      Eigen::RowVectorXd own = Eigen::RowVectorXd::Zero(t.num_vertices());
      for (size_t c = 0; c < face.size(); ++c) own[face[c]] += static_cast<double>(weights[c]);
      EXPECT_LE((one_row(next.S, i) - own).cwiseAbs().maxCoeff(), few_bits) << "corner " << i << " of level " << k;
      // Along its face's edges, and opposite to those: the part of its parent's interval next to the edge's knot.
      const Fraction along = hand.s.at({face[0], face[1]}), across = hand.s.at({face[0], face.back()});
      const HalfEdge first{i};
      HalfEdge out = first;
      for (const Fraction& length : {along, across, along, across}) {
        children.d[{index(fine.tail(out)), index(fine.head(out))}] = length;
        out = fine.ccw(out);
      }
      EXPECT_EQ(out, first);
    }
    if (next.intervals.empty()) return;
    each(fine, [&](HalfEdge h, const auto& pair) {
      EXPECT_EQ(next.intervals.length[knot_entry(KnotOwner::point, fine, h)], static_cast<double>(children.d.at(pair)));
    });
    level = std::move(next);
    hand = std::move(children);
  }
}

TEST(PointIntervals, RulesEqualThoseComputedByHand) {
  unsigned seed = 1;
  for (const Mesh& mesh : {cube(), octahedron(), prism(5), quads_from_triangles(tetrahedron())}) {
    expect_hand_children(point_levelled, with_point_intervals(mesh, ++seed), true);
    expect_hand_children(point_halved, with_point_intervals(mesh, ++seed), false);
  }
}

TEST(PointIntervals, AnyNewKnotsOfATorusAreKnotInsertion) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> positive(0.2, 3), part(0.1, 0.9);
  for (int run = 0; run < 4; ++run) {
    const Index m = 4 + run, n = 7 - run;
    const Mesh mesh = torus(m, n);
    const Topology t(view(mesh));
    std::vector<double> a(m), b(n), at_a(m), at_b(n);  // of rows and of columns; new knots from where they begin
    for (Index i = 0; i < m; ++i) a[i] = positive(random), at_a[i] = part(random) * a[i];
    for (Index j = 0; j < n; ++j) b[j] = positive(random), at_b[j] = part(random) * b[j];
    const auto count = size_t(2 * t.num_edges());
    KnotSplit split{KnotOwner::point, std::vector<double>(count), std::vector<double>(count)};
    for (Index e = 0; e < t.num_edges(); ++e)
      for (const size_t at_head : {0, 1}) {
        const Index tail = index(t.tail(Edge{e})), head = index(t.head(Edge{e}));
        const Index v = at_head ? head : tail, w = at_head ? tail : head;
        const bool along_a = v % n == w % n;
        const Index x = along_a ? v / n : v % n, y = along_a ? w / n : w % n;
        const double length = along_a ? a[x] : b[x], at = along_a ? at_a[x] : at_b[x];
        const bool forward = (x + 1) % (along_a ? m : n) == y;
        split.length[2 * size_t(e) + at_head] = length;
        split.distance[2 * size_t(e) + at_head] = forward ? length - at : at;
      }
    const Refinement r = refine(t, Split::dqq);
    const Level level = control_level(point_halved, mesh);
    const Sharpness fine_sharpness = refine(level.sharpness, t, r);
    const Eigen::MatrixXd own = all_rows(
        subdivision_matrix(point_halved, point_halved.steps[0], t, r, level.sharpness, fine_sharpness, 0, &split));
    using K = Knots<double>;
    const SplineSurface coarse(K::closed(2, breaks_of(b)), K::closed(2, breaks_of(a)));
    const SplineSurface fine(K::closed(2, finer_breaks(b, at_b)), K::closed(2, finer_breaks(a, at_a)));
    const Eigen::MatrixXd B = all_rows(refinement_matrix(coarse, fine));
    // The point of interval i is the spline's number i + 1.
    const auto coarse_number = [&](Index v) { return (v / n + 1) % m * n + (v % n + 1) % n; };
    const auto fine_number = [&](Index i, Index j) { return (i + 1) % (2 * m) * 2 * n + (j + 1) % (2 * n); };
    for (Index i = 0; i < t.num_half_edges(); ++i) {
      const HalfEdge h{i};
      const Index v = index(t.tail(h));
      // The corner's face lies on this side of its row and of its column.
      bool later_row = false, later_column = false;
      for (const HalfEdge g : {h, t.prev(h)}) {
        const Index w = g == h ? index(t.head(g)) : index(t.tail(g));
        if (w % n == v % n) later_row = (v / n + 1) % m == w / n;
        if (w / n == v / n) later_column = (v % n + 1) % n == w % n;
      }
      const Index row = fine_number(2 * (v / n) + later_row, 2 * (v % n) + later_column);
      for (Index w = 0; w < t.num_vertices(); ++w)
        EXPECT_NEAR(own(i, w), B(row, coarse_number(w)), rounding(12)) << i << ' ' << w;
    }
  }
}

/// Rows at corners of extraordinary faces of level 3 are those of equal intervals, of level 4 those of the faces next
/// to them too.
void expect_levelled_rows(const Mesh& mesh, const std::string& name) {
  SCOPED_TRACE(name);
  for (const int number : {3, 4}) {
    const Level level = refine(point_levelled, mesh, number).back();
    const Topology& t = level.topology();
    Level plain = level;
    plain.intervals = {};
    const SparseMatrix own = next_level(point_levelled, level).S, other = next_level(point_uniform, plain).S;
    int seen = 0;
    const auto expect_same = [&](Face f) {
      for (Index k = 0; k < t.size(f); ++k) {
        const Index corner = index(t.corner(f, k));
        ++seen;
        EXPECT_LE((one_row(own, corner) - one_row(other, corner)).cwiseAbs().maxCoeff(), few_bits) << corner;
      }
    };
    const auto is_inside = [&](Face f) {
      bool inside = true;
      for (Index k = 0; k < t.size(f); ++k) inside &= exists(t.twin(t.outgoing(t.tail(t.corner(f, k)))));
      return inside;
    };
    for (Index i = 0; i < t.num_faces(); ++i) {
      const Face f{i};
      if (t.size(f) == 4 || !is_inside(f)) continue;
      expect_same(f);
      if (number == 4)
        for (Index k = 0; k < t.size(f); ++k) expect_same(t.face(t.twin(t.corner(f, k))));
    }
    EXPECT_GT(seen, 0);
  }
}

TEST(PointIntervals, LevellingLeavesRowsOfEqualIntervalsAfterThreeLevels) {
  for (const Index n : {3, 5, 6, 7, 8}) {
    expect_levelled_rows(with_point_intervals(fan(n, 4, 2), unsigned(n)), "fan of " + std::to_string(n));
    expect_levelled_rows(with_point_intervals(prism(n), unsigned(n)), "prism of " + std::to_string(n));
  }
  for (unsigned seed = 1; seed <= 2; ++seed) {
    expect_levelled_rows(with_point_intervals(cube(), seed), "cube");
    expect_levelled_rows(with_point_intervals(tetrahedron(), seed), "tetrahedron");
    expect_levelled_rows(with_point_intervals(quads_from_triangles(octahedron()), seed), "octahedron's quads");
  }
}

TEST(PointIntervals, EqualOnesAreDooSabinByAveraging) {
  for (const Mesh& plain : {cube(), octahedron(), prism(5), grid(3, 4), tetrahedron()}) {
    Mesh mesh = plain;
    const Topology t(view(mesh));
    for (Index e = 0; e < t.num_edges(); ++e) {
      const Index a = index(t.tail(Edge{e})), b = index(t.head(Edge{e}));
      mesh.knot_intervals.insert(mesh.knot_intervals.end(), {{a, b, 3.25}, {b, a, 3.25}});
    }
    const std::vector<Level> own = refine(point_levelled, mesh, 2), other = refine(point_uniform, plain, 2);
    for (size_t k = 1; k <= 2; ++k)
      EXPECT_LE((all_rows(own[k].S) - all_rows(other[k].S)).cwiseAbs().maxCoeff(), few_bits);
  }
}

/// Without levelling a face keeps the ratios of its intervals: patches.md section 10.3 has these eigenvalues.
TEST(PointIntervals, HalvesMaySpiral) {
  const auto spectrum = [](const Mesh& plain, Face f, const std::vector<double>& to_next,
                           const std::vector<double>& to_previous) {
    Mesh mesh = plain;
    const Topology t(view(mesh));
    for (Index i = 0; i < t.size(f); ++i) {
      const HalfEdge h = t.corner(f, i), before = t.prev(h);
      mesh.knot_intervals.push_back({index(t.tail(h)), index(t.head(h)), to_next[size_t(i)]});
      mesh.knot_intervals.push_back({index(t.tail(h)), index(t.tail(before)), to_previous[size_t(i)]});
    }
    const Level next = next_level(point_halved, control_level(point_halved, mesh));
    Eigen::MatrixXd block(t.size(f), t.size(f));
    for (Index i = 0; i < t.size(f); ++i)
      for (Index j = 0; j < t.size(f); ++j)
        block(i, j) = next.S.coeff(index(t.corner(f, i)), index(t.tail(t.corner(f, j))));
    const Eigen::VectorXcd values = block.eigenvalues();
    std::vector<std::complex<double>> result(values.begin(), values.end());
    std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
    return result;
  };
  constexpr double four_digits = 1e-4;  // as the table has them
  const auto expect_pair = [](const std::vector<std::complex<double>>& values, double real, double imaginary) {
    EXPECT_NEAR(values[0].real(), 1, few_bits * 8);
    for (const size_t i : {1, 2}) {
      EXPECT_NEAR(values[i].real(), real, four_digits);
      EXPECT_NEAR(std::abs(values[i].imag()), imaginary, four_digits);
    }
  };
  // Three faces at each vertex of a tetrahedron: no ends are opposite.
  expect_pair(spectrum(tetrahedron(), Face{0}, {1, 2, 4}, {1, 1, 1}), 0.375, 0.0559);
  // A hexagon of a prism.
  const Mesh six = prism(6);
  const Topology t(view(six));
  Index hexagon = 0;
  while (t.size(Face{hexagon}) != 6) ++hexagon;
  expect_pair(spectrum(six, Face{hexagon}, {1, 8, 1, 8, 1, 8}, {1, 1, 1, 1, 1, 1}), 0.6446, 0.0728);
}

TEST(PointIntervals, RefusesWhatContradicts) {
  const auto refuses = [&](const Mesh& plain, std::vector<Mesh::KnotInterval> intervals,
                           std::initializer_list<std::string_view> words) {
    Mesh mesh = plain;
    mesh.knot_intervals = std::move(intervals);
    expect_error<InvalidMesh>([&] { control_level(point_levelled, mesh); }, words);
  };
  // Four edges meet at each vertex of an octahedron.
  const Topology t(view(octahedron()));
  const HalfEdge h = t.outgoing(Vertex{0});
  const Index east = index(t.head(h)), west = index(t.head(t.ccw(t.ccw(h))));
  refuses(octahedron(), {{0, east, 2}, {0, west, 3}}, {"vertex 0", "2", "3", "opposite"});
  refuses(octahedron(), {{0, east, 2}, {0, east, 3}}, {"given twice", "2", "3"});
  refuses(cube(), {{0, 1, -1}}, {"-1", "positive"});
  refuses(cube(), {{0, 1, std::nan("")}}, {"nan", "positive"});
  refuses(cube(), {{0, 1, INFINITY}}, {"inf", "positive"});
  refuses(cube(), {{0, 1, 0}}, {"is 0", "positive"});
  refuses(cube(), {{0, 7, 1}}, {"(0,7)", "no face has this edge"});
  refuses(cube(), {{0, 8, 1}}, {"vertex 8 does not exist"});
  // The two ends of an edge are two points'.
  Mesh two = cube();
  two.knot_intervals = {{0, 1, 2}, {1, 0, 3}};
  EXPECT_FALSE(control_level(point_levelled, two).intervals.empty());
}

}  // namespace
}  // namespace sublimit::testing
