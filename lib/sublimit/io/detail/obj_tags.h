// SPDX-License-Identifier: Apache-2.0
#pragma once
// The `t` lines of an OBJ file (their meaning: obj.h). They may come before the vertices and faces that they name, so
// what they point at is checked at the end.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/io/detail/text_scanner.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit {

class ObjTags {
 public:
  /// Reads the rest of a line behind its `t` into the mesh.
  void read(TextScanner& scanner, Mesh& mesh);
  /// Checks every tag against the whole mesh, whose faces are valid. Creases where no face has an edge are taken out,
  /// with a warning.
  /// @throws InvalidMesh  an id out of range, an interval where no face has an edge; with the line of the tag
  void settle(const TextScanner& scanner, Mesh& mesh) const;

 private:
  struct Arguments;
  void read_crease(const TextScanner& scanner, const Arguments& arguments, Mesh& mesh);
  void read_corner(const TextScanner& scanner, const Arguments& arguments, Mesh& mesh);
  void read_knot_interval(const TextScanner& scanner, const Arguments& arguments, Mesh& mesh);
  void read_hole(const TextScanner& scanner, const Arguments& arguments, Mesh& mesh);
  void skip(const TextScanner& scanner, std::string_view name, const char* why, Mesh& mesh);

  std::vector<std::int64_t> crease_lines_, corner_lines_, hole_lines_, interval_lines_;  // of each entry in the mesh
  std::vector<std::string> skipped_;                                                     // names warned about
};

}  // namespace sublimit
