// SPDX-License-Identifier: Apache-2.0
// Classical surfaces in the gallery: one panel or more for every kind, nets where they are exact, data on the surfaces,
// and documents that say the same.
#include "sublimit/stencils/gallery/patch_exhibits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "stencils/drawn_panels.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/source/linear_source.h"
#include "sublimit/stencils/recipes/detail/recipe.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using namespace gallery;

const std::vector<PatchExhibit>& shown_patches() {
  static const std::vector<PatchExhibit> all = patch_exhibits();
  return all;
}

const std::vector<Recipe>& shown_recipes() {
  static const std::vector<Recipe> all = parse_recipes(patch_recipes(), "patches.json");
  return all;
}

const PatchExhibit& exhibit_named(const std::string& name) {
  for (const PatchExhibit& exhibit : shown_patches())
    if (exhibit.name == name) return exhibit;
  throw std::runtime_error("no exhibit " + name);
}

const std::vector<DrawnPanel>& drawn_patches() {
  static const std::vector<DrawnPanel> all = read_panels(patch_pictures().files[0].text);
  return all;
}

/// Kinds of recipes that are surfaces.
std::set<std::string> kinds_of_surfaces() {
  std::set<std::string> kinds;
  for (const std::string& kind : recipe_kinds())
    if (!kind.ends_with("_curve") && !kind.starts_with("interpolate_") && !kind.ends_with("_join") &&
        kind != "implicit")
      kinds.insert(kind);
  return kinds;
}

TEST(PatchPictures, HaveAPanelForEveryKindOfSurface) {
  std::set<std::string> kinds, names;
  for (const PatchExhibit& exhibit : shown_patches()) {
    kinds.insert(exhibit.kind);
    EXPECT_TRUE(names.insert(exhibit.name).second) << exhibit.name << " twice";
  }
  EXPECT_EQ(kinds, kinds_of_surfaces());
  EXPECT_GE(kinds.size(), 22u);
  ASSERT_EQ(drawn_patches().size(), shown_patches().size());
  for (size_t i = 0; i < drawn_patches().size(); ++i) {
    EXPECT_EQ(drawn_patches()[i].caption, shown_patches()[i].name);
    EXPECT_EQ(drawn_patches()[i].note, shown_patches()[i].panel.note);
    EXPECT_GT(drawn_patches()[i].fills, 5) << drawn_patches()[i].caption;
  }
}

TEST(PatchPictures, AreBesideTheRecipesThatTheyAreMadeFrom) {
  const GalleryPart pictures = patch_pictures();
  ASSERT_EQ(pictures.files.size(), 2u);
  EXPECT_EQ(pictures.files[0].name, "patches.svg");
  EXPECT_EQ(pictures.files[0].text.find("nan"), std::string::npos);
  EXPECT_EQ(pictures.files[0].text, patch_pictures().files[0].text);
  EXPECT_EQ(pictures.files[1].name, "patches.json");
  EXPECT_EQ(parse_recipes(pictures.files[1].text, "patches.json").size(), shown_patches().size());
  for (const Recipe& recipe : shown_recipes()) EXPECT_TRUE(recipe.notes.empty()) << recipe.place;
}

// The width of its lines tells a net: 9 tenths of a pixel, data have 17.
TEST(PatchPictures, NetsAreDrawnWhereTheyAreExact) {
  for (size_t i = 0; i < drawn_patches().size(); ++i) {
    const PatchExhibit& exhibit = shown_patches()[i];
    SCOPED_TRACE(exhibit.name);
    const Recipe& recipe = shown_recipes()[i];
    const bool exact = recipe.surface() && recipe.surface()->net;
    EXPECT_EQ(exhibit.form == PatchForm::net, exact);
    EXPECT_EQ(exhibit.why.empty(), exact);
    EXPECT_EQ(exhibit.made_of.starts_with("net "), exact);
    EXPECT_EQ(exhibit.form == PatchForm::rows, recipe.surface() && !exact);
    const bool lattice = exhibit.kind == "bezier_triangle";
    EXPECT_EQ(!drawn_patches()[i].stroke(9).pieces.empty(), exact || lattice);
    // Every surface shows what it was made from: its net, or data.
    EXPECT_TRUE(exact || lattice || !drawn_patches()[i].stroke(17).pieces.empty());
  }
}

