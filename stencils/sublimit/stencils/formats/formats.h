// SPDX-License-Identifier: Apache-2.0
#pragma once
// The table of all file formats: those of meshes, curves and CAD files (io/detail/formats.h), and those of the offline
// part. What a subcommand reads or writes is a content; the extensions that it takes are the rows with that content.
//
//   all_formats().writers({contents::meshes, contents::arrays})  // ".obj", ".ply", ".npy"
#include "sublimit/io/detail/formats.h"

namespace sublimit {

namespace contents {
inline constexpr Content arrays{"arrays"};              ///< points by channels, also in many frames
inline constexpr Content matrices{"matrices"};          ///< sparse matrices
inline constexpr Content tables{"tables"};              ///< what `sublimit bake` writes
inline constexpr Content table_rows{"rows of tables"};  ///< tables as matrices for other programs
inline constexpr Content cells{"Bezier cells"};         ///< polynomials of a surface
inline constexpr Content recipes{"recipes"};            ///< of curves, surfaces and fields
inline constexpr Content reports{"reports"};            ///< results as data
inline constexpr Content jobs{"jobs"};                  ///< one a line
inline constexpr Content pages{"pages"};                ///< reports for people
inline constexpr Content pictures{"pictures"};
}  // namespace contents

/// Returns the formats of `io_formats()`, followed by those of the offline part.
const FileFormats& all_formats();

}  // namespace sublimit
