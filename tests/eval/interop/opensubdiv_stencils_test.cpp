// SPDX-License-Identifier: Apache-2.0
// Our tables by OpenSubdiv's evaluators, and its stencils by ours.
#include "sublimit/eval/interop/opensubdiv_stencils.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "eval/file/table_samples.h"
#include "eval/interop/opensubdiv_stencils_reference.h"
#include "meshes/meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

template <class Real>
std::vector<Real> random_points(std::int32_t count) {
  std::mt19937 random(3);
  std::vector<Real> points(size_t(count) * 3);
  for (Real& x : points) x = Real(random()) / Real(std::mt19937::max());
  return points;
}

/// Sums in another order differ by so much: up to a hundred terms of size 1.
template <class Real>
void expect_near(std::span<const Real> a, std::span<const Real> b) {
  ASSERT_EQ(a.size(), b.size());
  const Real tolerance = static_cast<Real>(rounding(100)) * (std::numeric_limits<Real>::epsilon() / Real(eps));
  for (size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], tolerance) << i;
}

TEST(OpenSubdivStencils, AreEvaluatedWithDerivatives) {
  const PatternTable<float> table = everything<float>().table;
  const OpenSubdivStencils<float> stencils = opensubdiv_stencils(table);
  ASSERT_EQ(stencils.GetNumStencils(), table.num_points());
  const std::vector<float> points = random_points<float>(table.num_control_points());
  const StencilTable<float> rows = table.expanded();
  std::vector<float> expected(size_t(rows.num_rows()) * 3);
  rows.apply(points, 3, expected);
  const auto made = osd_points(stencils, points);
  const size_t size = expected.size() / 3;
  for (size_t q = 0; q < 3; ++q) expect_near<float>(made[q], std::span<const float>(expected).subspan(q * size, size));
}

TEST(OpenSubdivStencils, RunSchemesThatOpenSubdivLacks) {
  const Mesh mesh = torus(8, 6);
  for (const char* scheme : {"doo-sabin", "kobbelt"}) {
    const SparseMatrix P = refinement_matrix(refine(find_scheme(scheme).value(), mesh, 2));
    const auto entries = size_t(P.nonZeros());
    const StencilTable<double> rows(std::int32_t(P.cols()),
                                    std::vector<std::int64_t>(P.outerIndexPtr(), P.outerIndexPtr() + P.rows() + 1),
                                    std::vector<std::int32_t>(P.innerIndexPtr(), P.innerIndexPtr() + entries),
                                    std::vector<double>(P.valuePtr(), P.valuePtr() + entries));
    const std::vector<double> points = random_points<double>(rows.num_control_points());
    std::vector<double> expected(size_t(rows.num_rows()) * 3);
    rows.apply(points, 3, expected);
    expect_near<double>(far_points(opensubdiv_stencils(rows), points), expected);
    const StencilTable<float> floats = in_float(rows);
    const std::vector<float> float_points(points.begin(), points.end());
    std::vector<float> float_expected(expected.size());
    floats.apply(float_points, 3, float_expected);
    expect_near<float>(osd_points(opensubdiv_stencils(floats), float_points)[0], float_expected);
    expect_near<float>(far_points(opensubdiv_stencils(floats), float_points), float_expected);
  }
}

TEST(OpenSubdivStencils, BecomeRowsAgain) {
  const StencilTable<double> rows = everything<double>().table.expanded();
  const OpenSubdivStencils<double> stencils = opensubdiv_stencils(rows);
  const StencilTable<double> again = rows_of_opensubdiv<double>(stencils);
  expect_equal("offsets", rows.offsets(), again.offsets());
  expect_equal("columns", rows.columns(), again.columns());
  expect_equal("weights", rows.weights(), again.weights());
}

TEST(OpenSubdivStencils, OfFarAreRows) {
  const Mesh mesh = cube();
  const std::vector<double> points = random_points<double>(8);
  const FarRows far = far_rows(mesh, 3, points);
  ASSERT_EQ(far.rows.num_rows(), 386);
  std::vector<double> made(far.points.size());
  far.rows.apply(points, 3, made);
  expect_near<double>(made, far.points);
}

TEST(OpenSubdivStencils, MayHaveSpareEntriesAndNoOffsets) {
  OpenSubdivStencils<double> stencils;
  stencils.num_control_points = 3;
  stencils.sizes = {2, 0, 1};
  stencils.indices = {2, 0, 1};
  stencils.weights[0] = {0.25, 0.75, 1, 9, 9};
  const StencilTable<double> rows = rows_of_opensubdiv<double>(stencils);
  EXPECT_EQ(rows.columns().size(), 3u);
  std::vector<double> made(3);
  rows.apply(std::vector<double>{4, 6, 8}, 1, made);
  EXPECT_EQ(made, (std::vector<double>{5, 0, 6}));
  stencils.offsets = {1, 0, 0};
  rows_of_opensubdiv<double>(stencils).apply(std::vector<double>{4, 6, 8}, 1, made);
  EXPECT_EQ(made, (std::vector<double>{9, 0, 2}));
  stencils.offsets = {2, 0, 0};
  expect_error<InvalidParameter>([&] { rows_of_opensubdiv<double>(stencils); }, {"number 0 has 2 entries from 2 on"});
  stencils.offsets = {0};
  expect_error<InvalidParameter>([&] { rows_of_opensubdiv<double>(stencils); }, {"1 offsets for 3 sizes"});
  stencils.offsets.clear();
  stencils.sizes = {4};
  expect_error<InvalidParameter>([&] { rows_of_opensubdiv<double>(stencils); }, {"there are 3"});
  stencils.sizes = {-1};
  expect_error<InvalidParameter>([&] { rows_of_opensubdiv<double>(stencils); }, {"-1 entries"});
  stencils.sizes = {3};
  stencils.num_control_points = 2;
  expect_error<InvalidParameter>([&] { rows_of_opensubdiv<double>(stencils); }, {"control point 2 of 2"});
  EXPECT_NO_THROW(rows_of_opensubdiv<double>(stencils, 3));
}

}  // namespace
}  // namespace sublimit::testing
