// SPDX-License-Identifier: Apache-2.0
// Laws of limit surfaces, for every scheme, on meshes that have everything at once: what stencils must be whatever the
// scheme.
#include "sublimit/surface/limit_map.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <random>

#include "laws/tested_schemes.h"
#include "meshes/places.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/limit/detail/limit_points.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Central differences over 2^-17, relative to the derivatives. Of polynomials, first ones are wrong by the square of
/// the step and by eps by the step, where pieces meet by the step itself, and second ones by a digit more.
constexpr double difference_error = 1e-6, second_difference_error = 10 * difference_error;
/// Of limits that are no polynomials the derivatives are but a little better than continuous.
constexpr double rough_difference_error = 1e-2;

/// Rows of a stencil over all vertices of a level.
RowMatrix dense(const LimitMap& surface, const LimitStencil& s) {
  RowMatrix rows = RowMatrix::Zero(s.weights.rows(), surface.level().topology().num_vertices());
  for (size_t j = 0; j < s.vertices.size(); ++j) rows.col(s.vertices[j]) = s.weights.col(Eigen::Index(j));
  return rows;
}

double norm1(const RowMatrix& row) { return row.cwiseAbs().sum(); }

std::string words(const Place& s) {
  return "square " + std::to_string(s.face) + " (" + std::to_string(s.u) + ", " + std::to_string(s.v) + ")";
}

class LimitSurfaceLaws : public ::testing::TestWithParam<TestedScheme> {
 protected:
  void SetUp() override {
    scheme_ = GetParam().scheme();
    types_ = std::make_shared<LimitCache>(scheme_);
  }
  template <class Law>
  void on_hard_meshes(const Law& law) const {
    int kind = 0;
    for (const Mesh& mesh : hard_meshes(scheme_, 2)) {
      SCOPED_TRACE("hard mesh " + std::to_string(kind++));
      law(LimitMap(scheme_, mesh, {}, types_), mesh);
    }
  }
  /// Places of all kinds: inside, on edges, at corners, near them.
  std::vector<Place> places(const LimitMap& surface, int count, unsigned seed) const {
    const Topology& t = surface.level().topology();
    std::vector<Place> result = random_places(surface.addresses(), count, seed);
    std::mt19937 random(seed);
    for (int i = 0; i < count; ++i) {
      const HalfEdge h{Index(random() % std::uint32_t(t.num_half_edges()))};
      const double d = std::ldexp(1.0, -1 - int(random() % 40));
      result.push_back(on_edge(t, surface.addresses(), h, double(random() % 16) / 16));
      result.push_back(from_corner(t, surface.addresses(), h, d * 0.625, d * 0.25));
      result.push_back(from_corner(t, surface.addresses(), h, 0, 0));
    }
    return result;
  }
  bool triangles() const { return takes_triangles(scheme_); }
  /// Of so many places, those that there is time for.
  int count(int places) const { return std::max(4, places / effort(scheme_)); }
  /// Sums of some hundred weights, each right to a few roundings; polynomials of degree 8 and 9 lose a digit.
  double rounded() const { return eigen(scheme_.claims.regular < 7 ? 10 : 100); }

  Scheme<double> scheme_;
  std::shared_ptr<LimitCache> types_;  // shared by all surfaces of a test
};

TEST_P(LimitSurfaceLaws, PositionsSumToOneAndDerivativesToZero) {
  on_hard_meshes([&](const LimitMap& surface, const Mesh&) {
    for (const Place& s : places(surface, count(20), 1)) {
      const LimitStencil stencil = surface.stencil(s, 2);
      ASSERT_GE(stencil.weights.rows(), 1) << words(s);
      ASSERT_TRUE(stencil.weights.allFinite() && stencil.tangents.allFinite()) << words(s);
      EXPECT_TRUE(std::is_sorted(stencil.vertices.begin(), stencil.vertices.end()));
      const double terms = double(stencil.vertices.size());
      for (Eigen::Index k = 0; k < stencil.weights.rows(); ++k) {
        const RowMatrix row = stencil.weights.row(k);
        EXPECT_LE(std::abs(row.sum() - (k == 0 ? 1 : 0)), rounding(terms, norm1(row))) << words(s) << " row " << k;
      }
      for (Eigen::Index k = 0; k < std::min<Eigen::Index>(2, stencil.tangents.rows()); ++k) {
        const RowMatrix row = stencil.tangents.row(k);
        EXPECT_LE(std::abs(row.sum()), rounding(terms, norm1(row)) + eigen(100) * norm1(row))
            << words(s) << " tangent " << k;
      }
    }
  });
}

