// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/obj.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/memory.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

const std::string square_text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

using Ids = std::vector<Index>;

TEST(Obj, ReadsPositionsAndFacesOfAnySize) {
  std::string text = "v 0.1 -2e3 +.5\n";
  for (int i = 1; i < 300; ++i) text += "v " + format_number(i) + " 0 1\n";
  text += "f 1 2 3\nf";
  for (int i = 1; i <= 300; ++i) text += " " + format_number(i);
  const Mesh mesh = parse_obj(text, "a.obj");
  EXPECT_EQ(mesh.num_vertices(), 300);
  EXPECT_EQ(mesh.positions.row(0), Eigen::RowVector3d(0.1, -2000, 0.5));
  EXPECT_EQ(mesh.positions(299, 0), 299);
  EXPECT_EQ(mesh.face_sizes, (Ids{3, 300}));
  EXPECT_EQ(mesh.face_vertices[2], 2);
  EXPECT_EQ(mesh.face_vertices.back(), 299);
  EXPECT_TRUE(mesh.warnings.empty());
}

TEST(Obj, CornersMayHaveTextureCoordinatesAndNormals) {
  for (const char* const face : {"f 1/1 2/2 3/3", "f 1//1 2//2 3//3", "f 1/1/1 2/2/2 3/3/3", "f 1/ 2// 3/-1/-1"}) {
    EXPECT_EQ(parse_obj(square_text + face, "a.obj").face_vertices, (Ids{0, 1, 2, 3, 0, 1, 2})) << face;
  }
}

TEST(Obj, NegativeIndicesCountBackFromTheLastVertexSoFar) {
  const Mesh mesh = parse_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 0 1 0\nf -4/-1 -2 -1\n", "a.obj");
  EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2, 0, 2, 3}));
}

TEST(Obj, FacesAndTagsMayComeBeforeVertices) {
  const Mesh mesh = parse_obj("t crease 2/1/0 2 0 3\nt hole 1/0/0 0\nf 1 2 3\nv 0 0 0\nv 1 0 0\nv 1 1 0\n", "a.obj");
  EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2}));
  ASSERT_EQ(mesh.creases.size(), 1u);
  EXPECT_EQ(mesh.creases[0].tail, 2);
  EXPECT_EQ(mesh.holes, (Ids{0}));
}

TEST(Obj, LinesMayBeContinuedAndEndInAnyWay) {
  const Mesh plain = parse_obj(square_text, "a.obj");
  for (const std::string text : {
           "v 0 0 \\\n0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2\\\n 3 \\\n 4",
           "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1 2 \\\r\n3 4\r\n",
           "v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rf 1 2 3 4\r",
           "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4 \\",
           "# a comment \\\n\n\tv\t0 0 0# here too\nv 1 0 0 #\n  v 1 1 0\n #\nv 0 1 0 \nf 1 2 3 4#",
       }) {
    const Mesh mesh = parse_obj(text, "a.obj");
    EXPECT_EQ(mesh.positions, plain.positions) << text;
    EXPECT_EQ(mesh.face_vertices, plain.face_vertices) << text;
    EXPECT_TRUE(mesh.warnings.empty()) << text;
  }
}

TEST(Obj, WeightsAndColoursAreDropped) {
  const Mesh mesh = parse_obj("v 1 2 3 0.5\nv 4 5 6 0.1 0.2 0.3\nv 7 8 9 1 1 1 1\nf 1 2 3\n", "a.obj");
  EXPECT_EQ(mesh.positions.row(1), Eigen::RowVector3d(4, 5, 6));
  EXPECT_EQ(mesh.positions.row(2), Eigen::RowVector3d(7, 8, 9));
}

TEST(Obj, StatementsThatAreNoMeshAreSkippedInSilence) {
  const Mesh mesh = parse_obj(
      "mtllib a b.mtl\no x\ng a b\ns off\nvt 0 0\nvn 0 0 1\nvp 1\nusemtl steel\nl 1 2\np 1\n" + square_text, "a.obj");
  EXPECT_EQ(mesh.num_faces(), 1);
  EXPECT_TRUE(mesh.warnings.empty());
}

std::vector<std::string> names_of_faces(const std::string& faces) {
  const Mesh mesh = parse_obj(square_text + faces, "a.obj");
  std::vector<std::string> names;
  for (const Index name : mesh.face_names().of_face)
    names.push_back(name < 0 ? std::string() : mesh.face_names().names[size_t(name)]);
  return names;
}

