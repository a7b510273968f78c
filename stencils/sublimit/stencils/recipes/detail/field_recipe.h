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

/// Reads the field of a file.
/// @throws FormatError  as `read_recipes`; no field or several; an unknown kind of field (the message has the nearest
///                      names); entries that are missing, unknown or of the wrong length
FieldJob read_field_job(const std::filesystem::path& path);
/// Reads the field of a text; messages start with `name`.
FieldJob parse_field_job(std::string_view text, const std::string& name);

}  // namespace sublimit
