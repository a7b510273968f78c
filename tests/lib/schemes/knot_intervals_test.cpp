// SPDX-License-Identifier: Apache-2.0
// Catmull-Clark with knot intervals: the rules computed once more from faces alone, in fractions; knot insertion on
// regular meshes for any new knots; after three levels of levelling Catmull-Clark's own rows; what is refused.
#include "sublimit/mesh/knot_intervals.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <set>

#include "meshes/knot_breaks.h"
#include "meshes/meshes.h"
#include "sublimit/patches/detail/finer_knots.h"
#include "sublimit/patches/spline_surface.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/splits/detail/child_intervals.h"
#include "sublimit/splits/detail/child_sharpness.h"
#include "support/expect_error.h"
#include "support/tolerance.h"
#include "truth/fraction.h"

namespace sublimit::testing {
namespace {

const Scheme<double> levelled = *find_scheme("catmull-clark-intervals");
const Scheme<double> halved_knots = *find_scheme("catmull-clark-intervals", {{"levelling", "off"}});
const Scheme<double> uniform = *find_scheme("catmull-clark");

/// A closed mesh of quadrilaterals as its faces, with intervals and new knots by directed pairs of vertices.
struct HandMesh {
  using Pair = std::pair<Index, Index>;
  using Row = std::map<Index, Fraction>;
  std::vector<std::array<Index, 4>> faces;
  std::map<Pair, Fraction> d, s;  // of (v, w): the interval, and from v to the new knot

  explicit HandMesh(const Topology& t) {
    for (Index f = 0; f < t.num_faces(); ++f) {
      const auto corners = t.vertices(Face{f});
      faces.push_back({corners[0], corners[1], corners[2], corners[3]});
    }
  }
  /// The face that runs from v to w, from v on.
  std::array<Index, 4> face(Index v, Index w) const {
    for (const std::array<Index, 4>& f : faces)
      for (size_t i = 0; i < 4; ++i)
        if (f[i] == v && f[(i + 1) % 4] == w) return {v, w, f[(i + 2) % 4], f[(i + 3) % 4]};
    throw std::logic_error("no such edge");
  }
  /// Neighbours of v, counter-clockwise from w on.
  std::vector<Index> around(Index v, Index w) const {
    std::vector<Index> result;
    for (Index x = w; result.empty() || x != w; x = face(v, x)[3]) result.push_back(x);
    return result;
  }
  Fraction beyond(Index v, Index w) const {
    const std::vector<Index> ring = around(v, w);
    const size_t n = ring.size();
    return (d.at({v, ring[2 % n]}) + d.at({v, ring[(2 * n - 2) % n]})) / 2;
  }

  static void add(Row& row, const Fraction& factor, const Row& other) {
    for (const auto& [point, weight] : other) row[point] += factor * weight;
  }
  Row middle(Index v, Index w) const {
    const Fraction whole = d.at({v, w}), near = s.at({v, w}), a = beyond(v, w), b = beyond(w, v);
    return {{v, (whole - near + b) / (whole + a + b)}, {w, (near + a) / (whole + a + b)}};
  }
  Row of_face(const std::array<Index, 4>& p) const {
    const auto share = [&](Index a, Index b, Index c, Index e) {  // of a and e along ab and ec
      const Fraction L = (beyond(a, b) + beyond(e, c)) / 2, R = (beyond(b, a) + beyond(c, e)) / 2;
      const Fraction far = d.at({a, b}) - s.at({a, b}) + R, near = s.at({a, b}) + L;
      return Fraction(far / (far + near));
    };
    const Fraction u = share(p[0], p[1], p[2], p[3]), v = share(p[1], p[2], p[3], p[0]);
    return {{p[0], u * v}, {p[1], (1 - u) * v}, {p[2], (1 - u) * (1 - v)}, {p[3], u * (1 - v)}};
  }
  Row of_edge(Index v, Index w) const {
    const std::array<Index, 4> left = face(v, w), right = face(w, v);
    const Fraction dl = d.at({v, left[3]}), sl = s.at({v, left[3]}), dr = d.at({v, right[2]}), sr = s.at({v, right[2]});
    Row row;
    add(row, (dr - sr) / (dl + dr), of_face(left));
    add(row, (sl + sr) / (dl + dr), middle(v, w));
    add(row, (dl - sl) / (dl + dr), of_face(right));
    return row;
  }
  Row of_vertex(Index v) const {
    Index first = -1;
    for (const auto& f : faces)
      for (size_t i = 0; i < 4; ++i)
        if (f[i] == v) first = f[(i + 1) % 4];
    const std::vector<Index> ring = around(v, first);
    const Index n = static_cast<Index>(ring.size());
    const auto spoke = [&](Index i) { return ring[size_t((i + 2 * n) % n)]; };
    const auto near = [&](Index i) { return s.at({v, spoke(i)}); };
    const auto far = [&](Index i) { return Fraction(d.at({v, spoke(i)}) - near(i)); };
    Fraction ss = 0, dd = 0, sum = 0;
    Row points;
    for (Index i = 0; i < n; ++i) {
      ss += near(i) * near(i + 1);
      dd += d.at({v, spoke(i)}) * d.at({v, spoke(i + 1)});
      const Fraction m = (far(i + 2) + far(i - 2)) / 2 * (near(i + 1) + near(i - 1)), f = far(i - 1) * far(i + 2);
      add(points, m, middle(v, spoke(i)));
      add(points, f, of_face(face(v, spoke(i))));
      sum += m + f;
    }
    const Fraction own = Fraction(4 * (n - 3)) / n * ss / dd;
    Row row;
    add(row, (1 - own) / sum, points);
    row[v] += own;
    return row;
  }

