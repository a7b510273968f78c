// SPDX-License-Identifier: Apache-2.0
#pragma once
// Values of a layer of USD: numbers, texts, paths, files of references, samples in time. All of them take the text of
// a value and throw FormatError with the line of what is wrong.
//
//   usd_numbers(layer, property.value, "points", usd_type(property.type)->width)  // x y z x y z ...
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sublimit/io/detail/usda.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// A type of numbers, such as `texCoord2f[]`.
struct UsdType {
  int width = 1;  ///< numbers of one value
  bool is_array = false;
  ValueType numbers = ValueType::float64;
};
/// Returns a type by its name; absent if its values are no numbers, or whole numbers of 64 bits.
std::optional<UsdType> usd_type(std::string_view name);

/// True if a value is `None`, which hides weaker ones.
inline bool is_blocked(std::string_view value) { return value == "None"; }

/// Returns the numbers of a value or of a list of values, one after the other.
/// @param what   name of the property, for messages
/// @param width  numbers of each value; those of one value are in parentheses
std::vector<double> usd_numbers(const UsdLayer& layer, std::string_view value, std::string_view what, int width);
/// Returns whole numbers.
/// @param least, most  the range they should be in
std::vector<Index> usd_indices(const UsdLayer& layer, std::string_view value, std::string_view what, Index least,
                               Index most);
/// Returns the texts of a value or a list, without quotes.
std::vector<std::string> usd_texts(const UsdLayer& layer, std::string_view value, std::string_view what);
/// Returns the paths of a value or a list, without `<` and `>`.
std::vector<std::string> usd_paths(std::string_view value);

/// Returns the entries of a dictionary, `{ string name = value }`: names, and values as text.
std::vector<std::pair<std::string, std::string_view>> usd_dictionary(std::string_view value);

/// What a reference leads to.
struct UsdReference {
  std::string file = {};  ///< empty: the same layer
  std::string path = {};  ///< empty: the layer's default prim
  std::string_view text;  ///< the entry, for messages
  bool moved_in_time = false;
};
/// Returns the references of a value or a list.
std::vector<UsdReference> usd_references(std::string_view value);

/// Returns the samples of `{ 1: a, 2: b }`, in the order of their times.
std::vector<std::pair<double, std::string_view>> usd_samples(const UsdLayer& layer, std::string_view value,
                                                             std::string_view what);

}  // namespace sublimit
