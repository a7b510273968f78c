// SPDX-License-Identifier: Apache-2.0
// STEP and BREP files, read by OpenCASCADE.
#include <BRepAdaptor_Surface.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <STEPControl_Reader.hxx>
#include <StepData_StepModel.hxx>
#include <StepShape_AdvancedFace.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <optional>
#include <sstream>
#include <tuple>

#include "meshes/meshes.h"
#include "sublimit/cad/limit_model.h"
#include "sublimit/cad/opencascade/write_cad.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/search/closest_point.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

struct ReadBack {
  TopoDS_Shape shape;
  LimitModel model;
  double size;
};

ReadBack read_back(const Mesh& mesh, const std::string& scheme, bool step) {
  const LimitMap surface(find_scheme(scheme).value(), mesh);
  ReadBack read;
  read.size = testing::diagonal(mesh.positions);
  LimitModelOptions options;
  options.tolerance = 1e-4 * read.size;
  read.model = limit_model(surface, mesh.positions, options);
  const CadFile file = cad_file(read.model.boundary, "m", step);
  EXPECT_TRUE(file.is_valid);
  if (step) {
    const testing::TemporaryDirectory directory;
    STEPControl_Reader reader;
    EXPECT_EQ(reader.ReadFile(directory.write("m.step", file.bytes).c_str()), IFSelect_RetDone);
    reader.TransferRoots();
    read.shape = reader.OneShape();
  } else {
    std::istringstream in(file.bytes);
    BRep_Builder builder;
    BRepTools::Read(read.shape, in, builder);
  }
  return read;
}

int count(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  int found = 0;
  for (TopExp_Explorer at(shape, kind); at.More(); at.Next()) ++found;
  return found;
}

TEST(ReadBack, ClosedMeshesAreValidSolidsWithEveryEdgeTwice) {
  for (const bool step : {true, false})
    for (const auto& [scheme, mesh] : std::vector<std::pair<std::string, Mesh>>{{"catmull-clark", testing::cube()},
                                                                                {"catmull-clark", testing::torus(8, 6)},
                                                                                {"doo-sabin", testing::cube()},
                                                                                {"loop", testing::icosahedron()},
                                                                                {"bilinear", testing::cube()}}) {
      const ReadBack read = read_back(mesh, scheme, step);
      EXPECT_EQ(count(read.shape, TopAbs_SOLID), 1) << scheme;
      EXPECT_EQ(count(read.shape, TopAbs_FACE), int(read.model.boundary.faces.size())) << scheme;
      EXPECT_TRUE(BRepCheck_Analyzer(read.shape).IsValid()) << scheme;
      TopTools_IndexedDataMapOfShapeListOfShape faces;
      TopExp::MapShapesAndAncestors(read.shape, TopAbs_EDGE, TopAbs_FACE, faces);
      EXPECT_EQ(faces.Extent(), int(read.model.boundary.edges.size())) << scheme;
      for (int e = 1; e <= faces.Extent(); ++e) EXPECT_EQ(faces(e).Extent(), 2) << scheme;
    }
}

TEST(ReadBack, OpenMeshesAreShells) {
  const ReadBack read = read_back(testing::grid(5, 4), "catmull-clark", true);
  EXPECT_EQ(count(read.shape, TopAbs_SOLID), 0);
  EXPECT_EQ(count(read.shape, TopAbs_SHELL), 1);
  EXPECT_TRUE(BRepCheck_Analyzer(read.shape).IsValid());
}

