// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/gallery/patch_data.h"

#include <string>
#include <utility>

#include "sublimit/patches/spline_curve.h"
#include "sublimit/stencils/recipes/detail/recipe_readers.h"

namespace sublimit::gallery {
namespace {

constexpr int points_per_segment = 48;

Points points_along(const CurveNet& curve) {
  std::vector<CurvePlace> places;
  for (Index segment = 0; segment < curve.knots.num_faces(); ++segment)
    for (int i = segment > 0; i <= points_per_segment; ++i) places.push_back({segment, double(i) / points_per_segment});
  return SplineCurve(curve.knots).evaluate(curve.columns, places, 0, curve.coordinates).position;
}

/// Reads the fields of one recipe by their names, which are the same in all kinds.
class DataReader {
 public:
  explicit DataReader(const JsonValue& recipe) : object_(recipe, "the gallery's recipes") {}

  PatchData read() {
    for (const char* field : {"c0", "c1", "d0", "d1", "c", "d", "curve"})
      if (object_.has(field)) add(read_inner_curve(object_, field, notes_));
    for (const char* field : {"curves_u", "curves_v"})
      if (object_.has(field))
        for (RecipeObject& one : object_.objects(field, "curves")) {
          Points points = one.space_points("points");
          add_curve(one, "knots", one.integer("degree", 0, max_degree), std::move(points));
        }
    if (object_.has("profile")) read_profile();
    if (object_.has("section")) read_sweep();
    if (object_.has("sections"))
      for (const Points& section : object_.lists_of_points("sections", 3, 3))
        add_curve(object_, "knots_u", object_.integer("degree_u", 0, max_degree), section);
    read_points();
    return std::move(data_);
  }

 private:
  void add(const CurveNet& curve) { data_.curves.push_back(points_along(curve)); }
  void add_curve(RecipeObject& object, const char* knots, int degree, Points points) {
    const Eigen::Index count = points.rows();
    add({read_knots(object, knots, degree, count, object.flag_or("closed", false), notes_), std::move(points)});
  }
  void read_profile() {
    RecipeObject profile = object_.object("profile", "a curve");
    const Points xz = profile.points("points", 2, 2);
    Points xyz = Points::Zero(xz.rows(), 3);
    xyz.col(0) = xz.col(0);
    xyz.col(2) = xz.col(1);
    add_curve(profile, "knots", profile.integer("degree", 0, max_degree), std::move(xyz));
  }
  /// The path, and the section where it begins.
  void read_sweep() {
    const Points origins = object_.space_points("origins");
    add_curve(object_, "knots", object_.integer("degree", 0, max_degree), origins);
    CurveNet section = read_inner_curve(object_, "section", notes_);
    const Points first = object_.lists_of_points("matrices", 3, 3)[0];
    section.columns = (section.columns * first.transpose()).rowwise() + origins.row(0);
    add(section);
  }
  void read_points() {
    const std::string kind = object_.string("kind", "a kind");
    data_.points.resize(0, 3);
    if (kind == "lagrange_surface" || object_.has("normals")) data_.points = object_.space_points("points");
    if (kind == "hermite_surface") data_.points = object_.space_points("p");
    if (object_.has("normals")) data_.normals = object_.space_points("normals");
  }

  RecipeObject object_;
  std::vector<std::string> notes_;
  PatchData data_;
};

}  // namespace

PatchData patch_data(const JsonValue& recipe) { return DataReader(recipe).read(); }

}  // namespace sublimit::gallery
