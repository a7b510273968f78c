// SPDX-License-Identifier: Apache-2.0
#pragma once
// The words for rules in files, tables and options. Each list has the order of the enumerators of mesh/mesh.h.
// Words for face-varying channels are those of OpenSubdiv.
#include <array>

namespace sublimit {

inline constexpr std::array boundary_words{"none", "edge-only", "edge-and-corner"};
/// A word of options alone: edge-only, and border vertices are corners.
inline constexpr const char* fixed_boundary = "fixed";
inline constexpr std::array boundary_and_fixed_words{"none", "edge-only", "edge-and-corner", fixed_boundary};
inline constexpr std::array creasing_words{"uniform", "chaikin"};
inline constexpr std::array triangles_words{"catmark", "smooth"};
inline constexpr std::array face_varying_words{"none",          "corners-only", "corners-plus1",
                                               "corners-plus2", "boundaries",   "all"};

inline constexpr std::array attributes_words{"smooth", "linear", "drop"};

}  // namespace sublimit