// Greville's net of m x n points has m (n - 1) + n (m - 1) edges; closed both ways, 2 m n. A lattice of degree n has
// 3 n (n + 1)/2.
TEST(PatchPictures, NetsHaveAllTheirEdges) {
  const auto edges = [](const char* name) { return exhibit_named(name).panel.layers[1].creases.size(); };
  EXPECT_EQ(edges("Bezier"), 24u);
  EXPECT_EQ(edges("B-spline"), 6u * 4 + 5 * 5);
  EXPECT_EQ(edges("B-spline, closed"), 2u * 6 * 4);
  EXPECT_EQ(edges("Bezier triangle"), 18u);
  EXPECT_EQ(edges("Ruled"), 4u * 1 + 2 * 3);
}

TEST(PatchPictures, TextIsWhatTheoryCounts) {
  const auto says = [](const char* name) {
    return std::regex_replace(exhibit_named(name).panel.note, std::regex("\u00a0"), " ");
  };
  EXPECT_EQ(says("Bezier"), "degree 3 × 3, net 4 × 4");
  EXPECT_EQ(says("Bezier triangle"), "degree 3, rows over 10 points");  // 4 * 5/2
  EXPECT_EQ(says("NURBS sphere"), "degree 2 × 2, rational, net 9 × 5");
  EXPECT_EQ(says("Coons, bilinear"), "degree 3 × 3, net 4 × 4");  // d0 is a cubic, d1 is raised
  EXPECT_EQ(says("Gregory"), "rows over 24 points");              // its net, and two twists a corner
  EXPECT_EQ(says("Gordon"), "degree 2 × 2, net 4 × 4");           // three parabolic splines each way
  EXPECT_EQ(says("Ruled"), "degree 3 × 1, net 4 × 2");            // a cubic and a parabola
  EXPECT_EQ(says("Revolution"), "degree 2 × 3, rational, net 9 × 6");
  EXPECT_EQ(says("Screw"), "rows over 12 points");  // four for each of three
  EXPECT_EQ(says("Loft"), "degree 3 × 3, net 4 × 4");
  EXPECT_EQ(exhibit_named("B-spline, closed").faces, 6 * 4);
  EXPECT_EQ(exhibit_named("NURBS sphere").faces, 4 * 2);
  EXPECT_EQ(exhibit_named("Screw").faces, 6);  // one and a half turns in quarters
}

/// Points of a surface of the recipes.
Points samples_of(const std::string& name) {
  for (const Recipe& recipe : shown_recipes())
    if (recipe.name == name) {
      const RecipeSurface& surface = *recipe.surface();
      return surface.patch->evaluate(surface.columns, grid_places(surface.patch->faces(), 7), 0, surface.coordinates)
          .position;
    }
  throw std::runtime_error("no recipe " + name);
}

TEST(PatchRecipes, TheSphereIsOne) {
  const Points x = samples_of("NURBS sphere");
  EXPECT_LT((x.rowwise().norm().array() - 1).abs().maxCoeff(), other_route);
}

// Lines between circles of radius 1 at z = -1 and z = 1, a quarter turn apart: the distance from the axis is that from
// the middle of a chord, r^2 = 1/2 + z^2/2.
TEST(PatchRecipes, TheRationalRuledSurfaceIsAHyperboloid) {
  const Points x = samples_of("Ruled, rational");
  const Eigen::ArrayXd r2 = x.leftCols(2).rowwise().squaredNorm();
  EXPECT_LT((r2 - (1 + x.col(2).array().square()) / 2).abs().maxCoeff(), other_route);
}

/// A point is nearer to a corner of a square that it is on than half of a diagonal, which is shorter than two sides.
double longest_side(const PictureMesh& mesh) {
  double longest = 0;
  size_t first = 0;
  for (const Index size : mesh.face_sizes) {
    for (Index i = 0; i < size; ++i)
      longest = std::max(longest, (mesh.positions.row(mesh.face_vertices[first + size_t(i)]) -
                                   mesh.positions.row(mesh.face_vertices[first + size_t((i + 1) % size)]))
                                      .norm());
    first += size_t(size);
  }
  return longest;
}

