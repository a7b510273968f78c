// SPDX-License-Identifier: Apache-2.0
#pragma once
// Data of a mesh of a table's points that is the same in every frame: values at the corners of faces, such as texture
// coordinates, and the creases and corners that are left after refinement:
//
//   const auto& baked = std::get<BakedTable<float>>(table.baked());  // table: a Table of eval/table.h
//   for (const FaceVaryingValues& channel : baked.channels.list)
//     std::cout << channel.name << ": " << channel.values.size() / channel.channels << " values\n";
//   if (baked.tags) std::cout << baked.tags->crease_sharpness.size() << " creases are left\n";
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/eval/table/shared_array.h"

namespace sublimit {

/// A face-varying channel: values at corners of faces. The corners at a point have one value or, at a seam, several.
struct FaceVaryingValues {
  std::string name;                   ///< name of the channel
  std::int32_t channels = 0;          ///< how many numbers a value has
  SharedArray<double> values;         ///< #values x channels
  SharedArray<std::int32_t> indices;  ///< index of the value at each corner of `faces_of(table)`
};

/// Face-varying channels of a table; none by default.
struct TableChannels {
  std::vector<FaceVaryingValues> list;  ///< the channels
  /// Where all of them are interpolated linearly, by OpenSubdiv's names: none, corners-only, corners-plus1,
  /// corners-plus2, boundaries, all (`FaceVaryingInterpolation`).
  std::string interpolation;
};

/// Creases and corners that are left on the level of the points: refining the points with these tags continues the
/// refinement. Holes are not included: `faces_of(table)` omits their faces, and refinement continues there as at
/// boundaries.
struct TableTags {
  SharedArray<std::int32_t> creases;    ///< edges, two points each
  SharedArray<float> crease_sharpness;  ///< sharpness of each edge, in levels; >= 10 is infinite
  SharedArray<std::int32_t> corners;    ///< sharp points
  SharedArray<float> corner_sharpness;  ///< sharpness of each of them, in levels; >= 10 is infinite
  std::string boundary;                 ///< rule for boundaries: edge-only, edge-and-corner
  std::string creasing;                 ///< rule for the decay of sharpness: uniform, chaikin
};

/// Checks face-varying channels.
/// @param num_corners  number of corners of the faces between points
/// @throws InvalidParameter  arrays that do not fit together, a number out of range, an unknown interpolation
void check_channels(const TableChannels& channels, std::int64_t num_corners);
/// Checks tags.
/// @param num_points  number of points of the table
/// @throws InvalidParameter  arrays that do not fit together, a number out of range, an unknown rule
void check_tags(const TableTags& tags, std::int64_t num_points);

}  // namespace sublimit