TEST_P(LimitSurfaceLaws, LowerOrdersAreTheSameRows) {
  on_hard_meshes([&](const LimitMap& surface, const Mesh&) {
    for (const Place& s : places(surface, count(6), 4)) {
      const RowMatrix both = dense(surface, surface.stencil(s, 2));
      for (int order = 0; order < 2; ++order) {
        const RowMatrix rows = dense(surface, surface.stencil(s, order));
        EXPECT_LE(rows.rows(), order == 0 ? 1 : 3);
        for (Eigen::Index k = 0; k < std::min(rows.rows(), both.rows()); ++k)
          EXPECT_LE(norm1(rows.row(k) - both.row(k)), rounded() * norm1(both.row(k))) << words(s) << " row " << k;
      }
    }
  });
}

/// Positions from both sides, and derivatives along the edge: differences of places along it say what these are.
TEST_P(LimitSurfaceLaws, IsOneSurfaceAcrossEdges) {
  on_hard_meshes([&](const LimitMap& surface, const Mesh&) {
    const Topology& t = surface.level().topology();
    const Addresses& addresses = surface.addresses();
    struct Side {
      Place at;
      double du, dv;  // of the place along the edge
    };
    const auto expect_same = [&](const Side& a, const Side& b) {
      SCOPED_TRACE(words(a.at) + " and " + words(b.at));
      const LimitStencil one = surface.stencil(a.at, 1), other = surface.stencil(b.at, 1);
      const RowMatrix x = dense(surface, one), y = dense(surface, other);
      EXPECT_LE(norm1(x.row(0) - y.row(0)), rounded() * norm1(x.row(0)));
      if (x.rows() < 3 || y.rows() < 3) return;
      const RowMatrix dx = a.du * x.row(1) + a.dv * x.row(2), dy = b.du * y.row(1) + b.dv * y.row(2);
      EXPECT_LE(norm1(dx - dy), (scheme_.claims.regular < 8 ? 100 : 1000) * rounded() * norm1(dx));
    };
    const auto along = [&](HalfEdge h, double s, double sign) {
      const double d = 1.0 / 64;
      const Place at = on_edge(t, addresses, h, s), to = on_edge(t, addresses, h, s + sign * d);
      return Side{at, (to.u - at.u) / d, (to.v - at.v) / d};
    };
    // Dual schemes have no parameter of their own along edges that come to a border between others.
    const auto meets_border = [&](Vertex v) { return scheme_.is_dual() && t.is_boundary(v) && t.num_faces(v) != 2; };
    const Index stride = 3 * effort(scheme_);
    for (Index i = 0; i < t.num_half_edges(); i += stride) {
      const HalfEdge h{i}, g = t.twin(h);
      if (exists(g)) {
        if (!meets_border(t.tail(h)) && !meets_border(t.head(h)))
          for (const double s : {0.34375, 0.6875, 0.75}) expect_same(along(h, s, 1), along(g, 1 - s, -1));
        const RowMatrix x = dense(surface, surface.stencil(on_edge(t, addresses, h, 0.5))),
                        y = dense(surface, surface.stencil(on_edge(t, addresses, g, 0.5)));
        EXPECT_LE(norm1(x - y), rounded() * norm1(x)) << "the middle of half-edge " << i;
      }
      const Face f = t.face(h);
      if (triangles() || t.size(f) == 4) continue;
      // Inside a polygon: the right side of one square is the upper side of the next one.
      const Index k = t.corner_index(h), first = addresses.first(f);
      for (const double s : {0.3125, 0.875})
        expect_same({{first + k, 1, s}, 0, 1}, {{first + (k + 1) % t.size(f), s, 1}, 1, 0});
    }
  });
}