  bool is_extraordinary(Index v) const {
    int count = 0;
    for (const auto& f : faces) count += static_cast<int>(std::count(f.begin(), f.end(), v));
    return count != 4;
  }
  /// All edges opposite to each other, (v, w) as its strip runs.
  std::set<Pair> strip(Index v, Index w) const {
    std::set<Pair> result;
    std::vector<Pair> open{{v, w}};
    while (!open.empty()) {
      const auto [a, b] = open.back();
      open.pop_back();
      if (!result.insert({a, b}).second) continue;
      const std::array<Index, 4> left = face(a, b), right = face(b, a);
      open.push_back({left[3], left[2]});
      open.push_back({right[2], right[3]});
    }
    return result;
  }
  /// @param least  what intervals of extraordinary vertices become; 0: halves
  void split(const Fraction& least) {
    for (const auto& [edge, length] : d) {
      bool tail = false, head = false;
      for (const auto& [a, b] : strip(edge.first, edge.second)) {
        tail |= is_extraordinary(a);
        head |= is_extraordinary(b);
      }
      s[edge] = least == 0 || tail == head || length == least ? Fraction(length / 2)
                : tail                                        ? Fraction(least / 2)
                                                              : Fraction(length - least / 2);
    }
  }
};

/// Intervals of whole numbers, one for each strip, and for all strips that meet other polygons there.
Mesh with_intervals(Mesh mesh, unsigned seed, int most = 7) {
  std::mt19937 random(seed);
  const Topology t(view(mesh));
  std::vector<bool> known(t.num_edges(), false);
  for (Index e = 0; e < t.num_edges(); ++e) {
    if (known[e]) continue;
    const double length = 1.0 + double(random() % unsigned(most));
    std::vector<Index> open{e};
    while (!open.empty()) {
      const Index at = open.back();
      open.pop_back();
      if (known[at]) continue;
      known[at] = true;
      mesh.knot_intervals.push_back({index(t.tail(Edge{at})), index(t.head(Edge{at})), length});
      for (const HalfEdge h : t.half_edges(Edge{at}))
        if (t.size(t.face(h)) == 4)
          open.push_back(index(t.edge(t.next(t.next(h)))));
        else
          for (HalfEdge k = t.next(h); k != h; k = t.next(k)) open.push_back(index(t.edge(k)));
    }
  }
  return mesh;
}

Eigen::MatrixXd dense(const SparseMatrix& S) { return Eigen::MatrixXd(S); }

/// Of weights below 1 whose true value is rounded once, and which are ratios of a few sums.
constexpr double last_bits = 4e-16;

/// Three levels by the library and by hand.
void expect_hand_rules(const Scheme<double>& scheme, const Mesh& mesh, bool levelling) {
  Level level = control_level(scheme, mesh);
  HandMesh hand(level.topology());
  const Topology& t0 = level.topology();
  ASSERT_FALSE(level.intervals.empty());
  Fraction least = 0;
  for (Index e = 0; e < t0.num_edges(); ++e) {
    const Index a = index(t0.tail(Edge{e})), b = index(t0.head(Edge{e}));
    const Fraction length(level.intervals.length[e]);
    hand.d[{a, b}] = hand.d[{b, a}] = length;
    if (levelling && (hand.is_extraordinary(a) || hand.is_extraordinary(b)))
      least = least == 0 ? length : std::min(least, length);
  }
  for (int k = 0; k < 3; ++k, least /= 2) {
    hand.split(least);
    const Topology& t = level.topology();
    Level next = next_level(scheme, level);
    const Refinement& r = next.steps[0];
    const Eigen::MatrixXd S = dense(next.S);
    const auto expect_row = [&](Vertex child, const HandMesh::Row& row, const char* what) {
      Eigen::RowVectorXd own = Eigen::RowVectorXd::Zero(S.cols());
      for (const auto& [point, weight] : row) own[point] = static_cast<double>(weight);
      EXPECT_LE((S.row(index(child)) - own).cwiseAbs().maxCoeff(), last_bits)
          << what << ' ' << index(child) << " of level " << k;
    };
    HandMesh fine(next.topology());
    for (Index v = 0; v < t.num_vertices(); ++v) expect_row(r.child(Vertex{v}), hand.of_vertex(v), "vertex");
    for (Index f = 0; f < t.num_faces(); ++f) expect_row(r.child(Face{f}), hand.of_face(hand.faces[f]), "face");
    for (Index e = 0; e < t.num_edges(); ++e) {
      const Index a = index(t.tail(Edge{e})), b = index(t.head(Edge{e}));
      expect_row(r.child(Edge{e}), hand.of_edge(a, b), "edge");
      const Index middle = index(r.child(Edge{e}));
      fine.d[{a, middle}] = fine.d[{middle, a}] = hand.s.at({a, b});
      fine.d[{b, middle}] = fine.d[{middle, b}] = hand.s.at({b, a});
    }
    for (Index i = 0; i < t.num_half_edges(); ++i) {
      const HalfEdge h{i};
      const Index middle = index(r.child(t.edge(h))), centre = index(r.child(t.face(h)));
      const Index a = index(t.head(h)), b = index(t.head(t.next(h)));
      fine.d[{middle, centre}] = fine.d[{centre, middle}] = hand.s.at({a, b});
    }
    if (!next.intervals.empty()) {
      for (Index e = 0; e < next.topology().num_edges(); ++e)
        EXPECT_EQ(next.intervals.length[e], static_cast<double>(fine.d.at({index(next.topology().tail(Edge{e})),
                                                                           index(next.topology().head(Edge{e}))})));
    }
    level = std::move(next);
    hand = std::move(fine);
  }
}

TEST(KnotIntervals, RulesOfTheCubeEqualThoseComputedByHand) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Mesh mesh = with_intervals(cube(), seed);
    expect_hand_rules(levelled, mesh, true);
    expect_hand_rules(halved_knots, mesh, false);
  }
}

