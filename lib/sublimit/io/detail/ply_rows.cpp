// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/ply_rows.h"

#include <algorithm>

namespace sublimit {
namespace {

[[noreturn]] void fail(const PlyElement& element, const std::string& file, const std::string& what) {
  throw FormatError(file + ":" + format_number(element.line) + ": " + what);
}

/// Position of a named property; its names are unique.
std::size_t find(const PlyElement& element, const std::string& file, std::string_view name) {
  const auto is_it = [&](const PlyProperty& property) { return property.name == name; };
  const auto found = std::ranges::find_if(element.properties, is_it);
  if (std::count_if(found, element.properties.end(), is_it) > 1)
    fail(element, file, "element '" + element.name + "' has two properties " + in_quotes(name));
  return static_cast<std::size_t>(found - element.properties.begin());
}

}  // namespace

const PlyElement& require_element(const PlyHeader& header, const std::string& file, std::string_view name,
                                  std::string_view properties) {
  const auto found = std::ranges::find(header.elements, name, &PlyElement::name);
  if (found == header.elements.end())
    throw InvalidMesh(file + ": no element '" + std::string(name) + "'; a mesh should have one with " +
                      std::string(properties));
  if (found->count == 0) throw InvalidMesh(file + ": no elements '" + std::string(name) + "'; a mesh should have some");
  return *found;
}

std::vector<std::string> names_of_numbers(const PlyElement& element, std::span<const std::string_view> except) {
  std::vector<std::string> names;
  for (const PlyProperty& property : element.properties)
    if (!property.length && std::ranges::find(except, property.name) == except.end() &&
        std::ranges::count(element.properties, property.name, &PlyProperty::name) == 1)
      names.push_back(property.name);
  return names;
}

std::size_t find_indices(const PlyElement& element, const std::string& file) {
  const auto& properties = element.properties;
  std::size_t list = find(element, file, "vertex_indices");
  if (list == properties.size()) list = find(element, file, "vertex_index");
  if (list == properties.size() || !properties[list].length)
    fail(element, file, "element '" + element.name + "' has no list 'vertex_indices' or 'vertex_index'");
  if (!is_integer(properties[list].type)) fail(element, file, "indices of vertices should have an integer type");
  return list;
}

PlyVertices::PlyVertices(const PlyElement& vertex, const std::string& file, std::span<const std::string> further)
    : vertex_(&vertex), column_(vertex.properties.size(), -1) {
  const auto number_named = [&](std::string_view name) {
    const std::size_t found = find(vertex, file, name);
    return found < column_.size() && !vertex.properties[found].length ? found : column_.size();
  };
  for (int k = 0; k < 3; ++k) {
    const std::string name(1, "xyz"[k]);
    const std::size_t found = number_named(name);
    if (found == column_.size())
      fail(vertex, file, "element 'vertex' has no number '" + name + "'; it should have x, y and z");
    column_[found] = k;
  }
  for (const std::string& name : further) {
    const std::size_t found = number_named(name);
    if (found == column_.size()) continue;
    column_[found] = static_cast<int>(3 + further_.size());
    further_.push_back(&vertex.properties[found]);
  }
}

PlyFaces::PlyFaces(const PlyElement& face, const std::string& file, std::int64_t num_vertices,
                   std::span<const std::string> further)
    : face_(&face),
      file_(file),
      num_vertices_(num_vertices),
      list_(find_indices(face, file)),
      texture_(face.properties.size()),
      column_(face.properties.size(), -1) {
  for (std::size_t i = 0; i < face.properties.size(); ++i) {
    const PlyProperty& property = face.properties[i];
    if (property.length && property.name == "texcoord") texture_ = i;
    if (property.length || std::ranges::find(further, property.name) == further.end()) continue;
    column_[i] = static_cast<int>(further_.size());
    further_.push_back(&property);
  }
}

}  // namespace sublimit
