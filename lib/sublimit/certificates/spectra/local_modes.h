// SPDX-License-Identifier: Apache-2.0
#pragma once
// Asymptotic shapes of subdivision around an extraordinary point: right eigenvectors of the local matrix as
// control nets. The subdominant pair is the net of the characteristic map, the next ones are the eigenfunctions
// that decide on curvature. In double; proofs enclose the same nets. Sources: Reif 1995; Peters, Reif 2008,
// "Subdivision Surfaces", chapters 4 and 5.
#include <complex>
#include <optional>

#include "sublimit/neighborhood/local_patch.h"
#include "sublimit/neighborhood/sector_mesh.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// A right eigenvector as values at the vertices of a net.
struct LocalMode {
  int block = 0;  ///< index of the Fourier block, 0 to n/2
  std::complex<double> value;
  Eigen::VectorXcd net;  ///< by vertex; real and imaginary part are the two modes of blocks k and n - k
};

/// The leading modes around a centre.
struct LocalModes {
  SectorMesh net;    ///< mesh around the centre that the modes are given on
  int dilation = 2;  ///< factor of labels in one period of the scheme
  /// Mode of the largest eigenvalue below 1. If it is from block 1, its net is the characteristic map; from
  /// another block k the net winds k times around 0, or is a spike (k = 0). It is scaled so that the end of the
  /// first spoke (for faces: the first corner) has modulus 1 and lies at angle 0 (for faces: pi/n).
  LocalMode leading;
  std::vector<LocalMode> next;  ///< the next modes, at most 4, by descending modulus
};

/// Returns the modes around an isolated interior vertex or extraordinary face.
/// @param rings  rings of faces of the net; 5 are enough for limits over two rings with any scheme
/// @return  nothing if such a centre has no child of its own type
/// @throws AnalysisError  the neighbourhood is not closed, or has no rotational symmetry
std::optional<LocalModes> local_modes(const Scheme<double>& scheme, const LocalType& type, int rings = 5);

}  // namespace sublimit