TEST(KnotIntervals, RulesOfHigherValencesEqualThoseComputedByHand) {
  for (const Mesh& mesh :
       {quads_from_triangles(octahedron()), quads_from_triangles(icosahedron()), quads_from_triangles(tetrahedron())})
    expect_hand_rules(levelled, with_intervals(mesh, 5), true);
}

/// A level with any new knots, of a torus whose strips they follow.
TEST(KnotIntervals, AnyNewKnotsOfATorusAreKnotInsertion) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> positive(0.2, 3), part(0.1, 0.9);
  for (int run = 0; run < 4; ++run) {
    const Index m = 4 + run, n = 7 - run;
    const Mesh mesh = torus(m, n);
    const Topology t(view(mesh));
    std::vector<double> a(m), b(n), at_a(m), at_b(n);
    for (Index i = 0; i < m; ++i) a[i] = positive(random), at_a[i] = part(random) * a[i];
    for (Index j = 0; j < n; ++j) b[j] = positive(random), at_b[j] = part(random) * b[j];
    // Vertex (i,j) has number i n + j; new knots of edges from (i,j) to (i+1,j) and to (i,j+1).
    KnotSplit split{KnotOwner::edge, std::vector<double>(t.num_edges()), std::vector<double>(t.num_edges())};
    for (Index e = 0; e < t.num_edges(); ++e) {
      const Index v = index(t.tail(Edge{e})), w = index(t.head(Edge{e}));
      const bool along_a = v % n == w % n;
      const Index x = along_a ? v / n : v % n, y = along_a ? w / n : w % n, count = along_a ? m : n;
      const bool forward = (x + 1) % count == y;
      const Index strip = forward ? x : y;
      const double length = along_a ? a[strip] : b[strip], at = along_a ? at_a[strip] : at_b[strip];
      split.length[e] = length;
      split.distance[e] = forward ? at : length - at;
    }
    const Refinement r = refine(t, Split::pqq);
    const Level level = control_level(halved_knots, mesh);
    const Sharpness fine_sharpness = refine(level.sharpness, t, r);
    const SparseMatrix S =
        subdivision_matrix(halved_knots, halved_knots.steps[0], t, r, level.sharpness, fine_sharpness, 0, &split);

    using K = Knots<double>;
    const SplineSurface coarse(K::closed(3, breaks_of(b)), K::closed(3, breaks_of(a)));
    const SplineSurface fine(K::closed(3, finer_breaks(b, at_b)), K::closed(3, finer_breaks(a, at_a)));
    const Eigen::MatrixXd B = dense(refinement_matrix(coarse, fine)), own = dense(S);
    // The control point of knot i is the spline's number i + 1.
    const auto coarse_number = [&](Index v) { return (v / n + 1) % m * n + (v % n + 1) % n; };
    const auto fine_number = [&](Index i, Index j) { return (i + 1) % (2 * m) * 2 * n + (j + 1) % (2 * n); };
    const auto expect_row = [&](Vertex child, Index i, Index j) {
      for (Index v = 0; v < t.num_vertices(); ++v)
        EXPECT_NEAR(own(index(child), v), B(fine_number(i, j), coarse_number(v)), rounding(12))
            << i << ' ' << j << ' ' << v;
    };
    const auto place = [](Index v, Index w, Index count) {  // of the middle between neighbours, or of one
      if (v == w) return 2 * v;
      return (v + 1) % count == w ? 2 * v + 1 : 2 * w + 1;
    };
    for (Index v = 0; v < t.num_vertices(); ++v) expect_row(r.child(Vertex{v}), 2 * (v / n), 2 * (v % n));
    for (Index e = 0; e < t.num_edges(); ++e) {
      const Index v = index(t.tail(Edge{e})), w = index(t.head(Edge{e}));
      expect_row(r.child(Edge{e}), place(v / n, w / n, m), place(v % n, w % n, n));
    }
    for (Index f = 0; f < t.num_faces(); ++f) {
      const auto c = t.vertices(Face{f});
      const Index across = c[2], first = c[0];
      expect_row(r.child(Face{f}), place(first / n, across / n, m), place(first % n, across % n, n));
    }
  }
}

