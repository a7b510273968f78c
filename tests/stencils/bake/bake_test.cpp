// SPDX-License-Identifier: Apache-2.0
// Tables by patterns are P_k, row by row, and every point of level k is in them once.
#include "sublimit/stencils/bake/detail/bake.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <array>
#include <map>
#include <random>
#include <thread>
#include <set>

#include "laws/tested_schemes.h"
#include "meshes/shared_meshes.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/eval/kernels/apply_patches.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/limit/detail/limit_masks.h"
#include "sublimit/scheme/detail/prepare.h"
#include "sublimit/source/address.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Where a piece lies in an address: a place (u, v) of it at origin + u a + v b.
struct Frame {
  Eigen::Vector2d origin, a, b;
};

/// Of one period from a level on.
std::vector<LevelStep> steps_after(const std::vector<Level>& levels, size_t from, size_t period) {
  std::vector<LevelStep> steps;
  for (size_t k = from + 1; k <= from + period; ++k)
    for (const Refinement& step : levels[k].steps) steps.push_back({&step, static_cast<int>(k) - 1});
  return steps;
}

/// Calls body(vertex of the last level, place in the address) for the corners of all faces that a piece becomes.
template <class Body>
void for_each_corner(const std::vector<Level>& levels, size_t from, size_t period, const Piece& piece,
                     const Frame& frame, const Body& body) {
  const bool triangle = piece.kind == Piece::Kind::triangle;
  if (from + 1 == levels.size()) {
    const Topology& t = levels.back().topology();
    std::vector<Eigen::Vector2d> at{frame.origin, frame.origin + frame.a, frame.origin + frame.a + frame.b,
                                    frame.origin + frame.b};
    if (triangle) at.erase(at.begin() + 2);
    HalfEdge h = piece.start;
    for (const Eigen::Vector2d& p : at) {
      body(t.tail(h), p);
      h = t.next(h);
    }
    return;
  }
  const std::vector<LevelStep> steps = steps_after(levels, from, period);
  for (const PieceChild& child : children(piece, levels[from].topology(), steps)) {
    const auto image = [&](double u, double v) {
      const PieceCoordinates p = child.map(triangle ? triangle_place(u, v) : quad_place(u, v));
      return Eigen::Vector2d(p.u, p.v);
    };
    Eigen::Matrix2d M;
    M << image(1, 0) - image(0, 0), image(0, 1) - image(0, 0);
    const Eigen::Matrix2d inverse = M.inverse();
    Eigen::Matrix2d axes;
    axes << frame.a, frame.b;
    const Frame inner{frame.origin - axes * inverse * image(0, 0), axes * inverse.col(0), axes * inverse.col(1)};
    for_each_corner(levels, from + period, period, child.piece, inner, body);
  }
}

/// Vertex of the last level at each place of the addresses where there is one, by (address, n u, n v).
/// @param n  cells a side of a face
std::map<std::array<Index, 3>, Index> vertices_by_place(const std::vector<Level>& levels, size_t period, bool triangles,
                                                        double n) {
  std::map<std::array<Index, 3>, Index> vertices;
  const Topology& t = levels[0].topology();
  const Addresses addresses(t, triangles);
  for (Index a = 0; a < addresses.size(); ++a) {
    const Addresses::FaceCorner at = addresses.place(a);
    const Piece piece = at.corner >= 0 ? Piece{Piece::Kind::cut, t.corner(at.face, at.corner)}
                                       : Piece{triangles ? Piece::Kind::triangle : Piece::Kind::quad, t.first(at.face)};
    for_each_corner(levels, 0, period, piece, {{0, 0}, {n, 0}, {0, n}}, [&](Vertex v, const Eigen::Vector2d& p) {
      vertices[{a, static_cast<Index>(std::lround(p[0])), static_cast<Index>(std::lround(p[1]))}] = index(v);
    });
  }
  return vertices;
}

/// Where a table knows no addresses: sorted images of random points agree.
double distance_of_sorted_images(const StencilTable<double>& table, const SparseMatrix& P) {
  const Eigen::VectorXd x = Eigen::VectorXd::Random(P.cols());
  Eigen::VectorXd a = P * x, b(table.num_rows());
  if (a.size() != b.size()) return INFINITY;
  table.apply({x.data(), size_t(x.size())}, 1, {b.data(), size_t(b.size())});
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return (a - b).cwiseAbs().maxCoeff();
}

