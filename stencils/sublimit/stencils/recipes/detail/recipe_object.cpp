// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/recipes/detail/recipe_object.h"

#include <utility>

#include "sublimit/base/detail/format_number.h"

namespace sublimit {
namespace {

std::string from_to(std::size_t least, std::size_t most) {
  if (least == most) return format_number(least);
  return format_number(least) + (most - least == 1 ? " or " : " to ") + format_number(most);
}

}  // namespace

ExactPoints RecipeObject::points_in(const JsonValue& list, const std::string& path, std::size_t least,
                                    std::size_t most) const {
  if (list.type != JsonValue::Type::array) fail(path, "is " + show(list) + "; it should be a list of points");
  ExactPoints result;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    const JsonValue& item = list.items[i];
    if (item.type != JsonValue::Type::array)
      fail(entry(path, i), "is " + show(item) + "; it should be a list of " + from_to(least, most) + " numbers");
    if (item.items.size() < least || item.items.size() > most)
      fail(entry(path, i),
           "has " + format_number(item.items.size()) + " numbers; it should have " + from_to(least, most));
    if (i > 0 && item.items.size() != result[0].size())
      fail(entry(path, i), "has " + format_number(item.items.size()) + " numbers, those before have " +
                               format_number(result[0].size()));
    std::vector<ExactNumber> row;
    for (std::size_t k = 0; k < item.items.size(); ++k)
      row.push_back(number_in(item.items[k], entry(entry(path, i), k)));
    result.push_back(std::move(row));
  }
  if (result.empty()) fail(path, "is empty; it should be a list of points");
  return result;
}

ExactPoints RecipeObject::exact_points(const std::string& field, std::size_t least, std::size_t most) {
  return points_in(required(field, "a list of points", JsonValue::Type::array), field, least, most);
}

Points RecipeObject::points(const std::string& field, std::size_t least, std::size_t most) {
  return rounded(exact_points(field, least, most));
}

Points RecipeObject::space_points(const std::string& field) { return in_space(points(field, 2, 3)); }

Points RecipeObject::space_points(const std::string& field, Eigen::Index count) {
  Points result = space_points(field);
  check_size(field, size_t(result.rows()), size_t(count), "points");
  return result;
}

Eigen::RowVector3d RecipeObject::space_vector(const std::string& field) {
  const std::vector<double> all = numbers(field);
  if (all.size() != 2 && all.size() != 3)
    fail(field, "has " + format_number(all.size()) + " numbers; it should have 2 or 3");
  return {all[0], all[1], all.size() == 3 ? all[2] : 0};
}

std::vector<Points> RecipeObject::lists_of_points(const std::string& field, std::size_t least, std::size_t most) {
  const JsonValue& list = required(field, "a list of lists of points", JsonValue::Type::array);
  std::vector<Points> result;
  for (std::size_t i = 0; i < list.items.size(); ++i)
    result.push_back(rounded(points_in(list.items[i], entry(field, i), least, most)));
  return result;
}

RecipeObject RecipeObject::object(const std::string& field, const char* what) {
  return {required(field, what, JsonValue::Type::object), place_, path_ + field + "."};
}

std::vector<RecipeObject> RecipeObject::objects(const std::string& field, const char* what) {
  const JsonValue& list = required(field, what, JsonValue::Type::array);
  std::vector<RecipeObject> result;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    if (list.items[i].type != JsonValue::Type::object)
      fail(entry(field, i), "is " + show(list.items[i]) + "; it should be an object");
    result.emplace_back(list.items[i], place_, path_ + entry(field, i) + ".");
  }
  return result;
}

Points rounded(const ExactPoints& points) {
  Points result(std::ssize(points), points.empty() ? 0 : std::ssize(points[0]));
  for (Eigen::Index i = 0; i < result.rows(); ++i)
    for (Eigen::Index k = 0; k < result.cols(); ++k) result(i, k) = points[size_t(i)][size_t(k)].value;
  return result;
}

Points in_space(Points points) {
  if (points.cols() == 3) return points;
  points.conservativeResize(Eigen::NoChange, 3);
  points.col(2).setZero();
  return points;
}

}  // namespace sublimit
