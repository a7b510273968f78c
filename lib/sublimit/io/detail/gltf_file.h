// SPDX-License-Identifier: Apache-2.0
#pragma once
// A glTF file: its JSON, and its buffers in the binary chunk, in the JSON itself or in files beside it.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/io/detail/gltf_json.h"

namespace sublimit {

/// The JSON of a file, and the bytes of its buffers, which are fetched when they are asked for.
class GltfFile {
 public:
  /// @param bytes   of a .glb or .gltf; must outlive this
  /// @param folder  where files beside it are; empty: there are none
  /// @throws FormatError  chunks that do not fit, no JSON, another version, extensions that cannot be read
  GltfFile(std::string_view bytes, std::string_view name, std::filesystem::path folder);
  GltfFile(const GltfFile&) = delete;

  /// Returns the whole of the JSON.
  const GltfObject& root() const { return root_; }
  /// Returns the name of the file, with which messages start.
  const std::string& name() const { return name_; }
  /// Returns the bytes of a buffer, `byteLength` of them.
  /// @throws FormatError, IoError, ResourceError  where it is not, or is too short
  std::string_view buffer(std::int64_t number);
  /// Returns the bytes of a buffer view.
  std::string_view view(std::int64_t number);
  /// Reservations on the file as a whole.
  std::vector<std::string> warnings;

 private:
  GltfJson parse(std::string_view bytes);
  GltfJson parse_json(std::string_view text, const std::string& where) const;
  void check_extensions() const;
  std::string load(const GltfObject& buffer) const;

  std::string name_;
  std::filesystem::path folder_;
  bool has_chunk_ = false;
  std::string_view chunk_;
  GltfJson json_;
  GltfObject root_;
  struct Buffer {
    bool is_loaded = false;
    std::string storage = {};
    std::string_view bytes = {};
  };
  std::vector<Buffer> buffers_;
};

}  // namespace sublimit
