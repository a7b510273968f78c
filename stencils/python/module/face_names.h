// SPDX-License-Identifier: Apache-2.0
#pragma once
// Names of faces in Python: one for each face, empty if it has none. They are bytes, since names in files need
// not be UTF-8.
#include <pybind11/pybind11.h>

#include <map>
#include <string>
#include <vector>

#include "sublimit/mesh/mesh.h"

namespace sublimit::python {

/// Returns the names of a mesh's faces.
/// @param names  one name for each face; empty: no face has a name
inline Mesh::FaceNames face_names(const std::vector<std::string>& names) {
  Mesh::FaceNames all;
  std::map<std::string, Index> known;
  for (const std::string& name : names) {
    const auto [found, is_new] = known.try_emplace(name, Index(all.names.size()));
    if (is_new && !name.empty()) all.names.push_back(name);
    all.of_face.push_back(name.empty() ? -1 : found->second);
  }
  return all;
}

/// Returns one name for each face; an empty list if no face has one.
inline pybind11::list names_by_face(const Mesh::FaceNames& names) {
  pybind11::list all;
  for (const Index name : names.of_face) all.append(pybind11::bytes(name < 0 ? "" : names.names[size_t(name)]));
  return all;
}

}  // namespace sublimit::python
