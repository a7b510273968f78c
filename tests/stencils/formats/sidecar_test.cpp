// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/formats/sidecar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/obj.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

using Ids = std::vector<Index>;

/// Two quads side by side, tagged in every way.
Mesh strip() {
  return parse_obj(
      "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nf 1 2 5 4\nf 2 3 6 5\n"
      "t crease 2/1/0 1 4 9\nt corner 1/1/0 5 9\nt hole 1/0/0 1\n"
      "t interpolateboundary 1/0/0 0\nt creasemethod 0/0/1 chaikin\nt smoothtriangles 0/0/1 smooth\n",
      "strip.obj");
}

Mesh with(const std::string& text) {
  Mesh mesh = strip();
  apply_sidecar_text(mesh, text, "strip.json");
  return mesh;
}

TEST(Sidecar, ReplacesEveryTag) {
  const Mesh mesh = with(R"({
    "creaseIndices": [0, 1, 2, 4, 5], "creaseLengths": [3, 2], "creaseSharpnesses": [2.5, 1e300],
    "cornerIndices": [0, 3], "cornerSharpnesses": [0.1, 10],
    "holeIndices": [0],
    "interpolateBoundary": "edgeOnly",
    "creaseMethod": "uniform",
    "triangleSubdivisionRule": "catmullClark",
    "faceVaryingLinearInterpolation": "cornersPlus1"})");
  ASSERT_EQ(mesh.creases.size(), 3u);
  EXPECT_EQ(mesh.creases[1].tail, 1);
  EXPECT_EQ(mesh.creases[1].head, 2);
  EXPECT_EQ(mesh.creases[1].sharpness, 2.5f);
  EXPECT_EQ(mesh.creases[2].head, 5);
  EXPECT_TRUE(std::isinf(mesh.creases[2].sharpness));
  ASSERT_EQ(mesh.corners.size(), 2u);
  EXPECT_EQ(mesh.corners[0].sharpness, 0.1f);
  EXPECT_EQ(mesh.corners[1].vertex, 3);
  EXPECT_EQ(mesh.holes, (Ids{0}));
  EXPECT_EQ(mesh.boundary, Boundary::edge_only);
  EXPECT_EQ(mesh.creasing, Creasing::uniform);
  EXPECT_EQ(mesh.triangles, Triangles::catmark);
  EXPECT_EQ(mesh.face_varying_interpolation, FaceVaryingInterpolation::corners_plus1);
  EXPECT_TRUE(mesh.warnings.empty());
}

TEST(Sidecar, WhatItLeavesOutStays) {
  const Mesh mesh = with("{}");
  EXPECT_EQ(mesh.creases.size(), 1u);
  EXPECT_EQ(mesh.corners.size(), 1u);
  EXPECT_EQ(mesh.holes, (Ids{1}));
  EXPECT_EQ(mesh.boundary, Boundary::none);
  EXPECT_EQ(mesh.creasing, Creasing::chaikin);
  EXPECT_EQ(mesh.triangles, Triangles::smooth);
}

TEST(Sidecar, EmptyListsRemoveTags) {
  const Mesh mesh = with(R"({"creaseIndices": [], "creaseLengths": [], "creaseSharpnesses": [],
                                    "cornerIndices": [], "cornerSharpnesses": [], "holeIndices": []})");
  EXPECT_TRUE(mesh.creases.empty());
  EXPECT_TRUE(mesh.corners.empty());
  EXPECT_TRUE(mesh.holes.empty());
}

TEST(Sidecar, SharpnessesMayBePerEdge) {
  const Mesh mesh =
      with(R"({"creaseIndices": [0, 1, 2, 4, 5], "creaseLengths": [3, 2], "creaseSharpnesses": [1, 2, 3]})");
  ASSERT_EQ(mesh.creases.size(), 3u);
  EXPECT_EQ(mesh.creases[0].sharpness, 1);
  EXPECT_EQ(mesh.creases[1].sharpness, 2);
  EXPECT_EQ(mesh.creases[2].sharpness, 3);
}

