// SPDX-License-Identifier: Apache-2.0
// Numbers in messages have the shortest form that reads back: what is wrong with 1.000000001 is not wrong with 1.
#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"

namespace sublimit::testing {
namespace {

TEST(CliMessages, NumbersHaveTheirShortestForm) {
  const TemporaryDirectory directory;
  const auto file = [&](const char* name, const std::string& text) { return directory.write(name, text).string(); };
  write_obj(directory / "cube.obj", cube());
  const std::string mesh = (directory / "cube.obj").string(), text = read_file(mesh), scheme = "catmull-clark";
  const std::string csv = (directory / "out.csv").string(), obj = (directory / "out.obj").string();
  const std::string places = file("places.csv", "face,u,v\n0,1.000000001,0.5\n");
  const std::string rays = file("rays.csv", "ox,oy,oz,dx,dy,dz,tmin,tmax\n0,0,0,0,0,1,1,0.9999999999\n");
  const std::string targets = file("targets.csv", "face,u,v,x,y,z,weight\n0,0.5,0.5,0,0,1,-1e-09\n");
  const std::string outside = file("outside.csv", "face,u,v,x,y,z\n0,0.5,-1e-09,0,0,1\n");
  const std::string normals = file("normals.csv", "vertex,x,y,z,nx,ny,nz\n0,1,1,1,1,1,1\n");
  const std::string creased = file("creased.obj", text + "t crease 2/1/0 0 1 -1e-09\n");
  for (const auto& [words, number] : std::initializer_list<std::pair<std::vector<std::string>, std::string>>{
           {{"sample", mesh, "-s", scheme, "--at", places, "-o", csv}, "(1.000000001, 0.5)"},
           {{"bake", mesh, "-s", scheme, "--at", places, "-o", (directory / "t.safetensors").string()}, "1.000000001"},
           {{"intersect", mesh, "-s", scheme, "--rays", rays, "-o", csv}, "0.9999999999"},
           {{"fit", mesh, "-s", scheme, "--targets", targets, "-o", obj}, "-1e-09"},
           {{"fit", mesh, "-s", scheme, "--targets", outside, "-o", obj}, "-1e-09"},
           {{"fit", mesh, "-s", "doo-sabin", "--targets", normals, "--construct", "--size", "1.000000001", "-o", obj},
            "1.000000001"},
           {{"fit", mesh, "-s", scheme, "--targets", normals, "--thin-plate", "-1e-9", "-o", obj}, "-1e-09"},
           {{"tessellate", mesh, "-s", scheme, "--chord", "-1e-9", "-o", obj}, "-1e-9"},
           {{"tessellate", mesh, "-s", scheme, "--chord", "1", "--angle", "-1e-9", "-o", obj}, "-1e-9"},
           {{"refine", creased, "-s", scheme, "-l", "1", "-o", obj}, "-1e-09"}}) {
    const Outcome outcome = sublimit(words);
    EXPECT_GE(outcome.status, 2);
    expect_parts(outcome.err, {number});
    EXPECT_EQ(outcome.err.find(".000000 "), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find(".000000,"), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace sublimit::testing