/// Of the same weights as ratios of intervals and as numbers.
constexpr double same_weights = 1e-15;

/// Children of the elements around an extraordinary vertex of level 3 have Catmull-Clark's rows; of level 4 those of
/// the vertices next to it too.
void expect_uniform_rows(const Mesh& mesh, const std::string& name, int number) {
  SCOPED_TRACE(name);
  const std::vector<Level> levels = refine(levelled, mesh, number);
  const Level& level = levels.back();
  const Topology& t = level.topology();
  const Level own = next_level(levelled, level);
  Level plain = level;
  plain.intervals = {};
  const Level other = next_level(uniform, plain);
  const Refinement& r = own.steps[0];
  int seen = 0;
  const auto expect_same = [&](Vertex child) {
    const auto row = [&](const SparseMatrix& S) { return Eigen::RowVectorXd(S.row(index(child))); };
    ++seen;
    EXPECT_LE((row(own.S) - row(other.S)).cwiseAbs().maxCoeff(), same_weights) << index(child);
  };
  for (Index i = 0; i < t.num_vertices(); ++i) {
    const Vertex v{i};
    const bool boundary = !exists(t.twin(t.outgoing(v)));
    if (boundary ? t.num_faces(v) <= 2 : t.num_faces(v) == 4) continue;
    expect_same(r.child(v));
    for (const Edge e : t.edges(v)) {
      expect_same(r.child(e));
      if (number < 4) continue;
      for (const Vertex end : {t.tail(e), t.head(e)})
        if (end != v) expect_same(r.child(end));
    }
    for (const HalfEdge start : t.fans(v)) {
      HalfEdge h = start;
      do {
        expect_same(r.child(t.face(h)));
        h = t.ccw(h);
      } while (exists(h) && h != start);
    }
  }
  EXPECT_GT(seen, 0);
}