TEST(Sidecar, EveryBoundaryHasAName) {
  EXPECT_EQ(with(R"({"interpolateBoundary": "none"})").boundary, Boundary::none);
  EXPECT_EQ(with(R"({"interpolateBoundary": "edgeOnly"})").boundary, Boundary::edge_only);
  EXPECT_EQ(with(R"({"interpolateBoundary": "edgeAndCorner"})").boundary, Boundary::edge_and_corner);
  EXPECT_EQ(with(R"({"triangleSubdivisionRule": "smooth"})").triangles, Triangles::smooth);
}

TEST(Sidecar, UnknownKeysAreWarnedAbout) {
  const Mesh mesh = with(R"({"subdivisionScheme": "loop", "deep": {"creaseIndices": 3}, "holeIndexes": []})");
  ASSERT_EQ(mesh.warnings.size(), 3u);
  EXPECT_EQ(mesh.warnings[2], "strip.json: unknown key \"holeIndexes\" ignored; the nearest is holeIndices");
  EXPECT_EQ(mesh.warnings[0], "strip.json: unknown key \"subdivisionScheme\" ignored");
  EXPECT_EQ(mesh.warnings[1], "strip.json: unknown key \"deep\" ignored");
}

TEST(Sidecar, SaysWhatIsNotJson) {
  const auto expect = [](const std::string& text, std::initializer_list<std::string_view> parts) {
    SCOPED_TRACE(text.substr(0, 100));
    expect_error<FormatError>([&] { with(text); }, parts);
  };
  expect("", {"strip.json:1: not JSON"});
  expect("{\n\"holeIndices\": [1,\n}", {"strip.json:3: not JSON", "column 1"});
  expect("{\"holeIndices\": [1e999]}", {"strip.json:1: not JSON", "1e999"});
  expect("\xff\xfe{", {"strip.json:1: not JSON"});
  expect("[1, 2]", {"strip.json: holds an array", "a sidecar is an object"});
  expect("3", {"strip.json: holds 3"});
  expect(std::string(1000000, '['), {"strip.json: nests deeper"});
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "{\"a\":";
  expect(deep, {"strip.json: nests deeper"});
  expect(R"({"holeIndices": [0], "holeIndices": [1]})", {"strip.json: has the field \"holeIndices\" twice"});
}