// Both halves of a torus, left and right of a plane with edges of the mesh.
TEST(ReadBack, FacesHaveTheirNames) {
  const Mesh mesh = testing::torus(8, 6);
  LimitModelOptions options;
  options.tolerance = 1e-4 * testing::diagonal(mesh.positions);
  options.face_names.names = {"left 'side'", "right"};
  for (size_t f = 0; f < mesh.face_sizes.size(); ++f) {
    double sum = 0;
    for (size_t i = 0; i < 4; ++i) sum += mesh.positions(mesh.face_vertices[4 * f + i], 1);
    options.face_names.of_face.push_back(sum < 0 ? 0 : 1);
  }
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  const CadFile file = cad_file(limit_model(surface, mesh.positions, options).boundary, "m", true);
  EXPECT_TRUE(file.is_valid);
  EXPECT_EQ(file.solids, 1);
  const testing::TemporaryDirectory directory;
  STEPControl_Reader reader;
  ASSERT_EQ(reader.ReadFile(directory.write("m.step", file.bytes).c_str()), IFSelect_RetDone);
  reader.TransferRoots();
  const Handle(Transfer_TransientProcess) made = reader.WS()->TransferReader()->TransientProcess();
  std::map<std::string, int> found;
  for (int e = 1; e <= reader.StepModel()->NbEntities(); ++e) {
    const Handle(StepShape_AdvancedFace) named = Handle(StepShape_AdvancedFace)::DownCast(reader.StepModel()->Value(e));
    if (named.IsNull()) continue;
    const std::string name = named->Name()->ToCString();
    const BRepAdaptor_Surface face(TopoDS::Face(TransferBRep::ShapeResult(made, named)));
    const gp_Pnt middle = face.Value((face.FirstUParameter() + face.LastUParameter()) / 2,
                                     (face.FirstVParameter() + face.LastVParameter()) / 2);
    EXPECT_EQ(name, middle.Y() < 0 ? "left 'side'" : "right");
    ++found[name];
  }
  EXPECT_EQ(found.size(), 2u);
}

/// Colours of the faces of a file as its readers have them, in sRGB, with the middle of each face.
std::vector<std::pair<gp_Pnt, std::optional<std::array<double, 3>>>> colours_of(const std::string& bytes) {
  const testing::TemporaryDirectory directory;
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("BinXCAF", document);
  STEPCAFControl_Reader reader;
  reader.SetColorMode(true);
  EXPECT_EQ(reader.ReadFile(directory.write("m.step", bytes).c_str()), IFSelect_RetDone);
  EXPECT_TRUE(reader.Transfer(document));
  const Handle(XCAFDoc_ColorTool) colours = XCAFDoc_DocumentTool::ColorTool(document->Main());
  TDF_LabelSequence shapes;
  XCAFDoc_DocumentTool::ShapeTool(document->Main())->GetShapes(shapes);
  std::vector<std::pair<gp_Pnt, std::optional<std::array<double, 3>>>> found;
  for (int i = 1; i <= shapes.Length(); ++i) {
    if (!XCAFDoc_ShapeTool::IsSimpleShape(shapes.Value(i))) continue;  // an assembly of parts
    for (TopExp_Explorer at(XCAFDoc_ShapeTool::GetShape(shapes.Value(i)), TopAbs_FACE); at.More(); at.Next()) {
      const BRepAdaptor_Surface face(TopoDS::Face(at.Current()));
      auto& [middle, colour] = found.emplace_back();
      middle = face.Value((face.FirstUParameter() + face.LastUParameter()) / 2,
                          (face.FirstVParameter() + face.LastVParameter()) / 2);
      Quantity_Color color;
      if (!colours->GetColor(at.Current(), XCAFDoc_ColorSurf, color)) continue;
      std::array<double, 3>& values = colour.emplace();
      color.Values(values[0], values[1], values[2], Quantity_TOC_sRGB);
    }
  }
  document->Close();
  return found;
}

