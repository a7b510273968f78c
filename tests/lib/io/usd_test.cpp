// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/usd.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "meshes/meshes.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/io/detail/usd_mesh.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/io/write_mesh.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

using Ids = std::vector<Index>;
using Names = std::vector<std::string>;

std::string usd_layer(const std::string& contents) { return "#usda 1.0\n" + contents; }
/// A prim of two triangles, a square in the plane z = 0, with further properties and prims.
std::string square_prim(const std::string& name, const std::string& more = {}) {
  return "def Mesh \"" + name +
         "\"\n{\n  point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]\n"
         "  int[] faceVertexCounts = [3, 3]\n  int[] faceVertexIndices = [0, 1, 2, 0, 2, 3]\n" +
         more + "\n}\n";
}
Mesh read(const std::string& contents) { return parse_usd(usd_layer(contents), "scene.usda"); }

TEST(Usd, TextIsReadWhateverItsShape) {
  const auto read_layer = parse_usda(
      "#usda 1.0\n(\n  \"\"\"a text with ) } \" and\n lines\"\"\"\n  defaultPrim = \"A\"; upAxis = \"Z\"\n"
      "  customLayerData = { string a = \"}\"; dictionary b = { int c = 1 } }\n)\n"
      "# a comment with { and \"\n"
      "def \"A\" ( prepend references = @./b.usda@</B> (offset = 2) ; variants = { string v = \"one\" }\n  kind = 'x' )\n{\n"
      "  custom uniform token[] x:y = [\"a\", \"]\"] ( doc = \"(\" )\n  float a;float b.timeSamples = { 0: 1, 1: 2, }\n"
      "  float c.connect = </A.b>\n  rel m = [ </A>, </B> ]\n  delete rel n = </A>\n"
      "  asset f = @@@a@b.png@@@\n  matrix4d t = ( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1) )\n"
      "  reorder properties = [\"a\"]\n"
      "  variantSet \"v\" = {\n    \"one\" (active = true) { over \"C\" { int i = 3 } }\n    \"two\" { }\n  }\n"
      "  class Xform \"C\" { def Mesh \"D\" { } }\n}\nover \"B\" { }",
      "a.usda");
  const UsdSpec& root = read_layer->root;
  ASSERT_EQ(root.children.size(), 2u);
  EXPECT_EQ(root.field("upAxis")->value, "\"Z\"");
  const UsdSpec& a = root.children[0];
  EXPECT_EQ(a.specifier, "def");
  EXPECT_EQ(a.type, "");
  EXPECT_EQ(a.field("references")->edit, "prepend");
  EXPECT_EQ(a.field("references")->value, "@./b.usda@</B> (offset = 2)");
  ASSERT_EQ(a.properties.size(), 8u);
  EXPECT_EQ(a.property("x:y")->type, "token[]");
  EXPECT_TRUE(a.property("x:y")->uniform);
  EXPECT_EQ(a.property("a")->value, "");
  EXPECT_EQ(a.property("b", "timeSamples")->value, "{ 0: 1, 1: 2, }");
  EXPECT_EQ(a.property("c", "connect")->value, "</A.b>");
  EXPECT_EQ(a.property("n")->edit, "delete");
  EXPECT_EQ(a.property("f")->value, "@@@a@b.png@@@");
  ASSERT_EQ(a.variants.size(), 2u);
  EXPECT_EQ(a.variants[1].set, "v");
  EXPECT_EQ(a.variants[0].children[0].property("i")->value, "3");
  EXPECT_EQ(a.children[0].children[0].name, "D");
  EXPECT_EQ(find_usd_spec(root, "/A/C/D"), &a.children[0].children[0]);
  EXPECT_EQ(find_usd_spec(root, "/A/D"), nullptr);
  const auto references = usd_references(a.field("references")->value);
  ASSERT_EQ(references.size(), 1u);
  EXPECT_EQ(references[0].file, "./b.usda");
  EXPECT_EQ(references[0].path, "/B");
  EXPECT_TRUE(references[0].moved_in_time);
}

TEST(Usd, WhatIsNoLayerIsToldWithItsLine) {
  const auto refused = [](const std::string& text, std::initializer_list<std::string_view> words) {
    SCOPED_TRACE(text);
    expect_error<FormatError>([&] { (void)parse_usd(text, "a.usda"); }, words);
  };
  refused("PXR-USDC\x01\x02", {"a.usda", "binary", "usdcat"});
  refused("#sdf", {"a.usda:1: ", "#usda"});
  refused(usd_layer("def Mesh {\n}"), {"a.usda:2: ", "name of a prim"});
  refused(usd_layer("def Mesh \"a\"\n{\n  int[] x = [1, 2\n}"), {"a.usda:4: ", "no end"});
  refused(usd_layer("def Mesh \"a\"\n{\n  int[] = 3\n}"), {"a.usda:4: ", "name of a property"});
  refused(usd_layer("def Mesh \"a\"\n{\n"), {"a.usda:3: ", "not closed"});
  refused(usd_layer("}\n"), {"a.usda:2: ", "without"});
  refused(usd_layer("def Mesh \"a\" (\n  x = \n)\n{}"), {"a.usda:4: ", "value of metadata"});
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "def \"a\"{";
  refused(usd_layer(deep), {"a.usda:2: ", "500"});
  refused(usd_layer("def Mesh \"a\" { point3f[] points = [(0, 0, 0), (1, 0, zero)] }"), {"a.usda:2: ", "'zero'"});
  refused(usd_layer("def Mesh \"a\" { point3f[] points = [(0, 0, 0),\n (1, 0)] }"), {"a.usda:3: ", "2 numbers", "3"});
  refused(usd_layer("def Mesh \"a\" { point3f[] points = [0, 1, 2] }"), {"a.usda:2: ", "parentheses"});
}

