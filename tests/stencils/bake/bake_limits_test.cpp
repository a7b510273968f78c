// SPDX-License-Identifier: Apache-2.0
// Tables of limits: by patterns and by rows they are the limit surface, of every linear scheme.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <map>
#include <random>

#include "laws/tested_schemes.h"
#include "meshes/shared_meshes.h"
#include "sublimit/limit/detail/limit_masks.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/scheme/detail/prepare.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/surface/limit_map.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Rows of a point: those of a table, by quantity.
struct TableRowsOf {
  const StencilTable<double>& rows;
  std::int64_t num_points;
  std::map<Index, double> operator()(std::int64_t point, int quantity) const {
    std::map<Index, double> row;
    const std::int64_t r = quantity * num_points + point;
    for (std::int64_t k = rows.offsets()[r]; k < rows.offsets()[r + 1]; ++k) row[rows.columns()[k]] = rows.weights()[k];
    return row;
  }
};

/// Sum of |weights| that differ, against the sum of |weights|.
struct Comparison {
  double difference = 0, size = 0;
};

Comparison compare(std::map<Index, double> row, const LimitStencil& stencil, const RowMatrix& weights, Eigen::Index r) {
  Comparison c;
  for (size_t j = 0; j < stencil.vertices.size() && r < weights.rows(); ++j) {
    row[stencil.vertices[j]] -= weights(r, Eigen::Index(j));
    c.size += std::abs(weights(r, Eigen::Index(j)));
  }
  for (const auto& [vertex, weight] : row) c.difference += std::abs(weight);
  return c;
}

/// What is left of two tangents that are not in the plane of two others, whose sense is theirs.
double off_plane(const std::map<Index, double>& t1, const std::map<Index, double>& t2, const LimitStencil& stencil) {
  std::map<Index, Eigen::Vector4d> columns;
  for (const auto& [v, weight] : t1) columns.try_emplace(v, Eigen::Vector4d::Zero()).first->second[0] = weight;
  for (const auto& [v, weight] : t2) columns.try_emplace(v, Eigen::Vector4d::Zero()).first->second[1] = weight;
  for (size_t j = 0; j < stencil.vertices.size(); ++j)
    columns.try_emplace(stencil.vertices[j], Eigen::Vector4d::Zero()).first->second.tail(2) =
        stencil.tangents.col(Eigen::Index(j)).head(2);
  Eigen::MatrixXd M(columns.size(), 4);
  Eigen::Index row = 0;
  for (const auto& [v, column] : columns) M.row(row++) = column;
  const Eigen::MatrixXd own = M.leftCols(2), other = M.rightCols(2);
  const Eigen::Matrix2d C = (other.transpose() * other).inverse() * (other.transpose() * own);  // own = other C
  if (!(C.determinant() > 0)) return INFINITY;
  return (own - other * C).norm() / own.norm();
}

void expect_the_limit(const Baked& baked, const LimitMap& surface, std::span<const Place> samples, int derivatives,
                      bool copied) {
  const StencilTable<double> expanded = baked.table.table.expanded();
  const TableRowsOf rows{expanded, baked.table.table.num_points()};
  ASSERT_EQ(rows.num_points, std::int64_t(samples.size()));
  const std::vector<std::uint8_t> statuses = statuses_of(baked.table);
  const TableInfo& info = baked.table.info;
  double position = 0, derivative = 0;
  int wrong_status = 0;
  for (std::int64_t i = 0; i < rows.num_points; ++i) {
    const LimitStencil stencil = surface.stencil(samples[i], derivatives);
    const size_t status = statuses.empty() ? 0 : statuses[size_t(i)];
    wrong_status += info.statuses[status] != name(stencil.status);
    if (derivatives > 0) wrong_status += num_quantities(info.orders[status]) != stencil.weights.rows();
    position = std::max(position, compare(rows(i, 0), stencil, stencil.weights, 0).difference);
    const bool tangents = derivatives > 0 && stencil.weights.rows() == 1 && stencil.tangents.rows() >= 2;
    if (tangents) derivative = std::max(derivative, off_plane(rows(i, 1), rows(i, 2), stencil));
    for (int q = tangents ? 3 : 1; q < num_quantities(derivatives); ++q) {
      const Comparison c = compare(rows(i, q), stencil, stencil.weights, q);
      derivative = std::max(derivative, c.difference / std::max(1.0, c.size));
    }
  }
  EXPECT_LE(position, copied ? other_route : rounding(100));
  EXPECT_LE(derivative, second_derivative);
  EXPECT_EQ(wrong_status, 0);
}

