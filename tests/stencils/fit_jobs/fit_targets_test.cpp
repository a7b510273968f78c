// SPDX-License-Identifier: Apache-2.0
// Targets of fits from a CSV: what is read, and what is refused with its line.
#include "sublimit/stencils/fit_jobs/fit_targets.h"

#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

using Eigen::Vector3d;

FitTargets read(const std::string& text) {
  const TemporaryDirectory directory;
  return read_fit_targets(directory.write("in.csv", text));
}

const std::string points = "vertex,x,y,z\n", normals = "vertex,x,y,z,nx,ny,nz\n",
                  curvatures = "vertex,x,y,z,nx,ny,nz,k1,k2,d1x,d1y,d1z\n", places = "face,u,v,x,y,z\n",
                  weighted = "face,u,v,x,y,z,weight\n";

TEST(FitTargets, AreReadRowByRow) {
  const FitTargets plain = read(points + "3,1,2,-3e-1\n 0 , 4,5,6\r\n");
  ASSERT_EQ(plain.size(), 2u);
  EXPECT_FALSE(plain.by_place);
  EXPECT_EQ(plain.vertices[0].vertex, 3);
  EXPECT_EQ(plain.vertices[0].position, Vector3d(1, 2, -.3));
  EXPECT_FALSE(plain.vertices[0].normal);
  EXPECT_EQ(plain.positions().row(1), Eigen::RowVector3d(4, 5, 6));
  EXPECT_TRUE(plain.where(1).ends_with("in.csv:3: "));

  const FitTargets all = read(curvatures + "1,0,0,0,0,0,2,.5,-.25,3,0,0\n2,0,0,0,0,1,0,,,,,\n7,0,0,0,,,,,,,,\n");
  EXPECT_EQ(all.num_normals, 2);
  EXPECT_EQ(all.num_curvatures, 1);
  EXPECT_EQ(*all.vertices[0].normal, Vector3d(0, 0, 1));  // of length 1
  EXPECT_EQ(all.vertices[0].curvature->k1, .5);
  EXPECT_EQ(all.vertices[0].curvature->k2, -.25);
  EXPECT_EQ(all.vertices[0].curvature->direction1, Vector3d(1, 0, 0));
  EXPECT_FALSE(all.vertices[1].curvature);
  EXPECT_FALSE(all.vertices[2].normal);

  const FitTargets scattered = read(weighted + "5,.25,.5,1,2,3,0\n5,.25,.5,1,2,4,2.5\n");
  EXPECT_TRUE(scattered.by_place);
  EXPECT_EQ(scattered.places.places[0].face, 5);
  EXPECT_EQ(scattered.places.places[0].u, .25);
  EXPECT_EQ(scattered.places.places[0].v, .5);
  EXPECT_EQ(scattered.places.values.row(1), Eigen::RowVector3d(1, 2, 4));
  EXPECT_EQ(scattered.places.weights, (std::vector<double>{0, 2.5}));
  EXPECT_TRUE(read(places + "0,0,0,0,0,0\n").places.weights.empty());
}

TEST(FitTargets, RefuseOtherFilesAndFields) {
  const auto refused = [](const std::string& text, std::initializer_list<std::string_view> parts) {
    SCOPED_TRACE(text);
    expect_error<FormatError>([&] { read(text); }, parts);
  };
  refused("", {"in.csv", "empty", "vertex,x,y,z[,nx,ny,nz", "face,u,v,x,y,z[,weight]"});
  refused("vertex,x,y\n0,1,2\n", {"in.csv:1", "'vertex,x,y'", "vertex,x,y,z[,nx,ny,nz"});
  refused("vertex,x,y,z,nx,ny,nz,k1,k2\n", {"in.csv:1", "d1x,d1y,d1z"});
  refused(points, {"in.csv", "no targets"});
  refused(points + "0,1,2\n", {"in.csv:2", "3 fields, not 4"});
  refused(points + "0,1,2,3\n1,nan,0,0\n", {"in.csv:3", "x is 'nan'", "finite"});
  refused(points + "0,1,inf,3\n", {"in.csv:2", "y is 'inf'"});
  refused(points + "-1,1,2,3\n", {"in.csv:2", "vertex -1", "counted from 0"});
  refused(points + "1e9,1,2,3\n", {"in.csv:2", "'1e9' is not a whole number"});
  refused(points + "3000000000,1,2,3\n", {"in.csv:2", "vertex 3000000000 does not exist"});
  refused(points + "4,0,0,0\n1,1,2,3\n4,0,0,0\n", {"in.csv:4", "vertex 4", "in line 2", "leave one"});
  refused(weighted + "0,0,0,0,0,0,-1\n", {"in.csv:2", "weight -1", "0 or more"});
}

