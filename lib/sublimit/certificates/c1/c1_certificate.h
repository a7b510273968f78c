// SPDX-License-Identifier: Apache-2.0
#pragma once
// Proofs of C^1 at an extraordinary point by Reif's criterion: order of the spectrum, and the characteristic
// map.
#include <optional>
#include <string>

#include "sublimit/certificates/c1/map_proof.h"
#include "sublimit/certificates/spectra/verdict.h"

namespace sublimit {

/// Verdict and evidence of one neighbourhood.
struct [[nodiscard]] C1Certificate {
  Verdict verdict;
  std::optional<CharacteristicMap> map;  ///< if block 1 has an isolated leading eigenvalue
  std::optional<MapProof> proof;         ///< for piecewise polynomial schemes, and others with a DerivativeTail
  LocalPatch<Algebraic> patch;
};

/// Prover for one scheme. Computes once what does not depend on the valence.
class C1Prover {
 public:
  /// @param scheme  scheme with exact masks, from `find_scheme<Algebraic>` or user-defined
  /// @throws AnalysisError  rules on regular meshes do not agree on one mask
  explicit C1Prover(Scheme<Algebraic> scheme);

  /// Returns the certificate of a neighbourhood.
  /// @param n  valence of the vertex, or corners of the face (dual schemes); >= 3
  C1Certificate certify(int n) const;
  /// Returns the closed neighbourhood that `certify` analyses.
  LocalPatch<Algebraic> patch(int n) const;

  const RegularMask<Algebraic>& mask() const { return mask_; }
  /// Returns the polynomials of the regular limit; nothing if it is not piecewise polynomial.
  const std::optional<RegularPieces>& pieces() const { return pieces_; }
  const BallFunctions& functions() const { return functions_; }
  /// Returns the bound on derivatives of a scheme without polynomials, if there is one.
  const std::optional<DerivativeTail>& tail() const { return tail_; }

 private:
  Scheme<Algebraic> scheme_;
  RegularMask<Algebraic> mask_;
  std::optional<RegularPieces> pieces_;
  BallFunctions functions_;
  std::optional<DerivativeTail> tail_;
  bool converges_ = false;
};

}  // namespace sublimit