TEST(PatchPictures, CurvesAndPointsOfDataLieOnTheirSurfaces) {
  int seen = 0;
  for (const PatchExhibit& exhibit : shown_patches()) {
    SCOPED_TRACE(exhibit.name);
    const PictureMesh &surface = exhibit.panel.layers.front(), &data = exhibit.panel.layers.back();
    if (&surface == &data || !data.ink || data.ink->width < 1.5) continue;
    ++seen;
    std::set<Index> on_surface(data.dots.begin(), data.dots.end());
    for (const PictureMesh::Line& line : data.creases)
      if (exhibit.form != PatchForm::nonlinear) on_surface.insert({line.tail, line.head});  // no normals
    EXPECT_GE(on_surface.size(), 3u);
    const double near = longest_side(surface);
    for (const Index v : on_surface)
      EXPECT_LT((surface.positions.rowwise() - data.positions.row(v)).rowwise().norm().minCoeff(), near);
  }
  EXPECT_GE(seen, 17);  // all but those that are made from a net alone
}

TEST(PatchPictures, FillThePanelsAndStayInThem) {
  const PictureOptions view = patch_view();
  for (const DrawnPanel& panel : drawn_patches()) {
    SCOPED_TRACE(panel.caption);
    Eigen::Vector2d low(1e9, 1e9), high = -low;
    for (const DrawnPanel::Stroke& stroke : panel.strokes)
      for (const auto& piece : stroke.pieces)
        for (const Eigen::Vector2d& p : piece) low = low.cwiseMin(p), high = high.cwiseMax(p);
    EXPECT_GE(low.minCoeff(), 0);
    EXPECT_LE(high.x(), 10 * view.panel_width);
    EXPECT_LE(high.y(), 10 * view.panel_height);
    const Eigen::Vector2d share = (high - low).array() / Eigen::Array2d(10 * view.panel_width, 10 * view.panel_height);
    EXPECT_GT(share.maxCoeff(), .7);
  }
}

TEST(PatchPictures, RowsSayWhatPanelsSay) {
  const Json rows = patch_pictures().rows;
  ASSERT_EQ(rows.size(), shown_patches().size());
  for (size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), 6u);
    EXPECT_EQ(rows[i][0], shown_patches()[i].name);
    EXPECT_TRUE(shown_patches()[i].panel.note.ends_with(rows[i][4].get<std::string>()));
  }
}

/// Rows of the table of kinds in a document: the code spans of the first cell, and the cells.
std::map<std::string, std::vector<std::string>> table_of_kinds(const std::string& document) {
  std::map<std::string, std::vector<std::string>> rows;
  std::istringstream text(read_file(SUBLIMIT_SOURCE "/" + document));
  const std::regex name("`([a-z_]+)`");
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with("| `")) continue;
    std::vector<std::string> cells;
    std::istringstream parts(line.substr(2));
    for (std::string cell; std::getline(parts, cell, '|');) cells.push_back(cell.substr(cell.find_first_not_of(' ')));
    for (std::sregex_iterator at(cells[0].begin(), cells[0].end(), name), end; at != end; ++at)
      EXPECT_TRUE(rows.emplace((*at)[1], cells).second) << (*at)[1];
  }
  return rows;
}

TEST(PatchPictures, TheTableOfKindsSaysWhichHaveNets) {
  const auto rows = table_of_kinds("lib/sublimit/patches/README.md");
  std::set<std::string> kinds;
  for (const auto& [kind, cells] : rows) {
    kinds.insert(kind);
    EXPECT_EQ(cells.size(), 5u) << kind;
  }
  EXPECT_EQ(kinds, kinds_of_surfaces());
  for (const PatchExhibit& exhibit : shown_patches()) {
    const char* word = exhibit.form == PatchForm::net ? "net" : exhibit.form == PatchForm::rows ? "rows" : "neither";
    EXPECT_TRUE(rows.at(exhibit.kind)[3].starts_with(word)) << exhibit.kind << ": " << rows.at(exhibit.kind)[3];
  }
}

}  // namespace
}  // namespace sublimit::testing
