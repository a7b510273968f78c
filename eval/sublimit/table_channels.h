// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a mesh of a table's points has besides them: values at the corners of faces, such as texture coordinates, and
// the tags that refinement has left. Both are the same in every frame.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/shared_array.h"

namespace sublimit {

/// A face-varying channel: a point has one value or, at a seam, several.
struct FaceVaryingValues {
  std::string name;
  std::int32_t channels = 0;          ///< numbers of a value
  SharedArray<double> values;         ///< #values x channels
  SharedArray<std::int32_t> indices;  ///< value of each corner of `faces_of(table)`, in its order
};

/// Face-varying channels of a table; none by default.
struct TableChannels {
  std::vector<FaceVaryingValues> list;
  /// Where they are linear, by OpenSubdiv's names: none, corners-only, corners-plus1, corners-plus2, boundaries, all.
  std::string interpolation;
};

/// What is left of creases and corners: refining the points with these goes on where the table stopped. Holes are no
/// part of it: `faces_of(table)` leaves their faces out, and where there were holes refinement goes on as at borders.
struct TableTags {
  SharedArray<std::int32_t> creases;    ///< pairs of points, each an edge
  SharedArray<float> crease_sharpness;  ///< levels; >= 10 is infinite
  SharedArray<std::int32_t> corners;    ///< points
  SharedArray<float> corner_sharpness;  ///< the same
  std::string boundary;                 ///< the rule for borders: edge-only, edge-and-corner
  std::string creasing;                 ///< how sharpness decays: uniform, chaikin
};

/// Checks texture coordinates.
/// @param num_corners  of the faces between points
/// @throws InvalidParameter  arrays that do not fit together, a number out of range
void check_channels(const TableChannels& channels, std::int64_t num_corners);
/// Checks tags.
/// @param num_points  that their indices count
/// @throws InvalidParameter  arrays that do not fit together, a number out of range, a word that is none of those above
void check_tags(const TableTags& tags, std::int64_t num_points);

}  // namespace sublimit