TEST(KnotIntervals, LevellingLeavesCatmullClarksRowsAfterThreeLevels) {
  const auto both = [](const Mesh& mesh, const std::string& name) {
    for (const int number : {3, 4}) expect_uniform_rows(mesh, name, number);
  };
  for (const Index n : {3, 5, 6, 7, 8})
    for (unsigned seed = 1; seed <= (n == 3 ? 2u : 1u); ++seed) {
      both(with_intervals(fan(n, 4, 3), seed), "fan of " + std::to_string(n));
      if (n > 3) continue;
      both(with_intervals(cube(), seed), "cube");
      both(with_intervals(quads_from_triangles(icosahedron()), seed), "ico");
      both(with_intervals(open_fan(4, 4, 3), seed), "open fan");
      both(with_intervals(prism(5), seed), "prism");
      both(with_intervals(polygon_ring({4, 5, 4, 4, 6}), seed), "ring");
    }
}

TEST(KnotIntervals, EqualOnesAreCatmullClark) {
  for (const Mesh& plain : {cube(), quads_from_triangles(tetrahedron()), prism(5), grid(3, 4), tetrahedron()}) {
    Mesh mesh = plain;
    const Topology t(view(mesh));
    for (Index e = 0; e < t.num_edges(); ++e)
      mesh.knot_intervals.push_back({index(t.tail(Edge{e})), index(t.head(Edge{e})), 3.25});
    const std::vector<Level> own = refine(levelled, mesh, 2), other = refine(uniform, plain, 2);
    for (size_t k = 1; k <= 2; ++k)
      EXPECT_LE((dense(own[k].S) - dense(other[k].S)).cwiseAbs().maxCoeff(), same_weights);
  }
}

/// Rows depend on ratios alone: the same bits for intervals times a power of two.
TEST(KnotIntervals, ScalesByPowersOfTwoDoNotMatter) {
  const Mesh mesh = with_intervals(quads_from_triangles(octahedron()), 3);
  Mesh scaled = mesh;
  for (Mesh::KnotInterval& interval : scaled.knot_intervals) interval.length *= 0x1p-20;
  const std::vector<Level> a = refine(levelled, mesh, 3), b = refine(levelled, scaled, 3);
  for (size_t k = 1; k <= 3; ++k) EXPECT_EQ((dense(a[k].S) - dense(b[k].S)).norm(), 0);
}

TEST(KnotIntervals, RefusesWhatContradicts) {
  const auto with = [](Mesh mesh, std::vector<Mesh::KnotInterval> intervals) {
    mesh.knot_intervals = std::move(intervals);
    return mesh;
  };
  const auto refuses = [&](const Mesh& mesh, std::initializer_list<std::string_view> words) {
    expect_error<InvalidMesh>([&] { control_level(levelled, mesh); }, words);
  };
  // Of the cube's face 0 -> 1 -> ... the edge (0,1) is opposite to one of its neighbours.
  const Topology t(view(cube()));
  const HalfEdge h = t.corner(Face{0}, 0), across = t.next(t.next(h));
  const Index a = index(t.tail(h)), b = index(t.head(h)), c = index(t.tail(across)), d = index(t.head(across));
  refuses(with(cube(), {{a, b, 2}, {c, d, 3}}), {"face", "opposite edges", "2", "3"});
  refuses(with(cube(), {{a, b, 2}, {b, a, 3}}), {"given twice", "2", "3"});
  refuses(with(cube(), {{a, b, -1}}), {"-1", "positive"});
  refuses(with(cube(), {{a, b, std::nan("")}}), {"nan", "positive"});
  refuses(with(cube(), {{a, b, INFINITY}}), {"inf", "positive"});
  refuses(with(cube(), {{a, b, 0}}), {"is 0", "t crease 2/1/0"});
  refuses(with(cube(), {{0, 7, 1}}), {"(0,7)", "no face has this edge"});
  refuses(with(cube(), {{0, 8, 1}}), {"vertex 8 does not exist"});
  refuses(with(prism(5), {{0, 1, 2}}), {"5 corners", "one interval"});
}

TEST(KnotIntervals, OtherSchemesIgnoreThem) {
  const Mesh mesh = with_intervals(cube(), 2);
  EXPECT_TRUE(control_level(uniform, mesh).intervals.empty());
}

}  // namespace
}  // namespace sublimit::testing