TEST(Usd, FacesAndTagsThatDoNotFitAreToldWithTheirPrim) {
  const auto refused = [](const std::string& contents, std::initializer_list<std::string_view> words) {
    SCOPED_TRACE(contents);
    try {
      (void)read(contents);
      ADD_FAILURE() << "it is read";
    } catch (const Error& error) {
      EXPECT_TRUE(error.code() == ErrorCode::invalid_mesh || error.code() == ErrorCode::format_error);
      for (const std::string_view word : words)
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  refused("def Xform \"a\" { }", {"scene.usda: no Mesh prim"});
  refused(
      square_prim("a", "int[] creaseIndices = [0, 1, 9]\nint[] creaseLengths = [3]\nfloat[] creaseSharpnesses = [1]"),
      {"scene.usda:7: ", "creaseIndices", "9"});
  refused(square_prim("a", "int[] creaseIndices = [0, 1]\nint[] creaseLengths = [3]\nfloat[] creaseSharpnesses = [1]"),
          {"/a: ", "creaseLengths", "add up to 3", "2 vertices"});
  refused(square_prim(
              "a", "int[] creaseIndices = [0, 1, 2]\nint[] creaseLengths = [3]\nfloat[] creaseSharpnesses = [1, 2, 3]"),
          {"creaseSharpnesses", "has 3", "1, one for each chain", "2, one for each edge"});
  refused(square_prim("a", "int[] cornerIndices = [0]\nfloat[] cornerSharpnesses = [-1]"), {"cornerSharpnesses", "-1"});
  refused(square_prim("a", "int[] holeIndices = [2]"), {"holeIndices", "from 0 to 1"});
  refused(square_prim("a", "token interpolateBoundary = \"edges\""), {"interpolateBoundary", "'edges'", "edgeOnly"});
  refused(
      "def Mesh \"a\" { point3f[] points = [(0, 0, inf)] int[] faceVertexCounts = [] int[] faceVertexIndices = [] }",
      {"point 0", "finite"});
  refused(
      "def Mesh \"a\" { point3f[] points = [(0, 0, 0)] int[] faceVertexCounts = [2] int[] faceVertexIndices = [0, 0] }",
      {"faceVertexCounts", "3 corners"});
  refused(
      "def Mesh \"a\" { point3f[] points = [(0, 0, 0)] int[] faceVertexCounts = [3] int[] faceVertexIndices = [0] }",
      {"faceVertexCounts", "add up to 3", "1 vertices"});
}

TEST(Usd, SubdivisionAttributesAreRead) {
  const Mesh mesh =
      read(square_prim("a",
                       "uniform token subdivisionScheme = \"loop\"\ntoken interpolateBoundary = \"edgeOnly\"\n"
                       "token triangleSubdivisionRule = \"smooth\"\n"
                       "token faceVaryingLinearInterpolation = \"cornersPlus2\"\n"
                       "int[] creaseIndices = [0, 1, 2, 0, 2]\nint[] creaseLengths = [3, 2]\n"
                       "float[] creaseSharpnesses = [2.5, 1e39]\n"
                       "int[] cornerIndices = [3]\nfloat[] cornerSharpnesses = [4]\nint[] holeIndices = [1]"));
  EXPECT_EQ(mesh.scheme, "loop");
  EXPECT_EQ(mesh.boundary, Boundary::edge_only);
  EXPECT_EQ(mesh.triangles, Triangles::smooth);
  EXPECT_EQ(mesh.face_varying_interpolation, FaceVaryingInterpolation::corners_plus2);
  ASSERT_EQ(mesh.creases.size(), 3u);
  EXPECT_EQ(mesh.creases[1].tail, 1);
  EXPECT_EQ(mesh.creases[1].head, 2);
  EXPECT_EQ(mesh.creases[1].sharpness, 2.5F);
  EXPECT_EQ(mesh.creases[2].sharpness, std::numeric_limits<float>::infinity());
  ASSERT_EQ(mesh.corners.size(), 1u);
  EXPECT_EQ(mesh.corners[0].sharpness, 4);
  EXPECT_EQ(mesh.holes, Ids{1});
  EXPECT_EQ(mesh.objects.names, Names{"a"});
  // What USD takes where nothing is said.
  const Mesh plain = read(square_prim("a"));
  EXPECT_EQ(plain.scheme, "catmull-clark");
  EXPECT_EQ(plain.face_varying_interpolation, FaceVaryingInterpolation::corners_plus1);
  EXPECT_EQ(read(square_prim("a", "uniform token subdivisionScheme = \"none\"")).scheme, "");
}

TEST(Usd, SharpnessesOfEdgesAreInTheOrderOfTheChains) {
  const Mesh mesh = read(square_prim("a",
                                     "int[] creaseIndices = [0, 1, 2, 2, 3]\nint[] creaseLengths = [3, 2]\n"
                                     "float[] creaseSharpnesses = [1, 2, 3]"));
  ASSERT_EQ(mesh.creases.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(mesh.creases[i].sharpness, float(i + 1));
}

TEST(Usd, TransformsAreThoseOfTheirMatrices) {
  const auto first_columns = [](const std::string& ops) {  // of the images of (1, 0, 0), (1, 1, 0) and (0, 0, 0)
    return read("def Xform \"w\" {\n" + ops + "\n" + square_prim("a") + "}").positions;
  };
  const Points turned = first_columns(
      "double3 xformOp:translate = (1, 2, 3)\nfloat3 xformOp:rotateXYZ = (90, 0, 90)\nfloat3 xformOp:scale = (2, 3, 4)\n"
      "uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:rotateXYZ\", \"xformOp:scale\"]");
  // Scale, then x by 90 degrees, then z by 90 degrees, then the shift.
  EXPECT_EQ(Eigen::RowVector3d(turned.row(1)), Eigen::RowVector3d(1, 4, 3));
  EXPECT_EQ(Eigen::RowVector3d(turned.row(3)), Eigen::RowVector3d(1, 2, 6));
  const Points by_matrix = first_columns(
      "matrix4d xformOp:transform = ((0, 2, 0, 0), (0, 0, 3, 0), (4, 0, 0, 0), (1, 2, 3, 1))\n"
      "uniform token[] xformOpOrder = [\"xformOp:transform\"]");
  EXPECT_EQ(by_matrix, turned);
  const Points by_quaternion =
      first_columns("quatf xformOp:orient = (0.5, 0.5, 0.5, 0.5)\nuniform token[] xformOpOrder = [\"xformOp:orient\"]");
  EXPECT_EQ(Eigen::RowVector3d(by_quaternion.row(1)), Eigen::RowVector3d(0, 1, 0));
  const Points pivoted = first_columns(
      "float3 xformOp:translate:pivot = (1, 1, 0)\nfloat xformOp:rotateZ = 180\n"
      "uniform token[] xformOpOrder = [\"xformOp:translate:pivot\", \"xformOp:rotateZ\", "
      "\"!invert!xformOp:translate:pivot\"]");
  EXPECT_EQ(Eigen::RowVector3d(pivoted.row(0)), Eigen::RowVector3d(2, 2, 0));
  EXPECT_EQ(Eigen::RowVector3d(pivoted.row(2)), Eigen::RowVector3d(1, 1, 0));
  const Points reset = read(
                           "def Xform \"w\" {\ndouble3 xformOp:translate = (9, 9, 9)\n"
                           "uniform token[] xformOpOrder = [\"xformOp:translate\"]\n" +
                           square_prim("a", "uniform token[] xformOpOrder = [\"!resetXformStack!\"]") + "}")
                           .positions;
  EXPECT_EQ(reset, read(square_prim("a")).positions);
}

// The signed volume tells the side of faces, whatever turns them.
TEST(Usd, FacesAreCounterClockwiseSeenFromOutside) {
  const Mesh box = cube();
  const auto volume = [](const Mesh& mesh) {
    double six = 0;
    std::size_t first = 0;
    for (const Index size : mesh.face_sizes) {
      const auto at = [&](Index k) {
        return Eigen::Vector3d(mesh.positions.row(mesh.face_vertices[first + std::size_t(k)]));
      };
      for (Index k = 1; k + 1 < size; ++k) six += at(0).dot(at(k).cross(at(k + 1)));
      first += std::size_t(size);
    }
    return six / 6;
  };
  const std::string text = format_usda(box);
  EXPECT_EQ(volume(parse_usd(text, "a")), volume(box));
  std::string left = text;
  left.replace(left.find("rightHanded"), 11, "leftHanded");
  EXPECT_EQ(volume(parse_usd(left, "a")), -volume(box));
  std::string mirrored = text;
  mirrored.insert(mirrored.find("    point3f[]"),
                  "    float3 xformOp:scale = (-1, 1, 1)\n    uniform token[] xformOpOrder = [\"xformOp:scale\"]\n");
  EXPECT_EQ(volume(parse_usd(mirrored, "a")), volume(box));
}

TEST(Usd, PrimvarsAndSubsetsAreKept) {
  const Mesh mesh = read(
      square_prim(
          "a",
          "color3f[] primvars:displayColor = [(0, 0.5, 1)] ( interpolation = \"constant\" )\n"
          "float[] primvars:weight = [1, 2] ( interpolation = \"vertex\" )\n"
          "int[] primvars:weight:indices = [0, 1, 1, 0]\n"
          "float3[] primvars:flow = [(1, 2, 3), (4, 5, 6), (7, 8, 9), (0, 0, 0)] ( interpolation = \"vertex\" )\n"
          "int[] primvars:id = [7, 8] ( interpolation = \"uniform\" )\n"
          "texCoord2f[] primvars:st = [(0, 0), (1, 1)] ( interpolation = \"faceVarying\" )\n"
          "int[] primvars:st:indices = [0, 1, 0, 1, 0, 1]\n"
          "float[] primvars:short = [1, 2, 3] ( interpolation = \"vertex\" )\n"
          "string primvars:name = \"x\"\nrel material:binding = </Looks/all>\n"
          "def GeomSubset \"s\" { uniform token elementType = \"face\" uniform token familyName = \"materialBind\" "
          "int[] indices = [1] rel material:binding = </Looks/red> }\n"
          "def GeomSubset \"g\" ( displayName = \"the group\" ) { int[] indices = [0] }") +
      "def Scope \"Looks\" { def Material \"all\" { } def Material \"red\" ( displayName = \"Red paint\" ) { } }");
  ASSERT_EQ(mesh.vertex_values.size(), 4u);
  EXPECT_EQ(mesh.vertex_values[0].name, "weight");
  EXPECT_EQ(mesh.vertex_values[0].values, (std::vector<double>{1, 2, 2, 1}));
  EXPECT_EQ(mesh.vertex_values[2].name, "flow_1");
  EXPECT_EQ(mesh.vertex_values[2].values, (std::vector<double>{2, 5, 8, 0}));
  ASSERT_EQ(mesh.face_values.size(), 4u);
  EXPECT_EQ(mesh.face_values[1].name, "green");
  EXPECT_EQ(mesh.face_values[1].values, (std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(mesh.face_values[3].name, "id");
  EXPECT_EQ(mesh.face_values[3].type, ValueType::int32);
  ASSERT_EQ(mesh.face_varying.size(), 1u);
  EXPECT_EQ(mesh.face_varying[0].indices, (Ids{0, 1, 0, 1, 0, 1}));
  EXPECT_EQ(mesh.materials.names, (Names{"all", "Red paint"}));
  EXPECT_EQ(mesh.materials.of_face, (Ids{0, 1}));
  EXPECT_EQ(mesh.groups.names, Names{"the group"});
  EXPECT_EQ(mesh.groups.of_face, (Ids{0, -1}));
  ASSERT_EQ(mesh.warnings.size(), 1u);
  EXPECT_NE(mesh.warnings[0].find("primvars:short is left out: it has 3 values; as vertex it should have 4"),
            std::string::npos);
  ASSERT_EQ(mesh.notes.size(), 1u);
  EXPECT_NE(mesh.notes[0].find("primvars:name"), std::string::npos);
  EXPECT_FALSE(mesh.attributes);
  EXPECT_EQ(read(square_prim("a", "float[] primvars:w = [1, 2, 3, 4] ( interpolation = \"varying\" )")).attributes,
            Attributes::linear);
}

TEST(Usd, LayersAreComposedByTheirStrength) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "parts");
  directory.write(
      "parts/asset.usda",
      usd_layer("( defaultPrim = \"Asset\" )\ndef Xform \"Asset\" {\n" +
                square_prim("body",
                            "token interpolateBoundary = \"edgeOnly\"\nuniform token subdivisionScheme = \"loop\"\n"
                            "rel material:binding = </Asset/Looks/paint>") +
                "def Scope \"Looks\" { def Material \"paint\" { } } }"));
  directory.write("weak.usda",
                  usd_layer("over \"World\" { over \"car\" { over \"body\" {\n"
                            "uniform token subdivisionScheme = \"bilinear\"\nint[] holeIndices = [0] } } }"));
  directory.write(
      "scene.usda",
      usd_layer("( subLayers = [@./weak.usda@] )\nclass \"_shared\" { token interpolateBoundary = \"none\" }\n"
                "def Xform \"World\" {\n  def \"car\" ( references = @parts/asset.usda@ ) {\n"
                "    over \"body\" ( inherits = </_shared>; variants = { string holes = \"two\" } ) {\n"
                "      variantSet \"holes\" = { \"one\" { int[] cornerIndices = [0] float[] cornerSharpnesses = [1] }\n"
                "        \"two\" { int[] cornerIndices = [1] float[] cornerSharpnesses = [2] } }\n    }\n  }\n}\n"));
  const Mesh mesh = read_mesh(directory / "scene.usda");
  EXPECT_EQ(mesh.objects.names, Names{"World/car/body"});
  EXPECT_EQ(mesh.scheme, "bilinear");        // the sublayer is stronger than the reference
  EXPECT_EQ(mesh.boundary, Boundary::none);  // and so is what is inherited
  EXPECT_EQ(mesh.holes, Ids{0});
  ASSERT_EQ(mesh.corners.size(), 1u);
  EXPECT_EQ(mesh.corners[0].vertex, 1);             // by the variant that is selected
  EXPECT_EQ(mesh.materials.names, Names{"paint"});  // a path of the asset is one of the scene
  EXPECT_EQ(mesh.warnings, Names{});

  directory.write("missing.usda",
                  usd_layer(square_prim("a") + "def \"b\" ( references = [@none.usda@, </nowhere>] ) { }"));
  const Mesh rest = read_mesh(directory / "missing.usda");
  ASSERT_EQ(rest.warnings.size(), 2u);
  EXPECT_NE(rest.warnings[0].find("missing.usda:9: 'none.usda' is not there"), std::string::npos) << rest.warnings[0];
  EXPECT_NE(rest.warnings[1].find("/nowhere"), std::string::npos);
}

// What exporters write around a mesh, by the facts of their files: Blender's, and the layers of Pixar's Kitchen Set, in
// which an asset is a reference to a payload with a class, a variant of its model and a mesh of Catmull-Clark.
TEST(Usd, ScenesAreReadAsProgramsExportThem) {
  const Mesh blender = parse_usd(
      "#usda 1.0\n(\n    defaultPrim = \"root\"\n    doc = \"Blender v4.1.0\"\n    metersPerUnit = 1\n    upAxis = \"Z\"\n)\n\n"
      "def Xform \"root\" (\n    customData = {\n        dictionary Blender = {\n            bool generated = 1\n        }\n    }\n)\n{\n"
      "    def Xform \"Plane\"\n    {\n        custom string userProperties:blender:object_name = \"Plane\"\n"
      "        float3 xformOp:rotateXYZ = (90, -0, 0)\n        float3 xformOp:scale = (2, 2, 2)\n"
      "        double3 xformOp:translate = (0, 0, 5)\n"
      "        uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:rotateXYZ\", \"xformOp:scale\"]\n\n"
      "        def Mesh \"Plane\" (\n            active = true\n            prepend apiSchemas = [\"MaterialBindingAPI\"]\n        )\n        {\n"
      "            uniform bool doubleSided = 1\n            float3[] extent = [(-1, -1, 0), (1, 1, 0)]\n"
      "            int[] faceVertexCounts = [4]\n            int[] faceVertexIndices = [0, 1, 3, 2]\n"
      "            rel material:binding = </root/_materials/Material_001>\n"
      "            normal3f[] normals = [(0, 0, 1), (0, 0, 1), (0, 0, 1), (0, 0, 1)] (\n                interpolation = \"faceVarying\"\n            )\n"
      "            point3f[] points = [(-1, -1, 0), (1, -1, 0), (-1, 1, 0), (1, 1, 0)]\n"
      "            bool[] primvars:sharp_face = [1] (\n                interpolation = \"uniform\"\n            )\n"
      "            texCoord2f[] primvars:UVMap = [(0, 0), (1, 0), (1, 1), (0, 1)] (\n                interpolation = \"faceVarying\"\n            )\n"
      "            uniform token subdivisionScheme = \"none\"\n            custom string userProperties:blender:data_name = \"Plane\"\n"
      "        }\n    }\n\n    def Scope \"_materials\"\n    {\n        def Material \"Material_001\"\n        {\n"
      "            token outputs:surface.connect = </root/_materials/Material_001/Principled_BSDF.outputs:surface>\n\n"
      "            def Shader \"Principled_BSDF\"\n            {\n                uniform token info:id = \"UsdPreviewSurface\"\n"
      "                color3f inputs:diffuseColor = (0.8, 0.1, 0.1)\n                token outputs:surface\n            }\n        }\n    }\n\n"
      "    def DomeLight \"env_light\"\n    {\n        float inputs:intensity = 1\n        asset inputs:texture:file = @./textures/color_0C0C0C.exr@\n    }\n}\n",
      "plane.usda");
  EXPECT_EQ(blender.objects.names, Names{"root/Plane/Plane"});
  EXPECT_EQ(blender.materials.names, Names{"Material_001"});
  EXPECT_EQ(blender.warnings, Names{});
  EXPECT_EQ(blender.scheme, "");
  ASSERT_EQ(blender.face_varying.size(), 1u);
  EXPECT_EQ(blender.face_varying[0].name, "UVMap");
  EXPECT_EQ(Eigen::RowVector3d(blender.positions.row(2)), Eigen::RowVector3d(-2, 0, 7));

  const TemporaryDirectory directory;
  std::filesystem::create_directories(directory / "assets/Cup");
  directory.write(
      "Kitchen.usda",
      usd_layer(
          "(\n    defaultPrim = \"Kitchen\"\n)\n\ndef Xform \"Kitchen\" (\n    kind = \"assembly\"\n)\n{\n"
          "    def Xform \"Props\" (\n        kind = \"group\"\n    )\n    {\n"
          "        def \"Cup_1\" (\n            add references = @./assets/Cup/Cup.usda@\n            variants = {\n"
          "                string modelingVariant = \"Tall\"\n            }\n        )\n        {\n"
          "            double3 xformOp:translate = (10, 0, 0)\n"
          "            uniform token[] xformOpOrder = [\"xformOp:translate\"]\n        }\n"
          "        def \"Cup_2\" (\n            add references = @./assets/Cup/Cup.usda@\n        )\n        {\n        }\n    }\n}\n"));
  directory.write(
      "assets/Cup/Cup.usda",
      usd_layer(
          "(\n    defaultPrim = \"Cup\"\n)\n\nclass \"_class_Cup\"\n{\n}\n\ndef Xform \"Cup\" (\n"
          "    add inherits = </_class_Cup>\n    kind = \"component\"\n    payload = @./Cup_payload.usda@</Cup>\n"
          "    variants = {\n        string modelingVariant = \"Short\"\n    }\n    add variantSets = \"modelingVariant\"\n)\n{\n"
          "    variantSet \"modelingVariant\" = {\n        \"Short\" {\n        }\n        \"Tall\" {\n            over \"Geom\"\n            {\n"
          "                float3 xformOp:scale = (1, 1, 3)\n"
          "                uniform token[] xformOpOrder = [\"xformOp:scale\"]\n            }\n        }\n    }\n}\n"));
  directory.write(
      "assets/Cup/Cup_payload.usda",
      usd_layer("def Xform \"Cup\"\n{\n    def Xform \"Geom\"\n    {\n        def Mesh \"cup\"\n        {\n"
                "            int[] faceVertexCounts = [4]\n            int[] faceVertexIndices = [0, 1, 2, 3]\n"
                "            point3f[] points = [(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]\n"
                "            color3f[] primvars:displayColor = [(0.5, 0.25, 1)]\n        }\n    }\n}\n"));
  const Mesh kitchen = read_mesh(directory / "Kitchen.usda");
  EXPECT_EQ(kitchen.warnings, Names{});
  EXPECT_EQ(kitchen.scheme, "catmull-clark");
  EXPECT_EQ(kitchen.objects.names, (Names{"Kitchen/Props/Cup_1/Geom/cup", "Kitchen/Props/Cup_2/Geom/cup"}));
  EXPECT_EQ(Eigen::RowVector3d(kitchen.positions.row(1)), Eigen::RowVector3d(11, 0, 3));  // the tall one
  EXPECT_EQ(Eigen::RowVector3d(kitchen.positions.row(5)), Eigen::RowVector3d(1, 0, 1));
  EXPECT_EQ(kitchen.face_values[1].values, (std::vector<double>{0.25, 0.25}));
}

TEST(Usd, CirclesOfReferencesEnd) {
  const TemporaryDirectory directory;
  const auto refused = [&](const std::string& text, const std::string& word) {
    directory.write("a.usda", usd_layer(text));
    expect_error<FormatError>([&] { (void)read_mesh(directory / "a.usda"); }, {"a.usda", word});
  };
  refused("def \"a\" ( references = </b> ) { } def \"b\" ( references = </a> ) { }", "refers to itself");
  refused("def \"a\" ( references = @a.usda@</a> ) { }", "refers to itself");
  refused("( subLayers = [@a.usda@] )\n" + square_prim("a"), "sublayer of itself");
  refused("def \"a\" { def \"b\" ( references = </a> ) { } }", "500");
  std::string doubled;
  for (int i = 0; i < 60; ++i)
    doubled += "def \"p" + std::to_string(i) + "\" ( references = [</p" + std::to_string(i + 1) + ">, </p" +
               std::to_string(i + 1) + "x>] ) { } def \"p" + std::to_string(i) + "x\" ( references = </p" +
               std::to_string(i) + "> ) { }\n";
  directory.write("a.usda", usd_layer(doubled + "def \"p60\" { } def \"p60x\" { }"));
  expect_error<ResourceError>([&] { (void)read_mesh(directory / "a.usda"); }, {"a.usda", "references"});
}

TEST(Usd, PrimsThatAreNotSeenAreLeftOutAndTold) {
  const Mesh mesh =
      read(square_prim("a") + "def Xform \"x\" { token visibility = \"invisible\"\n" + square_prim("b") + "}\n" +
           "def Xform \"y\" { uniform token purpose = \"guide\"\n" + square_prim("c") + "}\nover \"o\" {\n" +
           square_prim("d") + "}\nclass \"k\" {\n" + square_prim("e") + "}\ndef \"z\" (active = false) {\n" +
           square_prim("f") + "}\ndef PointInstancer \"i\" {\n" + square_prim("g") + "}\ndef Sphere \"s\" { }\n");
  EXPECT_EQ(mesh.objects.names, Names{"a"});
  ASSERT_EQ(mesh.warnings.size(), 4u);
  for (const std::size_t i : {0u, 1u, 2u, 3u})
    EXPECT_NE(mesh.warnings[i].find(std::vector<std::string>{"/x: ", "/y: ", "/i: ", "/s: "}[i]), std::string::npos);
}

TEST(Usd, MeshesOfASceneAreOneMesh) {
  const Mesh mesh =
      read(square_prim("a",
                       "color3f[] primvars:displayColor = [(0, 0, 0), (0.5, 0.5, 0.5)] (interpolation = "
                       "\"uniform\")\nint[] cornerIndices = [1]\nfloat[] cornerSharpnesses = [3]") +
           square_prim("b",
                       "texCoord2f[] primvars:st = [(0, 1)] (interpolation = \"faceVarying\")\n"
                       "int[] primvars:st:indices = [0, 0, 0, 0, 0, 0]\n"
                       "int[] creaseIndices = [0, 1]\nint[] creaseLengths = [2]\nfloat[] creaseSharpnesses = [2]"));
  EXPECT_EQ(mesh.num_vertices(), 8);
  EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7}));
  EXPECT_EQ(mesh.objects.of_face, (Ids{0, 0, 1, 1}));
  ASSERT_EQ(mesh.creases.size(), 1u);
  EXPECT_EQ(mesh.creases[0].head, 5);
  EXPECT_EQ(mesh.corners[0].vertex, 1);
  EXPECT_EQ(mesh.face_values[0].values, (std::vector<double>{0, 0.5, 1, 1}));
  ASSERT_EQ(mesh.face_varying.size(), 1u);
  EXPECT_EQ(mesh.face_varying[0].indices.size(), 12u);
  EXPECT_EQ(Eigen::RowVector2d(mesh.face_varying[0].values.row(mesh.face_varying[0].indices[0])),
            Eigen::RowVector2d(0, 0));
  EXPECT_EQ(Eigen::RowVector2d(mesh.face_varying[0].values.row(mesh.face_varying[0].indices[6])),
            Eigen::RowVector2d(0, 1));
  EXPECT_EQ(mesh.notes.size(), 4u);  // red, green, blue and st are not those of all
  expect_error<InvalidMesh>(
      [] { (void)read(square_prim("a") + square_prim("b", "token interpolateBoundary = \"none\"")); },
      {"scene.usda:9: /b: interpolateBoundary", "/a", "flatten"});
}

