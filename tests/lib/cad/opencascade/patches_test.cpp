// SPDX-License-Identifier: Apache-2.0
// Patches as STEP and BREP files, read by OpenCASCADE: each face is a patch.
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom_BSplineSurface.hxx>
#include <STEPControl_Reader.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

#include "meshes/free_form_shapes.h"
#include "meshes/spline_models.h"
#include "sublimit/base/error.h"
#include "sublimit/cad/opencascade/write_cad.h"
#include "sublimit/cad/patch_model.h"
#include "sublimit/patches/constructions/triangle_patch.h"
#include "sublimit/patches/detail/basis_surface.h"
#include "sublimit/patches/detail/cut_patch.h"
#include "sublimit/patches/detail/free_form_patches.h"
#include "support/temporary_directory.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

using testing::cad_exact;
using testing::rounding;

/// What OpenCASCADE's adaptive integral is asked for, of a volume, and what it keeps: 6e-9 on rational spheres and
/// tori, whose exact volumes are known. Its plain rule is 1% off there.
constexpr double asked_volume = 1e-9, read_volume = 1e-8;
/// Terms of an integral of ours: some hundred nodes on some ten faces.
constexpr double nodes = 1000;

std::vector<NamedPatch> named(const testing::SplineModel& model) {
  std::vector<NamedPatch> patches;
  for (size_t p = 0; p < model.surfaces.size(); ++p)
    patches.push_back({std::make_shared<const SplineSurface>(model.surfaces[p]), model.columns[p], model.coordinates,
                       "patch " + std::to_string(p), "patch " + std::to_string(p)});
  return patches;
}

struct ReadFile {
  PatchModel model;
  CadFile file;
  TopoDS_Shape shape;
  std::vector<Handle(Geom_BSplineSurface)> faces;
};

ReadFile read_back(const std::vector<NamedPatch>& patches, bool step = true) {
  ReadFile read;
  read.model = patch_model(patches);
  read.file = cad_file(read.model.boundary, "m", step);
  const testing::TemporaryDirectory directory;
  STEPControl_Reader reader;
  if (step) {
    EXPECT_EQ(reader.ReadFile(directory.write("m.step", read.file.bytes).c_str()), IFSelect_RetDone);
    reader.TransferRoots();
    read.shape = reader.OneShape();
  } else {
    std::istringstream in(read.file.bytes);
    BRep_Builder builder;
    BRepTools::Read(read.shape, in, builder);
  }
  EXPECT_TRUE(read.file.is_valid);
  EXPECT_TRUE(BRepCheck_Analyzer(read.shape).IsValid());
  for (TopExp_Explorer at(read.shape, TopAbs_FACE); at.More(); at.Next())
    read.faces.push_back(Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(TopoDS::Face(at.Current()))));
  EXPECT_EQ(read.faces.size(), read.model.boundary.faces.size());
  return read;
}

double volume_of(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties, asked_volume);
  return properties.Mass();
}

/// Largest distance at equal parameters; infinite if the patch has not these.
double distance(const Geom_BSplineSurface& face, const NamedPatch& patch) {
  double u0, u1, v0, v1;
  face.Bounds(u0, u1, v0, v1);
  std::vector<Place> places;
  std::vector<Eigen::RowVector3d> found;
  constexpr int steps = 23;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const double u = i == steps ? u1 : u0 + (u1 - u0) * i / steps, v = j == steps ? v1 : v0 + (v1 - v0) * j / steps;
      const auto side = [](int k) { return k == steps ? KnotSide::left : KnotSide::right; };  // of jumps
      try {
        places.push_back(patch.patch->place({.u = u, .v = v, .u_side = side(i), .v_side = side(j)}));
      } catch (const InvalidParameter&) {
        return INFINITY;
      }
      const gp_Pnt p = face.Value(u, v);
      found.emplace_back(p.X(), p.Y(), p.Z());
    }
  const LimitSamples right = patch.patch->evaluate(patch.columns, places, 0, patch.coordinates);
  double largest = 0;
  for (size_t k = 0; k < places.size(); ++k)
    largest = std::max(largest, (found[k] - right.position.row(Eigen::Index(k))).norm());
  return largest;
}

