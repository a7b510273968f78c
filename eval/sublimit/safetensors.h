// SPDX-License-Identifier: Apache-2.0
#pragma once
// The container of files of tables: named arrays in the layout of safetensors (github.com/huggingface/safetensors).
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

/// Types of items, by the words that the header has for them.
enum class DType { F64, I64, F32, I32, U8 };
const char* name(DType type);
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

/// An array that lies somewhere else.
struct Tensor {
  std::string name;
  DType dtype = DType::U8;
  std::vector<std::int64_t> shape;
  std::span<const std::byte> bytes;  ///< row by row, little-endian; of any alignment
};

/// An array where it lies.
/// @param items  which must stay
/// @param shape  its product is the number of items
template <class T>
Tensor tensor(std::string name, std::span<const T> items, std::vector<std::int64_t> shape) {
  return {std::move(name), dtype_of<T>(), std::move(shape), std::as_bytes(items)};
}

struct Safetensors {
  std::vector<Tensor> tensors;  ///< as their data lies
  std::map<std::string, std::string> metadata;
  const Tensor* find(std::string_view name) const;
};

/// XXH3, 64 bits, as 16 hexadecimal digits.
std::string checksum(std::span<const std::byte> bytes);

/// Checksum of what a header says, its own left out: names and texts of the metadata in the order of their bytes, then
/// name, dtype and shape ("2,3") of the arrays in the order of their data, a byte 0 after each of all these.
std::string header_checksum(const Safetensors& file);

/// Writes arrays and metadata, with "checksum.NAME" of each array and "header_checksum" added to the metadata. Data is
/// streamed from where it lies. The file appears whole or not at all; the same bytes for the same arguments.
/// @throws InvalidParameter  a name twice, a shape of other bytes than there are, text that is not UTF-8
/// @throws IoError           unwritable;  ResourceError  a full disk
void write_safetensors(const std::filesystem::path& path, Safetensors file);

/// Finds the arrays of a file; nothing of the data is read. The layout is checked: a header that is neither longer
/// than the file nor deeper than it should be, no name twice, shapes that make the bytes that there are, no overlaps,
/// no holes. If there is a checksum of the header, it is compared. Takes memory in proportion to the header.
/// @param bytes  of the file, which stay where they are
/// @param name   of the file, for messages
/// @throws FormatError  anything else
Safetensors read_safetensors(std::span<const std::byte> bytes, const std::string& name);
Safetensors read_safetensors(const std::vector<std::byte>&& bytes, const std::string& name) = delete;

/// Whether data is what was written; nothing if there is no checksum of it.
[[nodiscard]] std::optional<bool> matches_checksum(const Safetensors& file, const Tensor& tensor);

}  // namespace sublimit
