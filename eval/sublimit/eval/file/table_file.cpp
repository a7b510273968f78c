// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/file/table_file.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <new>
#include <string>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/mapped_file.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/file/detail/check_table.h"
#include "sublimit/eval/file/detail/safetensors.h"
#include "sublimit/eval/file/detail/table_tensors.h"

namespace sublimit {
namespace {

class TableReader {
 public:
  TableReader(Safetensors file, const std::string& name, std::shared_ptr<const void> owner, const LoadOptions& options)
      : file_(std::move(file)), name_(name), owner_(std::move(owner)), options_(options) {}

  AnyTable table() const {
    if (text("format") != table_words::format) fail("its metadata has no format = " + std::string(table_words::format));
    if (const auto schema = number("schema", 1, 1'000'000); schema > table_words::schema_version)
      fail("its schema is " + std::to_string(schema) + ", written by " + text("tool", "another program") + "; up to " +
           std::to_string(table_words::schema_version) + " are known here: a newer sublimit reads it");
    if (text("order", table_words::order) != table_words::order)
      fail("metadata: order is '" + text("order") + "', not " + table_words::order);
    const std::string precision = text("precision");
    if (precision != "F32" && precision != "F64") fail("metadata: precision is '" + precision + "', not F32 or F64");
    if (precision == "F32") return table<float>();
    return table<double>();
  }

 private:
  template <class Real>
  BakedTable<Real> table() const {
    BakedTable<Real> baked;
    baked.info = info();
    const auto control_points = static_cast<std::int32_t>(number("control_points", 0, largest_index));
    typename PatternTable<Real>::Arrays a;
    a.quantities = quantities();
    a.weights = array<Real>("weights");
    a.rows = array<std::int32_t>("rows");
    a.columns = array<std::int32_t>("columns");
    a.patch_points = array<std::int64_t>("patch_points");
    a.copies = array<std::int32_t>("copies", 2);
    read_lists<Real>(a);
    a.first = rows<Real>("first.", control_points);
    const auto inputs = a.first ? a.first->num_rows() : control_points;
    if (inputs > largest_index) fail("'first.offsets' makes " + std::to_string(inputs) + " points, too many");
    a.rest = rows<Real>("rest.", static_cast<std::int32_t>(inputs));
    baked.table = checked([&] { return PatternTable<Real>(control_points, std::move(a)); });
    if (baked.table.num_points() != number("points", 0, std::numeric_limits<std::int64_t>::max()))
      fail("metadata: it has " + text("points") + " points; its arrays make " +
           std::to_string(baked.table.num_points()));
    baked.lattices = lattices(baked.table);
    baked.faces = {array<std::int32_t>("faces.sizes"), array<std::int32_t>("faces.corners")};
    baked.addresses = {array<std::int32_t>("addresses.faces"), array<double>("addresses.parameters", 2)};
    baked.row_status = array<std::uint8_t>("row_status");
    baked.rest_status = array<std::uint8_t>("rest_status");
    baked.channels = channels();
    baked.tags = tags();
    checked([&] { check_table(baked); });
    return baked;
  }

  /// Lists of blocks and groups, the only ones that are copied.
  template <class Real>
  void read_lists(typename PatternTable<Real>::Arrays& a) const {
    const auto index = [&](std::int64_t number, const char* what) {
      if (number < 0 || number > largest_index) fail(std::string(what) + " has the number " + std::to_string(number));
      return static_cast<std::int32_t>(number);
    };
    const SharedArray<std::int64_t> blocks = array<std::int64_t>("blocks", 3),
                                    groups = array<std::int64_t>("groups", 4);
    a.blocks.reserve(blocks.size() / 3);
    for (size_t i = 0; i < blocks.size(); i += 3) {
      // Rows of no weights would be as many as anybody likes, and so would patches of no control points.
      if (blocks[i] > std::int64_t(a.weights.size()))
        fail("'blocks' has " + std::to_string(blocks[i]) + " rows; there are " + std::to_string(a.weights.size()) +
             " weights");
      a.blocks.push_back({index(blocks[i], "'blocks'"), index(blocks[i + 1], "'blocks'"), blocks[i + 2]});
    }
    a.groups.reserve(groups.size() / 4);
    for (size_t i = 0; i < groups.size(); i += 4) {
      if (groups[i + 3] > std::int64_t(a.columns.size()))
        fail("'groups' has " + std::to_string(groups[i + 3]) + " patches; there are " +
             std::to_string(a.columns.size()) + " columns");
      a.groups.push_back(
          {index(groups[i], "'groups'"), index(groups[i + 1], "'groups'"), groups[i + 2], groups[i + 3]});
    }
  }