TEST(Sidecar, SaysWhereItMakesNoSense) {
  const auto expect = [](const std::string& text, std::initializer_list<std::string_view> parts) {
    SCOPED_TRACE(text);
    expect_error<FormatError>([&] { with(text); }, parts);
  };
  expect(R"({"holeIndices": 1})", {"strip.json: holeIndices: is 1; it should be a list"});
  expect(R"({"holeIndices": null})", {"strip.json: holeIndices: is null"});
  expect(R"({"holeIndices": [0, "1"]})", {"strip.json: holeIndices[1]: is \"1\"; it should be a face"});
  expect(R"({"holeIndices": [0.5]})", {"strip.json: holeIndices[0]: is 0.5"});
  expect(R"({"holeIndices": [[0]]})", {"strip.json: holeIndices[0]: is an array"});
  expect(R"({"holeIndices": [2]})", {"strip.json: holeIndices[0]: is 2; it should be a face from 0 to 1"});
  expect(R"({"holeIndices": [-1]})", {"strip.json: holeIndices[0]: is -1; it should be a face"});
  expect(R"({"holeIndices": [18446744073709551615]})", {"strip.json: holeIndices[0]: is 18446744073709551615"});

  expect(R"({"cornerIndices": [6], "cornerSharpnesses": [1]})",
         {"strip.json: cornerIndices[0]: is 6; it should be a vertex from 0 to 5"});
  expect(R"({"cornerIndices": [1]})", {"strip.json: cornerIndices: comes without cornerSharpnesses"});
  expect(R"({"cornerSharpnesses": [1]})", {"strip.json: cornerSharpnesses: comes without cornerIndices"});
  expect(R"({"cornerIndices": [1], "cornerSharpnesses": [1, 2]})",
         {"strip.json: cornerSharpnesses: has 2 values; it should have 1"});
  expect(R"({"cornerIndices": [1, 2], "cornerSharpnesses": [1, -2]})",
         {"strip.json: cornerSharpnesses[1]: is -2; a sharpness"});
  expect(R"({"cornerIndices": [1], "cornerSharpnesses": [true]})", {"strip.json: cornerSharpnesses[0]: is true"});

  expect(R"({"creaseIndices": [0, 1]})", {"strip.json: creaseIndices: comes without creaseLengths"});
  expect(R"({"creaseIndices": [0, 1], "creaseLengths": [2]})", {"creaseIndices: comes without creaseSharpnesses"});
  expect(R"({"creaseLengths": [2]})", {"strip.json: creaseLengths: comes without creaseIndices"});
  expect(R"({"creaseSharpnesses": [2]})", {"strip.json: creaseSharpnesses: comes without creaseIndices"});
  const auto expect_crease = [&](const std::string& indices, const std::string& lengths, const std::string& sharpnesses,
                                 std::initializer_list<std::string_view> parts) {
    expect(R"({"creaseIndices": )" + indices + R"(, "creaseLengths": )" + lengths + R"(, "creaseSharpnesses": )" +
               sharpnesses + "}",
           parts);
  };
  expect_crease("[0, 1]", "[1]", "[1]",
                {"strip.json: creaseLengths[0]: is 1; it should be the number of vertices of a chain, from 2"});
  expect_crease("[0, 1]", "[-2]", "[1]", {"strip.json: creaseLengths[0]: is -2"});
  expect_crease("[0, 1]", "[\"2\"]", "[1]", {"strip.json: creaseLengths[0]: is \"2\""});
  expect_crease("[0, 1]", "[18446744073709551615]", "[1]", {"strip.json: creaseLengths[0]: is 18446744073709551615"});
  expect_crease("[0, 1, 2]", "[2]", "[1]", {"strip.json: creaseLengths: they add up to 2; creaseIndices has 3"});
  expect_crease("[0, 1, 2]", "[3, 2]", "[1, 1]", {"strip.json: creaseLengths[1]: the chains need more"});
  expect_crease("[0, 1, 2]", "[3]", "[1, 2, 3]",
                {"strip.json: creaseSharpnesses: has 3 values", "1, one for each chain, or 2"});
  expect_crease("[0, 9]", "[2]", "[1]", {"strip.json: creaseIndices[1]: is 9; it should be a vertex"});

  expect(R"({"interpolateBoundary": "edges"})",
         {"strip.json: interpolateBoundary: is \"edges\"; it should be one of none, edgeOnly, edgeAndCorner"});
  expect(R"({"interpolateBoundary": 1})", {"strip.json: interpolateBoundary: is 1"});
  expect(R"({"triangleSubdivisionRule": "catmark"})", {"triangleSubdivisionRule", "catmullClark, smooth"});
  expect(R"({"creaseMethod": "normal"})", {"creaseMethod", "uniform, chaikin"});
  expect(R"({"faceVaryingLinearInterpolation": []})", {"faceVaryingLinearInterpolation: is an array"});
}

TEST(Sidecar, CreasesWithoutAnEdgeAreWarnings) {
  Mesh mesh = strip();
  apply_sidecar_text(mesh, R"({"creaseIndices": [0, 1, 3], "creaseLengths": [3], "creaseSharpnesses": [1]})",
                     "strip.json");
  ASSERT_EQ(mesh.creases.size(), 1u);
  EXPECT_EQ(mesh.creases[0].head, 1);
  ASSERT_EQ(mesh.warnings.size(), 1u);
  EXPECT_EQ(
      mesh.warnings[0].find("strip.json: creaseIndices[1]: crease ignored: no face has an edge between vertices 1 "
                            "and 3"),
      0u);
}

