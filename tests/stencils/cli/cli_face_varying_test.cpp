// SPDX-License-Identifier: Apache-2.0
// Texture coordinates through the program: refined, in the limit, and refined again from what was written.
#include <gtest/gtest.h>

#include "meshes/face_varying_meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/files/level_files.h"

namespace sublimit::testing {
namespace {

/// What the program writes for `levels` levels.
std::string refined(const Scheme<double>& scheme, const Mesh& mesh, int levels) {
  const FaceVaryingInterpolation interpolation = *mesh.face_varying_interpolation;
  const std::vector<Level> all = refine(scheme, mesh, levels);
  Points points = mesh.positions;
  for (int k = 1; k <= levels; ++k) points = apply(all[k].S, points);
  const auto channel = refine_face_varying(scheme, interpolation, mesh.face_varying[0], all);
  Mesh out = level_output(all.back(), points, mesh, {}, true);
  add_channel(out, channel.back(), "uv", refined_values(channel, mesh.face_varying[0].values));
  out.face_varying_interpolation = interpolation;
  return format_obj(out);
}

TEST(RefinedChannel, TwiceByOneIsOnceByTwo) {
  int count = 0;
  for (const NamedMesh& named : tagged_meshes()) {
    // What non-manifold places lose in a file: cli_twice_test.cpp, and the note of add_channel.
    if (named.mesh.num_faces() > 150 || !Topology(view(named.mesh)).is_manifold()) continue;
    if (named.name == "valence_2_triangles") continue;  // two edges join the same two vertices: likewise
    for (const std::string& name : named.schemes)
      for (const double seams : {0.2, 1.0})
        for (const FaceVaryingInterpolation interpolation : all_interpolations) {
          const Scheme<double> scheme = find_scheme(name).value();
          Mesh mesh = with_random_channel(named.mesh, seams);
          mesh.face_varying_interpolation = interpolation;
          const Mesh first = parse_obj(refined(scheme, mesh, 1), named.name);
          EXPECT_EQ(first.face_varying_interpolation, interpolation);
          const bool same = refined(scheme, first, 1) == refined(scheme, mesh, 2);
          EXPECT_TRUE(same) << named.name << ", " << name << ", " << testing::name(interpolation) << ", seams "
                            << seams;
          ++count;
        }
  }
  EXPECT_GT(count, 500);
}

/// Two quadrilaterals with a seam between them, values in [0,1] x [0,1] and beside it.
const std::string two_quads =
    "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 2 0\nvt 3 0\nvt 3 1\nvt "
    "2 1\n"
    "f 1/1 2/2 5/3 4/4\nf 2/5 3/6 6/7 5/8\n";

TEST(CliFaceVarying, WordsAndTagsSayTheSame) {
  const TemporaryDirectory directory;
  const auto path = [&](const std::string& name) { return (directory / name).string(); };
  const char* const words[] = {"none", "corners-only", "corners-plus1", "corners-plus2", "boundaries", "all"};
  for (int i = 0; i < 6; ++i) {
    const std::string tag = "t facevaryinginterpolateboundary 1/0/0 " + std::to_string(i) + "\n";
    directory.write("plain.obj", two_quads);
    directory.write("tagged.obj", two_quads + tag);
    for (const char* command : {"refine", "limit"}) {
      const std::vector<std::string> common{"-s", "catmull-clark", "-l", "1", "-o"};
      const auto run = [&](const std::string& mesh, const std::string& to, std::vector<std::string> more) {
        std::vector<std::string> arguments{command, path(mesh)};
        arguments.insert(arguments.end(), common.begin(), common.end());
        arguments.push_back(path(to));
        arguments.insert(arguments.end(), more.begin(), more.end());
        expect_done(sublimit(arguments));
        return read_file(directory / to);
      };
      const std::string by_word = run("plain.obj", "a.obj", {"--face-varying", words[i]});
      EXPECT_EQ(by_word, run("tagged.obj", "b.obj", {}));
      EXPECT_EQ(by_word.find(tag) != std::string::npos, std::string_view(command) == "refine");
      const Mesh mesh = parse_obj(by_word, "a.obj");
      ASSERT_EQ(mesh.face_varying.size(), 1u);
      EXPECT_EQ(mesh.face_varying[0].values.rows(), 18);  // nine values a side
      const bool corner_stays =
          (mesh.face_varying[0].values.row(2).array() == 1).all();  // of the left side, at the seam
      EXPECT_EQ(corner_stays, i > 0);
      if (i == 5) {
        EXPECT_EQ(by_word, run("plain.obj", "c.obj", {}));  // the default
      }
      EXPECT_EQ(run("tagged.obj", "d.obj", {"--face-varying", words[(i + 1) % 6]}),
                run("plain.obj", "e.obj", {"--face-varying", words[(i + 1) % 6]}));  // words win
    }
  }
}

TEST(CliFaceVarying, LimitValuesStandBesideNormals) {
  const TemporaryDirectory directory;
  directory.write("mesh.obj", two_quads);
  const std::string mesh = (directory / "mesh.obj").string(), out = (directory / "out.obj").string();
  expect_done(sublimit({"limit", mesh, "-s", "catmull-clark", "--normals", "-o", out}));
  EXPECT_NE(read_file(out).find("f 1/1/"), std::string::npos);
  const Mesh limit = parse_obj(read_file(out), "out.obj");
  ASSERT_EQ(limit.face_varying.size(), 1u);
  EXPECT_EQ(limit.face_varying[0].values, parse_obj(two_quads, "mesh.obj").face_varying[0].values);  // all: they stay
  expect_done(sublimit({"limit", mesh, "-s", "catmull-clark", "-o", (directory / "out.ply").string()}));

  directory.write("hole.obj", two_quads + "t hole 1/0/0 0\n");  // is left out, with its corners
  expect_done(sublimit({"limit", (directory / "hole.obj").string(), "-s", "catmull-clark", "-o", out}));
  EXPECT_EQ(parse_obj(read_file(out), "out.obj").face_varying[0].indices, (std::vector<Index>{4, 5, 6, 7}));
}

TEST(CliFaceVarying, SchemesThatCutEdgesLeaveThemOutUnlessAskedTo) {
  const TemporaryDirectory directory;
  directory.write("mesh.obj", two_quads);
  const std::string mesh = (directory / "mesh.obj").string(), out = (directory / "out.obj").string();
  const std::vector<std::string> arguments{"refine", mesh, "-s", "doo-sabin", "-l", "1", "-o", out};
  expect_parts(expect_done(sublimit(arguments), true).err,
               {"warning", "mesh.obj", "texture coordinates are left out", "doo-sabin"});
  EXPECT_EQ(read_file(out).find("vt"), std::string::npos);
  expect_refused("mesh.obj", two_quads, {"-s", "doo-sabin", "--face-varying", "none"}, 3,
                 {"mesh.obj", "seam", "(1,4)", "doo-sabin"});
  expect_refused("mesh.obj", two_quads, {"-s", "doo-sabin", "--face-varying", "all"}, 2, {"'all'", "doo-sabin"});
}

TEST(CliFaceVarying, UnknownWordsAndTagsAreRefused) {
  expect_refused("mesh.obj", two_quads + "t facevaryinginterpolateboundary 1/0/0 6\n", {"-s", "catmull-clark"}, 3,
                 {"mesh.obj:17", "0 to 5"});
  expect_refused("mesh.obj", two_quads + "f 1/1 2/2 3/9\n", {"-s", "catmull-clark"}, 3,
                 {"mesh.obj:17", "texture coordinate 9"});
  const TemporaryDirectory directory;
  const std::string mesh = directory.write("mesh.obj", two_quads).string();
  expect_failure(
      sublimit({"refine", mesh, "-s", "catmull-clark", "-l", "1", "--face-varying", "some", "-o", mesh + ".obj"}), 2,
      {"--face-varying", "some", "corners-plus1"});
  expect_parts(expect_done(sublimit({"info", mesh})).out,
               {"face-varying", "uv: 8 values of 2 numbers", "interpolation all"});
}

}  // namespace
}  // namespace sublimit::testing
