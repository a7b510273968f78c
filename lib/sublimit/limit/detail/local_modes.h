// SPDX-License-Identifier: Apache-2.0
#pragma once
// What iterated subdivision tends to around an extraordinary point: right eigenvectors of the local matrix as control
// nets. The subdominant pair is the net of the characteristic map, the next ones are the eigenfunctions that decide on
// curvature. In double; proofs enclose the same nets. Sources: Reif 1995; Peters, Reif 2008, "Subdivision Surfaces",
// chapters 4 and 5.
#include <complex>
#include <optional>

#include "sublimit/neighborhood/local_type.h"
#include "sublimit/neighborhood/sector_mesh.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// One eigenvector over the labels of a net.
struct LocalMode {
  int block = 0;  ///< Fourier index, 0 to n/2
  std::complex<double> value;
  Eigen::VectorXcd net;  ///< by vertex; real and imaginary part are the two modes of blocks k and n - k
};

struct LocalModes {
  SectorMesh net;
  int dilation = 2;  ///< of labels in one period
  /// Leading mode below 1; its net is the characteristic map where it comes from block 1 (elsewhere it winds |block|
  /// times or is a spike). The end of the first spoke (the first corner) has modulus 1, and sector 0 lies symmetric to
  /// the ray at pi/n (0).
  LocalMode leading;
  std::vector<LocalMode> next;  ///< those of the next largest modulus, and of blocks 0 and 2, by descending modulus
};

/// Modes around an interior vertex or an extraordinary face, alone.
/// @param rings  of faces that the net has; 5 let a limit be taken over two rings of any scheme
/// @return  nothing where such a centre has no child of its own type
/// @throws AnalysisError  the neighbourhood is not closed, or has no rotational symmetry
std::optional<LocalModes> local_modes(const Scheme<double>& scheme, const LocalType& type, int rings = 5);

}  // namespace sublimit
