// SPDX-License-Identifier: Apache-2.0
#pragma once
// The text of a JSON file, which may be no longer than the memory for its values allows.
#include <filesystem>
#include <string>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/json/json_value.h"

namespace sublimit {

/// Reads a file of JSON. Devices that never end are not read on and on.
/// @throws IoError  missing, unreadable;  ResourceError  its values would take more memory than a job may
inline std::string read_json_text(const std::filesystem::path& path) {
  constexpr double of_a_byte = sizeof(JsonValue) / 4;  // of lists of short numbers, with commas and blanks
  const auto most = static_cast<std::size_t>(memory_limit() / of_a_byte);
  std::string text = read_file(path, most);
  if (text.size() > most)
    throw ResourceError(path.string() + ": more than " + bytes_in_words(double(most)) +
                        ", whose values as JSON take more memory than a job may; " + memory_limit_in_words() +
                        "; a shorter file can be read");
  return text;
}

}  // namespace sublimit
