// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/obj_names.h"

#include <utility>

namespace sublimit {

Index ObjNames::read(TextScanner& scanner, std::vector<std::string>& names) {
  std::string name;
  for (std::string_view token; !(token = scanner.token()).empty();) {
    if (!name.empty()) name += ' ';
    name += token;
  }
  if (name.empty()) return -1;
  const auto [found, is_new] = numbers_.emplace(std::move(name), static_cast<Index>(names.size()));
  if (is_new) names.push_back(found->first);
  return found->second;
}

}  // namespace sublimit