/// Types of wide supports are large: only the last mesh, which has most in it.
std::vector<Mesh> few_hard_meshes(const Scheme<double>& scheme, unsigned seed) {
  std::vector<Mesh> meshes = hard_meshes(scheme, seed);
  if (!scheme.has_one_ring_limits()) meshes.erase(meshes.begin(), meshes.end() - 1);
  return meshes;
}

class BakedLimits : public ::testing::TestWithParam<TestedScheme> {
 protected:
  const Scheme<double> scheme_ = GetParam().scheme();
};

TEST_P(BakedLimits, OfGridsAreTheSurface) {
  Patterns patterns(scheme_);
  // Thirds; but not on the third side of triangles, where they are rounded, and sqrt3's vertices are beside them.
  const int N = takes_triangles(scheme_) ? 5 : 4;
  for (const Mesh& mesh : few_hard_meshes(scheme_, 4))
    for (const int derivatives : {0, 2}) {
      SCOPED_TRACE(std::to_string(derivatives) + " derivatives");
      BakeRequest request;
      request.rows = TableRows::grid;
      request.grid = N;
      request.derivatives = derivatives;
      const Baked baked = bake(patterns, mesh, request);
      const LimitMap surface(scheme_, mesh, {}, patterns.types());
      expect_the_limit(baked, surface, surface.grid(N), derivatives, true);
    }
}

TEST_P(BakedLimits, OfPlacesAreTheSurface) {
  Patterns patterns(scheme_);
  for (const Mesh& mesh : few_hard_meshes(scheme_, 3)) {
    const LimitMap surface(scheme_, mesh, {}, patterns.types());
    BakeRequest request;
    request.rows = TableRows::samples;
    for (Index f = 0; f < surface.addresses().size(); f += 2) {
      request.samples.push_back({f, 0.25, 0.125});
      request.samples.push_back({f, 0, 0});
    }
    request.derivatives = 2;
    const bool by_patterns = scheme_.preparation.empty() || surface.level().topology().uniform_face_size() == 4;
    for (const BakeMethod method : {BakeMethod::rows, BakeMethod::patterns}) {
      if (method == BakeMethod::patterns && !by_patterns) continue;
      SCOPED_TRACE(name(method));
      request.method = method;
      expect_the_limit(bake(patterns, mesh, request), surface, request.samples, 2, false);
    }
  }
}

/// In any order, some places several times, some addresses in several parts of the list.
TEST(BakedPlaces, StandAsTheyWereAskedFor) {
  for (const char* name : {"catmull-clark", "loop", "doo-sabin"}) {
    SCOPED_TRACE(name);
    const Scheme<double> scheme = find_scheme(name).value();
    const Mesh mesh = hard_meshes(scheme, 5)[1];
    Patterns patterns(scheme);
    const LimitMap surface(scheme, mesh, {}, patterns.types());
    BakeRequest request{.rows = TableRows::samples, .derivatives = 1, .method = BakeMethod::patterns};
    std::mt19937 random(3);
    for (int i = 0; i < 300; ++i) {
      const auto face = static_cast<Index>(random() % std::uint32_t(surface.addresses().size()));
      for (auto count = 1 + random() % 3; count > 0; --count)
        request.samples.push_back({face, double(random() % 5) / 8, double(random() % 4) / 8});
    }
    const Baked baked = bake(patterns, mesh, request);
    EXPECT_EQ(baked.statistics.method, BakeMethod::patterns);
    expect_the_limit(baked, surface, request.samples, 1, false);
    const SampleAddresses& addresses = baked.table.addresses;
    for (size_t i = 0; i < request.samples.size(); ++i) {
      EXPECT_EQ(addresses.faces[i], request.samples[i].face);
      EXPECT_EQ(addresses.parameters[2 * i], request.samples[i].u);
    }
  }
}

