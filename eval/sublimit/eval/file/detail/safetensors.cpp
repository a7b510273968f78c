// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/file/detail/safetensors.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <nlohmann/json.hpp>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

static_assert(std::endian::native == std::endian::little, "files are little-endian");

struct TypeName {
  const char* name;
  std::int64_t size;
};
constexpr std::array<TypeName, 5> types{{{"F64", 8}, {"I64", 8}, {"F32", 4}, {"I32", 4}, {"U8", 1}}};

constexpr std::uint64_t alignment = 64;
/// What other readers of the layout take.
constexpr std::uint64_t longest_header = 100'000'000;
/// More than any array here has.
constexpr size_t most_dimensions = 8;

constexpr const char* of_header = "header_checksum";
std::string checksum_key(const std::string& tensor) { return "checksum." + tensor; }

/// A name for a message; files may have names of any length.
std::string in_quotes(const std::string& name) {
  return "'" + (name.size() > 80 ? name.substr(0, 80) + "..." : name) + "'";
}

std::string hexadecimal(std::uint64_t number) {
  std::string digits(16, '0');
  for (size_t i = 16; i-- > 0; number >>= 4) digits[i] = "0123456789abcdef"[number & 15];
  return digits;
}

/// Bytes of an array; nothing if there are more than numbers count.
std::optional<std::int64_t> num_bytes(DType type, std::span<const std::int64_t> shape) {
  std::int64_t bytes = item_size(type);
  for (const std::int64_t n : shape)
    if (n < 0 || __builtin_mul_overflow(bytes, n, &bytes)) return std::nullopt;
  return bytes;
}

std::string shape_text(std::span<const std::int64_t> shape) {
  std::string text;
  for (const std::int64_t n : shape) {
    if (!text.empty()) text += ',';
    append_number(text, n);
  }
  return text;
}

/// JSON of a text.
std::string json_text(const std::string& text) {
  try {
    return nlohmann::json(text).dump();
  } catch (const nlohmann::json::exception&) {
    throw InvalidParameter("the text " + in_quotes(text) + " is not UTF-8");
  }
}

/// The header, item by item. Every state has its place in the layout, so nothing is deeper than an array in a tensor.
class HeaderReader : public nlohmann::json_sax<nlohmann::json> {
 public:
  struct Entry {
    Tensor tensor;
    std::vector<std::int64_t> offsets;
    bool has_dtype = false, has_shape = false;
  };
  std::vector<Entry> entries;
  std::map<std::string, std::string> metadata;
  std::string problem;

