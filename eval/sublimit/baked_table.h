// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table with what it was made of: enough to write a mesh of the points that it makes, and to refuse another cage.
#include <map>
#include <optional>
#include <string>

#include "sublimit/face_lattices.h"
#include "sublimit/pattern_table.h"
#include "sublimit/table_channels.h"

namespace sublimit {

/// What points a table makes.
enum class TableRows {
  level,    ///< vertices of level k
  limit,    ///< the same, moved to the limit
  grid,     ///< N x N places on each address face (triangles N (N + 1) / 2), face by face, u fastest
  samples,  ///< a list of places (face, u, v), one after the other
};
/// "level", "limit", "grid", "samples".
const char* name(TableRows rows);
std::optional<TableRows> table_rows(const std::string& name);

struct TableInfo {
  std::string scheme;
  std::map<std::string, std::string> options;  ///< of the scheme, and the rules: boundary, creasing, triangles
  TableRows rows = TableRows::level;
  int level = 0;                      ///< k, of `level` and `limit`
  int grid = 0;                       ///< N, of `grid`
  bool triangles = false;             ///< addresses are triangles
  std::uint64_t topology_hash = 0;    ///< of the cage; 0: not known
  std::string tool;                   ///< name and version of what made it
  std::vector<std::string> statuses;  ///< what the numbers of statuses stand for: "regular", ...
  /// Derivatives that exist at points of each status, 0 to 2, as many: rows of the others are zero, or two tangents
  /// that no parameter belongs to. None: all that the table has.
  std::vector<std::int8_t> orders;
  /// Control points are homogeneous columns (w x, w y, w z, w), and so is what the weights make of them: the points are
  /// the quotients, see `Evaluation::rational`. Texture coordinates are none of these.
  bool rational = false;
};

/// 64 bits of the connectivity of a cage, the same on all machines. Tags and positions are no part of it.
/// @param sizes    corners of each face
/// @param corners  their vertices, face by face
std::uint64_t topology_hash(std::int32_t num_vertices, std::span<const std::int32_t> sizes,
                            std::span<const std::int32_t> corners);

/// Faces as sizes and corners, counter-clockwise.
struct [[nodiscard]] FaceList {
  SharedArray<std::int32_t> sizes, corners;
};

/// Where points are, one by one: (face, u, v).
struct SampleAddresses {
  SharedArray<std::int32_t> faces;
  SharedArray<double> parameters;  ///< #points x 2
};

template <class Real>
struct BakedTable {
  PatternTable<Real> table;
  TableInfo info;
  /// Of tables by patterns: how points lie on faces.
  std::optional<FaceLattices> lattices;
  /// Of tables by rows, and of lists of places that have them: the faces between points.
  FaceList faces;
  /// Of lists of places: these.
  SampleAddresses addresses;
  /// What is there at a point of the limit, as a number of `TableInfo::statuses`: for every entry of the table's
  /// `rows`, and for the points of `rest`. None: all points are `regular`.
  SharedArray<std::uint8_t> row_status, rest_status;
  /// Of `level` and `limit`, where they were asked for: texture coordinates of level k, or of its limit; tags of level
  /// k.
  TableChannels channels = {};
  std::optional<TableTags> tags = {};
};

/// Status of each point, in their order; empty if all are regular.
template <class Real>
std::vector<std::uint8_t> statuses_of(const BakedTable<Real>& table);

[[nodiscard]] BakedTable<float> in_float(const BakedTable<double>& table);

/// The faces that a table's points make, those of holes left out: what a mesh is written with.
/// @throws ResourceError  more points than 32-bit numbers
template <class Real>
FaceList faces_of(const BakedTable<Real>& table);

/// Corners of all of these faces of a level, without making them.
template <class Real>
std::int64_t num_corners(const BakedTable<Real>& table);

}  // namespace sublimit