/// Where faces have the same places blocks pay, where each place is another one they do not.
TEST(BakedPlaces, AreBlocksWhereTheyComeAgain) {
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  Patterns patterns(scheme);
  const Mesh mesh = torus(20, 20);
  BakeRequest again{.rows = TableRows::samples}, apart = again;
  std::mt19937 random(3);
  for (Index f = 0; f < mesh.num_faces(); ++f)
    for (const double u : {0.21, 0.79})
      for (const double v : {0.21, 0.79}) {
        again.samples.push_back({f, u, v});
        apart.samples.push_back({static_cast<Index>(random() % 400), double(random() % 997) / 997, 0.5});
      }
  const BakeStatistics by_patterns = bake(patterns, mesh, again).statistics;
  EXPECT_EQ(by_patterns.method, BakeMethod::patterns);
  EXPECT_EQ(by_patterns.blocks, 1);
  EXPECT_EQ(by_patterns.bytes, bake_plan(patterns, mesh, again).statistics.bytes);
  EXPECT_EQ(bake(patterns, mesh, apart).statistics.method, BakeMethod::rows);
  again.method = BakeMethod::rows;
  EXPECT_LT(7 * by_patterns.bytes, bake(patterns, mesh, again).statistics.bytes);
}

TEST(BakedPlaces, OutsideTheirAddressesAreErrors) {
  Patterns patterns(find_scheme("catmull-clark").value());
  BakeRequest request{.rows = TableRows::samples, .samples = {{6, 0, 0}}};
  expect_error<InvalidParameter>([&] { bake(patterns, cube(), request); }, {"face 6", "faces are 0 to 5"});
  request.samples = {{0, 0.5, 1.5}};
  expect_error<InvalidParameter>([&] { bake(patterns, cube(), request); }, {"outside the square"});
}

/// By rows and by patterns the same points, in some order: images of random points agree when they are sorted.
TEST_P(BakedLimits, OfLevelsAreThoseOfTheirVertices) {
  Patterns patterns(scheme_);
  for (const Mesh& mesh : hard_meshes(scheme_, 3))
    for (int level = 0; level <= 2; ++level) {
      SCOPED_TRACE("level " + std::to_string(level));
      BakeRequest request;
      request.rows = TableRows::limit;
      request.level = level;
      const auto images = [&](BakeMethod method) {
        request.method = method;
        const Baked baked = bake(patterns, mesh, request);
        std::vector<double> made(size_t(baked.table.table.num_points()));
        Eigen::VectorXd x(mesh.num_vertices());
        for (Index v = 0; v < x.size(); ++v) x[v] = std::sin(1.0 + 7.0 * v);
        baked.table.table.apply({x.data(), size_t(x.size())}, 1, made);
        std::sort(made.begin(), made.end());
        return made;
      };
      const std::vector<double> by_rows = images(BakeMethod::rows), chosen = images(BakeMethod::automatic);
      ASSERT_EQ(by_rows.size(), chosen.size());
      double largest = 0;
      for (size_t i = 0; i < chosen.size(); ++i) largest = std::max(largest, std::abs(chosen[i] - by_rows[i]));
      EXPECT_LE(largest, other_route);
    }
}

INSTANTIATE_TEST_SUITE_P(Schemes, BakedLimits, ::testing::ValuesIn(schemes_and_degrees()), test_name);

}  // namespace
}  // namespace sublimit::testing
