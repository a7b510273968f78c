// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables of one mesh by many processes, for programs that mpirun starts. Each process, a rank, has a run of the
// vertices and a run of the faces, so that no process needs the whole:
//
//   int main(int argc, char** argv) {
//     const Ranks ranks(argc, argv);  // begins MPI, and ends it when it goes
//     return ranks.run([&] {          // an error of one rank is an error of all; returns the exit status
//       const MeshRun mesh = read_mesh_run(ranks, "city.ply");  // or fill one in
//       const DistributedTable table = bake(ranks, mesh, "catmull-clark", {.levels = 2});
//       std::vector<double> points(table.num_results(3));
//       table.apply({mesh.positions.data(), size_t(mesh.positions.size())}, 3, points);  // every frame
//       table.point_numbers()[i];                 // where the point at points[3 * i] stands in the whole
//       table.apply_transpose(gradient, 3, own);  // of this rank's points; to this rank's control points
//       const double largest = ranks.largest(own_largest);
//     });
//   }
//
// Runs: rank 0 has the first vertices and the first faces of the whole, rank 1 those that follow, and so on. Any of the
// runs may be empty. Control points are divided as the vertices are.
//
// The points of the whole have numbers from 0 on: first vertices of no face, then the points of face 0, of face 1, and
// so on; a point on a side or at a corner is with the first face that has it. Numbers and bits are the same for any
// number of ranks. A table that `bake` of sublimit.h makes of the same mesh has the same points to rounding, in another
// order.
//
// Functions that take `ranks`, `apply` and `apply_transpose` are collective: all ranks call them, in the same order,
// each from one thread. What is wrong on one rank is thrown by all of them: an `Error` whose `code()` says which of the
// errors below it is, with the message of the first rank that has it. So all ranks can catch it, and go on together.
// What is thrown outside of these functions on one rank alone ends all ranks, as `Ranks::run` says.
//
// A rank uses all threads of oneTBB that its process may use: of a rank that mpirun binds to a core, one.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sublimit/distributed/ranks.h"
#include "sublimit/eval/table/baked_table.h"
#include "sublimit/mesh/mesh.h"
#include "sublimit/scheme/any_scheme.h"

namespace sublimit {

/// The part of a mesh that one rank has: a run of the vertices and a run of the faces. Vertices and faces are numbered
/// in the whole, from 0.
struct [[nodiscard]] MeshRun {
  Points positions;                         ///< #vertices of this rank x 3
  std::vector<Index> face_sizes;            ///< corners of each face of this rank, >= 3
  std::vector<std::int64_t> face_vertices;  ///< vertices of these faces, one after the other, counter-clockwise

  struct Crease {
    std::int64_t tail = 0, head = 0;
    float sharpness = 0;  ///< levels, >= 0; >= 10 is infinite
  };
  struct Corner {
    std::int64_t vertex = 0;
    float sharpness = 0;
  };
  /// Tags, each given by one rank, whichever. Of several entries for an edge, or a vertex, the last one of the last
  /// rank wins.
  std::vector<Crease> creases;
  std::vector<Corner> corners;
  std::vector<std::int64_t> holes;  ///< faces that are refined but are not part of the limit

  /// Rules, by the first rank; what others say is ignored. Absent ones have their defaults: edge_and_corner, uniform,
  /// catmark.
  std::optional<Boundary> boundary;
  std::optional<Creasing> creasing;
  std::optional<Triangles> triangles;

  std::string name = "mesh";          ///< what messages call the mesh
  std::vector<std::string> warnings;  ///< what a reader accepted with a reservation, on the rank that read it
};

/// Reads a run of a file's mesh; each rank reads its own bytes. A binary .ply, .obj or .safetensors, and the tags of a
/// .json beside it (the formats of `sublimit-mpi`). Texture coordinates are not read.
/// @return  runs that are as equal as can be; of an .obj those of its lines that begin in equal parts of its bytes
/// @throws FormatError, InvalidMesh, IoError  a file that cannot be read: says where
/// @throws InvalidOption                      a file of another size on another rank
/// @throws ResourceError                      more memory than there is, predicted before it is taken
[[nodiscard]] MeshRun read_mesh_run(const Ranks& ranks, const std::filesystem::path& path);

/// Returns a run of a mesh that this process has whole: of so many equal runs that of `rank`. Not collective. Where all
/// ranks have the mesh, each takes `mesh_run(mesh, ranks.rank(), ranks.size())`; where only the first rank has it, that
/// takes `mesh_run(mesh)`, and the others an empty `MeshRun`. Tags are with run 0; texture coordinates are left out.
/// @throws InvalidParameter  not 0 <= rank < size
/// @throws InvalidMesh       knot intervals, which parts of a mesh cannot have; faces that do not fit together
[[nodiscard]] MeshRun mesh_run(const Mesh& whole, int rank = 0, int size = 1);

/// Which rank makes which points.
enum class Partition {
  few_neighbours,  ///< as many faces for each rank, with short seams: the least memory and messages (PT-Scotch)
  as_given,        ///< each rank makes the points of the faces of its `MeshRun`; their numbers follow each other
};

/// What points a table makes, and which rank makes them. The same on all ranks.
struct DistributedBakeOptions {
  int levels = 1;      ///< points of this level, 1 to 11; 0 to 11 if `limit` is set and all faces have as many corners
                       ///< as the scheme splits
  bool limit = false;  ///< the limits of these points instead
  /// `few_neighbours` costs time once. `as_given` costs none, and is as good where the runs have short seams: where
  /// faces near each other have numbers near each other.
  Partition partition = Partition::few_neighbours;
  /// Keeps the faces between the points, for `DistributedTable::faces`. Costs a ring of faces more around each part.
  bool faces = false;
};

/// A table that no process has whole: each rank makes points of its own, from control points that ranks have in runs.
/// It must go before the `Ranks` that it was made with. Copies share it; calls of two copies must not overlap.
class DistributedTable {
 public:
  // Moving copies: a moved-from object stays valid.
  DistributedTable(const DistributedTable&) = default;
  DistributedTable& operator=(const DistributedTable&) = default;