/// Each face of both kinds of files is a patch.
ReadFile expect_exact(const std::vector<NamedPatch>& patches) {
  ReadFile step = read_back(patches, true);
  for (const ReadFile& read : {step, read_back(patches, false)})
    for (const auto& face : read.faces) {
      double least = INFINITY;
      for (const NamedPatch& patch : patches) least = std::min(least, distance(*face, patch));
      EXPECT_LE(least, cad_exact * read.model.diagonal);
    }
  EXPECT_LE(step.model.gap, cad_exact * step.model.diagonal);
  return step;
}

TEST(PatchFiles, RationalSphereIsOneFaceAndOneSolid) {
  const ReadFile read = expect_exact(named(testing::nurbs_sphere()));
  EXPECT_EQ(read.file.solids, 1);
  EXPECT_EQ(read.faces.size(), 1u);
  EXPECT_EQ(read.model.seams, 1);
  EXPECT_EQ(read.model.points, 2);
  EXPECT_EQ(read.model.boundary.vertices.rows(), 2);
  const double volume = 4 * std::numbers::pi / 3;
  EXPECT_NEAR(read.file.volume, volume, rounding(nodes, volume));
  EXPECT_NEAR(read.model.area, 3 * volume, rounding(nodes, 3 * volume));
  EXPECT_NEAR(volume_of(read.shape), volume, read_volume * volume);
  EXPECT_TRUE(read.faces[0]->IsURational());
}

TEST(PatchFiles, ToriHaveTwoSeamsAndOneVertex) {
  testing::SplineModel bicubic;
  const auto knots = [](double scale, size_t count) {
    std::vector<double> breaks;
    for (size_t i = 0; i <= count; ++i) breaks.push_back(1 + scale * double(i * i + 5 * i));
    return Knots<double>::closed(3, breaks);
  };
  bicubic.add(knots(0.25, 8), knots(1, 6));
  for (Index i = 0; i < 48; ++i) {
    const double u = std::numbers::pi / 4 * (i % 8), v = std::numbers::pi / 3 * (i / 8), r = 3 + std::cos(v);
    bicubic.columns[0].row(i) << r * std::cos(u), r * std::sin(u), std::sin(v);
  }
  for (const testing::SplineModel& model : {testing::nurbs_torus(), bicubic}) {
    const ReadFile read = expect_exact(named(model));
    EXPECT_EQ(read.file.solids, 1);
    EXPECT_EQ(read.model.seams, 2);
    EXPECT_EQ(read.model.boundary.vertices.rows(), 1);
    EXPECT_NEAR(volume_of(read.shape), read.file.volume, read_volume * read.file.volume);
  }
  const CadFile torus = cad_file(patch_model(named(testing::nurbs_torus())).boundary, "m", false);
  const double volume = 6 * std::numbers::pi * std::numbers::pi;
  EXPECT_NEAR(torus.volume, volume, rounding(nodes, volume));
}

/// The same patch over other parameters, from 1 on.
testing::SplineModel stretched(const testing::SplineModel& model, double factor) {
  const auto stretch = [&](const Knots<double>& knots) {
    std::vector<double> all(knots.all().begin(), knots.all().end());
    for (double& t : all) t = 1 + factor * t;
    return Knots<double>::open(knots.degree(), knots.num_points(), std::move(all));
  };
  return {{SplineSurface(stretch(model.surfaces[0].u()), stretch(model.surfaces[0].v()))}, model.columns};
}