TEST(Usd, PackagesHoldStoredFilesAtMultiplesOf64) {
  const TemporaryDirectory directory;
  Mesh mesh = cube();
  write_mesh(directory / "a.usdz", mesh);
  const std::string bytes = read_file(directory / "a.usdz");
  EXPECT_EQ(bytes.find("#usda") % 64, 0u);
  EXPECT_EQ(read_mesh(directory / "a.usdz").positions, mesh.positions);
  const std::string text(129, 'x');
  const std::string package = format_usdz({{"scene.usda", "#usda 1.0\n"}, {"a/b.png", text}, {"c", ""}}, "p");
  const auto files = usdz_files(package, "p");
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files[1].name, "a/b.png");
  EXPECT_EQ(files[1].bytes, text);
  EXPECT_EQ((files[1].bytes.data() - package.data()) % 64, 0);
  // A file that ends early is told wherever it does, and so is a byte that is another one.
  std::size_t told = 0;
  for (std::size_t end = 0; end < bytes.size(); end += 7) {
    try {
      (void)parse_usd(bytes.substr(0, end), "p");
    } catch (const Error&) {
      ++told;
    }
  }
  EXPECT_EQ(told, (bytes.size() + 6) / 7);
  std::string other = bytes;
  other[bytes.find("point3f") + 30] ^= 1;
  expect_error<FormatError>([&] { (void)parse_usd(other, "p"); }, {"checksum"});
  std::string out_of_it = format_usdz({{"../../etc/passwd", ""}}, "p");
  expect_error<FormatError>([&] { (void)usdz_files(out_of_it, "p"); }, {"passwd", "out of the package"});
  std::string compressed = bytes;
  for (std::size_t at = compressed.rfind("PK\x01\x02"); at != std::string::npos; at = std::string::npos)
    compressed[at + 10] = 8;
  expect_error<FormatError>([&] { (void)parse_usd(compressed, "p"); }, {"is compressed"});
}

