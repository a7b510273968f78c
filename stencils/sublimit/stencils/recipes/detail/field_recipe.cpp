// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/recipes/detail/field_recipe.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/nearest_names.h"
#include "sublimit/implicit/detail/combinations.h"
#include "sublimit/stencils/recipes/detail/recipe.h"
#include "sublimit/stencils/json/json_file.h"
#include "sublimit/stencils/recipes/detail/recipe_object.h"

namespace sublimit {
namespace {

constexpr int most_exponent = 100;

struct FieldKind {
  const char* name;
  FieldPointer (*read)(RecipeObject&);
};

FieldPointer read_one_field(RecipeObject& object);

Eigen::Vector3d space(RecipeObject& object, const char* field) { return object.space_vector(field).transpose(); }
double number(RecipeObject& object, const char* field) { return object.number(field).value; }

std::vector<Blob> read_blobs(RecipeObject& object, const char* size) {
  std::vector<Blob> blobs;
  for (RecipeObject& blob : object.objects("blobs", "a list of blobs {center, height, ..}")) {
    blobs.push_back({space(blob, "center"), number(blob, "height"), number(blob, size)});
    blob.finish();
  }
  return blobs;
}

std::vector<FieldPointer> read_fields(RecipeObject& object) {
  std::vector<FieldPointer> fields;
  for (RecipeObject& one : object.objects("of", "a list of fields [{\"field\": ..}, ..]")) {
    fields.push_back(read_one_field(one));
    one.finish();
  }
  return fields;
}

FieldPointer read_inner(RecipeObject& object) {
  RecipeObject inner = object.object("of", "a field {\"field\": ..}");
  FieldPointer field = read_one_field(inner);
  inner.finish();
  return field;
}

FieldPointer read_polynomial(RecipeObject& object) {
  std::vector<PolynomialTerm> terms;
  const Points rows = object.points("terms", 4, 4);
  for (Eigen::Index t = 0; t < rows.rows(); ++t) {
    int exponents[3];
    for (int i = 0; i < 3; ++i) {
      const double e = rows(t, i + 1);
      if (!(e >= 0 && e <= most_exponent && e == std::floor(e)))
        object.fail(
            "terms[" + format_number(t) + "][" + format_number(i + 1) + "]",
            "is " + format_number(e) + "; exponents should be whole numbers from 0 to " + format_number(most_exponent));
      exponents[i] = int(e);
    }
    terms.push_back({rows(t, 0), exponents[0], exponents[1], exponents[2]});
  }
  return polynomial_field(std::move(terms));
}

FieldPointer read_transformed(RecipeObject& object) {
  FieldPointer inner = read_inner(object);
  // Rows of a matrix, or its 16 numbers by rows.
  const JsonValue& value = object.required("matrix", "4 rows of 4 numbers");
  const bool flat = value.type == JsonValue::Type::array && value.items.size() == 16;
  Eigen::Matrix4d matrix;
  if (flat) {
    const std::vector<double> all = object.numbers("matrix", 16);
    for (int i = 0; i < 16; ++i) matrix(i / 4, i % 4) = all[size_t(i)];
  } else {
    const Points rows = object.points("matrix", 4, 4);
    if (rows.rows() != 4) object.fail("matrix", "has " + format_number(rows.rows()) + " rows; it should have 4");
    matrix = rows;
  }
  return transformed_field(std::move(inner), matrix);
}

constexpr FieldKind field_kinds[] = {
    {"sphere", [](RecipeObject& o) { return sphere_field(space(o, "center"), number(o, "radius")); }},
    {"distance-point", [](RecipeObject& o) { return distance_to_point(space(o, "point"), number(o, "radius")); }},
    {"distance-line",
     [](RecipeObject& o) { return distance_to_line(space(o, "point"), space(o, "direction"), number(o, "radius")); }},
    {"distance-segment",
     [](RecipeObject& o) { return distance_to_segment(space(o, "from"), space(o, "to"), number(o, "radius")); }},
    {"distance-plane",
     [](RecipeObject& o) {
       return distance_to_plane(space(o, "point"), space(o, "normal"), number(o, "offset"), o.flag_or("signed", false));
     }},
    {"distance-circle",
     [](RecipeObject& o) {
       return distance_to_circle(space(o, "center"), space(o, "normal"), number(o, "ring"), number(o, "radius"));
     }},
    {"distance-polygon",
     [](RecipeObject& o) { return distance_to_polygon(o.space_points("points"), number(o, "radius")); }},
    {"box", [](RecipeObject& o) { return box_field(space(o, "center"), space(o, "half")); }},
    {"polynomial", read_polynomial},
    {"blinn", [](RecipeObject& o) { return blinn_field(number(o, "threshold"), read_blobs(o, "decay")); }},
    {"metaballs", [](RecipeObject& o) { return metaballs_field(number(o, "threshold"), read_blobs(o, "radius")); }},
    {"soft-objects",
     [](RecipeObject& o) { return soft_objects_field(number(o, "threshold"), read_blobs(o, "radius")); }},
    {"union", [](RecipeObject& o) { return union_field(read_fields(o)); }},
    {"intersection", [](RecipeObject& o) { return intersection_field(read_fields(o)); }},
    {"difference", [](RecipeObject& o) { return difference_field(read_fields(o)); }},
    {"smooth-union", [](RecipeObject& o) { return smooth_union_field(read_fields(o), number(o, "width")); }},
    {"offset", [](RecipeObject& o) { return offset_field(read_inner(o), number(o, "by")); }},
    {"transformed", read_transformed},
};

/// What the field's own names say; what is left is the caller's to finish.
FieldPointer read_one_field(RecipeObject& object) {
  const std::string name = object.string("field", "the name of a field, such as \"sphere\"");
  const auto found = std::ranges::find_if(field_kinds, [&](const FieldKind& kind) { return name == kind.name; });
  if (found == std::end(field_kinds))
    object.fail("field", "unknown field " + show_text(name) + "; " + nearest_in_words(name, field_names()));
  try {
    return found->read(object);
  } catch (const InvalidParameter& error) {
    object.fail(name, error.what());
  }
}

FieldJob read_job(const JsonValue& value, const std::string& place) {
  FieldJob job;
  job.place = place;
  RecipeObject object(value, place);
  object.has("kind"), object.has("name"), object.has("group");
  job.field = read_one_field(object);
  job.name = object.string("field", "the name of a field");
  if (object.has("box")) {
    const Points corners = object.space_points("box", 2);
    job.box.emplace(corners.row(0).transpose(), corners.row(1).transpose());
    if (!((corners.row(1) - corners.row(0)).minCoeff() > 0))
      object.fail("box", "has no inside; the second corner should be greater in x, y and z");
  }
  if (object.has("cells")) job.cells = object.integer("cells", 4, 100'000);
  object.finish();
  return job;
}

}  // namespace

std::vector<std::string> field_names() {
  std::vector<std::string> names;
  for (const FieldKind& kind : field_kinds) names.emplace_back(kind.name);
  return names;
}

FieldJob parse_field_job(std::string_view text, const std::string& name) {
  const JsonValue root = parse_json(text, name);
  if (root.type == JsonValue::Type::object && root.find("field") && !root.find("kind")) return read_job(root, name);
  const std::vector<Recipe> recipes = parse_recipes(text, name);
  const Recipe* found = nullptr;
  for (const Recipe& recipe : recipes) {
    if (!std::holds_alternative<FieldRecipe>(recipe.shape)) continue;
    if (found)
      throw FormatError(name + ": " + label(*found) + " and " + label(recipe) +
                        " are fields both; a file should have one, \"union\" joins them");
    found = &recipe;
  }
  if (!found)
    throw FormatError(name +
                      ": no recipe of the kind \"implicit\"; one should be {\"kind\": \"implicit\", \"field\": ..}");
  return read_job(std::get<FieldRecipe>(found->shape).object, found->place);
}

FieldJob read_field_job(const std::filesystem::path& path) {
  return parse_field_job(read_json_text(path), path.string());
}

}  // namespace sublimit
