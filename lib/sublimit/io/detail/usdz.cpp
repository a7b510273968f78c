// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/usdz.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <unordered_set>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

constexpr std::string_view local_mark = "PK\x03\x04", central_mark = "PK\x01\x02", end_mark = "PK\x05\x06";
constexpr std::size_t local_size = 30, central_size = 46, end_size = 22, alignment = 64;
constexpr unsigned encrypted = 1, names_are_utf8 = 0x800;

/// A number of `count` bytes, least first.
std::uint32_t load(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  return value;
}
void put(std::string& out, std::uint64_t value, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out += static_cast<char>(value >> (8 * i) & 0xff);
}

std::uint32_t checksum(std::string_view bytes) {
  std::uint32_t sum = 0;
  constexpr std::size_t most = std::numeric_limits<uInt>::max();
  for (std::size_t at = 0; at < bytes.size(); at += most)
    sum = static_cast<std::uint32_t>(crc32(sum, reinterpret_cast<const Bytef*>(bytes.data() + at),
                                           static_cast<uInt>(std::min(most, bytes.size() - at))));
  return sum;
}

class UsdzReader {
 public:
  UsdzReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  std::vector<UsdzFile> read() {
    const std::size_t end = find_end();
    const std::size_t count = load(bytes_, end + 10, 2), size = load(bytes_, end + 12, 4);
    std::size_t at = load(bytes_, end + 16, 4);
    if (at > end || size > end - at) fail("its list of files lies outside of it");
    std::vector<UsdzFile> files;
    std::unordered_set<std::string_view> names;
    for (std::size_t i = 0; i < count; ++i) {
      if (at + central_size > end || bytes_.substr(at, 4) != central_mark)
        fail("its list ends after " + format_number(i) + " of " + format_number(count) + " files");
      const std::size_t length = load(bytes_, at + 28, 2), more = load(bytes_, at + 30, 2) + load(bytes_, at + 32, 2);
      if (length + more > end - at - central_size) fail("its list of files is cut off");
      files.push_back({std::string(bytes_.substr(at + central_size, length)), contents(at, length)});
      if (!names.insert(bytes_.substr(at + central_size, length)).second)
        fail("two files have the name " + in_quotes(files.back().name));
      at += central_size + length + more;
    }
    return files;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw FormatError(name_ + ": not a sound package: " + what + "; copy it again");
  }

  std::size_t find_end() const {
    if (bytes_.size() >= end_size) {
      const std::size_t found = bytes_.rfind(end_mark, bytes_.size() - end_size);
      constexpr std::size_t longest_comment = 65535;
      if (found != std::string_view::npos && bytes_.size() - found - end_size <= longest_comment) return found;
    }
    fail("the end of the archive is missing");
  }

  /// The bytes of the file that an entry of the list is of.
  std::string_view contents(std::size_t entry, std::size_t length) const {
    const std::string name(bytes_.substr(entry + central_size, length));
    const auto refuse = [&](const std::string& what) {
      throw FormatError(name_ + ": " + in_quotes(name) + " " + what);
    };
    if (load(bytes_, entry + 8, 2) & encrypted) refuse("is encrypted; a .usdz has plain files");
    if (load(bytes_, entry + 10, 2) != 0)
      refuse("is compressed; a .usdz has stored files alone (`zip -0` makes them so)");
    if (name.empty() || name[0] == '/' || name.find('\\') != std::string::npos ||
        ("/" + name + "/").find("/../") != std::string::npos)
      refuse("leads out of the package");
    const std::size_t size = load(bytes_, entry + 20, 4), local = load(bytes_, entry + 42, 4);
    if (load(bytes_, entry + 24, 4) != size) refuse("has two sizes");
    if (local > entry || entry - local < local_size || bytes_.substr(local, 4) != local_mark)
      fail(in_quotes(name) + " is not where the list says");
    const std::size_t begin = local + local_size + load(bytes_, local + 26, 2) + load(bytes_, local + 28, 2);
    if (begin > entry || size > entry - begin) fail(in_quotes(name) + " is cut off");
    const std::string_view bytes = bytes_.substr(begin, size);
    if (checksum(bytes) != load(bytes_, entry + 16, 4)) fail(in_quotes(name) + " does not have its checksum");
    return bytes;
  }

  std::string_view bytes_;
  const std::string& name_;
};

/// The fields that the header of a file and its entry in the list share.
std::string common_fields(const UsdzFile& file) {
  std::string out;
  put(out, 10, 2);  // version 1.0
  put(out, names_are_utf8, 2);
  put(out, 0, 2);             // stored
  put(out, 0, 2);             // time and
  put(out, (1 << 5) | 1, 2);  // date: the first day that the format has
  put(out, checksum(file.bytes), 4);
  put(out, file.bytes.size(), 4);
  put(out, file.bytes.size(), 4);
  put(out, file.name.size(), 2);
  return out;
}

}  // namespace

bool is_zip(std::string_view bytes) { return bytes.starts_with(local_mark) || bytes.starts_with(end_mark); }

bool begins_usdz(std::string_view bytes) {
  if (!bytes.starts_with(local_mark) || bytes.size() < local_size) return false;
  const std::string_view name = bytes.substr(local_size, load(bytes, 26, 2));
  return name.find(".usd") != std::string_view::npos;
}

std::vector<UsdzFile> usdz_files(std::string_view bytes, const std::string& name) {
  return UsdzReader(bytes, name).read();
}

std::string format_usdz(const std::vector<UsdzFile>& files, const std::string& name) {
  std::uint64_t most = end_size;
  for (const UsdzFile& file : files)
    most += file.bytes.size() + 2 * file.name.size() + local_size + central_size + 2 * alignment;
  if (most > std::numeric_limits<std::uint32_t>::max() || files.size() > std::numeric_limits<std::uint16_t>::max())
    throw ResourceError(name + ": a .usdz has less than 4 GB and 65536 files; write a .usda");
  std::string out, list;
  out.reserve(most);
  for (const UsdzFile& file : files) {
    const std::size_t local = out.size(), header = local + local_size + file.name.size();
    // A field of four bytes and more that nothing reads brings the contents to a multiple of 64.
    const std::size_t padding = 4 + (alignment - (header + 4) % alignment) % alignment;
    const std::string common = common_fields(file);
    out += local_mark;
    out += common;
    put(out, padding, 2);
    out += file.name;
    put(out, 0x1986, 2);
    put(out, padding - 4, 2);
    out.append(padding - 4, '\0');
    out += file.bytes;
    list += central_mark;
    put(list, 10, 2);
    list += common;
    list.append(2 + 2 + 2 + 2 + 4, '\0');  // no more fields, no comment, one disk, no attributes
    put(list, local, 4);
    list += file.name;
  }
  const std::size_t begin = out.size();
  out += list;
  out += end_mark;
  put(out, 0, 4);
  put(out, files.size(), 2);
  put(out, files.size(), 2);
  put(out, list.size(), 4);
  put(out, begin, 4);
  put(out, 0, 2);
  return out;
}

}  // namespace sublimit