TEST(Usd, ReferencesInAPackageAreRead) {
  const std::string scene = usd_layer("def \"a\" ( references = @parts/b.usda@ ) { }"),
                    part = usd_layer("( defaultPrim = \"q\" )\n" + square_prim("q", "int[] holeIndices = [1]"));
  const Mesh mesh = parse_usd(format_usdz({{"scene.usda", scene}, {"parts/b.usda", part}}, "p"), "p.usdz");
  EXPECT_EQ(mesh.holes, Ids{1});
  EXPECT_EQ(mesh.objects.names, Names{"a"});
  const Mesh without = parse_usd(format_usdz({{"scene.usda", scene + square_prim("m")}}, "p"), "p.usdz");
  ASSERT_EQ(without.warnings.size(), 1u);
  EXPECT_NE(without.warnings[0].find("p.usdz[scene.usda]:2: 'parts/b.usda' is not in the package"), std::string::npos)
      << without.warnings[0];
}

// All that a mesh has comes back, to the same bits.
TEST(Usd, WhatIsWrittenIsRead) {
  Mesh mesh = cube();
  mesh.positions *= 1.0 / 3;
  mesh.scheme = "catmull-clark";
  mesh.boundary = Boundary::edge_only;
  mesh.creasing = Creasing::chaikin;
  mesh.triangles = Triangles::smooth;
  mesh.face_varying_interpolation = FaceVaryingInterpolation::boundaries;
  mesh.creases = {{0, 1, 2.5F}, {1, 3, 0.1F}};
  mesh.corners = {{7, 10}};
  mesh.holes = {2, 4};
  mesh.knot_intervals = {{0, 1, 1.0 / 7}};
  mesh.face_varying = {{"st", mesh.positions.leftCols(2), mesh.face_vertices}};
  mesh.groups = {{"one two", "3"}, {0, 0, -1, 1, 1, 0}};
  mesh.materials = {{"a/b", "_"}, {1, 0, 0, -1, 1, 1}};
  mesh.smoothing_groups = {{"1"}, {-1, 0, 0, 0, 0, 0}};
  mesh.vertex_values = {{"heat_0", std::vector<double>(8, 1.0 / 3), ValueType::float64},
                        {"heat_1", std::vector<double>(8, 2.0 / 3), ValueType::float64},
                        {"age", std::vector<double>(8, -5), ValueType::int32}};
  mesh.face_values = {{"red", {0, 0.25, 0.5, 0.75, 1, 0}, ValueType::float32},
                      {"green", {0, 0.25, 0.5, 0.75, 1, 0}, ValueType::float32},
                      {"blue", {0, 0.25, 0.5, 0.75, 1, 0}, ValueType::float32},
                      {"alpha", {1, 1, 1, 1, 1, 0.5}, ValueType::float32}};
  mesh.attributes = Attributes::linear;
  for (const bool object : {false, true}) {
    if (object) mesh.objects = {{"World/a \"cage\"", "b c"}, {0, 0, 0, 0, 0, object ? 0 : 1}};
    const Mesh back = parse_usd(format_usda(mesh), "a.usda");
    EXPECT_EQ(back.warnings, Names{});
    EXPECT_EQ(back.positions, mesh.positions);
    EXPECT_EQ(back.face_sizes, mesh.face_sizes);
    EXPECT_EQ(back.face_vertices, mesh.face_vertices);
    EXPECT_EQ(back.scheme, mesh.scheme);
    EXPECT_EQ(back.boundary, mesh.boundary);
    EXPECT_EQ(back.creasing, mesh.creasing);
    EXPECT_EQ(back.triangles, mesh.triangles);
    EXPECT_EQ(back.face_varying_interpolation, mesh.face_varying_interpolation);
    ASSERT_EQ(back.creases.size(), 2u);
    EXPECT_EQ(back.creases[1].sharpness, 0.1F);
    EXPECT_EQ(back.corners[0].vertex, 7);
    EXPECT_EQ(back.holes, mesh.holes);
    EXPECT_EQ(back.knot_intervals[0].length, 1.0 / 7);
    EXPECT_EQ(back.face_varying[0].name, "st");
    EXPECT_EQ(back.face_varying[0].values, mesh.face_varying[0].values);
    EXPECT_EQ(back.face_varying[0].indices, mesh.face_varying[0].indices);
    for (const auto names : {&Mesh::groups, &Mesh::materials, &Mesh::smoothing_groups, &Mesh::objects})
      for (std::size_t f = 0; f < mesh.face_sizes.size(); ++f) {
        const auto name = [&](const Mesh& of) {
          const Mesh::FaceNames& list = of.*names;
          const Index number = list.of_face.empty() ? -1 : list.of_face[f];
          return number < 0 ? std::string() : list.names[std::size_t(number)];
        };
        EXPECT_EQ(name(back), name(mesh)) << f;
      }
    ASSERT_EQ(back.vertex_values.size(), mesh.vertex_values.size());
    for (std::size_t i = 0; i < mesh.vertex_values.size(); ++i) {
      EXPECT_EQ(back.vertex_values[i].name, mesh.vertex_values[i].name);
      EXPECT_EQ(back.vertex_values[i].values, mesh.vertex_values[i].values);
      EXPECT_EQ(back.vertex_values[i].type, mesh.vertex_values[i].type);
    }
    ASSERT_EQ(back.face_values.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(back.face_values[i].name, mesh.face_values[i].name);
      EXPECT_EQ(back.face_values[i].values, mesh.face_values[i].values);
    }
    EXPECT_EQ(back.attributes, mesh.attributes);
    // Twice is as once.
    EXPECT_EQ(format_usda(back), format_usda(parse_usd(format_usda(back), "a.usda")));
  }
}

