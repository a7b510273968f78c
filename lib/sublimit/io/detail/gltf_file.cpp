// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/gltf_file.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/base64.h"
#include "sublimit/io/detail/formats.h"
#include "sublimit/io/detail/gltf.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

constexpr std::string_view glb_magic = "glTF";
constexpr std::size_t glb_header = 12, chunk_header = 8;
constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

/// Extensions that change neither triangles nor what is read of them, or that are read.
bool is_known_extension(std::string_view name) {
  constexpr std::array<std::string_view, 7> names{"KHR_mesh_quantization", "FB_ngon_encoding", "KHR_lights_punctual",
                                                  "KHR_xmp_json_ld",       "KHR_xmp",          "KHR_animation_pointer",
                                                  "EXT_lights_image_based"};
  constexpr std::array<std::string_view, 4> families{"KHR_materials_", "EXT_materials_", "KHR_texture_",
                                                     "EXT_texture_"};
  return std::ranges::find(names, name) != names.end() ||
         std::ranges::any_of(families, [&](std::string_view family) { return name.starts_with(family); });
}

std::uint32_t load_word(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  return value;
}

int hexadecimal(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// A URI with its %XX as bytes; nothing if they are none.
std::optional<std::string> percent_decoded(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      text += uri[i];
      continue;
    }
    if (i + 2 >= uri.size()) return std::nullopt;
    const int high = hexadecimal(uri[i + 1]), low = hexadecimal(uri[i + 2]);
    if (high < 0 || low < 0) return std::nullopt;
    text += static_cast<char>(16 * high + low);
    i += 2;
  }
  return text;
}

/// True for "http:", "file:", "c:", also where a path goes on: what a relative URI does not begin with.
bool has_scheme(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  return colon != std::string_view::npos && uri.substr(0, colon).find_first_of("/?#") == std::string_view::npos;
}

}  // namespace

GltfFile::GltfFile(std::string_view bytes, std::string_view name, std::filesystem::path folder)
    : name_(name), folder_(std::move(folder)), json_(parse(bytes)), root_(json_, name_, "") {
  const std::optional<GltfObject> asset = root_.object("asset");
  if (!asset) root_.fail("it has no 'asset' with a version; a glTF file has one");
  const std::string_view version = asset->text("version");
  if (version.substr(0, version.find('.')) != "2")
    asset->fail("version", in_quotes(version) + "; glTF 2.0 can be read");
  check_extensions();
  buffers_.resize(static_cast<std::size_t>(root_.size("buffers")));
}

GltfJson GltfFile::parse(std::string_view bytes) {
  if (bytes.empty()) throw FormatError(name_ + ": the file is empty; a glTF file is expected");
  if (!bytes.starts_with(glb_magic)) {
    const std::size_t first = bytes.find_first_not_of(" \t\r\n", bytes.starts_with("\xef\xbb\xbf") ? 3 : 0);
    if (first == std::string_view::npos || bytes[first] != '{')
      throw FormatError(name_ + ": it begins neither with 'glTF', as binary files do, nor with the '{' of JSON");
    return parse_json(bytes, "");
  }
  const auto require = [&](bool holds, std::size_t at, const std::string& what) {
    if (!holds) throw FormatError(name_ + ": byte " + format_number(at) + ": " + what);
  };
  require(bytes.size() >= glb_header + chunk_header, bytes.size(), "the file ends before its first chunk");
  const std::uint32_t version = load_word(bytes, 4), length = load_word(bytes, 8);
  require(version == 2, 4, "version " + format_number(version) + "; binary glTF 2 can be read");
  require(length <= bytes.size(), 8,
          "the file should have " + format_number(length) + " bytes and has " + format_number(bytes.size()));
  require(length >= glb_header + chunk_header, 8, format_number(length) + " bytes are too few for a chunk");
  if (length < bytes.size())
    warnings.push_back(name_ + ": byte " + format_number(length) + ": data behind the end ignored");
  std::optional<std::string_view> text;
  for (std::size_t at = glb_header; at < length;) {
    require(length - at >= chunk_header, at, "the file ends inside the header of a chunk");
    const std::size_t size = load_word(bytes, at);
    const std::uint32_t type = load_word(bytes, at + 4);
    require(size <= length - at - chunk_header, at,
            "a chunk of " + format_number(size) + " bytes where " + format_number(length - at - chunk_header) +
                " are left");
    const std::string_view chunk = bytes.substr(at + chunk_header, size);
    if (!text) {
      require(type == json_chunk, at + 4, "the first chunk is not JSON, which it should be");
      text = chunk;
    } else if (type == binary_chunk && !has_chunk_) {
      has_chunk_ = true;
      chunk_ = chunk;
    }
    at += chunk_header + size;
  }
  return parse_json(*text, "the JSON chunk, ");
}