/// Sum of |weights| that differ.
double difference_of_rows(const SparseMatrix& P, Index vertex, const StencilTable<double>& table, std::int64_t point) {
  std::map<Index, double> difference;
  for (SparseMatrix::InnerIterator it(P, vertex); it; ++it) difference[static_cast<Index>(it.col())] += it.value();
  for (auto k = table.offsets()[point]; k < table.offsets()[point + 1]; ++k)
    difference[table.columns()[k]] -= table.weights()[k];
  double sum = 0;
  for (const auto& [column, weight] : difference) sum += std::abs(weight);
  return sum;
}

struct Difference {
  double largest = 0;       ///< sum of |weights| that differ, over all rows
  std::int64_t points = 0;  ///< of level k
  bool one_to_one = true;
};

Difference compare_with_refinement(const Baked& baked, const Scheme<double>& scheme, const Mesh& mesh, int levels) {
  Difference d;
  const std::vector<Level> refined = refine(scheme, mesh, levels);
  const SparseMatrix P = refinement_matrix(refined);
  const StencilTable<double> table = baked.table.table.expanded();
  const FaceLattices& lattices = *baked.table.lattices;
  d.points = P.rows();
  if (!lattices.has_addresses()) {
    d.largest = distance_of_sorted_images(table, P);
    return d;
  }
  std::vector<std::int64_t> point_of(P.rows(), -1), vertex_of(table.num_rows(), -1);
  const Topology& t = refined[0].topology();
  // Cells are those of faces; where these are quarters of an address, it has twice as many a side.
  const double n = std::pow(scheme.dilation(), levels / scheme.period);
  const std::map<std::array<Index, 3>, Index> vertices =
      vertices_by_place(refined, size_t(scheme.period), lattices.lattice().triangle, n);
  for (Index f = 0; f < lattices.num_faces(); ++f)
    lattices.lattice().for_each([&](Index i, Index j) {
      const AddressParameters p = lattices.parameters(f, i, j);
      const auto at = vertices.find({lattices.place(f).address, static_cast<Index>(std::lround(n * p.u)),
                                     static_cast<Index>(std::lround(n * p.v))});
      const std::int64_t point = lattices.point(f, lattices.lattice().row(i, j));
      d.one_to_one &= point >= 0 && at != vertices.end();
      if (!d.one_to_one) return;
      const Index v = at->second;
      d.one_to_one &= point_of[v] < 0 || point_of[v] == point;
      d.one_to_one &= vertex_of[point] < 0 || vertex_of[point] == v;
      point_of[v] = point;
      vertex_of[point] = v;
    });
  std::int64_t alone = 0;
  for (Index v = 0; v < P.rows(); ++v) {
    if (point_of[v] < 0) {
      ++alone;
      continue;
    }
    d.largest = std::max(d.largest, difference_of_rows(P, v, table, point_of[v]));
  }
  Index isolated = 0;
  for (Index v = 0; v < t.num_vertices(); ++v) isolated += t.is_isolated(Vertex{v});
  d.one_to_one &= alone == isolated && table.num_rows() == P.rows();
  return d;
}

std::vector<TestedScheme> pattern_schemes() {
  std::vector<TestedScheme> tested;
  for (const Scheme<double>& scheme : all_schemes())
    if (Patterns::is_possible(scheme)) tested.push_back({scheme.name, {}});
  return tested;
}

/// By patterns, from level 0 or 1 on, even where types are shared so little that rows would be made sooner.
Baked bake_level_by_patterns(Patterns& patterns, const Mesh& mesh, int levels) {
  BakeRequest request{.level = levels, .method = BakeMethod::patterns};
  try {
    return bake(patterns, mesh, request);
  } catch (const InvalidParameter&) {
    request.method = BakeMethod::rows_then_patterns;
    return bake(patterns, mesh, request);
  }
}

