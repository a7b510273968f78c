// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/obj_names.h"

#include <algorithm>
#include <array>
#include <utility>

namespace sublimit {

std::string rest_of_line(TextScanner& scanner) {
  std::string words;
  for (std::string_view token; !(token = scanner.name_token()).empty();) {
    if (!words.empty()) words += ' ';
    words += token;
  }
  return words;
}

bool has_comment(std::string_view name) {
  for (std::size_t at = 0; (at = name.find('#', at)) != std::string_view::npos; ++at)
    if (at == 0 || std::string_view(" \t\v\f").find(name[at - 1]) != std::string_view::npos) return true;
  return false;
}

bool is_name_keyword(std::string_view keyword) {
  constexpr std::array<std::string_view, 6> keywords{"g", "o", "usemtl", "mtllib", "s", "call"};
  return std::ranges::find(keywords, keyword) != keywords.end();
}

Index ObjNames::number(std::string name, std::vector<std::string>& names) {
  if (name.empty()) return -1;
  const auto [found, is_new] = numbers_.emplace(std::move(name), static_cast<Index>(names.size()));
  if (is_new) names.push_back(found->first);
  return found->second;
}

void ObjNames::add_face(std::size_t face, Mesh::FaceNames& names) const {
  if (current_ < 0 && names.of_face.empty()) return;
  names.of_face.resize(face, -1);  // those before the first that has one
  names.of_face.push_back(current_);
}

}  // namespace sublimit
