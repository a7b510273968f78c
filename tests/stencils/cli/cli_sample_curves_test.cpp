// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "stencils/cli_program.h"

namespace sublimit::testing {
namespace {

const std::string zigzag = "x,y\n0,0\n1,2\n3,1\n4,0\n5,1\n6,3\n7,0\n";

TEST(CliSampleCurves, FourPointOnAGrid) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("p.csv", zigzag).string(), out = (directory / "o.csv").string();
  const Outcome outcome = sublimit({"sample", in, "-s", "four-point", "--grid", "3", "--derivatives", "1", "-o", out});
  expect_done(outcome);
  expect_parts(outcome.out, {"18 samples"});
  const std::string text = read_file(out);
  EXPECT_TRUE(text.starts_with("segment,t,status,x,y,xt,yt,nx,ny\n0,0,crease,0,0,")) << text;
  expect_parts(text,
               {"\n0,1,unbounded-second,1,2,", "\n1,0,unbounded-second,1,2,", "\n5,1,crease,7,0,"});  // it interpolates
}

TEST(CliSampleCurves, PlacesBeforeTheStartAreOutside) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("p.csv", zigzag).string(), out = (directory / "o.csv").string(),
                    at = directory.write("at.csv", "segment,t\n0,0.25\n0,0.5\n").string();
  expect_done(sublimit({"sample", in, "-s", "chaikin", "--at", at, "-o", out, "--quiet"}));
  expect_parts(read_file(out), {"\n0,0.25,outside,0.5,1,,\n", "\n0,0.5,crease,0.5,1,"});
}

TEST(CliSampleCurves, ArcsHaveUnitTangents) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("h.csv", "x,y,tx,ty\n1,0,0,1\n0,1,-1,0\n").string(),
                    out = (directory / "o.csv").string();
  expect_done(
      sublimit({"sample", in, "-s", "hermite-incentre", "--grid", "2", "--derivatives", "2", "-o", out, "--quiet"}));
  EXPECT_TRUE(read_file(out).starts_with("segment,t,status,x,y,xt,yt,xtt,ytt,nx,ny\n0,0,")) << read_file(out);
}

TEST(CliSampleCurves, RefusesWithTheLine) {
  for (const auto& [places, parts] : std::initializer_list<std::pair<std::string, std::string>>{
           {"segment,t\n0,0.5\n6,0\n", "at.csv:3: segment 6 does not exist; segments are 0 to 5"},
           {"segment,t\n0,1.5\n", "at.csv:2: t = 1.5 is outside"},
           {"segment,t\n0,nan\n", "at.csv:2: "},
           {"segment,t\n0\n", "at.csv:2: "},
           {"face,u,v\n0,0,0\n", "segment,t"}}) {
    const TemporaryDirectory directory;
    const std::string in = directory.write("p.csv", zigzag).string(), at = directory.write("at.csv", places).string();
    expect_failure(sublimit({"sample", in, "-s", "chaikin", "--at", at, "-o", (directory / "o.csv").string()}), 3,
                   {parts});
    EXPECT_EQ(directory.num_files(), 2);
  }
}

}  // namespace
}  // namespace sublimit::testing
