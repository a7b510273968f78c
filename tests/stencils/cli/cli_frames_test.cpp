// SPDX-License-Identifier: Apache-2.0
// Sequences of files with a frame each: `sublimit apply TABLE 'pose.####.ply' -o 'out.####.ply'`.
#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/detail/ply.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/stencils/formats/npy.h"

namespace sublimit::testing {
namespace {

using Words = std::vector<std::string>;

Mesh pose(int frame) {
  Mesh mesh = cube();
  mesh.positions.array() += frame;
  return mesh;
}

struct CliFrames : ::testing::Test {
  TemporaryDirectory directory;
  std::string path(const std::string& name) const { return (directory / name).string(); }
  bool has(const std::string& name) const { return std::filesystem::exists(directory / name); }
  CliFrames() {
    write_obj(path("cube.obj"), cube());
    expect_done(sublimit({"bake", path("cube.obj"), "-s", "catmull-clark", "-l", "1", "--precision", "double", "-o",
                          path("table.safetensors"), "--quiet"}));
  }
  void poses(const std::string& before, const Words& numbers) {
    for (const std::string& number : numbers) write_ply(path(before + number + ".ply"), pose(std::stoi(number)));
  }
  Outcome apply(const std::string& in, const std::string& out, const Words& more = {}) const {
    Words words{"apply", path("table.safetensors"), path(in), "-o", path(out)};
    words.insert(words.end(), more.begin(), more.end());
    return sublimit(words);
  }
};

TEST_F(CliFrames, EveryFileIsAppliedInTheOrderOfItsNumber) {
  poses("pose.", {"9998", "10000", "9999"});
  directory.write("pose.00001.ply", "not of the sequence: five digits begin with no zero");
  directory.write("pose.1.ply", "nor this");
  directory.write("pose.abcd.ply", "nor this");
  const Outcome outcome = apply("pose.####.ply", "out.####.ply");
  expect_parts(expect_done(outcome).out, {"out.####.ply: 26 points, 3 frames"});
  for (const char* const number : {"9998", "9999", "10000"}) {
    expect_done(apply(std::string("pose.") + number + ".ply", "one.ply"));
    EXPECT_EQ(read_file(path("one.ply")), read_file(path(std::string("out.") + number + ".ply"))) << number;
  }
  expect_done(apply("pose.####.ply", "all.npy"));
  const NpyArray all(path("all.npy"));
  EXPECT_EQ(all.shape(), (std::vector<std::int64_t>{3, 26, 3}));
  std::vector<double> first(3);
  for (int i = 0; i < 3; ++i) {
    all.read<double>(std::int64_t(i) * 26 * 3, first);
    EXPECT_EQ(first[0], read_mesh(path("out." + std::to_string(9998 + i) + ".ply")).positions(0, 0));
  }
}

TEST_F(CliFrames, SomeFramesAndOnesThatAreMissing) {
  poses("p", {"1", "2", "4", "8", "9", "10"});
  const Outcome outcome = apply("p#.ply", "out_##.obj", {"--frames", "2-9"});
  EXPECT_EQ(outcome.status, 0);
  expect_parts(outcome.err, {"note: " + path("p#.ply") + ": no file for frames 3, 5-7; they are left out"});
  EXPECT_TRUE(has("out_02.obj") && has("out_04.obj") && has("out_08.obj") && has("out_09.obj"));
  EXPECT_FALSE(has("out_01.obj") || has("out_10.obj") || has("out_03.obj"));
  EXPECT_EQ(apply("p#.ply", "other_##.obj", {"--frames", "2:9", "--quiet"}).err, "");
  expect_parts(apply("p#.ply", "x.npy", {"--frames", "8:12"}).err, {"no file for frames 11-12"});
  expect_done(apply("p#.ply", "one.npy", {"--frames", "4"}));
  EXPECT_EQ(NpyArray(path("one.npy")).shape(), (std::vector<std::int64_t>{1, 26, 3}));
}

TEST_F(CliFrames, AnArrayOfFramesGoesToFilesAndBack) {
  poses("pose.", {"0000", "0001", "0002"});
  NpyWriter array(path("animation.npy"), DType::F64, {3, 8, 3});
  for (int frame = 0; frame < 3; ++frame) {
    const Points points = pose(frame).positions;
    array.write<double>({points.data(), size_t(points.size())});
  }
  array.commit();
  expect_done(apply("animation.npy", "out.####.npy"));
  expect_done(apply("pose.####.ply", "same.####.npy"));
  for (const char* const number : {"0000", "0001", "0002"})
    EXPECT_EQ(read_file(path("out." + std::string(number) + ".npy")),
              read_file(path("same." + std::string(number) + ".npy")));
  expect_done(apply("animation.npy", "all.npy"));
  expect_done(apply("animation.npy", "last.npy", {"--frames", "1-2"}));
  EXPECT_EQ(read_file(path("last.npy")).substr(128), read_file(path("all.npy")).substr(128 + 26 * 3 * 8));
  expect_done(apply("animation.npy", "f#.csv", {"--frames", "2"}));
  EXPECT_TRUE(has("f2.csv") && !has("f0.csv"));
  expect_failure(apply("animation.npy", "z.npy", {"--frames", "2-3"}), 2,
                 {"holds 3 frames, from 0 to 2", "no frame 3"});
  expect_failure(apply("cube.obj", "z.npy", {"--frames", "0"}), 2, {"--frames", "holds one frame"});
}

TEST_F(CliFrames, MistakesNameTheFile) {
  poses("pose.", {"0001", "0002", "0003"});
  write_ply(path("pose.0002.ply"), torus(4, 4));
  const Outcome mixed = apply("pose.####.ply", "out.####.ply");
  expect_failure(mixed, 3, {"pose.0002.ply: 16 points of 3 channels, and ", "pose.0001.ply has 8 of 3"});
  EXPECT_TRUE(has("out.0001.ply"));
  EXPECT_FALSE(has("out.0002.ply") || has("out.0003.ply"));
  expect_failure(apply("pose.####.ply", "all.npy"), 3, {"pose.0002.ply: 16 points"});
  EXPECT_FALSE(has("all.npy"));
  Mesh other = cube();
  std::swap(other.face_vertices[0], other.face_vertices[2]);
  std::swap(other.face_vertices[4], other.face_vertices[6]);
  write_ply(path("pose.0002.ply"), other);
  expect_failure(apply("pose.####.ply", "all.npy"), 3, {"pose.0002.ply: its faces are others"});
  expect_failure(apply("none.####.ply", "all.npy"), 3, {"none.####.ply: there is no such file"});
  expect_failure(apply("pose.####.ply", "all.npy", {"--frames", "7-9"}), 3,
                 {"there is no such file for frames 7-9, but of 1 to 3"});
  expect_failure(apply("po#e.####.ply", "all.npy"), 2, {"# in two places"});
  expect_failure(apply("pose.0001.ply", "out.####.ply"), 2, {"has one frame, without a number"});
  expect_failure(apply("pose.####.ply", "out.ply"), 2, {"holds 3 frames and ", "as out.####.obj"});
  for (const char* const text : {"3-1", "a", "1-", "-1", "1-2-3", "1.5"})
    expect_failure(apply("pose.####.ply", "all.npy", {"--frames", text}), 2, {"--frames " + std::string(text)});
}

/// A file that is really named so is that file.
TEST_F(CliFrames, FilesWithSuchNamesStayFiles) {
  write_ply(path("pose.####.ply"), pose(5));
  poses("pose.", {"0001", "0002"});
  expect_done(apply("pose.####.ply", "one.ply"));
  EXPECT_EQ(read_mesh(path("one.ply")).num_vertices(), 26);
}

/// Each file is replaced when it has been read.
TEST_F(CliFrames, FramesCanBeWrittenOverTheirPoints) {
  expect_done(sublimit({"bake", path("cube.obj"), "-s", "catmull-clark", "-l", "0", "--limit", "--precision", "double",
                        "-o", path("limit.safetensors"), "--quiet"}));
  poses("pose.", {"01", "02"});
  expect_done(sublimit({"apply", path("limit.safetensors"), path("pose.##.ply"), "-o", path("out.##.ply")}));
  expect_done(sublimit({"apply", path("limit.safetensors"), path("pose.##.ply"), "-o", path("pose.##.ply")}));
  for (const char* const number : {"01", "02"})
    EXPECT_EQ(read_file(path("pose." + std::string(number) + ".ply")),
              read_file(path("out." + std::string(number) + ".ply")));
}

}  // namespace
}  // namespace sublimit::testing