TEST(PatchFiles, FrontsOfASolidAreOutsideHoweverPatchesAreGiven) {
  std::mt19937 random(1);
  const testing::SplineModel cube = testing::bilinear_cube();
  for (int trial = 0; trial < 20; ++trial) {
    testing::SplineModel turned;
    for (size_t p = 0; p < 6; ++p) {
      testing::SplineModel face = testing::arranged(cube.only(p), int(random() % 8));
      if (random() % 2) face.refine(elevated_knots(face.surfaces[0].u()), elevated_knots(face.surfaces[0].v()));
      if (random() % 2) face.refine(with_knot(face.surfaces[0].u(), 0.75), face.surfaces[0].v());
      turned.append(stretched(face, double(1 + random() % 3)));
    }
    const ReadFile read = expect_exact(named(turned));
    EXPECT_EQ(read.file.solids, 1);
    EXPECT_EQ(read.model.shared, 12);
    EXPECT_EQ(read.model.boundary.vertices.rows(), 8);
    EXPECT_NEAR(read.file.volume, 8, cad_exact * 8);
    EXPECT_NEAR(read.model.angle, std::numbers::pi / 2, cad_exact);
    EXPECT_NEAR(volume_of(read.shape), 8, read_volume * 8);
  }
}

TEST(PatchFiles, TeapotIsShellsThatShareEdges) {
  const FreeForm shapes = testing::teapot();
  const FreeFormPatches found = free_form_patches(shapes, "teapot.obj");
  std::vector<NamedPatch> patches;
  for (size_t p = 0; p < 32; ++p)
    patches.push_back({found.patches.members()[p].patch, found.patches.columns_of(p, found.columns), Coordinates::plain,
                       "part " + std::to_string(p)});
  const ReadFile read = expect_exact(patches);
  EXPECT_EQ(read.file.shells, 4);  // body with its rim and bottom, lid, handle, spout
  EXPECT_EQ(read.file.solids, 0);
  EXPECT_EQ(read.model.points, 8);  // the middle of lid and bottom
  EXPECT_EQ(read.model.unsuitable + read.model.non_manifold, 0);
}

TEST(PatchFiles, OtherKindsOfPatchesAreTheirBSplines) {
  std::mt19937 random(3);
  const auto points = [&](Index count) {
    Points columns(count, 3);
    for (Index i = 0; i < count; ++i)
      for (int c = 0; c < 3; ++c) columns(i, c) = std::uniform_real_distribution<>(-1, 1)(random);
    return columns;
  };
  const auto cardinal =
      std::make_shared<const BasisSurface>(SegmentBasis::cardinal({0, 1, 3, 4}), SegmentBasis::taylor(2, {0, 0.5}));
  const auto unclamped = std::make_shared<const SplineSurface>(
      Knots<double>::open(3, 6, {0, 1, 2, 3, 5, 6, 7, 9, 10, 11}), Knots<double>::closed(2, {0, 1, 2, 4}));
  const auto cut = std::make_shared<const CutPatch>(unclamped, Eigen::Array2d(3.5, 0.25), Eigen::Array2d(6.5, 3));
  const auto jump = std::make_shared<const SplineSurface>(Knots<double>::open(1, 6, {0, 0, 1, 1, 2, 2, 3, 3}),
                                                          bezier_knots<double>(4));
  for (const auto& patch : std::vector<std::shared_ptr<const Patch>>{cardinal, unclamped, cut})
    expect_exact({{patch, points(patch->num_points()), Coordinates::plain, "it"}});
  EXPECT_EQ(expect_exact({{jump, points(jump->num_points()), Coordinates::plain, "it"}}).faces.size(), 3u);
}

TEST(PatchFiles, TwoFacesOnEachOtherAreNoSolid) {
  const testing::SplineModel face = testing::bilinear_cube().only(0);
  testing::SplineModel twice = face;
  twice.append(face);
  const ReadFile read = expect_exact(named(twice));
  EXPECT_EQ(read.model.shared, 4);
  EXPECT_EQ(read.file.solids, 0);
  EXPECT_EQ(read.file.shells, 1);
}

TEST(PatchFiles, SidesWithAGapAreValidEdges) {
  testing::SplineModel cube = testing::bilinear_cube();
  cube.columns[2].col(0).array() += 1e-4;
  const PatchModel model = patch_model(named(cube), {.same = 1e-3});
  EXPECT_EQ(model.shared, 12);
  const CadFile file = cad_file(model.boundary, "m", true);
  EXPECT_TRUE(file.is_valid);
  EXPECT_EQ(file.solids, 1);
}