/// Where children of pieces meet, a place beside another has nearly the same stencil.
TEST_P(LimitSurfaceLaws, IsContinuousWherePiecesAreCut) {
  on_hard_meshes([&](const LimitMap& surface, const Mesh&) {
    for (const Place& s : random_places(surface.addresses(), count(12), 6))
      for (const double cut : {0.5, 0.25, 1.0 / 3}) {
        const double v = triangles() ? s.v * (1 - cut) : s.v;
        for (const bool turned : {false, true}) {
          const auto at = [&](double x) { return turned ? Place{s.face, v, x} : Place{s.face, x, v}; };
          const RowMatrix x = dense(surface, surface.stencil(at(cut), 0)),
                          y = dense(surface, surface.stencil(at(std::nextafter(cut, 0.0)), 0)),
                          z = dense(surface, surface.stencil(at(std::nextafter(cut, 1.0)), 0));
          EXPECT_LE(norm1(x - y), rounded() * norm1(x)) << words(at(cut));
          EXPECT_LE(norm1(x - z), rounded() * norm1(x)) << words(at(cut));
        }
      }
  });
}

/// Away from what is dyadic.
TEST_P(LimitSurfaceLaws, DerivativesAreDifferences) {
  const double h = std::ldexp(1.0, -17);
  on_hard_meshes([&](const LimitMap& surface, const Mesh&) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> inside(0.01, 0.49);
    int compared = 0;
    for (int i = 0; i < count(15); ++i) {
      const Place s{Index(random() % std::uint32_t(surface.addresses().size())), inside(random), inside(random)};
      const RowMatrix x = dense(surface, surface.stencil(s, 2));
      if (x.rows() < 3) continue;
      const auto at = [&](double u, double v) {
        return dense(surface, surface.stencil({s.face, s.u + u, s.v + v}, 1));
      };
      const RowMatrix e = at(h, 0), w = at(-h, 0), n = at(0, h), o = at(0, -h);
      const auto expect_close = [&](const RowMatrix& row, const RowMatrix& difference, double bound, const char* what) {
        EXPECT_LE(norm1(row - difference / (2 * h)), bound) << what << " at " << words(s);
      };
      const double first = has_polynomials(scheme_) ? difference_error : rough_difference_error;
      const double first_size = norm1(x.row(1)) + norm1(x.row(2));
      expect_close(x.row(1), e.row(0) - w.row(0), first * first_size, "du");
      expect_close(x.row(2), n.row(0) - o.row(0), first * first_size, "dv");
      ++compared;
      if (x.rows() < 6 || e.rows() < 3 || w.rows() < 3 || n.rows() < 3 || o.rows() < 3) continue;
      const double second =
          second_difference_error * (first_size + norm1(x.row(3)) + norm1(x.row(4)) + norm1(x.row(5)));
      expect_close(x.row(3), e.row(1) - w.row(1), second, "duu");
      expect_close(x.row(4), e.row(2) - w.row(2), second, "duv");
      expect_close(x.row(4), n.row(1) - o.row(1), second, "dvu");
      expect_close(x.row(5), n.row(2) - o.row(2), second, "dvv");
    }
    EXPECT_GE(compared, 3);
  });
}

