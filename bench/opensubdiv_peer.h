// SPDX-License-Identifier: Apache-2.0
#pragma once
// OpenSubdiv in its fastest way for the jobs of the benchmarks. The wrapper is thin: timed code contains only
// calls of the library and the arrays that it needs. Its refinement and its stencil factory always use one
// thread.
#include <cstddef>
#include <memory>
#include <span>

namespace sublimit::bench {

enum class PeerScheme { bilinear, catmull_clark, loop };

/// A mesh for OpenSubdiv, as references to arrays. Boundary edges and corners are sharp (edge_and_corner).
struct PeerMesh {
  PeerScheme scheme = PeerScheme::catmull_clark;
  int num_vertices = 0;
  std::span<const int> face_sizes, face_vertices;
  std::span<const int> crease_vertices;  ///< two per crease
  std::span<const float> crease_sharpness;
  std::span<const int> corner_vertices;
  std::span<const float> corner_sharpness;
};

/// Summary of the results, so that they are not optimised away and can be compared with those of this library.
struct PeerPositions {
  std::size_t vertices = 0;  ///< number of vertices of levels 1 to the last
  double checksum = 0;       ///< sum of absolute coordinates of every 1000th vertex of the last level
};
struct PeerStencils {
  std::size_t stencils = 0, weights = 0;
};

/// The connectivity of all levels, by `TopologyRefinerFactory::Create` and `RefineUniform` in the constructor.
///
/// Options are the fastest ones: no validation, children of vertices first, and for the last level only the
/// vertices of faces, which suffice for interpolation and stencils; or, with `whole_last_level`, all of its
/// topology.
class PeerRefiner {
 public:
  /// @throws std::runtime_error  if OpenSubdiv refuses the mesh
  PeerRefiner(const PeerMesh& mesh, int levels, bool whole_last_level = false);
  ~PeerRefiner();
  PeerRefiner(PeerRefiner&&) noexcept;
  PeerRefiner& operator=(PeerRefiner&&) noexcept;

  int levels() const;
  std::size_t num_vertices(int level) const;
  std::size_t num_faces(int level) const;

  /// Computes the positions of levels 1 to the last by `PrimvarRefiner::Interpolate`, x y z interleaved, in an
  /// uninitialised array that it allocates. Weights have the type of the positions.
  PeerPositions refine(std::span<const double> positions) const;
  PeerPositions refine(std::span<const float> positions) const;

  /// Makes the stencils of the last level over the control vertices (P_k in this library) by
  /// `StencilTableFactory::Create`, with offsets, without intermediate levels.
  PeerStencils stencils_double() const;
  PeerStencils stencils_float() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sublimit::bench
