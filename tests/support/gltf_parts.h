// SPDX-License-Identifier: Apache-2.0
#pragma once
// Files of glTF written by hand: JSON, and a buffer of numbers.
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sublimit::testing {

/// Returns numbers as the bytes of a buffer, the least byte first.
template <class T>
std::string bytes_of(const std::vector<T>& numbers) {
  std::string bytes;
  for (const T number : numbers) {
    std::uint64_t bits = 0;
    if constexpr (std::is_same_v<T, float>)
      bits = std::bit_cast<std::uint32_t>(number);
    else
      bits = static_cast<std::uint64_t>(number);
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes += static_cast<char>(bits >> (8 * i) & 0xff);
  }
  return bytes;
}

inline std::string gltf_word(std::size_t value) { return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(value)}); }

/// Returns a .glb of JSON and a binary chunk.
inline std::string glb_of(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const std::string rest = binary.empty() ? "" : gltf_word(binary.size()) + std::string("BIN\0", 4) + binary;
  return "glTF" + gltf_word(2) + gltf_word(20 + json.size() + rest.size()) + gltf_word(json.size()) + "JSON" + json +
         rest;
}

/// A file that grows by accessors, each with a buffer view of its own.
class GltfParts {
 public:
  /// Adds rows. Returns the number of their accessor.
  /// @param type   5120, 5121, 5122, 5123, 5125 or 5126, as T is
  /// @param more   further fields: `,"normalized":true`
  template <class T>
  int add(int type, const std::string& shape, std::size_t columns, const std::vector<T>& numbers,
          const std::string& more = "") {
    const int number = add_view(bytes_of(numbers));
    accessors_ += std::string(count_++ ? "," : "") + "{\"bufferView\":" + std::to_string(number) +
                  ",\"componentType\":" + std::to_string(type) +
                  ",\"count\":" + std::to_string(numbers.size() / columns) + ",\"type\":\"" + shape + "\"" + more + "}";
    return count_ - 1;
  }
  /// Adds an accessor of any text.
  int add_accessor(const std::string& text) {
    accessors_ += std::string(count_++ ? "," : "") + text;
    return count_ - 1;
  }
  /// Adds bytes. Returns the number of their buffer view.
  int add_view(const std::string& bytes, const std::string& more = "") {
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    views_ += std::string(num_views_++ ? "," : "") + "{\"buffer\":0,\"byteOffset\":" + std::to_string(binary_.size()) +
              ",\"byteLength\":" + std::to_string(bytes.size()) + more + "}";
    binary_ += bytes;
    return num_views_ - 1;
  }
  int positions(const std::vector<float>& numbers) { return add<float>(5126, "VEC3", 3, numbers); }
  int indices(const std::vector<std::uint16_t>& numbers) { return add<std::uint16_t>(5123, "SCALAR", 1, numbers); }

  const std::string& binary() const { return binary_; }
  /// Returns the JSON with the rest of the fields: `"meshes":[...],"nodes":[...]`.
  /// @param uri  of the buffer: `,"uri":"a.bin"`
  std::string json(const std::string& rest, const std::string& uri = "") const {
    return "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":" + std::to_string(binary_.size()) + uri +
           "}],\"bufferViews\":[" + views_ + "],\"accessors\":[" + accessors_ + "]," + rest + "}";
  }
  std::string glb(const std::string& rest) const { return glb_of(json(rest), binary_); }

 private:
  std::string views_, accessors_, binary_;
  int num_views_ = 0, count_ = 0;
};

}  // namespace sublimit::testing
