// SPDX-License-Identifier: Apache-2.0
#pragma once
// Compressed input files (gzip), recognised by their first bytes, whatever their names are.
#include <filesystem>
#include <string>
#include <string_view>

namespace sublimit {

/// Returns the bytes of a file, inflated if it is compressed.
/// @throws IoError, ResourceError  as `read_file`;  FormatError, ResourceError  as `inflated`
std::string read_inflated(const std::filesystem::path& path);

/// Returns true for bytes that begin as a gzip file does.
bool is_gzip(std::string_view bytes);
/// Returns the bytes that a gzip file holds, those of its members one after the other.
/// @param name  name of the file, with which messages start
/// @throws FormatError    damaged, cut off, or with other bytes behind the last member
/// @throws ResourceError  more bytes than a job may take (`memory_limit`)
std::string inflated(std::string_view bytes, const std::string& name);

/// Returns the name of a file without `.gz` at its end: the name that its bytes had.
std::filesystem::path without_gz(const std::filesystem::path& path);

}  // namespace sublimit
