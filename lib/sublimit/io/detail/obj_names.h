// SPDX-License-Identifier: Apache-2.0
#pragma once
// Lines of OBJ files that name the faces after them: `g`, `o`, `usemtl`, `s`.
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sublimit/io/detail/text_scanner.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Returns the words that are left of a line, joined by a blank. Only a `#` behind a blank begins a comment.
std::string rest_of_line(TextScanner& scanner);

/// Returns true if a part of a name would be a comment: a `#` at its beginning or behind a blank.
bool has_comment(std::string_view name);
/// Returns true if names stand behind a keyword: `g`, `o`, `usemtl`, `mtllib`, `s`, `call`.
bool is_name_keyword(std::string_view keyword);

/// Names of one kind. Words of a line are one name; faces after a line without a word have none.
class ObjNames {
 public:
  /// Returns the number of a name in a list, where it is added if it is new; -1 for an empty one.
  Index number(std::string name, std::vector<std::string>& names);
  /// Names the faces that follow.
  void set(std::string name, Mesh::FaceNames& names) { current_ = number(std::move(name), names.names); }
  /// Names them by the rest of a line.
  void read(TextScanner& scanner, Mesh::FaceNames& names) { set(rest_of_line(scanner), names); }
  /// Names the next face.
  /// @param face  its number
  void add_face(std::size_t face, Mesh::FaceNames& names) const;

 private:
  std::unordered_map<std::string, Index> numbers_;
  Index current_ = -1;
};

}  // namespace sublimit