  template <class Real>
  std::optional<StencilTable<Real>> rows(const std::string& prefix, std::int32_t control_points) const {
    SharedArray<std::int64_t> offsets = array<std::int64_t>(prefix + "offsets");
    SharedArray<std::int32_t> columns = array<std::int32_t>(prefix + "columns");
    SharedArray<Real> weights = array<Real>(prefix + "weights");
    if (offsets.empty() && columns.empty() && weights.empty()) return std::nullopt;
    return checked(
        [&] { return StencilTable<Real>(control_points, std::move(offsets), std::move(columns), std::move(weights)); },
        "'" + prefix + "*': ");
  }

  template <class Real>
  std::optional<FaceLattices> lattices(const PatternTable<Real>& table) const {
    FaceLattices::Arrays a;
    if (text("lattice").empty()) return std::nullopt;
    a.lattice = {static_cast<std::int32_t>(number("lattice", 1, 4096)), is_triangle("lattice_shape")};
    // The inside of a face is made by some group or by rows; so little is taken for a lattice that no face can have.
    const std::int64_t made =
        std::int64_t(table.arrays().rows.size()) + (table.arrays().rest ? table.arrays().rest->num_rows() : 0);
    if (a.lattice.size() > 64 + 4 * made)
      fail("metadata: a lattice of " + text("lattice") + " is larger than what " + std::to_string(made) +
           " rows can make");
    const int sides = a.lattice.num_sides();
    a.side_faces = array<std::int32_t>("lattices.side_faces", sides);
    a.side_places = array<std::uint8_t>("lattices.side_places", sides);
    a.corner_faces = array<std::int32_t>("lattices.corner_faces", sides);
    a.corner_places = array<std::uint8_t>("lattices.corner_places", sides);
    a.first_points = array<std::int64_t>("lattices.first_points");
    a.addresses = array<std::int32_t>("lattices.addresses");
    a.places = array<std::uint8_t>("lattices.places");
    a.holes = array<std::uint8_t>("lattices.holes");
    return checked([&] { return FaceLattices(table.num_points(), std::move(a)); });
  }

  TableChannels channels() const {
    TableChannels channels{.list = {}, .interpolation = text("face_varying")};
    for (size_t c = 0;; ++c) {
      const std::string prefix = table_words::face_varying(c);
      const Tensor* const values = file_.find(prefix + "values");
      if (!values) break;
      const std::int64_t columns = values->shape.size() == 2 ? values->shape[1] : 1;
      if (columns < 1 || columns > largest_index)
        fail("'" + values->name + "' has " + std::to_string(columns) + " numbers a value");
      channels.list.push_back({.name = text(prefix + "name"),
                               .channels = static_cast<std::int32_t>(columns),
                               .values = array<double>(values->name, columns),
                               .indices = array<std::int32_t>(prefix + "indices")});
    }
    if (channels.list.empty() && !channels.interpolation.empty())
      fail("metadata: face_varying is '" + channels.interpolation + "', and there is no 'face_varying.0.values'");
    return channels;
  }

  std::optional<TableTags> tags() const {
    if (text("tags.boundary").empty()) return std::nullopt;
    return TableTags{.creases = array<std::int32_t>("tags.creases", 2),
                     .crease_sharpness = array<float>("tags.crease_sharpness"),
                     .corners = array<std::int32_t>("tags.corners"),
                     .corner_sharpness = array<float>("tags.corner_sharpness"),
                     .boundary = text("tags.boundary"),
                     .creasing = text("tags.creasing")};
  }

  TableInfo info() const {
    TableInfo info;
    info.scheme = text("scheme");
    info.tool = text("tool");
    const std::string prefix = table_words::option_prefix;
    for (auto at = file_.metadata.lower_bound(prefix); at != file_.metadata.end() && at->first.starts_with(prefix);
         ++at)
      info.options.emplace(at->first.substr(prefix.size()), at->second);
    const std::optional<TableRows> rows = table_rows(text("rows"));
    if (!rows) fail("metadata: rows is '" + text("rows") + "'; level, limit, grid and samples are right");
    info.rows = *rows;
    info.level = static_cast<int>(number("level", 0, 30, "0"));
    info.grid = static_cast<int>(number("grid", 0, 4097, "0"));
    info.triangles = is_triangle("address_shape");
    if (const std::string coordinates = text("coordinates"); !coordinates.empty()) {
      if (coordinates != table_words::homogeneous)
        fail("metadata: coordinates is '" + coordinates + "'; '" + table_words::homogeneous + "' is right, or no word");
      info.rational = true;
    }
    if (const std::string hash = text("topology_hash"); !hash.empty()) {
      const std::from_chars_result end =
          std::from_chars(hash.data(), hash.data() + hash.size(), info.topology_hash, 16);
      if (end.ec != std::errc() || end.ptr != hash.data() + hash.size() || hash.size() != 16)
        fail("metadata: topology_hash is '" + hash + "', not 16 hexadecimal digits");
    }
    info.statuses = words("statuses");
    for (const std::string& order : words("orders")) {
      if (order != "0" && order != "1" && order != "2")
        fail("metadata: orders has '" + order + "'; 0, 1 and 2 derivatives are right");
      info.orders.push_back(static_cast<std::int8_t>(order[0] - '0'));
    }
    return info;
  }

