// SPDX-License-Identifier: Apache-2.0
#pragma once
// The header of .npy files: a dictionary of Python.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sublimit {

/// What an .npy file holds.
struct NpyHeader {
  std::string descr;                                        ///< '<f8'; empty for records
  std::vector<std::pair<std::string, std::string>> fields;  ///< of records: name and type
  bool fortran_order = false;
  std::vector<std::int64_t> shape;
  std::size_t bytes = 0;  ///< of the header: data begins there
};

/// Reads the header of a file.
/// @throws FormatError  not an .npy file of versions 1 to 3, or a damaged header
NpyHeader parse_npy_header(std::span<const std::byte> bytes, const std::string& name);

/// Returns the bytes of a header, a multiple of 64.
/// @param descr   as Python has it: "'<f8'"
/// @param length  bytes that it should have; 0: as few as it can
std::string format_npy_header(std::string_view descr, std::span<const std::int64_t> shape, std::size_t length = 0);

}  // namespace sublimit
