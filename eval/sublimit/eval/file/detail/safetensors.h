// SPDX-License-Identifier: Apache-2.0
#pragma once
// The container of table files: named arrays in the layout of safetensors (github.com/huggingface/safetensors).
//
//   8 bytes, little-endian: length of the header | header: JSON, then spaces | data of all arrays, without holes
//
// The header says {"name": {"dtype": "F32", "shape": [2, 3], "data_offsets": [begin, end]}, ...}, counted from the
// first byte of data, and may have strings in "__metadata__". Here data begins at a multiple of 64, and arrays of
// larger items come first: so each lies at a multiple of the size of its items, though nothing is put between them.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sublimit {

/// Types of items, by their words in the header.
enum class DType { F64, I64, F32, I32, U8 };
/// Returns the word of a type.
const char* name(DType type);
/// Returns the size of an item in bytes.
std::int64_t item_size(DType type);

template <class T>
constexpr DType dtype_of();
template <>
constexpr DType dtype_of<double>() {
  return DType::F64;
}
template <>
constexpr DType dtype_of<std::int64_t>() {
  return DType::I64;
}
template <>
constexpr DType dtype_of<float>() {
  return DType::F32;
}
template <>
constexpr DType dtype_of<std::int32_t>() {
  return DType::I32;
}
template <>
constexpr DType dtype_of<std::uint8_t>() {
  return DType::U8;
}

/// A named array in memory that it does not own.
struct Tensor {
  std::string name;
  DType dtype = DType::U8;
  std::vector<std::int64_t> shape;
  std::span<const std::byte> bytes;  ///< row by row, little-endian; of any alignment
};

/// Returns a tensor that refers to an array.
/// @param items  must outlive the tensor
/// @param shape  its product is the number of items
template <class T>
Tensor tensor(std::string name, std::span<const T> items, std::vector<std::int64_t> shape) {
  return {std::move(name), dtype_of<T>(), std::move(shape), std::as_bytes(items)};
}

/// Arrays and metadata of a file.
struct Safetensors {
  std::vector<Tensor> tensors;                  ///< arrays in the order of their data
  std::map<std::string, std::string> metadata;  ///< texts by name
  /// Returns the array of a name, null if there is none.
  const Tensor* find(std::string_view name) const;
};

/// Returns the XXH3 hash of 64 bits, as 16 hexadecimal digits.
std::string checksum(std::span<const std::byte> bytes);

/// Returns the checksum of a header, without the entry of that checksum: it covers names and texts of the metadata in
/// the order of their bytes, then name, dtype and shape ("2,3") of the arrays in the order of their data, each followed
/// by a byte 0.
std::string header_checksum(const Safetensors& file);

/// Writes arrays and metadata, with "checksum.NAME" of each array and "header_checksum" added to the metadata. Data is
/// written directly from the arrays. The file appears whole or not at all; the same arguments give the same bytes.
/// @throws InvalidParameter  a name twice, a shape that does not fit the number of bytes, text that is not UTF-8
/// @throws IoError           unwritable;  ResourceError  a full disk
void write_safetensors(const std::filesystem::path& path, Safetensors file);

/// Returns the arrays of a file, without reading their data. The layout is checked: length and depth of the header,
/// unique names, shapes that fit the number of bytes, neither overlaps nor gaps. A checksum of the header is compared,
/// if there is one. Takes memory in proportion to the header.
/// @param bytes  the file; must outlive the result
/// @param name   name of the file for messages
/// @throws FormatError  another layout, another checksum
Safetensors read_safetensors(std::span<const std::byte> bytes, const std::string& name);
Safetensors read_safetensors(const std::vector<std::byte>&& bytes, const std::string& name) = delete;

/// Returns true if the data of an array has its checksum; absent if the file has none for it.
[[nodiscard]] std::optional<bool> matches_checksum(const Safetensors& file, const Tensor& tensor);

}  // namespace sublimit
