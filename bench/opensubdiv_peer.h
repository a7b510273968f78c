// SPDX-License-Identifier: Apache-2.0
#pragma once
// OpenSubdiv as it is best used for the jobs that the benchmarks time against ours. Thin: between the clock and the
// library there is nothing but the arrays it asks for. Its refinement and its stencil factory use one thread, always.
#include <cstddef>
#include <memory>
#include <span>

namespace sublimit::bench {

enum class PeerScheme { bilinear, catmull_clark, loop };

/// A mesh as OpenSubdiv takes it, looked at where it is. Boundary edges and corners are sharp (edge_and_corner).
struct PeerMesh {
  PeerScheme scheme = PeerScheme::catmull_clark;
  int num_vertices = 0;
  std::span<const int> face_sizes, face_vertices;
  std::span<const int> crease_vertices;  ///< two per crease
  std::span<const float> crease_sharpness;
  std::span<const int> corner_vertices;
  std::span<const float> corner_sharpness;
};

/// What came out, so that it is not optimised away and can be compared with ours.
struct PeerPositions {
  std::size_t vertices = 0;  ///< of levels 1 to the last, together
  double checksum = 0;       ///< absolute coordinates of every 1000th vertex of the last level, summed: free of charge
};
struct PeerStencils {
  std::size_t stencils = 0, weights = 0;
};

/// Connectivity of all levels: `TopologyRefinerFactory::Create` and `RefineUniform`, both in the constructor.
///
/// Options are those that make it fastest: no validation, vertices ordered from vertices first, and of the last level
/// the face vertices only, which is all that interpolation and stencils need; or, on demand, its edges and the rest
/// too.
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

  /// Positions of levels 1 to the last by `PrimvarRefiner::Interpolate`, x y z interleaved, into one array of the
  /// refiner's own making, left uninitialised; weights are of the type of the positions.
  PeerPositions refine(std::span<const double> positions) const;
  PeerPositions refine(std::span<const float> positions) const;

  /// Stencils of the last level over the control vertices (our P_k) by `StencilTableFactory::Create`, with offsets,
  /// without intermediate levels.
  PeerStencils stencils_double() const;
  PeerStencils stencils_float() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sublimit::bench