class BakedLevels : public ::testing::TestWithParam<TestedScheme> {
 protected:
  void expect_refinement(Patterns& patterns, const Mesh& mesh, int levels) {
    const Baked baked = bake_level_by_patterns(patterns, mesh, levels);
    const Difference d = compare_with_refinement(baked, scheme_, mesh, levels);
    EXPECT_TRUE(d.one_to_one);
    EXPECT_EQ(baked.statistics.points, d.points);
    const PatternTable<double>::Arrays& arrays = baked.table.table.arrays();
    std::set<std::int32_t> used;
    for (const auto& group : arrays.groups) used.insert(group.block);
    EXPECT_EQ(used.size(), arrays.blocks.size()) << "blocks that make no points";
    // Rows of up to 100 terms, in differences and not, k products.
    EXPECT_LE(d.largest, rounding(10.0 * levels));
  }
  const Scheme<double> scheme_ = GetParam().scheme();
};

TEST_P(BakedLevels, AreRefinementOnHardMeshes) {
  Patterns patterns(scheme_);
  for (const Mesh& mesh : hard_meshes(scheme_, 4))
    for (int levels = 1; levels <= 3; ++levels) {
      if (levels % scheme_.period != 0) continue;
      SCOPED_TRACE("level " + std::to_string(levels));
      expect_refinement(patterns, mesh, levels);
    }
}

TEST_P(BakedLevels, AreRefinementOnTheSharedMeshes) {
  if (shared_meshes().empty()) GTEST_SKIP() << "NO SHARED MESHES at " << SUBLIMIT_SHARED_MESHES;
  Patterns patterns(scheme_);
  for (const SharedMesh& shared : shared_meshes()) {
    Mesh mesh = read_mesh(shared.path);
    if (takes_triangles(scheme_)) mesh = triangulated(mesh);
    if (scheme_.sharpening != Sharpening::semi_sharp) mesh = without_creases(mesh);
    // Types of wide supports are large.
    if (mesh.num_faces() >= (full_sweep() ? 1000 : scheme_.has_one_ring_limits() ? 300 : 30)) continue;
    SCOPED_TRACE(shared.name);
    if (scheme_.period > 1 && !Topology(view(mesh)).is_manifold()) {  // sheets have points of their own at their edges
      EXPECT_EQ(bake(patterns, mesh, {.level = 2}).statistics.method, BakeMethod::rows);
      continue;
    }
    expect_refinement(patterns, mesh, 2);
  }
}

