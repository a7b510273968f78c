// SPDX-License-Identifier: Apache-2.0
#include "sublimit/table_file.h"

#include <charconv>
#include <cstring>
#include <limits>
#include <new>
#include <string>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/base/format_number.h"
#include "sublimit/base/mapped_file.h"
#include "sublimit/check_table.h"
#include "sublimit/safetensors.h"

namespace sublimit {
namespace {

constexpr const char* format_word = "sublimit-table";
constexpr int schema_version = 1;
/// One quantity after the other, each for all points.
constexpr const char* order_word = "quantity,point";
const std::string option_prefix = "option.";

const char* quantity_words(int quantities) {
  return quantities == 1 ? "x" : quantities == 3 ? "x xu xv" : "x xu xv xuu xuv xvv";
}
const char* shape_word(bool triangles) { return triangles ? "triangle" : "quadrilateral"; }

// Writing.

class TableWriter {
 public:
  template <class Real>
  void add(const BakedTable<Real>& table) {
    const typename PatternTable<Real>::Arrays& a = table.table.arrays();
    for (const auto& block : a.blocks) blocks_.insert(blocks_.end(), {block.rows, block.columns, block.weights});
    for (const auto& g : a.groups) groups_.insert(groups_.end(), {g.block, g.num_rows, g.rows, g.num_patches});
    add("blocks", std::span<const std::int64_t>(blocks_), 3);
    add("groups", std::span<const std::int64_t>(groups_), 4);
    add("weights", a.weights.span());
    add("rows", a.rows.span());
    add("columns", a.columns.span());
    add("patch_points", a.patch_points.span());
    add("copies", a.copies.span(), 2);
    if (a.first) add("first.", *a.first);
    if (a.rest) add("rest.", *a.rest);
    if (table.lattices) add(table.lattices->arrays());
    add("faces.sizes", table.faces.sizes.span());
    add("faces.corners", table.faces.corners.span());
    add("addresses.faces", table.addresses.faces.span());
    add("addresses.parameters", table.addresses.parameters.span(), 2);
    add("row_status", table.row_status.span());
    add("rest_status", table.rest_status.span());

    const TableInfo& info = table.info;
    auto& m = file.metadata;
    m["format"] = format_word;
    m["schema"] = std::to_string(schema_version);
    m["order"] = order_word;
    m["precision"] = name(dtype_of<Real>());
    m["quantities"] = quantity_words(a.quantities);
    m["control_points"] = std::to_string(table.table.num_control_points());
    m["points"] = std::to_string(table.table.num_points());
    m["rows"] = name(info.rows);
    m["level"] = std::to_string(info.level);
    m["grid"] = std::to_string(info.grid);
    m["addresses"] = shape_word(info.triangles);
    if (!info.scheme.empty()) m["scheme"] = info.scheme;
    if (!info.tool.empty()) m["tool"] = info.tool;
    for (const auto& [key, value] : info.options) m[option_prefix + key] = value;
    if (info.topology_hash != 0) {
      char digits[16];
      const std::to_chars_result end = std::to_chars(digits, digits + 16, info.topology_hash, 16);
      m["topology_hash"] = std::string(size_t(digits + 16 - end.ptr), '0') + std::string(digits, end.ptr);
    }
    for (const std::string& status : info.statuses) {
      std::string& words = m["statuses"];
      words += (words.empty() ? "" : " ") + status;
    }
  }

  Safetensors file;

 private:
  /// Arrays without entries are left out.
  template <class T>
  void add(const std::string& name, std::span<const T> items, std::int64_t columns = 1) {
    if (items.empty()) return;
    std::vector<std::int64_t> shape{std::int64_t(items.size()) / columns};
    if (columns != 1) shape.push_back(columns);
    file.tensors.push_back(tensor(name, items, std::move(shape)));
  }
  template <class Real>
  void add(const std::string& prefix, const StencilTable<Real>& table) {
    add(prefix + "offsets", table.offsets().span());
    add(prefix + "columns", table.columns().span());
    add(prefix + "weights", table.weights().span());
  }
  void add(const FaceLattices::Arrays& a) {
    const int sides = a.lattice.num_sides();
    add("lattices.side_faces", a.side_faces.span(), sides);
    add("lattices.side_places", a.side_places.span(), sides);
    add("lattices.corner_faces", a.corner_faces.span(), sides);
    add("lattices.corner_places", a.corner_places.span(), sides);
    add("lattices.first_points", a.first_points.span());
    add("lattices.addresses", a.addresses.span());
    add("lattices.places", a.places.span());
    add("lattices.holes", a.holes.span());
    file.metadata["lattice"] = std::to_string(a.lattice.n);
    file.metadata["lattice_shape"] = shape_word(a.lattice.triangle);
  }