TEST(Sidecar, LeavesTheMeshAsItWasWhenItFails) {
  Mesh mesh = strip();
  expect_error<FormatError>(
      [&] {
        apply_sidecar_text(mesh,
                           R"({"holeIndices": [0], "interpolateBoundary": "edgeOnly", "x": 1, "cornerIndices": [9]})",
                           "strip.json");
      },
      {"cornerIndices"});
  EXPECT_EQ(mesh.holes, (Ids{1}));
  EXPECT_EQ(mesh.boundary, Boundary::none);
  EXPECT_TRUE(mesh.warnings.empty());
}

TEST(Sidecar, ReportsAreNone) {
  const TemporaryDirectory directory;
  directory.write("strip.json", "{\n \"format\": \"sublimit-fit\",\n \"version\": 1\n}\n");
  EXPECT_FALSE(find_sidecar(directory / "strip.obj"));
  directory.write("strip.json", R"({"format": "other", "holeIndices": [0]})");
  EXPECT_TRUE(find_sidecar(directory / "strip.obj"));
}

// Every key that is read makes a file a sidecar.
TEST(Sidecar, IsFoundByAnyOfItsKeys) {
  const TemporaryDirectory directory;
  const std::filesystem::path mesh = directory.write("a.obj", "");
  for (const char* const key :
       {"creaseIndices", "creaseLengths", "creaseSharpnesses", "cornerIndices", "cornerSharpnesses", "knotIntervals",
        "knotIntervalEdges", "holeIndices", "interpolateBoundary", "creaseMethod", "triangleSubdivisionRule",
        "faceVaryingLinearInterpolation"}) {
    const std::string text = "{\"" + std::string(key) + "\": []}";
    directory.write("a.json", text);
    EXPECT_TRUE(find_sidecar(mesh).has_value()) << key;
    Mesh strip_of_quads = strip();
    try {  // read, whatever is wrong with it
      apply_sidecar_text(strip_of_quads, text, "a.json");
    } catch (const FormatError&) {
    }
    EXPECT_TRUE(std::ranges::none_of(strip_of_quads.warnings, [](const std::string& warning) {
      return warning.find("unknown key") != std::string::npos;
    })) << key;
  }
}

TEST(Sidecar, DevicesWithoutAnEndAreRefused) {
  Mesh mesh = strip();
  limit_memory(1e8);
  expect_error<ResourceError>([&] { apply_sidecar(mesh, "/dev/zero"); },
                              {"/dev/zero: more than ", "values as JSON", "the limit is 100.0 MB"});
  limit_memory(std::numeric_limits<double>::infinity());
}

TEST(Sidecar, IsFoundNextToTheMesh) {
  const TemporaryDirectory directory;
  EXPECT_FALSE(find_sidecar(directory / "strip.obj"));
  const std::filesystem::path path = directory.write("strip.json", R"({"holeIndices": [0]})");
  EXPECT_EQ(find_sidecar(directory / "strip.obj"), path);
  EXPECT_EQ(find_sidecar(directory / "strip.ply"), path);
  EXPECT_EQ(find_sidecar(directory / "strip.obj.gz"), path);
  EXPECT_FALSE(find_sidecar(directory / "other.obj"));
  EXPECT_FALSE(find_sidecar(path));
  Mesh mesh = strip();
  apply_sidecar(mesh, path);
  EXPECT_EQ(mesh.holes, (Ids{0}));
  expect_error<IoError>([&] { apply_sidecar(mesh, directory / "no.json"); }, {"no.json: cannot read"});
}

}  // namespace
}  // namespace sublimit::testing
