// SPDX-License-Identifier: Apache-2.0
#pragma once
// Values of vertices and of faces in Python: name, numbers and the type that files have, as NumPy calls it. Names are
// bytes, since names in files need not be UTF-8.
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "arrays.h"
#include "sublimit/base/error.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit::python {

/// Names of the types, in the order of `ValueType`.
inline constexpr std::array value_types{"int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"};

/// Name, numbers and type of each value.
using ValueRows = std::vector<std::tuple<std::string, Array<double>, std::string>>;

/// Returns the values of a mesh.
/// @throws InvalidOption  another type
inline std::vector<Mesh::Values> mesh_values(const ValueRows& rows) {
  std::vector<Mesh::Values> all;
  for (const auto& [name, numbers, type] : rows) {
    const auto* const found = std::ranges::find(value_types, type);
    if (found == value_types.end()) throw InvalidOption("'" + type + "' is no type of values");
    all.push_back({name, vector(numbers), ValueType(found - value_types.begin())});
  }
  return all;
}

/// Returns the values in the form of `ValueRows`.
/// @param numbers_of  makes an array of the numbers of one
template <class NumbersOf>
py::list value_rows(const std::vector<Mesh::Values>& values, const NumbersOf& numbers_of) {
  py::list all;
  for (const Mesh::Values& one : values)
    all.append(py::make_tuple(py::bytes(one.name), numbers_of(one.values), value_types[size_t(one.type)]));
  return all;
}

}  // namespace sublimit::python