TEST(Obj, GroupsNameFacesAndObjectsThoseWithoutGroup) {
  using Names = std::vector<std::string>;
  const std::string f = "f 1 2 3\n";
  EXPECT_EQ(names_of_faces(f + f), Names());
  EXPECT_EQ(names_of_faces("g a\n" + f + "g\n" + f), Names({"", "a", ""}));  // the square_text has none
  EXPECT_EQ(names_of_faces("o thing\n" + f + "g a\n" + f + "o other\n" + f + "g\n" + f),
            Names({"", "thing", "a", "a", "other"}));
  EXPECT_EQ(names_of_faces("g left  side # words\n" + f + "g \\\nleft side\n" + f),
            Names({"", "left side", "left side"}));
  EXPECT_EQ(names_of_faces("g a\ng b\ng\n" + f), Names());
}

// A # inside of a name is part of it; behind a blank it begins a comment.
TEST(Obj, NamesMayHaveNumberSigns) {
  const std::string f = "f 1 2 3\n";
  const Mesh mesh = parse_obj("mtllib a#b.mtl # of materials\n" + square_text +
                                  "usemtl a#1\no part#2 # two\ng x#y z#\ns #\n" + f + "usemtl a#2\n" + f,
                              "a.obj");
  EXPECT_EQ(mesh.materials.names, (std::vector<std::string>{"a#1", "a#2"}));
  EXPECT_EQ(mesh.material_files, std::vector<std::string>{"a#b.mtl"});
  EXPECT_EQ(mesh.objects.names, std::vector<std::string>{"part#2"});
  EXPECT_EQ(mesh.groups.names, std::vector<std::string>{"x#y z#"});
  EXPECT_TRUE(mesh.smoothing_groups.of_face.empty());
  const Mesh again = parse_obj(format_obj(mesh), "b.obj");
  EXPECT_EQ(again.materials.names, mesh.materials.names);
  EXPECT_EQ(again.materials.of_face, mesh.materials.of_face);
  EXPECT_EQ(again.groups.names, mesh.groups.names);
  EXPECT_EQ(again.material_files, mesh.material_files);
  for (const char* const name : {"#1", "a #1"}) {
    Mesh other = mesh;
    other.materials.names[0] = name;
    expect_error<InvalidParameter>([&] { (void)format_obj(other); }, {"OBJ has no way to write", "# behind a blank"});
  }
  // Lines are counted in the same way for readers of parts.
  EXPECT_EQ(count_obj("g a# \\\nb\nv 0 0 0\nf 1 2 3\n").vertices, 1);
  EXPECT_EQ(count_obj("g a#b \\\nv 0 0 0\nv 0 0 0\n").vertices, 1);
}

TEST(Obj, WeightsAreNotLeftOutInSilence) {
  const Mesh mesh = parse_obj("v 1 2 3 1\nv 4 5 6 0.5\nv 7 8 9 2\nf 1 2 3\n", "a.obj");
  EXPECT_EQ(mesh.warnings,
            std::vector<std::string>{"a.obj:2: weight 0.5 behind a vertex left out, and any others; a mesh "
                                     "has none, free-form surfaces have"});
  EXPECT_TRUE(parse_obj("v 1 2 3 1\nv 4 5 6 1.0\nv 7 8 9\nf 1 2 3\n", "a.obj").warnings.empty());
}

// Digits that floats do not hold are kept, and the type of the values says so.
TEST(Obj, ColoursHaveTheTypeOfTheirDigits) {
  const auto type = [](const std::string& red) {
    return parse_obj("v 0 0 0 " + red + " 0 1\nv 1 0 0 0 0 0\nv 0 1 0 1 1 1\nf 1 2 3\n", "a.obj")
        .vertex_values.at(0)
        .type;
  };
  for (const char* const red : {"0.5", "0.1", "0.784314", "1e-3", "0"}) EXPECT_EQ(type(red), ValueType::float32) << red;
  for (const char* const red : {"0.12345678901", "1e300"}) EXPECT_EQ(type(red), ValueType::float64) << red;
}

// A text of 8 bytes a vertex makes coordinates of 24.
TEST(Obj, TakesNoMoreMemoryThanAJobMay) {
  std::string text;
  for (int i = 0; i < 200000; ++i) text += "v 0 0 0\n";
  limit_memory(double(3 * text.size()));
  expect_error<ResourceError>([&] { (void)parse_obj(text, "a.obj"); },  // before it has no faces
                              {"a.obj: the text, ", " vertices and 0 faces to begin with take about ",
                               "the limit is 4.8 MB", "a smaller mesh can be read"});
  limit_memory(std::numeric_limits<double>::infinity());
}