TEST(PatchFiles, TrianglesAreThreeFaces) {
  // A tetrahedron of quadratic triangles, two of them rational by weights that their sides have in common.
  const double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  std::vector<NamedPatch> patches;
  for (const auto& face : faces) {
    Points columns(6, 4);
    const int ends[6][2] = {{0, 0}, {0, 1}, {1, 1}, {0, 2}, {1, 2}, {2, 2}};
    for (int i = 0; i < 6; ++i) {
      const int a = face[ends[i][0]], b = face[ends[i][1]];
      const double w = a == b ? 1 : 0.6 + 0.05 * (a + b), bulge = a == b ? 0 : 0.2;
      for (int c = 0; c < 3; ++c) columns(i, c) = w * ((corners[a][c] + corners[b][c]) / 2 * (1 + bulge) - bulge / 4);
      columns(i, 3) = w;
    }
    patches.push_back({std::make_shared<const TrianglePatch>(2), columns, Coordinates::homogeneous, "triangle"});
  }
  const ReadFile read = read_back(patches);
  EXPECT_EQ(read.file.solids, 1);
  EXPECT_EQ(read.faces.size(), 12u);
  EXPECT_EQ(read.model.shared, 24);
  EXPECT_EQ(read.model.boundary.vertices.rows(), 4 + 6 + 4);
  EXPECT_NEAR(volume_of(read.shape), read.file.volume, read_volume * read.file.volume);
}

TEST(PatchFiles, TrianglesAndSquaresShareHalvesOfSides) {
  // A prism over a triangle with quadratic sides.
  const double corners[3][2] = {{0, 0}, {1, 0}, {0, 1}}, middles[3][2] = {{0.5, -0.2}, {0.6, 0.7}, {-0.1, 0.5}};
  const auto point = [](const double(&x)[2], double z) { return Eigen::RowVector3d(x[0], x[1], z); };
  std::vector<NamedPatch> patches;
  for (const double z : {0.0, 2.0}) {
    Points columns(6, 3);
    columns << point(corners[0], z), point(middles[0], z), point(corners[1], z), point(middles[2], z),
        point(middles[1], z), point(corners[2], z);
    patches.push_back({std::make_shared<const TrianglePatch>(2), columns});
  }
  const auto side = std::make_shared<const SplineSurface>(bezier_knots<double>(2), bezier_knots<double>(1));
  for (size_t k = 0; k < 3; ++k) {
    Points columns(6, 3);
    for (Index j = 0; j < 2; ++j)
      columns.middleRows(3 * j, 3) << point(corners[k], 2.0 * double(j)), point(middles[k], 2.0 * double(j)),
          point(corners[(k + 1) % 3], 2.0 * double(j));
    patches.push_back({side, columns});
  }
  for (const bool step : {true, false}) {
    const ReadFile read = read_back(patches, step);
    EXPECT_EQ(read.file.solids, 1);
    EXPECT_EQ(read.model.partial, 0);
    EXPECT_EQ(read.model.boundary.vertices.rows(), 2 * 7);
    EXPECT_EQ(read.faces.size(), 9u);
    EXPECT_NEAR(volume_of(read.shape), read.file.volume, read_volume * read.file.volume);
  }
}

TEST(PatchFiles, NamesAreThoseOfPatches) {
  std::vector<NamedPatch> patches = named(testing::nurbs_sphere());
  patches[0].name = "Kugel 'groß' \\ 球 \xF0\x9F\x8C\x8D";
  const CadFile file = cad_file(patch_model(patches).boundary, "m", true);
  EXPECT_NE(file.bytes.find("'Kugel ''gro\\X2\\00DF\\X0\\'' \\\\ \\X2\\7403\\X0\\ \\X4\\0001F30D\\X0\\'"),
            std::string::npos)
      << file.bytes.substr(file.bytes.find("ADVANCED_FACE"), 120);
}

}  // namespace
}  // namespace sublimit