  bool start_object(size_t) override {
    if (at_ == At::start) return go(At::top);
    if (at_ != At::top) return fail("an object where none should be");
    if (key_ == "__metadata__") return go(At::metadata);
    entries.emplace_back().tensor.name = key_;
    return go(At::tensor);
  }
  bool key(string_t& text) override {
    if (at_ == At::top && !names_.insert(text).second) return fail(in_quotes(text) + " is there twice");
    if (at_ == At::metadata && metadata.count(text) != 0)
      return fail(in_quotes(text) + " is there twice in __metadata__");
    key_ = std::move(text);
    return true;
  }
  bool string(string_t& text) override {
    if (at_ == At::metadata) {
      metadata.emplace(key_, std::move(text));
      return true;
    }
    if (at_ != At::tensor || key_ != "dtype") return fail("a text where none should be");
    Entry& entry = entries.back();
    const auto type = std::find_if(types.begin(), types.end(), [&](const TypeName& t) { return text == t.name; });
    if (type == types.end())
      return fail(in_quotes(entry.tensor.name) + ": dtype " + in_quotes(text) +
                  "; F64, I64, F32, I32 and U8 are right");
    if (std::exchange(entry.has_dtype, true)) return fail(in_quotes(entry.tensor.name) + ": two dtypes");
    entry.tensor.dtype = DType(type - types.begin());
    return true;
  }
  bool start_array(size_t) override {
    if (at_ != At::tensor) return fail("a list where none should be");
    Entry& entry = entries.back();
    if (key_ == "shape" && !std::exchange(entry.has_shape, true)) return go(At::shape);
    if (key_ == "data_offsets" && entry.offsets.empty()) return go(At::offsets);
    return fail(in_quotes(entry.tensor.name) + ": the list " + in_quotes(key_) + " is there twice or should not be");
  }
  bool number_unsigned(number_unsigned_t number) override {
    if (at_ != At::shape && at_ != At::offsets) return fail("a number where none should be");
    Entry& entry = entries.back();
    std::vector<std::int64_t>& list = at_ == At::shape ? entry.tensor.shape : entry.offsets;
    if (list.size() == (at_ == At::shape ? most_dimensions : 2))
      return fail(in_quotes(entry.tensor.name) + ": too many numbers in " + in_quotes(key_));
    if (number > std::uint64_t(std::numeric_limits<std::int64_t>::max()))
      return fail(in_quotes(entry.tensor.name) + ": " + std::to_string(number) + " in " + in_quotes(key_) +
                  " is larger than any file");
    list.push_back(std::int64_t(number));
    return true;
  }
  bool end_array() override {
    if (at_ == At::offsets && entries.back().offsets.size() != 2)
      return fail(in_quotes(entries.back().tensor.name) + ": data_offsets must be two numbers");
    return go(At::tensor);
  }
  bool end_object() override {
    if (at_ == At::top) return go(At::end);
    if (at_ == At::tensor) {
      const Entry& entry = entries.back();
      if (!entry.has_dtype || !entry.has_shape || entry.offsets.empty())
        return fail(in_quotes(entry.tensor.name) + ": dtype, shape and data_offsets must be there");
    }
    return go(At::top);
  }
  bool null() override { return fail("null where it should not be"); }
  bool boolean(bool) override { return fail("true or false where none should be"); }
  bool number_integer(number_integer_t) override { return fail("a negative number"); }
  bool number_float(number_float_t, const string_t&) override {
    return fail("a number that is not whole, or larger than any file");
  }
  bool binary(binary_t&) override { return fail("binary data"); }
  bool parse_error(size_t position, const std::string&, const nlohmann::json::exception&) override {
    return fail("not JSON, at byte " + std::to_string(position));
  }

 private:
  enum class At { start, top, metadata, tensor, shape, offsets, end };
  bool go(At at) {
    at_ = at;
    return true;
  }
  bool fail(std::string what) {
    problem = std::move(what);
    return false;
  }
  At at_ = At::start;
  std::string key_;
  std::unordered_set<std::string> names_;
};

}  // namespace

const char* name(DType type) { return types[size_t(type)].name; }
std::int64_t item_size(DType type) { return types[size_t(type)].size; }

const Tensor* Safetensors::find(std::string_view name) const {
  for (const Tensor& tensor : tensors)
    if (tensor.name == name) return &tensor;
  return nullptr;
}

std::string checksum(std::span<const std::byte> bytes) { return hexadecimal(XXH3_64bits(bytes.data(), bytes.size())); }

std::string header_checksum(const Safetensors& file) {
  std::string text;
  const auto add = [&](std::string_view part) { (text += part) += '\0'; };
  for (const auto& [key, value] : file.metadata)
    if (key != of_header) add(key), add(value);
  for (const Tensor& t : file.tensors) add(t.name), add(name(t.dtype)), add(shape_text(t.shape));
  return checksum(std::as_bytes(std::span(text)));
}