// Objects that are apart are prims of their own; those that share vertices are one mesh, or it would break.
TEST(Usd, ObjectsArePrimsWhereTheyShareNoVertex) {
  Mesh two = read(square_prim("a") + square_prim("b"));
  const std::string apart = format_usda(two);
  EXPECT_NE(apart.find("def Mesh \"a\""), std::string::npos);
  EXPECT_NE(apart.find("def Mesh \"b\""), std::string::npos);
  EXPECT_EQ(parse_usd(apart, "a").positions, two.positions);
  Mesh one = cube();
  one.objects = {{"left", "right"}, {0, 0, 0, 1, 1, 1}};
  const std::string joined = format_usda(one);
  EXPECT_NE(joined.find("def Mesh \"mesh\""), std::string::npos);
  const Mesh back = parse_usd(joined, "a");
  EXPECT_EQ(back.num_vertices(), 8);
  EXPECT_EQ(back.objects.names, one.objects.names);
  EXPECT_EQ(back.objects.of_face, one.objects.of_face);
}

TEST(Usd, SamplesInTimeAreFrames) {
  const std::string text = usd_layer(
      "def Mesh \"a\" {\n point3f[] points.timeSamples = { 2: [(0, 0, 2), (1, 0, 2), (0, 1, 2)],\n"
      " -1: [(0, 0, -1), (1, 0, -1), (0, 1, -1)] }\n int[] faceVertexCounts = [3]\n int[] faceVertexIndices = [0, 1, 2] }");
  UsdStage stage(text, "a.usda");
  Names warnings;
  const auto meshes = usd_meshes(stage, warnings);
  ASSERT_EQ(meshes.size(), 1u);
  EXPECT_EQ(meshes[0].times, (std::vector<double>{-1, 2}));
  EXPECT_EQ(meshes[0].mesh.positions(0, 2), -1);
  EXPECT_EQ(usd_points(meshes[0], 1)(0, 2), 2);
  const TemporaryDirectory directory;
  const UsdFrames frames = read_usd_frames(directory.write(
      "a.usda", usd_layer("def Xform \"w\" { double3 xformOp:translate.timeSamples = { 0: (0, 0, 0), 4: (8, 0, 0) }\n"
                          "uniform token[] xformOpOrder = [\"xformOp:translate\"]\n" +
                          text.substr(text.find('\n')) + "}\n" + square_prim("still"))));
  ASSERT_EQ(frames.count, 4);  // -1, 0, 2, 4
  for (std::int64_t k = 0; k < 4; ++k) {
    const Points points = frames.positions(k);
    ASSERT_EQ(points.rows(), 7);
    // Between samples all is linear, before and behind them it stands still.
    EXPECT_EQ(Eigen::RowVector3d(points.row(1)), Eigen::RowVector3d(std::vector<double>{1, 1, 5, 9}[std::size_t(k)], 0,
                                                                    std::vector<double>{-1, 0, 2, 2}[std::size_t(k)]));
    EXPECT_EQ(Eigen::RowVector3d(points.row(5)), Eigen::RowVector3d(1, 1, 0));
  }
  EXPECT_EQ(frames.positions(0), read_mesh(directory / "a.usda").positions);
  const std::string other = usd_layer(
      "def Mesh \"a\" {\n point3f[] points.timeSamples = { 0: [(0, 0, 2), (1, 0, 2), (0, 1, 2)],\n"
      " 1: [(0, 0, -1)] }\n int[] faceVertexCounts = [3]\n int[] faceVertexIndices = [0, 1, 2] }");
  UsdStage changing(other, "a.usda");
  const auto changed = usd_meshes(changing, warnings);
  expect_error<InvalidMesh>([&] { (void)usd_points(changed[0], 1); }, {"a.usda:4: ", "time 1", "1 at", "3"});
}

}  // namespace
}  // namespace sublimit::testing
