// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table with its description: what it was made from, faces between its points, their statuses, texture coordinates
// and tags. This is enough to write a mesh of the points, and to recognise a control mesh of another connectivity:
//
//   const Table table = load("level3.safetensors");  // eval/table.h
//   const auto& baked = std::get<BakedTable<float>>(table.baked());
//   if (baked.info.topology_hash != topology_hash(num_vertices, sizes, corners)) return false;
//   const FaceList faces = faces_of(baked);
//   const std::vector<std::uint8_t> statuses = statuses_of(baked);  // empty: all regular
#include <map>
#include <optional>
#include <string>

#include "sublimit/eval/table/face_lattices.h"
#include "sublimit/eval/table/pattern_table.h"
#include "sublimit/eval/table/table_channels.h"

namespace sublimit {

/// Kind of points that a table makes.
enum class TableRows {
  level,    ///< vertices of level k
  limit,    ///< limits of the vertices of level k
  grid,     ///< N x N places on each face of the surface (triangles N (N + 1) / 2), face by face, u fastest
  samples,  ///< a list of places (face, u, v), in its order
};
/// Returns the word of a kind in files: "level", "limit", "grid", "samples".
const char* name(TableRows rows);
/// Returns the kind of a word; absent for any other word.
std::optional<TableRows> table_rows(const std::string& name);

/// Description of a table: what it was made from.
struct TableInfo {
  std::string scheme;                          ///< name of the scheme
  std::map<std::string, std::string> options;  ///< options of the scheme, and the rules boundary, creasing, triangles
  TableRows rows = TableRows::level;           ///< kind of points
  int level = 0;                               ///< k of `TableRows::level` and `limit`
  int grid = 0;                                ///< N of `TableRows::grid`
  bool triangles = false;                      ///< true if the faces of places are triangles, else squares
  std::uint64_t topology_hash = 0;             ///< `topology_hash` of the control mesh; 0: not recorded
  std::string tool;                            ///< name and version of the program that made the table
  std::vector<std::string> statuses;           ///< words for the numbers of statuses: "regular", ...
  /// Highest order of the derivatives that exist at points of each status, 0 to 2, one entry for each of `statuses`.
  /// Rows of higher ones are zero; where there is a tangent plane but no natural parameter, the rows of u and v are two
  /// tangents. Empty: all derivatives of the table exist.
  std::vector<std::int8_t> orders;
  /// True if control points are homogeneous columns (w x, w y, w z, w). The weights make such columns too, and points
  /// are the quotients: see `Evaluation::rational`. Texture coordinates are never homogeneous.
  bool rational = false;
};

/// Returns a hash of the connectivity of a control mesh: the same on all machines, never 0, without positions and tags.
/// @param num_vertices  number of vertices
/// @param sizes         corners of each face
/// @param corners       vertices of all faces, face by face
std::uint64_t topology_hash(std::int32_t num_vertices, std::span<const std::int32_t> sizes,
                            std::span<const std::int32_t> corners);

/// Faces as sizes and corners, counter-clockwise.
struct [[nodiscard]] FaceList {
  SharedArray<std::int32_t> sizes, corners;
};

/// Places of points on the limit, point by point.
struct SampleAddresses {
  SharedArray<std::int32_t> faces;  ///< face of each place
  SharedArray<double> parameters;   ///< (u, v) of each place, #points x 2
};

/// A table with its description. Threads may share it as long as none changes it; copies share the arrays.
template <class Real>
struct BakedTable {
  PatternTable<Real> table;  ///< weights
  TableInfo info;            ///< what it was made from
  /// How points lie on faces, in tables by patterns; faces between points follow from it.
  std::optional<FaceLattices> lattices;
  /// Faces between points, in tables by rows and of lists of places; may be empty.
  FaceList faces;
  /// Places of the points, in tables of lists of places.
  SampleAddresses addresses;
  /// Status at each entry of `PatternTable::Arrays::rows`, and at each point of `rest`, as a number of
  /// `TableInfo::statuses`. Empty: all points are `regular`. `statuses_of` lists them by point.
  SharedArray<std::uint8_t> row_status, rest_status;
  /// Texture coordinates of level k, or of its limit; empty if they were not asked for.
  TableChannels channels = {};
  /// Creases and corners that are left on level k; absent if they were not asked for.
  std::optional<TableTags> tags = {};
  /// Of `level` and `limit`, where it was asked for: the point of each vertex of the refined mesh, in the order of
  /// refinement; -1 of vertices that no face has. Not written to files.
  SharedArray<std::int64_t> refined_points = {};
};

/// Returns the status of each point, as a number of `TableInfo::statuses`; empty if all are regular.
template <class Real>
std::vector<std::uint8_t> statuses_of(const BakedTable<Real>& table);

/// Returns the table with weights rounded to float.
[[nodiscard]] BakedTable<float> in_float(const BakedTable<double>& table);

/// Returns the faces between the points, without those of holes. Makes them anew at each call.
/// @throws ResourceError  more points than 32-bit indices count
template <class Real>
FaceList faces_of(const BakedTable<Real>& table);

/// Returns the number of corners of the faces of a level (`faces_of`), without making them.
template <class Real>
std::int64_t num_corners(const BakedTable<Real>& table);

}  // namespace sublimit
