// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fields from recipes: an object of kind `implicit`, or a field by itself.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/implicit/field.h"

namespace sublimit {

struct FieldJob {
  FieldPointer field;
  std::string name;                        ///< "smooth-union"
  std::string place;                       ///< "file.json: recipe 0 (implicit)", for messages
  std::optional<Eigen::AlignedBox3d> box;  ///< if the recipe has one
  int cells = 0;                           ///< 0: the recipe leaves it out
};

/// Names of all fields, in the order of the documents.
std::vector<std::string> field_names();

/// The one field of a file.
/// @throws FormatError  as read_recipes; none or several fields; an unknown field (the nearest names are told), fields
///                      that are missing, unknown or of other numbers than they should be
FieldJob read_field_job(const std::filesystem::path& path);
/// The same from text; messages start with `name`.
FieldJob parse_field_job(std::string_view text, const std::string& name);

}  // namespace sublimit
