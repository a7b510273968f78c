// SPDX-License-Identifier: Apache-2.0
#pragma once
// Names of groups and objects in OBJ files, `g NAME ...` and `o NAME`: of the elements from there to the next such
// line.
#include <string>
#include <unordered_map>
#include <vector>

#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {

class ObjNames {
 public:
  /// Reads the rest of a line behind its `g` or `o`. Several names are one, with blanks between its words.
  /// @param names  where it is, or is added
  /// @return       which of them; -1 if the line has none
  Index read(TextScanner& scanner, std::vector<std::string>& names);

 private:
  std::unordered_map<std::string, Index> numbers_;
};

}  // namespace sublimit
