// SPDX-License-Identifier: Apache-2.0
#pragma once
// Arrays of NumPy: .npy files.
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/eval/file/detail/safetensors.h"

namespace sublimit {

/// Returns the header of a .npy file, for arrays in C order: a multiple of 64 bytes.
std::string npy_header(DType type, std::span<const std::int64_t> shape);

/// An array of floats or doubles in a mapped file.
class NpyArray {
 public:
  /// Maps a file; only its header is read. Its size is checked against its shape.
  /// @throws IoError      missing, unreadable
  /// @throws FormatError  not a .npy file of versions 1 to 3; numbers other than little-endian float32 and float64;
  ///                      in Fortran order; longer or shorter than its shape
  explicit NpyArray(const std::filesystem::path& path);
  /// Reads an array from the bytes of a file, which must outlive this.
  NpyArray(std::span<const std::byte> bytes, const std::string& name);
  NpyArray(const std::vector<std::byte>&& bytes, const std::string& name) = delete;
  NpyArray(const NpyArray&) = default;  // copies share the bytes; there is no move, so that none is left empty
  NpyArray& operator=(const NpyArray&) = default;

  DType dtype() const { return dtype_; }  ///< F32 or F64
  const std::vector<std::int64_t>& shape() const { return shape_; }
  std::int64_t size() const { return size_; }
  /// Copies numbers, in C order from `first` on, rounded where they must be.
  template <class Real>
  void read(std::int64_t first, std::span<Real> out) const;

 private:
  void parse(const std::string& name);
  std::shared_ptr<const void> owner_;
  std::span<const std::byte> bytes_;  // bytes of the file, then of its data
  DType dtype_ = DType::F32;
  std::vector<std::int64_t> shape_;
  std::int64_t size_ = 0;
};

/// Writes an array piece by piece; the file appears whole or not at all.
class NpyWriter {
 public:
  /// @throws IoError  unwritable;  ResourceError  a full disk, here and in what follows
  NpyWriter(const std::filesystem::path& path, DType type, std::vector<std::int64_t> shape);
  /// Writes the next items, in C order.
  template <class T>
  void write(std::span<const T> items) {
    write_bytes(dtype_of<T>(), std::as_bytes(items));
  }
  /// @throws InvalidParameter  unless as many items as the shape has were written
  void commit();

 private:
  void write_bytes(DType type, std::span<const std::byte> bytes);
  AtomicFile file_;
  DType type_;
  std::int64_t left_ = 0;  // bytes
};

}  // namespace sublimit