  std::vector<std::int64_t> blocks_, groups_;
};

// Reading.

class TableReader {
 public:
  TableReader(Safetensors file, const std::string& name, std::shared_ptr<const void> owner, const LoadOptions& options)
      : file_(std::move(file)), name_(name), owner_(std::move(owner)), options_(options) {}

  AnyTable table() const {
    if (text("format") != format_word) fail("its metadata has no format = " + std::string(format_word));
    if (const auto schema = number("schema", 1, 1'000'000); schema > schema_version)
      fail("its schema is " + std::to_string(schema) + ", written by " + text("tool", "another program") + "; up to " +
           std::to_string(schema_version) + " are known here: a newer sublimit reads it");
    if (text("order", order_word) != order_word) fail("metadata: order is '" + text("order") + "', not " + order_word);
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
    for (size_t i = 0; i < blocks.size(); i += 3)
      a.blocks.push_back({index(blocks[i], "'blocks'"), index(blocks[i + 1], "'blocks'"), blocks[i + 2]});
    a.groups.reserve(groups.size() / 4);
    for (size_t i = 0; i < groups.size(); i += 4) {
      // Patches of no control points would be as many as anybody likes.
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

  TableInfo info() const {
    TableInfo info;
    info.scheme = text("scheme");
    info.tool = text("tool");
    for (auto at = file_.metadata.lower_bound(option_prefix);
         at != file_.metadata.end() && at->first.starts_with(option_prefix); ++at)
      info.options.emplace(at->first.substr(option_prefix.size()), at->second);
    const std::optional<TableRows> rows = table_rows(text("rows"));
    if (!rows) fail("metadata: rows is '" + text("rows") + "'; level, limit, grid and samples are right");
    info.rows = *rows;
    info.level = static_cast<int>(number("level", 0, 30, "0"));
    info.grid = static_cast<int>(number("grid", 0, 4097, "0"));
    info.triangles = is_triangle("addresses");
    if (const std::string hash = text("topology_hash"); !hash.empty()) {
      const std::from_chars_result end =
          std::from_chars(hash.data(), hash.data() + hash.size(), info.topology_hash, 16);
      if (end.ec != std::errc() || end.ptr != hash.data() + hash.size() || hash.size() != 16)
        fail("metadata: topology_hash is '" + hash + "', not 16 hexadecimal digits");
    }
    const std::string statuses = text("statuses");
    for (size_t at = 0; at < statuses.size();) {
      const size_t end = std::min(statuses.find(' ', at), statuses.size());
      info.statuses.push_back(statuses.substr(at, end - at));
      at = end + 1;
    }
    return info;
  }

  int quantities() const {
    const std::string words = text("quantities");
    for (const int n : {1, 3, 6})
      if (words == quantity_words(n)) return n;
    fail("metadata: quantities is '" + words + "'; '" + quantity_words(1) + "', '" + quantity_words(3) + "' and '" +
         quantity_words(6) + "' are right");
  }

  bool is_triangle(const std::string& key) const {
    const std::string word = text(key, shape_word(false));
    if (word != shape_word(false) && word != shape_word(true))
      fail("metadata: " + key + " is '" + word + "', not " + shape_word(false) + " or " + shape_word(true));
    return word == shape_word(true);
  }

  std::string text(const std::string& key, const std::string& otherwise = "") const {
    const auto at = file_.metadata.find(key);
    return at == file_.metadata.end() ? otherwise : at->second;
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
  TableWriter writer;
  writer.add(table);
  write_safetensors(path, std::move(writer.file));
}

AnyTable load_table(std::span<const std::byte> bytes, const std::string& name, std::shared_ptr<const void> owner,
                    const LoadOptions& options) {
  try {
    return TableReader(read_safetensors(bytes, name), name, std::move(owner), options).table();
  } catch (const std::bad_alloc&) {
    throw ResourceError(name + ": does not fit into memory");
  }
}

AnyTable load_table(const std::filesystem::path& path, const LoadOptions& options) {
  const MappedFile file = map_file(path);
  return load_table(file.bytes, path.string(), file.owner, options);
}

template void save_table(const std::filesystem::path&, const BakedTable<float>&);
template void save_table(const std::filesystem::path&, const BakedTable<double>&);

}  // namespace sublimit
