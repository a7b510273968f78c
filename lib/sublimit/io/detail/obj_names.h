// SPDX-License-Identifier: Apache-2.0
#pragma once
// Names of groups and objects in OBJ files, `g NAME ...` and `o NAME`, which apply to the elements up to the
// next such line.
#include <string>
#include <unordered_map>
#include <vector>

#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {

class ObjNames {
 public:
  /// Reads the rest of a line after its `g` or `o`. Several words are one name with blanks.
  /// @param names  list of names, to which it is added if it is new
  /// @return       index of the name; -1 if the line has none
  Index read(TextScanner& scanner, std::vector<std::string>& names);

 private:
  std::unordered_map<std::string, Index> numbers_;
};

}  // namespace sublimit