/// Corners of squares are where limits of vertices are known, with normals on each side.
TEST_P(LimitSurfaceLaws, CornersAreTheLimitsOfVertices) {
  on_hard_meshes([&](const LimitMap& surface, const Mesh& mesh) {
    const Topology& t = surface.level().topology();
    const bool prepared = !scheme_.preparation.empty();
    LimitCache cache(scheme_);
    const Level level = prepared ? next_level(scheme_, surface.level()) : surface.level();
    const LimitMatrices L = limit_matrices(level, cache);
    const SparseMatrix position = prepared ? SparseMatrix(L.position * level.S) : L.position;
    const LimitPoints limits =
        limit_points(L, level.topology(), prepared ? Points(level.S * mesh.positions) : mesh.positions);
    const Index stride = 3 * effort(scheme_);
    std::vector<Place> corners;
    for (Index i = 0; i < t.num_half_edges(); i += stride)
      corners.push_back(from_corner(t, surface.addresses(), HalfEdge{i}, 0, 0));
    const LimitSamples samples = surface.evaluate(mesh.positions, corners, 1);
    for (Index i = 0, k = 0; i < t.num_half_edges(); i += stride, ++k) {
      const Vertex vertex = t.tail(HalfEdge{i});
      // Dual schemes have no parameter of their own at borders where other than two faces meet.
      if (scheme_.is_dual() && t.is_boundary(vertex) && t.num_faces(vertex) != 2) continue;
      SCOPED_TRACE("corner " + std::to_string(i));
      const RowMatrix x = dense(surface, surface.stencil(corners[size_t(k)], 0));
      const RowMatrix expected = RowMatrix(position.row(index(vertex)));
      EXPECT_LE(norm1(x.row(0) - expected), rounded() * norm1(expected));
      if (prepared || scheme_.claims.regular == 0) continue;  // no normals to compare
      const Index side = L.corner_side[size_t(i)];
      if (samples.status[size_t(k)] == LimitStatus::hole) continue;
      const Eigen::Vector3d ours = samples.normal.row(k), theirs = limits.normal.row(side);
      EXPECT_EQ(ours.isZero(0), theirs.isZero(0))
          << name(samples.status[size_t(k)]) << ", " << name(limits.status[size_t(side)]) << ", valence "
          << t.num_faces(vertex);
      if (ours.isZero(0) || theirs.isZero(0)) continue;
      EXPECT_LE((ours - theirs).norm(), reference_angle);
    }
  });
}

/// The child of a square at its nearest corner, and where in that child a place is that was (a, b) from `corner`.
std::pair<HalfEdge, Eigen::Vector2d> child_place(const Topology& t, const Refinement& step, HalfEdge corner, double a,
                                                 double b) {
  if (t.size(t.face(corner)) != 4) return {step.halves(t, corner).first, {a, b}};
  if (a > 0.5) return child_place(t, step, t.next(corner), b, 1 - a);
  if (b > 0.5) return child_place(t, step, t.prev(corner), 1 - b, a);
  return {step.halves(t, corner).first, {2 * a, 2 * b}};
}

/// Of schemes that keep their vertices and have squares for children at every corner.
class LimitSurfaceLawsOfSquares : public LimitSurfaceLaws {
 public:
  static bool hold(const Scheme<double>& scheme) {
    return !scheme.is_dual() && !takes_triangles(scheme) && scheme.preparation.empty();
  }
};

/// Stencils over level 1 times S are those over level 0.
TEST_P(LimitSurfaceLawsOfSquares, IsTheSameFromTheNextLevel) {
  on_hard_meshes([&](const LimitMap& surface, const Mesh&) {
    const Level next = next_level(scheme_, surface.level());
    const LimitMap later(scheme_, next, types_);
    const Topology &t = surface.level().topology(), &fine = next.topology();
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < count(25); ++i) {
      const HalfEdge corner{Index(random() % std::uint32_t(t.num_half_edges()))};
      const double d = i % 2 ? std::ldexp(1.0, -int(random() % 40)) : 1;
      const double a = d * std::round(1024 * unit(random)) / 1024, b = d * std::round(1024 * unit(random)) / 1024;
      const Place here = from_corner(t, surface.addresses(), corner, a, b);
      const auto [child, place] = child_place(t, next.steps[0], corner, a, b);
      const Place there = from_corner(fine, later.addresses(), child, place[0], place[1]);
      const RowMatrix x = dense(surface, surface.stencil(here, 0)).row(0),
                      y = dense(later, later.stencil(there, 0)).row(0) * next.S;
      EXPECT_LE(norm1(x - y), rounded() * norm1(x)) << words(here) << ", then " << words(there);
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Schemes, LimitSurfaceLaws, ::testing::ValuesIn(schemes_and_degrees()), test_name);
INSTANTIATE_TEST_SUITE_P(Schemes, LimitSurfaceLawsOfSquares,
                         ::testing::ValuesIn(schemes_and_degrees_if(LimitSurfaceLawsOfSquares::hold)), test_name);

}  // namespace
}  // namespace sublimit::testing
