// SPDX-License-Identifier: Apache-2.0
#pragma once
// Packages of USD (`.usdz`): zip archives whose files are stored, not compressed, each at a multiple of 64 bytes. The
// first one is the scene.
//
// Written here, not by libzip: it places no file at a multiple of 64 bytes. As nothing is compressed, nothing can grow.
// Source: OpenUSD, "Usdz file format specification" 1.3; PKWARE, "APPNOTE" 6.3.
#include <string>
#include <string_view>
#include <vector>

namespace sublimit {

/// A file of a package; a view into its bytes.
struct UsdzFile {
  std::string name;
  std::string_view bytes;
};

/// Returns true for bytes that begin as a zip archive does.
bool is_zip(std::string_view bytes);
/// Returns true for bytes that begin as a package does, whose first file is a layer.
bool begins_usdz(std::string_view bytes);
/// Returns the files of a package, in their order.
/// @param name  of the package, with which messages start
/// @throws FormatError  damaged, cut off, compressed or encrypted files, names that lead out of the package
std::vector<UsdzFile> usdz_files(std::string_view bytes, const std::string& name);
/// Returns the bytes of a package.
/// @throws ResourceError  4 GB or more, or 65536 files, the limits of the format
std::string format_usdz(const std::vector<UsdzFile>& files, const std::string& name);

}  // namespace sublimit