  // Control points, which ranks have in runs.
  std::int64_t num_control_points() const;   ///< of this rank
  std::int64_t first_control_point() const;  ///< number in the whole of this rank's first one
  std::int64_t all_control_points() const;   ///< of all ranks

  // Points that are made.
  std::int64_t num_points() const;  ///< of this rank
  std::int64_t all_points() const;  ///< of all ranks
  /// Returns how many numbers `apply` makes on this rank of points of so many channels.
  size_t num_results(int channels) const;
  /// Returns the number in the whole of each of this rank's points, in the order of `apply`. Each point of the whole is
  /// one rank's. They ascend, but that a table of `load` starts again with each of its shards.
  std::vector<std::int64_t> point_numbers() const;
  /// Returns the faces between the points on this rank's control faces, without those of holes. Corners are numbers of
  /// the whole: points at seams may be those of other ranks. In the order of the control faces. Empty unless
  /// `DistributedBakeOptions::faces` was set.
  const FaceList& faces() const;
  /// Returns how many control points this rank gets from other ranks each time.
  std::int64_t num_remote_control_points() const;

  /// Makes the points of one frame. Collective. While control points of other ranks are on their way, points that need
  /// none of them are made.
  /// @param own      num_control_points x channels, interleaved: this rank's run
  /// @param points   num_points x channels, interleaved: this rank's points. The same bits for any number of ranks.
  /// @throws InvalidParameter  on some rank spans of the wrong length, channels below 1; channels that differ
  void apply(std::span<const double> own, int channels, std::span<double> points) const;

  /// Applies the transpose: gradients with regard to the control points, of those with regard to the points.
  /// Collective.
  /// @param points  num_points x channels, interleaved: this rank's
  /// @param own     num_control_points x channels: this rank's run; overwritten. Sums over ranks are in any order, so
  ///                the last bits may differ from call to call.
  /// @throws InvalidParameter  as `apply`
  void apply_transpose(std::span<const double> points, int channels, std::span<double> own) const;

 private:
  friend DistributedTable bake(const Ranks& ranks, MeshRun mesh, const AnyScheme& scheme,
                               const DistributedBakeOptions& options);
  friend DistributedTable load(const Ranks& ranks, const std::filesystem::path& directory,
                               std::int64_t num_control_points);
  struct State;
  explicit DistributedTable(std::shared_ptr<const State> state);
  std::shared_ptr<const State> state_;
};

/// Bakes a table of a mesh that ranks have in runs; its weights are those of one process, bit by bit. Collective.
/// @param ranks   which must stay as long as the table
/// @param mesh    this rank's; `std::move` it if it is not needed afterwards, which saves memory
/// @param scheme  not a dual scheme, nor one that rotates the mesh (`sqrt3`). A name that does not exist is thrown
///                where it becomes an `AnyScheme`, by each rank for itself
/// @throws InvalidOption        schemes or options that differ between ranks
/// @throws InvalidParameter     levels outside their range; a scheme that tables of parts cannot have
/// @throws InvalidMesh          on some rank arrays that do not fit together, coordinates that are not finite, a face
///                              with less than 3 corners, a vertex or face that does not exist, a crease on no edge,
///                              negative sharpness; no vertices, no faces: says where
/// @throws UnsupportedTopology  a face or valence that the scheme cannot refine
/// @throws ResourceError        more memory than there is, predicted before it is taken; a part, or the points if faces
///                              are asked for, of more than 32-bit numbers count
/// @note  What is found while a rank's part is baked is said with the numbers of this part, which the message names.
[[nodiscard]] DistributedTable bake(const Ranks& ranks, MeshRun mesh, const AnyScheme& scheme,
                                    const DistributedBakeOptions& options);
DistributedTable bake(const Ranks&&, MeshRun, const AnyScheme&, const DistributedBakeOptions&) = delete;

/// Reads a table in shards, as `sublimit-mpi bake` writes it, by any number of ranks. Collective.
/// @param ranks               which must stay as long as the table
/// @param directory           with "shards.json", seen by all ranks
/// @param num_control_points  of this rank's run; those of all ranks are the vertices of the mesh, in its order
/// @throws IoError           a directory without shards, or whose bake is not done
/// @throws FormatError       a damaged shard, or one of another bake: says which
/// @throws InvalidParameter  runs that are not as many control points as the table has; a negative number
[[nodiscard]] DistributedTable load(const Ranks& ranks, const std::filesystem::path& directory,
                                    std::int64_t num_control_points);
DistributedTable load(const Ranks&&, const std::filesystem::path&, std::int64_t) = delete;

}  // namespace sublimit