  int quantities() const {
    const std::string words = text("quantities");
    for (const int n : {1, 3, 6})
      if (words == table_words::quantities(n)) return n;
    fail("metadata: quantities is '" + words + "'; '" + table_words::quantities(1) + "', '" +
         table_words::quantities(3) + "' and '" + table_words::quantities(6) + "' are right");
  }

  bool is_triangle(const std::string& key) const {
    const std::string word = text(key, table_words::shape(false));
    if (word != table_words::shape(false) && word != table_words::shape(true))
      fail("metadata: " + key + " is '" + word + "', not " + table_words::shape(false) + " or " +
           table_words::shape(true));
    return word == table_words::shape(true);
  }

  std::string text(const std::string& key, const std::string& otherwise = "") const {
    const auto at = file_.metadata.find(key);
    return at == file_.metadata.end() ? otherwise : at->second;
  }

  /// With a space between.
  std::vector<std::string> words(const std::string& key) const {
    const std::string all = text(key);
    std::vector<std::string> words;
    for (size_t at = 0; at < all.size();) {
      const size_t end = std::min(all.find(' ', at), all.size());
      words.push_back(all.substr(at, end - at));
      at = end + 1;
    }
    return words;
  }

  std::int64_t number(const std::string& key, std::int64_t least, std::int64_t most,
                      const std::string& otherwise = "") const {
    const std::string value = text(key, otherwise);
    const Parsed<std::int64_t> parsed = parse_number<std::int64_t>(value);
    if (!parsed || parsed.value < least || parsed.value > most)
      fail("metadata: " + key + " is '" + value + "'; a number from " + std::to_string(least) + " to " +
           std::to_string(most) + " is right");
    return parsed.value;
  }

  /// An array where it lies; empty if there is none. Only what lies at an odd place is copied.
  template <class T>
  SharedArray<T> array(const std::string& name, std::int64_t columns = 1) const {
    const Tensor* const found = file_.find(name);
    if (!found) return {};
    if (found->dtype != dtype_of<T>())
      fail("'" + name + "' is of " + sublimit::name(found->dtype) + ", not " + sublimit::name(dtype_of<T>()));
    if (found->shape.size() != (columns == 1 ? 1 : 2) || (columns != 1 && found->shape[1] != columns))
      fail("'" + name + "' must have the shape N" + (columns == 1 ? "" : " x " + std::to_string(columns)));
    if (options_.checksums && matches_checksum(file_, *found) == false)
      fail("'" + name + "': its checksum does not match");
    const size_t size = found->bytes.size() / sizeof(T);
    if (reinterpret_cast<std::uintptr_t>(found->bytes.data()) % alignof(T) == 0)
      return {std::span(reinterpret_cast<const T*>(found->bytes.data()), size), owner_};
    std::vector<T> copy(size);
    if (size > 0) std::memcpy(copy.data(), found->bytes.data(), found->bytes.size());
    return copy;
  }

  /// What `make` returns; what it says of arrays that do not fit becomes a fault of the file.
  template <class Make>
  auto checked(const Make& make, const std::string& what = "") const {
    try {
      return make();
    } catch (const InvalidParameter& error) {
      fail(what + error.what());
    }
  }

  [[noreturn]] void fail(const std::string& what) const { throw FormatError(name_ + ": " + what); }

  static constexpr std::int64_t largest_index = std::numeric_limits<std::int32_t>::max();
  Safetensors file_;
  const std::string& name_;
  std::shared_ptr<const void> owner_;
  LoadOptions options_;
};

}  // namespace

template <class Real>
void save_table(const std::filesystem::path& path, const BakedTable<Real>& table) {
  check_table(table);
  write_safetensors(path, TableTensors(table).file());
}

AnyTable load_table(std::span<const std::byte> bytes, const std::string& name, std::shared_ptr<const void> owner,
                    const LoadOptions& options) {
  try {
    return TableReader(read_safetensors(bytes, name), name, std::move(owner), options).table();
  } catch (const std::bad_alloc&) {
    throw ResourceError(name + ": does not fit into memory");
  }
}

AnyTable load_table(std::vector<std::byte>&& bytes, const std::string& name, const LoadOptions& options) {
  const auto kept = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
  return load_table(std::span(*kept), name, kept, options);
}

AnyTable load_table(const std::filesystem::path& path, const LoadOptions& options) {
  const MappedFile file = map_file(path);
  return load_table(file.bytes, path.string(), file.owner, options);
}

template void save_table(const std::filesystem::path&, const BakedTable<float>&);
template void save_table(const std::filesystem::path&, const BakedTable<double>&);

}  // namespace sublimit
