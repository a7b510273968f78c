// SPDX-License-Identifier: Apache-2.0
#pragma once
// Statements `call FILE` of an OBJ: the lines of another file stand in place of the statement.
#include <filesystem>
#include <string>
#include <vector>

#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {

/// Text with the lines of called files, and where they come from.
struct CalledText {
  std::string text;
  std::vector<TextScanner::Origin> origins;  ///< empty: the file calls no other
  std::vector<std::string> warnings;         ///< calls that are left out: of files that are missing, with arguments
};

/// Returns the text of an OBJ with the lines of the files that it calls, and of those that these call. Paths are
/// relative to the file that names them.
/// @param path  where the text comes from
/// @throws FormatError    a file that calls itself, by way of others too: names the line;  IoError  unreadable
/// @throws ResourceError  more text than memory
CalledText with_called_files(std::string text, const std::filesystem::path& path);

}  // namespace sublimit