/// Faces of a tube three or four faces around see the same points twice. They are regular all the same, and weights of
/// a point that is there twice add up.
TEST_P(BakedLevels, AreRefinementOnThinTubes) {
  Patterns patterns(scheme_);
  for (const Index around : {3, 4}) {
    Mesh mesh = disjoint_union(torus(9, 8), torus(9, around));
    if (takes_triangles(scheme_)) mesh = triangulated(mesh);
    expect_refinement(patterns, mesh, 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, BakedLevels, ::testing::ValuesIn(pattern_schemes()), test_name);

/// Dual schemes: faces of the table are those of level k, and so say which vertex each point is.
class BakedCorners : public ::testing::TestWithParam<TestedScheme> {
 protected:
  void expect_refinement(Patterns& patterns, const Mesh& mesh, int levels) {
    const Baked baked =
        bake(patterns, mesh, {.rows = TableRows::level, .level = levels, .method = BakeMethod::patterns});
    const std::vector<Level> refined = refine(scheme_, mesh, levels);
    const SparseMatrix P = refinement_matrix(refined);
    const StencilTable<double> table = baked.table.table.expanded();
    ASSERT_EQ(table.num_rows(), P.rows());
    std::vector<std::int32_t> point_of(size_t(P.rows()), -1), vertex_of(size_t(P.rows()), -1);
    const Topology& t = refined.back().topology();
    size_t corner = 0;
    double largest = 0;
    bool one_to_one = true;
    for (Index f = 0; f < t.num_faces(); ++f)
      for (const Index v : t.vertices(Face{f})) {
        const std::int32_t point = baked.table.faces.corners[corner++];
        one_to_one &= (point_of[v] < 0 || point_of[v] == point) && (vertex_of[point] < 0 || vertex_of[point] == v);
        if (point_of[v] < 0) largest = std::max(largest, difference_of_rows(P, v, table, point));
        point_of[v] = point;
        vertex_of[point] = v;
      }
    EXPECT_EQ(corner, baked.table.faces.corners.size());
    EXPECT_TRUE(one_to_one);
    EXPECT_LE(largest, rounding(10.0 * levels));
  }
  const Scheme<double> scheme_ = GetParam().scheme();
};

TEST_P(BakedCorners, AreRefinement) {
  Patterns patterns(scheme_);
  std::vector<Mesh> meshes = hard_meshes(scheme_, 4);
  meshes.push_back(disjoint_union(torus(9, 8), torus(9, 3)));
  for (const Mesh& mesh : meshes)
    for (int levels = scheme_.period; levels <= 4 / effort(scheme_); levels += scheme_.period) {
      SCOPED_TRACE("level " + std::to_string(levels));
      expect_refinement(patterns, mesh, levels);
    }
}

INSTANTIATE_TEST_SUITE_P(Schemes, BakedCorners, ::testing::ValuesIn(schemes_and_degrees_if([](const auto& scheme) {
                           return scheme.is_dual();
                         })),
                         test_name);

/// A fan of triangles around a vertex of a hundred edges, no two of them alike: types would take a hundred times as
/// long.
TEST(BakedLevel, BeginsWithRowsWhereTypesOfManyPointsAreSharedByFewFaces) {
  const auto method = [](const Mesh& mesh) {
    Patterns patterns(find_scheme("loop").value());
    return bake(patterns, mesh, {.level = 2}).statistics.method;
  };
  Mesh alike = fan(100, 3, 2), unlike = alike;
  EXPECT_EQ(method(alike), BakeMethod::patterns);
  for (Index v = 1; v <= 100; ++v) unlike.creases.push_back({0, v, 0.03f * float(v)});
  EXPECT_NE(method(unlike), BakeMethod::patterns);
}

TEST(BakedLevel, AppliesWhatItExpandsTo) {
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  Patterns patterns(scheme);
  for (const Mesh& mesh : {torus(5, 7), hard_polygons(2, {.open = true, .semi_sharp = true})}) {
    const Baked baked = bake_level(patterns, mesh, 2);
    const StencilTable<double> rows = baked.table.table.expanded();
    const auto channels = 3;
    std::vector<double> by_rows(size_t(rows.num_rows()) * channels), by_patterns(by_rows.size());
    const std::span points(mesh.positions.data(), size_t(mesh.positions.size()));
    rows.apply(points, channels, by_rows);
    baked.table.table.apply(points, channels, by_patterns);
    double largest = 0;
    for (size_t i = 0; i < by_rows.size(); ++i) largest = std::max(largest, std::abs(by_rows[i] - by_patterns[i]));
    EXPECT_LE(largest, rounding(8, mesh.positions.cwiseAbs().maxCoeff()));
    const std::vector<double> before = by_patterns;
    baked.table.table.apply(points, channels, by_patterns);
    EXPECT_EQ(by_patterns, before);
  }
}

/// Columns of random numbers in [-1, 1].
template <class Real>
std::vector<Real> random_numbers(size_t count) {
  std::mt19937 random(11);
  std::vector<Real> numbers(count);
  for (Real& x : numbers) x = Real(int(random() % 2001) - 1000) / 1000;
  return numbers;
}

template <class Real>
void expect_the_evaluator_is_the_table(const PatternTable<Real>& table) {
  for (const bool reproducible : {false, true})
    for (const int channels : {1, 2, 3, 4, 7}) {
      SCOPED_TRACE(std::to_string(channels) + " channels");
      const PatternEvaluator<Real> evaluator(table, {.reproducible = reproducible});
      const std::vector<Real> points = random_numbers<Real>(size_t(table.num_control_points()) * size_t(channels));
      std::vector<Real> expected(size_t(table.num_points()) * size_t(channels)), found(expected.size());
      table.apply(points, channels, expected);
      evaluator.apply(points, channels, found);
      double largest = 0;
      for (size_t i = 0; i < found.size(); ++i) largest = std::max(largest, double(std::abs(found[i] - expected[i])));
      EXPECT_LE(largest, rounding(8) * double(std::numeric_limits<Real>::epsilon()) / eps);
      // The scalar kernel adds in the same order, and nothing is fused.
      if (reproducible) {
        EXPECT_EQ(found, expected);
      }
    }
}

TEST(PatternEvaluator, AppliesTheTable) {
  for (const char* name : {"catmull-clark", "loop"}) {
    const Scheme<double> scheme = find_scheme(name).value();
    Patterns patterns(scheme);
    for (const Mesh& mesh : hard_meshes(scheme, 3))
      for (int levels = 1; levels <= 3; ++levels) {
        SCOPED_TRACE(std::string(name) + ", level " + std::to_string(levels));
        const Baked baked = bake_level(patterns, mesh, levels);
        expect_the_evaluator_is_the_table(in_float(baked.table.table));
        expect_the_evaluator_is_the_table(baked.table.table);
      }
  }
}

/// Every kind of registers that this machine has, scalar emulation included.
TEST(PatternEvaluator, ReproducibleBitsAreThoseOfEveryTarget) {
  Patterns patterns(find_scheme("catmull-clark").value());
  const Baked baked = bake_level(patterns, hard_polygons(5, {.open = true}), 3);
  const PatternEvaluator<double> evaluator(baked.table.table, {.reproducible = true});
  const std::vector<double> points = random_numbers<double>(size_t(baked.table.table.num_control_points()) * 3);
  std::vector<double> expected(size_t(baked.table.table.num_points()) * 3), found(expected.size());
  evaluator.apply(points, 3, expected);
  int targets = 0;
  for (const std::int64_t target : kernels::targets()) {
    kernels::use_target(target);
    std::fill(found.begin(), found.end(), 0.0);
    evaluator.apply(points, 3, found);
    EXPECT_EQ(found, expected) << target;
    ++targets;
  }
  kernels::use_target(0);
  EXPECT_GE(targets, 1);
}

TEST(BakedLevel, OfARegularMeshIsOneBlock) {
  Patterns patterns(find_scheme("catmull-clark").value());
  const Baked baked = bake_level(patterns, torus(12, 9), 3);
  EXPECT_EQ(baked.statistics.types, 1);
  EXPECT_EQ(baked.statistics.points, 12 * 9 * 64);
  EXPECT_EQ(baked.table.table.arrays().columns.size(), 12u * 9 * 16);
}

/// Without channels and tags a bake gives the control level away before the table is complete.
TEST(BakedLevel, IsTheSameWhetherConnectivityIsKept) {
  const std::vector<Mesh> meshes{torus(12, 9), cube(), prism(5), hard_polygons(1, {.open = true, .sharp = true}),
                                 hard_polygons(2, {.open = true, .sharp = true})};
  for (size_t i = 0; i < meshes.size(); ++i)
    for (const TableRows rows : {TableRows::level, TableRows::limit}) {
      SCOPED_TRACE("mesh " + std::to_string(i) + ", " + name(rows));
      const auto made = [&](bool tags) {
        Patterns patterns(find_scheme("catmull-clark").value());
        return bake(patterns, meshes[i], {.rows = rows, .level = 2, .tags = tags}).table;
      };
      const BakedTable<double> given_away = made(false), kept = made(true);
      const auto &a = given_away.table.arrays(), &b = kept.table.arrays();
      EXPECT_EQ(given_away.table.num_control_points(), meshes[i].num_vertices());
      EXPECT_TRUE(std::ranges::equal(a.columns.span(), b.columns.span()));
      EXPECT_TRUE(std::ranges::equal(a.rows.span(), b.rows.span()));
      EXPECT_TRUE(std::ranges::equal(a.weights.span(), b.weights.span()));
      ASSERT_EQ(given_away.lattices.has_value(), kept.lattices.has_value());
      if (!kept.lattices) continue;
      const auto &x = given_away.lattices->arrays(), &y = kept.lattices->arrays();
      EXPECT_TRUE(std::ranges::equal(x.first_points.span(), y.first_points.span()));
      EXPECT_TRUE(std::ranges::equal(x.side_faces.span(), y.side_faces.span()));
      EXPECT_TRUE(std::ranges::equal(x.addresses.span(), y.addresses.span()));
      EXPECT_TRUE(std::ranges::equal(x.places.span(), y.places.span()));
    }
}

/// Threads that meet the same types at once make the tables that each would make alone. Not with finite sharpness,
/// whose sums keep the order of the mesh that was first.
TEST(BakedLevel, ThreadsShareADictionary) {
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  std::vector<Mesh> meshes;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    meshes.push_back(hard_polygons(seed, {.open = true, .sharp = true}));
    meshes.push_back(torus(5 + Index(seed), 6));
  }
  const auto request = [](size_t i) {
    BakeRequest r;
    r.level = 2;
    if (i % 3 == 1) r.rows = TableRows::limit;
    if (i % 3 == 2) r = {.rows = TableRows::grid, .grid = 4, .derivatives = 1};
    return r;
  };
  Patterns shared(scheme);
  std::vector<std::vector<Baked>> made(4);
  std::vector<std::thread> threads;
  for (size_t k = 0; k < made.size(); ++k)
    threads.emplace_back([&, k] {
      for (size_t i = 0; i < meshes.size(); ++i)
        made[k].push_back(bake(shared, meshes[(i + k) % meshes.size()], request(i)));
    });
  for (std::thread& thread : threads) thread.join();
  for (size_t k = 0; k < made.size(); ++k)
    for (size_t i = 0; i < meshes.size(); ++i) {
      SCOPED_TRACE("thread " + std::to_string(k) + ", mesh " + std::to_string((i + k) % meshes.size()));
      Patterns own(scheme);
      const Baked alone = bake(own, meshes[(i + k) % meshes.size()], request(i));
      const auto &a = alone.table.table.arrays(), &b = made[k][i].table.table.arrays();
      EXPECT_TRUE(std::equal(a.weights.begin(), a.weights.end(), b.weights.begin(), b.weights.end()));
      EXPECT_TRUE(std::equal(a.columns.begin(), a.columns.end(), b.columns.begin(), b.columns.end()));
    }
}

/// The dictionary outlives meshes: nothing is new in the second one, and no rotation makes a type.
TEST(BakedLevel, KnowsTypesFromBefore) {
  Patterns patterns(find_scheme("catmull-clark").value());
  bake_level(patterns, cube(), 2);
  EXPECT_EQ(patterns.num_types(), 1u);
  bake_level(patterns, torus(9, 9), 2);
  EXPECT_EQ(patterns.num_types(), 2u);
  bake_level(patterns, torus(11, 8), 2);
  EXPECT_EQ(patterns.num_types(), 2u);
}

TEST(BakedLevel, BadRequestsAreErrors) {
  Patterns patterns(find_scheme("catmull-clark").value());
  expect_error<InvalidParameter>([&] { bake_level(patterns, cube(), 0); }, {"level 0", "1 to 11"});
  expect_error<InvalidParameter>([&] { bake_level(patterns, cube(), 12); }, {"level 12", "1 to 11"});
  const auto refuse_faces = [&](std::vector<Index> sizes, std::vector<Index> corners, TableRows rows,
                                std::initializer_list<std::string_view> parts) {
    BakeRequest request{.rows = rows, .level = 1, .samples = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    request.face_sizes = std::move(sizes), request.face_vertices = std::move(corners);
    expect_error<InvalidParameter>([&] { bake(patterns, cube(), request); }, parts);
  };
  refuse_faces({3}, {0, 1, 2}, TableRows::level, {"faces", "samples"});
  refuse_faces({2}, {0, 1}, TableRows::samples, {"2 corners"});
  refuse_faces({3}, {0, 1}, TableRows::samples, {"add up"});
  refuse_faces({3}, {0, 1, 3}, TableRows::samples, {"sample 3 of 3"});
  Patterns of_triangles(find_scheme("loop").value());
  expect_error<UnsupportedTopology>([&] { bake_level(of_triangles, cube(), 1); },
                                    {"face 0 has 4 corners", "triangulate"});
  const Baked baked = bake_level(patterns, cube(), 1);
  std::vector<double> few(3 * 7), out(size_t(baked.table.table.num_points()) * 3);
  expect_error<InvalidParameter>([&] { baked.table.table.apply(few, 3, out); }, {"points holds 21", "8 x 3"});
}

}  // namespace
}  // namespace sublimit::testing