GltfJson GltfFile::parse_json(std::string_view text, const std::string& where) const {
  try {
    return GltfJson::parse(text.begin(), text.end());
  } catch (const GltfJson::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    std::string what = error.what();
    what.erase(0, what.find("] ") + 2);
    if (constexpr std::string_view start = "parse error at "; what.starts_with(start)) what.erase(0, start.size());
    for (char& c : what)
      if (static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) >= 127) c = '?';
    if (what.size() > 200) what = what.substr(0, 200) + " ...";
    throw FormatError(name_ + ": " + where + what);
  }
}

void GltfFile::check_extensions() const {
  std::vector<std::string> unknown;
  for (const std::string& name : root_.texts("extensionsRequired"))
    if (!is_known_extension(name)) unknown.push_back(in_quotes(name));
  if (unknown.size() > 10) {
    unknown.resize(10);
    unknown.emplace_back("others");
  }
  if (!unknown.empty())
    root_.fail("extensionsRequired", listed(unknown, "and") + " cannot be read; export the file without");
}

std::string GltfFile::load(const GltfObject& buffer) const {
  const std::string_view uri = buffer.text("uri");
  if (uri.starts_with("data:")) {
    constexpr std::string_view mark = ";base64,";
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos || !uri.substr(0, comma + 1).ends_with(mark))
      buffer.fail("uri", "data in another way than base64; 'data:application/octet-stream;base64,' is right");
    std::optional<std::string> bytes = parse_base64(uri.substr(comma + 1));
    if (!bytes) buffer.fail("uri", "its data are not base64");
    return std::move(*bytes);
  }
  const auto refuse = [&](const char* why) { buffer.fail("uri", in_quotes(uri) + " " + why); };
  if (has_scheme(uri)) refuse("is not a file beside; a relative path is right");
  const std::optional<std::string> path = percent_decoded(uri);
  if (!path || path->find('\0') != std::string::npos) refuse("is no path of a file: % should begin two digits");
  if (path->empty() || path->starts_with('/') || path->starts_with('\\') || has_scheme(*path))
    refuse("is not a path relative to the file");
  for (std::size_t at = 0; at <= path->size();) {
    const std::size_t end = std::min(path->find_first_of("/\\", at), path->size());
    if (std::string_view(*path).substr(at, end - at) == "..") refuse("leads out of the folder of the file");
    at = end + 1;
  }
  if (folder_.empty()) refuse("is another file, which is not at hand");
  try {
    return read_file(folder_ / *path);
  } catch (const IoError& error) {
    throw IoError(buffer.place() + error.what());
  }
}

std::string_view GltfFile::buffer(std::int64_t number) {
  Buffer& found = buffers_[static_cast<std::size_t>(number)];
  if (found.is_loaded) return found.bytes;
  const GltfObject buffer = root_.element("buffers", number);
  if (buffer.has("uri")) {
    found.storage = load(buffer);
    found.bytes = found.storage;
  } else if (number == 0 && has_chunk_) {
    found.bytes = chunk_;
  } else {
    buffer.fail("it has neither a 'uri' nor a binary chunk; where its data are compressed, export without");
  }
  const std::int64_t length = buffer.integer("byteLength");
  if (length > std::ssize(found.bytes))
    buffer.fail("byteLength", format_number(length) + " bytes where there are " + format_number(found.bytes.size()));
  found.bytes = found.bytes.substr(0, static_cast<std::size_t>(length));
  found.is_loaded = true;
  return found.bytes;
}

std::string_view GltfFile::view(std::int64_t number) {
  const GltfObject view = root_.element("bufferViews", number);
  const std::int64_t buffer_number = view.index("buffer", root_.size("buffers"), "buffers");
  if (buffer_number < 0) view.fail("it has no 'buffer'");
  const std::string_view bytes = buffer(buffer_number);
  const std::int64_t offset = view.integer("byteOffset", 0), length = view.integer("byteLength");
  if (offset > std::ssize(bytes) || length > std::ssize(bytes) - offset)
    view.fail("bytes " + format_number(offset) + " to " + format_number(offset + length) + " of a buffer of " +
              format_number(bytes.size()));
  return bytes.substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

bool begins_gltf(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || text[first] != '{') return false;
  return std::ranges::any_of(std::array{"\"asset\"", "\"accessors\"", "\"bufferViews\""},
                             [&](const char* key) { return text.find(key) != std::string_view::npos; });
}

}  // namespace sublimit
