// SPDX-License-Identifier: Apache-2.0
// Addresses of points are where they are: the limit there is the point. Normals are those of the limit.
#include "sublimit/stencils/bake/detail/applied_points.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "meshes/meshes.h"
#include "meshes/random_doubles.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/eval/table/detail/point_addresses.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/surface/limit_map.h"
#include "support/temporary_directory.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// A limit table of a mesh, and what the surface says at its addresses.
void expect_at_addresses(const std::string& name, const Mesh& mesh, const BakeRequest& request) {
  SCOPED_TRACE(name + ", rows " + sublimit::name(request.rows));
  Patterns patterns(find_scheme(name).value());
  const BakedTable<double> table = bake(patterns, mesh, request).table;
  const auto n = static_cast<size_t>(table.table.num_points());
  std::vector<double> values(n * 3 * size_t(table.table.quantities()));
  table.table.apply({mesh.positions.data(), size_t(mesh.positions.size())}, 3, values);
  const SampleAddresses at = addresses_of(table);
  ASSERT_EQ(at.faces.size(), n);
  const LimitMap surface(patterns.scheme(), mesh);
  std::vector<Place> samples;
  for (size_t i = 0; i < n; ++i) samples.push_back({at.faces[i], at.parameters[2 * i], at.parameters[2 * i + 1]});
  const LimitSamples found = surface.evaluate(mesh.positions, samples, std::max(request.derivatives, 1));
  const Points normals = AppliedPoints(table).normals<double>(values);
  const std::vector<std::uint8_t> statuses = statuses_of(table);
  for (size_t i = 0; i < n; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (Eigen::Index k = 0; k < 3; ++k)
      EXPECT_NEAR(values[3 * i + size_t(k)], found.position(row, k), other_route) << "point " << i;
    if (request.derivatives == 0) continue;
    const size_t status = statuses.empty() ? 0 : statuses[i];
    EXPECT_EQ(int(table.info.orders[status]), int(found.order[row])) << "point " << i;
    if (found.status[row] == LimitStatus::undefined_normal) continue;  // by these points, perhaps
    EXPECT_EQ(table.info.statuses[status], sublimit::name(found.status[row])) << "point " << i;
    EXPECT_LT((normals.row(row) - found.normal.row(row)).norm(), reference_angle) << "point " << i;
  }
}

TEST(AppliedPoints, AddressesAndNormalsAreThoseOfTheLimit) {
  Mesh creased = jittered(cube());
  creased.creases = {{0, 1, 10}, {1, 3, 10}, {3, 2, 10}, {2, 0, 10}};
  const BakeRequest level{.rows = TableRows::limit, .level = 2},
      grid{.rows = TableRows::grid, .grid = 4, .derivatives = 1},
      list{.rows = TableRows::samples, .samples = {{0, 0.25, 0.125}, {4, 1, 0}, {2, 0.5, 0.5}}, .derivatives = 1};
  BakeRequest with_normals = level, with_second = grid, list_with_second = list;
  with_normals.derivatives = 1;
  with_second.derivatives = list_with_second.derivatives = 2;
  for (const BakeRequest& request : {level, with_normals, grid, list, with_second, list_with_second}) {
    expect_at_addresses("catmull-clark", jittered(torus(6, 5)), request);
    expect_at_addresses("catmull-clark", jittered(prism(5)), request);
    expect_at_addresses("catmull-clark", creased, request);
    expect_at_addresses("loop", jittered(icosahedron()), request);
    expect_at_addresses("bilinear", creased, request);
    if (request.rows != TableRows::limit) expect_at_addresses("doo-sabin", jittered(cube()), request);
  }
}

TEST(AppliedPoints, NoNormalsOfParallelDerivatives) {
  Patterns patterns(find_scheme("catmull-clark").value());
  const AppliedPoints applied(
      bake(patterns, cube(), {.rows = TableRows::samples, .samples = {{0, 0.5, 0.5}, {1, 0.5, 0.5}}, .derivatives = 1})
          .table);
  // Positions, then derivatives along u, then along v; those of the first point are parallel but for rounding.
  const std::vector<double> values{1, 0.5,  -1, 0, 0, 0, 0.333, -0.25, 0.333, 1, 0, 0, 0.1665, -0.125, 0.1665 + 1e-15,
                                   1, 1e-6, 0};
  const Points normals = applied.normals<double>(values);
  EXPECT_TRUE(normals.row(0).isZero(0));
  EXPECT_EQ(normals.row(1), Eigen::RowVector3d(0, 0, 1));
  const TemporaryDirectory directory;
  applied.write_csv<double>(directory / "points.csv", {"x", "y", "z"}, values);
  EXPECT_EQ(read_file(directory / "points.csv"),
            "face,u,v,status,x,y,z,xu,yu,zu,xv,yv,zv,nx,ny,nz\n"
            "0,0.5,0.5,undefined-normal,1,0.5,-1,0.333,-0.25,0.333,0.1665,-0.125,0.166500000000001,,,\n"
            "1,0.5,0.5,regular,0,0,0,1,0,0,1,1e-06,0,0,0,1\n");
}

TEST(AppliedPoints, RowsAreThoseOfAPlainWriterForAnyNumberOfThreads) {
  // Numbers of all bit patterns: what a table makes of large points is infinite, or not a number.
  Patterns patterns(find_scheme("catmull-clark").value());
  const TemporaryDirectory directory;
  for (const int size : {8, 16, 17}) {  // 1024 points at level 2, which is a block, then others
    const BakedTable<double> table = bake_level(patterns, torus(size, 8), 2).table;
    const auto points = static_cast<size_t>(table.table.num_points());
    const std::vector<double> values = random_doubles(points, 2 * points, true);
    const SampleAddresses at = addresses_of(table);
    std::string plain = "face,u,v,a,b\n";
    for (size_t i = 0; i < points; ++i)
      plain += format_number(at.faces[i]) + "," + format_number(at.parameters[2 * i]) + "," +
               format_number(at.parameters[2 * i + 1]) + "," + format_number(values[2 * i]) + "," +
               format_number(values[2 * i + 1]) + "\n";
    for (const size_t threads : {1u, 2u, 5u}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      AppliedPoints(table).write_csv<double>(directory / "points.csv", {"a", "b"}, values);
      EXPECT_TRUE(read_file(directory / "points.csv") == plain) << points << " points, " << threads << " threads";
    }
  }
}

TEST(AppliedPoints, NoAddressesByRows) {
  Patterns patterns(find_scheme("doo-sabin").value());
  EXPECT_TRUE(addresses_of(bake_level(patterns, cube(), 2).table).faces.empty());
}

}  // namespace
}  // namespace sublimit::testing
