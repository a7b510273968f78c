// SPDX-License-Identifier: Apache-2.0
#pragma once
// What `info` prints of a mesh in `sublimit` and in `sublimit-mpi`. `Info` is MeshInfo or SpreadInfo.
#include <fmt/core.h>

#include <string>

#include "support/mesh_options.h"

namespace sublimit::cli {

/// Returns a histogram as text: "4 x 120, 5 x 2".
template <class Histogram>
std::string in_words(const Histogram& histogram) {
  std::string text;
  for (const auto& [key, count] : histogram) text += fmt::format("{}{} x {}", text.empty() ? "" : ", ", key, count);
  return text.empty() ? "none" : text;
}

/// Prints counts, valences, boundaries, tags and rules.
/// @param program  name of the program whose `sample` takes the addresses
template <class Info>
void print_counts(const Info& info, const std::string& name, const char* program) {
  fmt::print("{}\n", name);
  fmt::print("  {} vertices, {} edges, {} faces; Euler characteristic {}, {} component(s)\n", info.vertices, info.edges,
             info.faces, info.euler_characteristic, info.components);
  fmt::print("  face sizes         {}\n", in_words(info.face_sizes));
  if (info.why_not.empty())
    fmt::print("  addresses          faces 0 to {} of `{} sample`: {}\n", info.addresses - 1, program,
               info.triangles ? "the triangles" : "a quad is one, another polygon one a corner");
  fmt::print("  interior valences  {}\n", in_words(info.interior_valences));
  fmt::print("  boundary valences  {}\n", in_words(info.boundary_valences));
  fmt::print("  boundary loops     {}\n", info.boundary_loops);
  fmt::print("  tags               {} creases, {} corners, {} holes\n", info.creases, info.corners, info.holes);
  fmt::print("  rules              boundary {}, creasing {}, triangles {}\n", info.boundary, info.creasing,
             info.smooth_triangles);
}

/// Prints whether the scheme takes the mesh, if one was asked about.
template <class Info>
void print_verdict(const Info& info) {
  if (info.scheme.empty()) return;
  fmt::print("  {:<18} {}\n", info.scheme + ":",
             info.why_not.empty() ? "takes this mesh" : "no: " + in_words_of_the_program(info.why_not));
}

template <class Info>
void print_warnings(const Info& info) {
  for (const std::string& warning : info.warnings) fmt::print("  warning: {}\n", warning);
}

}  // namespace sublimit::cli
