// SPDX-License-Identifier: Apache-2.0
#pragma once
// The fields of an object in a recipe: those of any JSON object (json_object.h), points, and objects in it.
#include <string>
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/stencils/json/json_object.h"

namespace sublimit {

class RecipeObject : public JsonObject {
 public:
  using JsonObject::JsonObject;

  /// Returns rows of numbers of equal length, `least` to `most` numbers in each.
  ExactPoints exact_points(const std::string& field, std::size_t least, std::size_t most);
  Points points(const std::string& field, std::size_t least, std::size_t most);
  /// Returns points in space; z is 0 for points of two numbers.
  Points space_points(const std::string& field);
  /// Returns `count` points in space.
  Points space_points(const std::string& field, Eigen::Index count);
  /// Returns a vector [x, y] or [x, y, z]; z is 0 if absent.
  Eigen::RowVector3d space_vector(const std::string& field);
  /// Returns the lists of points in an array, with `least` to `most` coordinates for each point.
  std::vector<Points> lists_of_points(const std::string& field, std::size_t least, std::size_t most);

  RecipeObject object(const std::string& field, const char* what);
  std::vector<RecipeObject> objects(const std::string& field, const char* what);

 private:
  ExactPoints points_in(const JsonValue& value, const std::string& path, std::size_t least, std::size_t most) const;
};

/// Returns exact points rounded to doubles.
Points rounded(const ExactPoints& points);
/// Returns points of 3 columns from points of 2 or 3 columns, with z = 0.
Points in_space(Points points);

}  // namespace sublimit
