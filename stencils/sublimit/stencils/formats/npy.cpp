// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/formats/npy.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/mapped_file.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/formats/npy_header.h"

namespace sublimit {
namespace {

const char* description(DType type) {
  switch (type) {
    case DType::F64:
      return "<f8";
    case DType::I64:
      return "<i8";
    case DType::F32:
      return "<f4";
    case DType::I32:
      return "<i4";
    case DType::U8:
      break;
  }
  return "|u1";
}

std::int64_t num_items(std::span<const std::int64_t> shape) {
  std::int64_t items = 1;
  for (const std::int64_t n : shape) items *= n;
  return items;
}

}  // namespace

std::string npy_header(DType type, std::span<const std::int64_t> shape) {
  return format_npy_header(std::string("'") + description(type) + "'", shape);
}

NpyArray::NpyArray(const std::filesystem::path& path) {
  MappedFile file = map_file(path);
  bytes_ = file.bytes;
  owner_ = std::move(file.owner);
  parse(path.string());
}

NpyArray::NpyArray(std::span<const std::byte> bytes, const std::string& name) : bytes_(bytes) { parse(name); }

void NpyArray::parse(const std::string& name) {
  const auto fail = [&](const std::string& what) { throw FormatError(name + ": " + what); };
  NpyHeader header = parse_npy_header(bytes_, name);
  if (!header.fields.empty()) fail("its items are records; plain numbers are right");
  if (header.descr != "<f4" && header.descr != "<f8")
    fail("its items are '" + header.descr.substr(0, 40) +
         "'; little-endian '<f4' and '<f8' are right: a.astype('<f8')");
  if (header.fortran_order && header.shape.size() > 1)
    fail("its items are in Fortran order; C order is right: numpy.ascontiguousarray(a)");
  dtype_ = header.descr == "<f4" ? DType::F32 : DType::F64;
  shape_ = std::move(header.shape);
  std::int64_t expected = item_size(dtype_);
  bool too_large = false;
  for (const std::int64_t n : shape_) too_large = __builtin_mul_overflow(expected, n, &expected) || too_large;
  // A dimension of 0 makes an overflow before it harmless for the bytes, but nobody means such an array.
  bytes_ = bytes_.subspan(header.bytes);
  if (too_large || expected != std::int64_t(bytes_.size()))
    fail("its data has " + std::to_string(bytes_.size()) + " bytes, " +
         (too_large ? "its shape more than any file" : "its shape " + std::to_string(expected)));
  size_ = expected / item_size(dtype_);
}

template <class Real>
void NpyArray::read(std::int64_t first, std::span<Real> out) const {
  if (first < 0 || first > size_ || std::int64_t(out.size()) > size_ - first)
    throw InvalidParameter(".npy: items " + std::to_string(first) + " to " +
                           std::to_string(first + std::int64_t(out.size())) + " of " + std::to_string(size_));
  const auto copy = [&]<class Item>() {
    const std::byte* from = bytes_.data() + first * std::int64_t(sizeof(Item));
    if constexpr (std::is_same_v<Item, Real>) {
      if (!out.empty()) std::memcpy(out.data(), from, out.size_bytes());
    } else {
      for (Real& number : out) {  // of any alignment
        Item item;
        std::memcpy(&item, from, sizeof(Item));
        number = static_cast<Real>(item);
        from += sizeof(Item);
      }
    }
  };
  if (dtype_ == DType::F32) return copy.template operator()<float>();
  copy.template operator()<double>();
}

template void NpyArray::read(std::int64_t, std::span<float>) const;
template void NpyArray::read(std::int64_t, std::span<double>) const;

NpyWriter::NpyWriter(const std::filesystem::path& path, DType type, std::vector<std::int64_t> shape)
    : file_(path), type_(type), left_(num_items(shape) * item_size(type)) {
  file_.write(npy_header(type, shape));
}

void NpyWriter::write_bytes(DType type, std::span<const std::byte> bytes) {
  if (type != type_ || std::int64_t(bytes.size()) > left_)
    throw InvalidParameter(std::string(".npy: ") + std::to_string(bytes.size()) + " bytes of " + name(type) +
                           ", where " + std::to_string(left_) + " of " + name(type_) + " are left");
  left_ -= std::int64_t(bytes.size());
  file_.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void NpyWriter::commit() {
  if (left_ != 0) throw InvalidParameter(".npy: " + std::to_string(left_) + " bytes have not been written");
  file_.commit();
}

}  // namespace sublimit
