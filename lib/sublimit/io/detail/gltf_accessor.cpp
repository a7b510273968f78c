// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/gltf_accessor.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

/// Rows without data are zeros, which a short file may have any number of.
constexpr std::int64_t most_zeros = 1 << 20;

std::optional<GltfType> type_of(std::int64_t number) {
  constexpr std::array all{GltfType::int8,   GltfType::uint8,  GltfType::int16,
                           GltfType::uint16, GltfType::uint32, GltfType::float32};
  for (const GltfType one : all)
    if (static_cast<std::int64_t>(one) == number) return one;
  return std::nullopt;
}

int bytes_of(GltfType type) {
  switch (type) {
    case GltfType::int8:
    case GltfType::uint8:
      return 1;
    case GltfType::int16:
    case GltfType::uint16:
      return 2;
    default:
      return 4;
  }
}

std::uint32_t load_bits(std::string_view bytes, std::int64_t at, int count) {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i)
    value |= std::uint32_t{static_cast<unsigned char>(bytes[static_cast<std::size_t>(at + i)])} << (8 * i);
  return value;
}

double load_number(std::string_view bytes, std::int64_t at, GltfType type) {
  const std::uint32_t bits = load_bits(bytes, at, bytes_of(type));
  switch (type) {
    case GltfType::int8:
      return static_cast<std::int8_t>(bits);
    case GltfType::int16:
      return static_cast<std::int16_t>(bits);
    case GltfType::float32:
      return std::bit_cast<float>(bits);
    default:
      return bits;
  }
}

}  // namespace

GltfAccessor::Rows GltfAccessor::rows(GltfFile& file, const GltfObject& object, const char* view_key,
                                      std::int64_t row_bytes, std::int64_t count) const {
  const std::int64_t number = object.index(view_key, file.root().size("bufferViews"), "buffer views");
  if (number < 0) object.fail(std::string("it has no '") + view_key + "'");
  const GltfObject view = file.root().element("bufferViews", number);
  const std::int64_t buffer = view.index("buffer", file.root().size("buffers"), "buffers");
  if (const std::optional<GltfObject> extensions = view.object("extensions"); extensions && buffer > 0)
    for (const std::string& name : extensions->keys())
      if (name.find("compression") != std::string::npos && !file.root().element("buffers", buffer).has("uri"))
        view.fail("its data are compressed by " + in_quotes(name) + ", which cannot be read; export the file without");
  const std::string_view bytes = file.view(number);
  const std::int64_t offset = object.integer("byteOffset", 0), stride = view.integer("byteStride", row_bytes);
  if (stride < row_bytes || stride > 65536)
    view.fail("byteStride", format_number(stride) + " bytes from row to row, which have " + format_number(row_bytes));
  const std::int64_t room = std::ssize(bytes) - offset;
  if (count > 0 && (room < row_bytes || count - 1 > (room - row_bytes) / stride))
    object.fail(format_number(count) + " rows of " + format_number(row_bytes) + " bytes, " + format_number(stride) +
                " from one to the next, cannot be in the " + format_number(std::max<std::int64_t>(room, 0)) +
                " bytes that bufferViews[" + format_number(number) + "] has for them");
  return {bytes.substr(static_cast<std::size_t>(std::min<std::int64_t>(offset, std::ssize(bytes)))), stride};
}

GltfAccessor::GltfAccessor(GltfFile& file, std::int64_t number) {
  const GltfObject object = file.root().element("accessors", number);
  place_ = file.name() + ": accessors[" + format_number(number) + "]";
  const std::int64_t component = object.integer("componentType");
  const std::optional<GltfType> type = type_of(component);
  if (!type)
    object.fail("componentType", format_number(component) + "; 5120 to 5123, 5125 and 5126 are types of numbers");
  type_ = *type;
  normalized_ = object.flag("normalized") && type_ != GltfType::float32;
  constexpr std::array<std::pair<std::string_view, int>, 7> shapes{
      {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};
  const std::string_view shape = object.text("type");
  const auto* const found = std::ranges::find(shapes, shape, &std::pair<std::string_view, int>::first);
  if (found == shapes.end()) object.fail("type", in_quotes(shape) + "; SCALAR, VEC2, VEC3, VEC4 are types of rows");
  columns_ = found->second;
  count_ = checked_index(object.integer("count"), place_, "rows");
  if (object.has("bufferView"))
    rows_ = rows(file, object, "bufferView", columns_ * bytes_of(type_), count_);
  else if (!object.has("sparse"))
    object.fail("it has no 'bufferView'; where an extension compresses its data, export without");
  else if (count_ > most_zeros)
    object.fail("count", format_number(count_) + " rows without a buffer view, which are zeros; at most " +
                             format_number(most_zeros) + " can be read");
  if (const std::optional<GltfObject> sparse = object.object("sparse")) read_sparse(file, *sparse);
}

void GltfAccessor::read_sparse(GltfFile& file, const GltfObject& sparse) {
  const std::int64_t count = sparse.integer("count");
  const std::optional<GltfObject> indices = sparse.object("indices"), values = sparse.object("values");
  if (!indices || !values) sparse.fail("it should have 'indices' and 'values'");
  const std::optional<GltfType> type = type_of(indices->integer("componentType"));
  if (type != GltfType::uint8 && type != GltfType::uint16 && type != GltfType::uint32)
    indices->fail("componentType", "5121, 5123 and 5125 are types of indices");
  const Rows places = rows(file, *indices, "bufferView", bytes_of(*type), count);
  replacements_ = rows(file, *values, "bufferView", columns_ * bytes_of(type_), count);
  replaced_.reserve(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i) {
    const std::uint32_t row = load_bits(places.bytes, i * places.stride, bytes_of(*type));
    if (row >= count_)
      indices->fail("row " + format_number(row) + " is out of range; there are " + format_number(count_));
    if (!replaced_.empty() && row <= replaced_.back()) indices->fail("rows should ascend");
    replaced_.push_back(row);
  }
}

double GltfAccessor::raw(std::int64_t row, int column) const {
  const std::int64_t offset = std::int64_t{column} * bytes_of(type_);
  if (!replaced_.empty()) {
    const auto found = std::ranges::lower_bound(replaced_, static_cast<std::uint32_t>(row));
    if (found != replaced_.end() && *found == row)
      return load_number(replacements_.bytes, (found - replaced_.begin()) * replacements_.stride + offset, type_);
  }
  return rows_.bytes.empty() ? 0 : load_number(rows_.bytes, row * rows_.stride + offset, type_);
}

double GltfAccessor::value(std::int64_t row, int column) const {
  const double number = raw(row, column);
  if (!normalized_) return number;
  switch (type_) {
    case GltfType::int8:
      return std::max(number / 127, -1.0);
    case GltfType::uint8:
      return number / 255;
    case GltfType::int16:
      return std::max(number / 32767, -1.0);
    case GltfType::uint16:
      return number / 65535;
    default:
      return number / 4294967295.0;
  }
}

}  // namespace sublimit
