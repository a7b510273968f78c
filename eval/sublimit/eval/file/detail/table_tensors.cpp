// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/file/detail/table_tensors.h"

#include <charconv>
#include <string>
#include <utility>

namespace sublimit {

template <class T>
void TableTensors::add(const std::string& name, std::span<const T> items, std::int64_t columns) {
  if (items.empty()) return;
  std::vector<std::int64_t> shape{std::int64_t(items.size()) / columns};
  if (columns != 1) shape.push_back(columns);
  file_.tensors.push_back(tensor(name, items, std::move(shape)));
}

template <class Real>
void TableTensors::add(const std::string& prefix, const StencilTable<Real>& table) {
  add(prefix + "offsets", table.offsets().span());
  add(prefix + "columns", table.columns().span());
  add(prefix + "weights", table.weights().span());
}

void TableTensors::add(const FaceLattices::Arrays& a) {
  const int sides = a.lattice.num_sides();
  add("lattices.side_faces", a.side_faces.span(), sides);
  add("lattices.side_places", a.side_places.span(), sides);
  add("lattices.corner_faces", a.corner_faces.span(), sides);
  add("lattices.corner_places", a.corner_places.span(), sides);
  add("lattices.first_points", a.first_points.span());
  add("lattices.addresses", a.addresses.span());
  add("lattices.places", a.places.span());
  add("lattices.holes", a.holes.span());
  file_.metadata["lattice"] = std::to_string(a.lattice.n);
  file_.metadata["lattice_shape"] = table_words::shape(a.lattice.triangle);
}

void TableTensors::add(const TableChannels& channels) {
  for (size_t c = 0; c < channels.list.size(); ++c) {
    const FaceVaryingValues& channel = channels.list[c];
    const std::string prefix = table_words::face_varying(c);
    add(prefix + "values", channel.values.span(), channel.channels);
    add(prefix + "indices", channel.indices.span());
    file_.metadata[prefix + "name"] = channel.name;
  }
  if (!channels.list.empty()) file_.metadata["face_varying"] = channels.interpolation;
}

void TableTensors::add(const TableTags& tags) {
  add("tags.creases", tags.creases.span(), 2);
  add("tags.crease_sharpness", tags.crease_sharpness.span());
  add("tags.corners", tags.corners.span());
  add("tags.corner_sharpness", tags.corner_sharpness.span());
  file_.metadata["tags.boundary"] = tags.boundary;
  file_.metadata["tags.creasing"] = tags.creasing;
}

template <class Real>
TableTensors::TableTensors(const BakedTable<Real>& table) {
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
  add(table.channels);
  if (table.tags) add(*table.tags);

  const TableInfo& info = table.info;
  auto& m = file_.metadata;
  m["format"] = table_words::format;
  m["schema"] = std::to_string(table_words::schema_of(info));
  m["order"] = table_words::order;
  m["precision"] = name(dtype_of<Real>());
  m["quantities"] = table_words::quantities(a.quantities);
  m["control_points"] = std::to_string(table.table.num_control_points());
  m["points"] = std::to_string(table.table.num_points());
  m["rows"] = name(info.rows);
  m["level"] = std::to_string(info.level);
  m["grid"] = std::to_string(info.grid);
  m["address_shape"] = table_words::shape(info.triangles);
  if (info.rational) m["coordinates"] = table_words::homogeneous;
  if (!info.scheme.empty()) m["scheme"] = info.scheme;
  if (!info.tool.empty()) m["tool"] = info.tool;
  for (const auto& [key, value] : info.options) m[std::string(table_words::option_prefix) + key] = value;
  if (info.topology_hash != 0) {
    char digits[16];
    const std::to_chars_result end = std::to_chars(digits, digits + 16, info.topology_hash, 16);
    m["topology_hash"] = std::string(size_t(digits + 16 - end.ptr), '0') + std::string(digits, end.ptr);
  }
  for (const std::string& status : info.statuses) {
    std::string& words = m["statuses"];
    words += (words.empty() ? "" : " ") + status;
  }
  for (const int order : info.orders) {
    std::string& words = m["orders"];
    words += (words.empty() ? "" : " ") + std::to_string(order);
  }
}

template TableTensors::TableTensors(const BakedTable<float>&);
template TableTensors::TableTensors(const BakedTable<double>&);

}  // namespace sublimit