TEST(Obj, NamesOfFacesAreThereOnce) {
  const Mesh mesh = parse_obj("g a\n" + square_text + "o b\nf 1 2 3\ng\nf 1 2 3\ng a\nf 1 2 3\n", "a.obj");
  EXPECT_EQ(mesh.face_names().names, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(mesh.face_names().of_face, (Ids{0, 0, 1, 0}));
}

TEST(Obj, UnknownKeywordsAreWarnedAboutOnceEach) {
  const Mesh mesh = parse_obj("bzp 1 2\n" + square_text + "bzp 0 2\nfoo\n", "a.obj");
  ASSERT_EQ(mesh.warnings.size(), 2u);
  EXPECT_EQ(mesh.warnings[0], "a.obj:1: unknown keyword 'bzp' ignored");
  EXPECT_EQ(mesh.warnings[1], "a.obj:8: unknown keyword 'foo' ignored");
}

TEST(Obj, WarningsDoNotGrowWithTheFile) {
  std::string text = square_text;
  for (int i = 0; i < 1000; ++i) text += "k" + format_number(i) + "\nt t" + format_number(i) + "\n";
  EXPECT_LE(parse_obj(text, "a.obj").warnings.size(), 50u);
}

TEST(Obj, ReadsEveryTag) {
  const Mesh mesh = parse_obj(square_text +
                                  "t crease 2/1/0 0 1 2.5\n"
                                  "t crease 4/1/0 1 2 3 2 inf\n"
                                  "t crease 4/2/0 0 3 1 0 0.5 12\n"
                                  "t corner 1/1/0 3 0.1\n"
                                  "t corner 2/2/0 0 1 10 3\n"
                                  "t hole 1/0/0 0\n"
                                  "t interpolateboundary 1/0/0 2\n"
                                  "t creasemethod 0/0/1 chaikin\n"
                                  "t smoothtriangles 0/0/1 smooth\n"
                                  "t facevaryinginterpolateboundary 1/0/0 5\n"
                                  "t facevaryingpropagatecorners 1/0/0 1\n",
                              "a.obj");
  ASSERT_EQ(mesh.creases.size(), 5u);
  EXPECT_EQ(mesh.creases[0].head, 1);
  EXPECT_EQ(mesh.creases[0].sharpness, 2.5f);
  EXPECT_EQ(mesh.creases[2].tail, 3);
  EXPECT_TRUE(std::isinf(mesh.creases[2].sharpness));
  EXPECT_EQ(mesh.creases[3].sharpness, 0.5f);
  EXPECT_EQ(mesh.creases[4].sharpness, 12.0f);
  ASSERT_EQ(mesh.corners.size(), 3u);
  EXPECT_EQ(mesh.corners[0].vertex, 3);
  EXPECT_EQ(mesh.corners[0].sharpness, 0.1f);  // read as a float, not as a double made one
  EXPECT_EQ(mesh.corners[2].sharpness, 3.0f);
  EXPECT_EQ(mesh.holes, (Ids{0}));
  EXPECT_EQ(mesh.boundary, Boundary::edge_only);
  EXPECT_EQ(mesh.creasing, Creasing::chaikin);
  EXPECT_EQ(mesh.triangles, Triangles::smooth);
  EXPECT_EQ(mesh.face_varying_interpolation, FaceVaryingInterpolation::all);
  EXPECT_TRUE(mesh.warnings.empty());
}

TEST(Obj, TheTagNamesEveryFaceVaryingInterpolation) {
  using enum FaceVaryingInterpolation;
  int number = 0;
  for (const FaceVaryingInterpolation interpolation :
       {none, corners_only, corners_plus1, corners_plus2, boundaries, all}) {
    const std::string tag = "t facevaryinginterpolateboundary 1/0/0 " + format_number(number++) + "\n";
    const Mesh mesh = parse_obj(square_text + tag, "a.obj");
    EXPECT_EQ(mesh.face_varying_interpolation, interpolation);
    EXPECT_NE(format_obj(mesh).find(tag), std::string::npos);
  }
}

TEST(Obj, TextureCoordinatesAreAChannel) {
  const Mesh mesh = parse_obj(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0.5\nvt 1 2\nf 1/2 2/1 3/-1\nf 1/3/1 3/1/1 4/-2/1\n"
      "vt 0.1 0.2 0.3 4\n",
      "a.obj");
  ASSERT_EQ(mesh.face_varying.size(), 1u);
  EXPECT_EQ(mesh.face_varying[0].name, "uv");
  Points values(3, 3);  // what a line leaves out is 0
  values << 0.5, 0, 0, 1, 2, 0, 0.1, 0.2, 0.3;
  EXPECT_EQ(mesh.face_varying[0].values, values);
  EXPECT_EQ(mesh.face_varying[0].indices, (Ids{1, 0, 1, 2, 0, 0}));
  EXPECT_TRUE(mesh.warnings.empty());

  const Mesh again = parse_obj(format_obj(mesh), "a.obj");
  EXPECT_EQ(again.face_varying[0].values, values);
  EXPECT_EQ(again.face_varying[0].indices, mesh.face_varying[0].indices);
}

TEST(Obj, TextureCoordinatesOfSomeCornersAreDropped) {
  for (const char* const faces : {"f 1 2 3\nf 1/1 3/1 4/1\n", "f 1/1 2/1 3/1\nf 1 3/1 4/1\n", "f 1/1 2/1 3\nf 1 3 4\n",
                                  "f 1/1 2/1 3//1\nf 1/1 3/1 4/1\n"}) {
    const Mesh mesh = parse_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\n" + std::string(faces), "a.obj");
    EXPECT_EQ(mesh.num_faces(), 2);
    EXPECT_TRUE(mesh.face_varying.empty());
    ASSERT_EQ(mesh.warnings.size(), 1u) << faces;
    const int line = std::string_view(faces).starts_with("f 1/1 2/1 3/1") ? 7 : 6;
    EXPECT_EQ(mesh.warnings[0],
              "a.obj:" + format_number(line) +
                  ": corners without texture coordinate, which others have; texture coordinates are dropped");
  }
  EXPECT_TRUE(parse_obj("vt 0 0\n" + square_text, "a.obj").warnings.empty());  // no corner has any
}

TEST(Obj, OptionsAreAbsentWhereTheFileSaysNothing) {
  const Mesh mesh = parse_obj(square_text, "a.obj");
  EXPECT_FALSE(mesh.boundary || mesh.creasing || mesh.triangles);
}

TEST(Obj, LaterOptionsWin) {
  const Mesh mesh = parse_obj(square_text +
                                  "t interpolateboundary 1/0/0 0\nt interpolateboundary 1/0/0 1\n"
                                  "t creasemethod 0/0/1 chaikin\nt creasemethod 0/0/1 normal\n"
                                  "t smoothtriangles 0/0/1 smooth\nt smoothtriangles 0/0/1 catmark\n",
                              "a.obj");
  EXPECT_EQ(mesh.boundary, Boundary::edge_and_corner);
  EXPECT_EQ(mesh.creasing, Creasing::uniform);
  EXPECT_EQ(mesh.triangles, Triangles::catmark);
}

TEST(Obj, HierarchicalEditsAndUnknownTagsAreWarnedAboutOnceEach) {
  const Mesh mesh = parse_obj(square_text +
                                  "t vertexedit 4/3/3 3 0 1 0 0 0 1 add P value\nt vertexedit\n"
                                  "t edgeedit 1/0/0 1\nt faceedit x\nt glitter 0/0/1 much\n",
                              "a.obj");
  ASSERT_EQ(mesh.warnings.size(), 4u);
  EXPECT_EQ(mesh.warnings[0], "a.obj:6: tag 'vertexedit' ignored: hierarchical edits are not supported");
  EXPECT_EQ(mesh.warnings[3], "a.obj:10: tag 'glitter' ignored: unknown tag");
}

TEST(Obj, CreasesMayRunAlongDegenerateEdges) {
  EXPECT_EQ(parse_obj("v 0 0 0\nv 1 0 0\nf 1 2 2\nt crease 2/1/0 1 1 1\n", "a.obj").creases.size(), 1u);
}

// Time is no law, but a quadratic reader would take minutes here: all vertices, faces and creases meet in one vertex.
TEST(Obj, PolesOfManyCreasesTakeLinearTime) {
  const int n = 100000;
  std::string text = "v 0 0 1\n";
  for (int i = 1; i <= n; ++i) text += "v " + format_number(i) + " 0 0\n";
  for (int i = 0; i < n; ++i) {
    text += "f 1 " + format_number(i + 2) + " " + format_number((i + 1) % n + 2) + "\n";
    text += "t crease 2/1/0 " + format_number(i + 1) + " 0 1\n";
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(parse_obj(text, "a.obj").creases.size(), std::size_t{n});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST(Obj, ReadsFiles) {
  const TemporaryDirectory directory;
  EXPECT_EQ(read_obj(directory.write("a.obj", square_text)).num_faces(), 1);
}

}  // namespace
}  // namespace sublimit::testing