void write_safetensors(const std::filesystem::path& path, Safetensors file) {
  std::stable_sort(file.tensors.begin(), file.tensors.end(),
                   [](const Tensor& a, const Tensor& b) { return item_size(a.dtype) > item_size(b.dtype); });
  std::unordered_set<std::string_view> names{"__metadata__"};
  for (const Tensor& tensor : file.tensors) {
    if (!names.insert(tensor.name).second) throw InvalidParameter("two arrays with the name " + in_quotes(tensor.name));
    if (num_bytes(tensor.dtype, tensor.shape) != std::int64_t(tensor.bytes.size()))
      throw InvalidParameter("the array " + in_quotes(tensor.name) + " has " + std::to_string(tensor.bytes.size()) +
                             " bytes, which its shape " + shape_text(tensor.shape) + " does not make");
    file.metadata[checksum_key(tensor.name)] = checksum(tensor.bytes);
  }
  file.metadata[of_header] = header_checksum(file);

  std::string header = "{\"__metadata__\":{";
  for (const auto& [key, value] : file.metadata) header += json_text(key) + ":" + json_text(value) + ",";
  header.back() = '}';
  std::int64_t at = 0;
  for (const Tensor& tensor : file.tensors) {
    const std::int64_t end = at + std::int64_t(tensor.bytes.size());
    header += ',';
    header += json_text(tensor.name) + ":{\"dtype\":\"" + name(tensor.dtype) + "\",\"shape\":[" +
              shape_text(tensor.shape) + "],\"data_offsets\":[" + std::to_string(at) + "," + std::to_string(end) + "]}";
    at = end;
  }
  header += '}';
  header.resize((8 + header.size() + alignment - 1) / alignment * alignment - 8, ' ');
  if (header.size() > longest_header) throw InvalidParameter("too many arrays for one file");

  AtomicFile out(path);
  std::string length;
  for (int i = 0; i < 8; ++i) length += static_cast<char>(header.size() >> (8 * i) & 255);
  out.write(length);
  out.write(header);
  for (const Tensor& tensor : file.tensors)
    out.write({reinterpret_cast<const char*>(tensor.bytes.data()), tensor.bytes.size()});
  out.commit();
}

Safetensors read_safetensors(std::span<const std::byte> bytes, const std::string& name) {
  const auto fail = [&](const std::string& what) { throw FormatError(name + ": " + what); };
  if (bytes.size() < 8)
    fail("it has " + std::to_string(bytes.size()) + " bytes; a file in the layout of safetensors has 8 and more");
  std::uint64_t length = 0;
  for (size_t i = 8; i-- > 0;) length = length << 8 | std::to_integer<std::uint64_t>(bytes[i]);
  if (length > longest_header)
    fail("not in the layout of safetensors: its first eight bytes are not the length of a header");
  if (length > bytes.size() - 8)
    fail("its header should have " + std::to_string(length) + " bytes; there are " + std::to_string(bytes.size() - 8) +
         ": truncated, or not in the layout of safetensors");
  const std::string_view header(reinterpret_cast<const char*>(bytes.data()) + 8, length);
  const std::span<const std::byte> data = bytes.subspan(8 + length);
  if (!header.starts_with('{')) fail("its header does not begin with '{': not in the layout of safetensors");
  HeaderReader reader;
  if (!nlohmann::json::sax_parse(header, &reader)) fail("header: " + reader.problem);

  Safetensors file;
  file.metadata = std::move(reader.metadata);
  std::stable_sort(reader.entries.begin(), reader.entries.end(),
                   [](const auto& a, const auto& b) { return a.offsets < b.offsets; });
  std::int64_t at = 0;
  for (HeaderReader::Entry& entry : reader.entries) {
    Tensor& tensor = entry.tensor;
    const std::int64_t begin = entry.offsets[0], end = entry.offsets[1];
    const std::string place =
        in_quotes(tensor.name) + " lies at " + std::to_string(begin) + " to " + std::to_string(end);
    if (end < begin || end > std::int64_t(data.size()))
      fail(place + ", outside the " + std::to_string(data.size()) + " bytes of data");
    if (begin != at)
      fail(place + (begin < at ? ", over the array before it" : ", after a hole") + ", which ends at " +
           std::to_string(at));
    if (num_bytes(tensor.dtype, tensor.shape) != end - begin)
      fail(place + ", which is not what " + sublimit::name(tensor.dtype) + " of shape " + shape_text(tensor.shape) +
           " takes");
    tensor.bytes = data.subspan(size_t(begin), size_t(end - begin));
    file.tensors.push_back(std::move(tensor));
    at = end;
  }
  if (at != std::int64_t(data.size()))
    fail("its arrays end at byte " + std::to_string(at) + " of data; there are " + std::to_string(data.size()));
  if (const auto sum = file.metadata.find(of_header);
      sum != file.metadata.end() && sum->second != header_checksum(file))
    fail("header: its checksum does not match");
  return file;
}

std::optional<bool> matches_checksum(const Safetensors& file, const Tensor& tensor) {
  const auto sum = file.metadata.find(checksum_key(tensor.name));
  if (sum == file.metadata.end()) return std::nullopt;
  return sum->second == checksum(tensor.bytes);
}

}  // namespace sublimit
