// SPDX-License-Identifier: Apache-2.0
#pragma once
// Layers of Universal Scene Description as text (`.usda`): a tree of prims with their properties. Values stay text
// until they are asked for (usd_values.h), and everything knows its place in the file, so that a part can be replaced
// while all else stays byte for byte.
//
//   const auto layer = parse_usda(read_file("scene.usda"), "scene.usda");
//   for (const UsdSpec& prim : layer->root.children) std::cout << prim.type << " " << prim.name << "\n";
//
// Read: prims of the three specifiers, attributes with values, time samples and connections, relationships, metadata,
// edits of lists, variants, comments. Source: OpenUSD, "Usda file format" (2024).
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace sublimit {

/// An entry of metadata, `prepend references = @a.usda@</A>`; views into the layer.
struct UsdField {
  std::string_view edit = {};   ///< prepend, append, add, delete, reorder; empty: none
  std::string_view key = {};    ///< empty: a text alone, which is a comment
  std::string_view value = {};  ///< without blanks around it
};

/// An attribute or a relationship: a declaration, a value, or one of the further parts of it.
struct UsdProperty {
  std::string_view edit = {};
  bool uniform = false;
  std::string_view type = {};   ///< `point3f[]`; `rel` for a relationship
  std::string_view name = {};   ///< `primvars:st:indices`
  std::string_view part = {};   ///< `timeSamples`, `connect`, ...; empty: the value itself
  std::string_view value = {};  ///< without blanks around it; empty: there is none
  std::vector<UsdField> metadata = {};
  std::string_view text = {};  ///< the whole statement
};

/// A prim as one layer has it.
struct UsdSpec {
  std::string_view specifier = {};  ///< def, over or class
  std::string_view type = {};       ///< `Mesh`; empty: none is said
  std::string_view name = {};
  std::vector<UsdField> metadata = {};
  std::vector<UsdProperty> properties = {};
  std::vector<UsdSpec> children = {};
  std::vector<UsdSpec> variants = {};  ///< of all sets, each with what it brings
  std::string_view set = {};           ///< of a variant: the name of its set
  std::string_view text = {};          ///< from the specifier to the closing brace
  std::string_view body = {};          ///< between its braces

  /// Places of properties by "name.part", where they are many; the last one of a name.
  std::unordered_map<std::string, std::size_t> by_name = {};

  /// Returns an entry of metadata; null if there is none.
  const UsdField* field(std::string_view key) const;
  /// Returns a property by its name and part; null if there is none. The last one wins.
  const UsdProperty* property(std::string_view named, std::string_view part = {}) const;
};

/// A layer. It owns the text that all views are of.
struct UsdLayer {
  std::string name;  ///< of the file, with which messages start
  std::string text;
  UsdSpec root;                    ///< metadata of the layer, and its prims
  std::vector<std::size_t> lines;  ///< ends of the lines of the text

  UsdLayer() = default;
  UsdLayer(const UsdLayer&) = delete;
  UsdLayer& operator=(const UsdLayer&) = delete;

  /// Returns "NAME:LINE: " of a place in the text.
  std::string place(std::string_view part) const;
};

/// Returns the spec of a path, "/World/Cube", in a layer; null if it has none. Variants are not looked at.
const UsdSpec* find_usd_spec(const UsdSpec& root, std::string_view path);

/// Reads a layer.
/// @throws FormatError  not text, not USD as text, a statement that cannot be read; with its line
std::shared_ptr<const UsdLayer> parse_usda(std::string text, std::string name);

/// Returns the end of a value that begins at `at`, for code that walks over values: texts, paths, assets and groups in
/// brackets are skipped whole. `at` itself if there is no value.
/// @return  `npos` if the value does not end
std::size_t end_of_usd_value(std::string_view text, std::size_t at);

}  // namespace sublimit