// Halves of a torus, and of two in one mesh: left red and right of a colour that no language has a word for.
TEST(ReadBack, FacesHaveTheirColours) {
  for (const int parts : {1, 2}) {
    SCOPED_TRACE(parts);
    Mesh mesh = testing::torus(8, 6);
    if (parts == 2) {
      Mesh other = mesh;
      other.positions.col(2).array() += 100;
      const Index first = mesh.num_vertices();
      mesh.positions.conservativeResize(2 * first, 3);
      mesh.positions.bottomRows(first) = other.positions;
      mesh.face_sizes.insert(mesh.face_sizes.end(), other.face_sizes.begin(), other.face_sizes.end());
      for (const Index v : other.face_vertices) mesh.face_vertices.push_back(v + first);
    }
    LimitModelOptions options;
    options.tolerance = 1e-4 * testing::diagonal(mesh.positions);
    const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
    const std::string without = cad_file(limit_model(surface, mesh.positions, options).boundary, "m", true).bytes;
    EXPECT_EQ(without.find("COLOUR"), std::string::npos);
    for (const auto& [name, left, right] :
         {std::tuple{"red", 255.0, 51.0}, std::tuple{"green", 0.0, 102.0}, std::tuple{"blue", 0.0, 204.0}}) {
      Mesh::Values& channel = options.face_values.emplace_back();
      channel.name = name;
      channel.type = ValueType::uint8;
      for (size_t f = 0; f < mesh.face_sizes.size(); ++f) {
        double sum = 0;
        for (size_t i = 0; i < 4; ++i) sum += mesh.positions(mesh.face_vertices[4 * f + i], 1);
        channel.values.push_back(sum < 0 ? left : right);
      }
    }
    const CadFile file = cad_file(limit_model(surface, mesh.positions, options).boundary, "m", true);
    EXPECT_TRUE(file.is_valid);
    EXPECT_EQ(file.solids, parts);
    const auto faces = colours_of(file.bytes);
    EXPECT_GE(faces.size(), size_t(2 * parts));
    for (const auto& [middle, colour] : faces) {
      ASSERT_TRUE(colour.has_value());
      const std::array<double, 3> expected =
          middle.Y() < 0 ? std::array{1.0, 0.0, 0.0} : std::array{51 / 255.0, 102 / 255.0, 204 / 255.0};
      // OpenCASCADE's colours are floats.
      for (size_t k = 0; k < 3; ++k) EXPECT_NEAR((*colour)[k], expected[k], testing::float_reference);
    }
  }
  LimitModelOptions options;
  options.tolerance = 1;
  const Mesh mesh = testing::cube();
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  options.face_values = {{"red", {1, 1, 1, 1, 1, 2}}, {"green", {0, 0, 0, 0, 0, 0}}, {"blue", {0, 0, 0, 0, 0, 0}}};
  testing::expect_error<InvalidParameter>([&] { (void)limit_model(surface, mesh.positions, options); },
                                          {"a colour of face 5 is 2; it should be 0 to 1"});
  options.face_values[0].values.resize(5);
  testing::expect_error<InvalidParameter>([&] { (void)limit_model(surface, mesh.positions, options); },
                                          {"5 faces have a colour 'red'; all should have one"});
}

TEST(ReadBack, ExactFacesAreOnTheLimit) {
  for (const auto& [scheme, mesh] :
       std::vector<std::pair<std::string, Mesh>>{{"catmull-clark", testing::jittered(testing::torus(8, 6))},
                                                 {"doo-sabin", testing::jittered(testing::torus(8, 6))},
                                                 {"loop", testing::jittered(testing::triangle_torus(6, 5))}}) {
    const ReadBack read = read_back(mesh, scheme, true);
    EXPECT_EQ(read.model.caps, 0) << scheme;
    std::vector<Eigen::RowVector3d> found;
    for (TopExp_Explorer at(read.shape, TopAbs_FACE); at.More(); at.Next()) {
      const BRepAdaptor_Surface face(TopoDS::Face(at.Current()));
      for (const double s : {0.0, 0.13, 0.5, 0.77, 1.0})
        for (const double t : {0.0, 0.31, 0.6, 1.0}) {
          const gp_Pnt p = face.Value((1 - s) * face.FirstUParameter() + s * face.LastUParameter(),
                                      (1 - t) * face.FirstVParameter() + t * face.LastVParameter());
          found.push_back({p.X(), p.Y(), p.Z()});
        }
    }
    Points points(Index(found.size()), 3);
    for (size_t i = 0; i < found.size(); ++i) points.row(Index(i)) = found[i];
    const LimitMap surface(find_scheme(scheme).value(), mesh);
    EXPECT_LT(closest(surface, mesh.positions, points).distances.maxCoeff(), testing::cad_exact * read.size) << scheme;
  }
}

}  // namespace
}  // namespace sublimit