TEST(FitTargets, RefuseNormalsAndCurvaturesThatAreNone) {
  const auto refused = [](const std::string& text, std::initializer_list<std::string_view> parts) {
    SCOPED_TRACE(text);
    expect_error<FormatError>([&] { read(text); }, parts);
  };
  refused(normals + "0,1,2,3,0,0,0\n", {"in.csv:2", "normal has length 0", "empty"});
  refused(normals + "0,1,2,3,1,,0\n", {"in.csv:2", "ny is missing"});
  const std::string start = curvatures + "0,1,2,3,";
  refused(start + "0,0,1,1,2,,,\n", {"in.csv:2", "without a direction", "d1x,d1y,d1z"});
  refused(start + "0,0,1,1,2,1,,0\n", {"in.csv:2", "d1y is missing"});
  refused(start + "0,0,1,,2,1,0,0\n", {"in.csv:2", "k1 is missing"});
  refused(start + "0,0,1,1,2,0,0,0\n", {"in.csv:2", "direction", "length 0"});
  refused(start + ",,,1,2,1,0,0\n", {"in.csv:2", "without a normal"});
  refused(start + "0,0,1,1,2,1,0,1\n", {"in.csv:2", "(1, 0, 1)", "45 degrees", "tangent plane", "(0, 0, 1)"});
  refused(start + "0,0,1,1,2,1,0,2e-6\n", {"in.csv:2", "tangent plane"});
  EXPECT_NO_THROW(read(start + "0,0,1e-200,1,2,1,0,0\n"));
  EXPECT_NO_THROW(read(start + "0,0,1e200,1,2,1e200,0,0\n"));
  EXPECT_NO_THROW(read(start + "0,0,1,1,2,1,0,5e-7\n"));  // files have a few digits
}

TEST(FitTargets, RefuseWhatTheMeshDoesNotHave) {
  Mesh mesh = cube();
  mesh.positions.conservativeResize(9, 3);
  mesh.positions.row(8).setZero();
  const Topology topology(view(mesh));
  std::vector<bool> holes(6, false);
  EXPECT_NO_THROW(check_vertices(read(points + "7,0,0,0\n"), topology, holes));
  expect_error<FormatError>([&] { check_vertices(read(points + "9,0,0,0\n"), topology, holes); },
                            {"in.csv:2", "vertex 9 does not exist", "0 to 8"});
  expect_error<FormatError>([&] { check_vertices(read(points + "1,0,0,0\n8,0,0,0\n"), topology, holes); },
                            {"in.csv:3", "vertex 8", "no face"});
  holes = {true, true, true, true, true, false};
  const Index off = topology.vertices(Face{0})[0];
  const bool touches = std::ranges::find(topology.vertices(Face{5}), off) != topology.vertices(Face{5}).end();
  const Index inside = touches ? topology.vertices(Face{0})[2] : off;
  expect_error<FormatError>(
      [&] { check_vertices(read(points + std::to_string(inside) + ",0,0,0\n"), topology, holes); },
      {"in.csv:2", "in holes alone"});

  const Addresses squares(topology, false);
  holes.assign(6, false);
  holes[2] = true;
  EXPECT_NO_THROW(check_places(read(places + "5,1,0,0,0,0\n"), squares, holes));
  const auto refused = [&](const std::string& row, std::initializer_list<std::string_view> parts) {
    expect_error<FormatError>([&] { check_places(read(places + row), squares, holes); }, parts);
  };
  refused("6,0,0,0,0,0\n", {"in.csv:2", "face 6 does not exist", "0 to 5"});
  refused("0,1.5,0,0,0,0\n", {"in.csv:2", "(1.5, 0)", "outside"});
  refused("0,0,0,0,0,0\n2,0,0,0,0,0\n", {"in.csv:3", "face 2", "hole"});
}

}  // namespace
}  // namespace sublimit::testing
