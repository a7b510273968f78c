// SPDX-License-Identifier: Apache-2.0
#pragma once
// Classification of the statements of an OBJ file, so that readers of some of them report which others they
// skip.
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {

/// Number of elements of each kind in a file.
struct ObjElements {
  std::int64_t faces = 0, lines = 0, curves = 0, curves_2d = 0, surfaces = 0;
  std::int64_t first_free_form = -1;  ///< line of the first `curv`, `curv2` or `surf`

  /// Counts a statement if it is an element other than a point.
  bool count(const TextScanner& scanner, std::string_view keyword);
  bool has_free_form() const { return first_free_form >= 0; }
  /// Returns the counts as text: "2 curves and 1 surface"; `curv2` are "curves in parameter space".
  std::string free_form() const;
};

/// Returns "1 face", "2 faces", for words with a plural in s.
std::string counted(std::int64_t count, std::string_view singular);

/// True for a statement that neither a mesh, a polygon, a curve nor a surface depends on: groups, materials,
/// how to display.
bool is_attribute_keyword(std::string_view keyword);
/// True for a statement of free-form curves and surfaces (free_form.h) that is no element.
bool is_free_form_keyword(std::string_view keyword);

/// Warnings about keywords that no version of the format has: one per keyword, at most 20.
class UnknownKeywords {
 public:
  /// Adds a warning.
  /// @throws FormatError  the keyword is no text
  void warn(const TextScanner& scanner, std::string_view keyword, std::vector<std::string>& warnings);

 private:
  std::unordered_set<std::string> seen_;
};

}  // namespace sublimit
