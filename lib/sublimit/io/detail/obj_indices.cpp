// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/obj_indices.h"

#include <algorithm>
#include <limits>
#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {

Index ObjIndices::read(const TextScanner& scanner, std::string_view token, std::int64_t so_far) {
  const std::int64_t index = scanner.integer(token, "index");
  if (index == 0) reject_index_zero(scanner);
  if (index < 0) {
    if (index >= -so_far) return static_cast<Index>(so_far + index);
    throw InvalidMesh(scanner.place() + "index " + format_number(index) + " counts back beyond the first of " +
                      format_number(so_far) + " " + std::string(what_) +
                      " so far; relative indices start at -1, the last one");
  }
  // Only an index above all earlier ones can be the first that is not there.
  if (index > so_far && (forward_.empty() || index > forward_.back().index))
    forward_.push_back({.index = index, .line = scanner.line()});
  return static_cast<Index>(std::min<std::int64_t>(index - 1, std::numeric_limits<Index>::max()));
}

void ObjIndices::check(const TextScanner& scanner, std::int64_t count) const {
  for (const Forward& forward : forward_) {
    if (forward.index <= count) continue;
    const std::string number = format_number(count);
    throw InvalidMesh(
        scanner.place(forward.line) + "index " + format_number(forward.index) + " is out of range; the file has " +
        (count > 0 ? number + " " + std::string(what_) + ", 1 to " + number : "no " + std::string(what_)));
  }
}

void reject_index_zero(const TextScanner& scanner) {
  throw FormatError(scanner.place() + "index 0; indices of an OBJ file count from 1, or backwards from -1");
}

}  // namespace sublimit
