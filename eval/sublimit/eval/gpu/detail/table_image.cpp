// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/gpu/detail/table_image.h"

#include <cstring>
#include <limits>
#include <string>

#include "sublimit/base/error.h"

namespace sublimit::gpu {

std::int64_t Image::add_bytes(std::span<const std::byte> bytes) {
  bytes_.resize(size_t(rounded_up(num_bytes(), 64)));
  const std::int64_t at = num_bytes();
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  return at;
}

std::span<const std::byte> Image::at(std::uint64_t address) {
  for (const auto& [at, target] : addresses_) {
    const std::uint64_t value = address + std::uint64_t(target);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }
  return bytes_;
}

std::uint32_t number(std::int64_t value, const char* what) {
  if (value < 0 || value > std::numeric_limits<std::int32_t>::max())
    throw ResourceError("tables on a GPU count up to 2147483647 " + std::string(what) + ", not " +
                        std::to_string(value) + "; cut the table into several, or apply it on the CPU");
  return static_cast<std::uint32_t>(value);
}

const float* row_of(const Arrays& a, const PatternTable<float>::Group& group, std::int64_t row, int quantity) {
  const auto& block = a.blocks[size_t(group.block)];
  return a.weights.data() + block.weights +
         (std::int64_t{quantity} * block.rows + a.rows[group.rows + row]) * block.columns;
}

std::vector<std::int32_t> rows_key(const Arrays& a, const PatternTable<float>::Group& group) {
  const auto rows = a.rows.span().subspan(size_t(group.rows), size_t(group.num_rows));
  std::vector<std::int32_t> key{group.block};
  key.insert(key.end(), rows.begin(), rows.end());
  return key;
}

std::int64_t pack_patch_points(const Arrays& a, Image& image) {
  if (a.patch_points.empty()) return -1;
  const std::vector<std::uint32_t> places(a.patch_points.begin(), a.patch_points.end());
  return image.add<std::uint32_t>(places);
}

}  // namespace sublimit::gpu
