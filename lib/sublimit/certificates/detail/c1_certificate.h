// SPDX-License-Identifier: Apache-2.0
#pragma once
// C^1 at an extraordinary point by Reif's criterion, proved: order of the spectrum, and the characteristic map.
#include <optional>
#include <string>

#include "sublimit/certificates/detail/map_proof.h"
#include "sublimit/limit/detail/verdict.h"

namespace sublimit {

/// Verdict and evidence of one neighbourhood.
struct [[nodiscard]] C1Certificate {
  Verdict verdict;
  std::optional<CharacteristicMap> map;  ///< of schemes whose block 1 has an isolated leading eigenvalue
  std::optional<MapProof> proof;         ///< of polynomial schemes, and of others whose second differences are schemes
  LocalPatch<Algebraic> patch;
};

/// Certificates of one scheme: what does not depend on the valence is found once.
class C1Prover {
 public:
  /// @param scheme  with exact masks; `find_scheme<Algebraic>`, or your own
  /// @throws AnalysisError  its rules on regular meshes are not one mask
  explicit C1Prover(Scheme<Algebraic> scheme);

  /// @param n  valence of the vertex, or corners of the face (dual schemes); >= 3
  C1Certificate certify(int n) const;
  /// The closed neighbourhood that `certify` looks at.
  LocalPatch<Algebraic> patch(int n) const;

  const RegularMask<Algebraic>& mask() const { return mask_; }
  /// Nothing for schemes whose limits are not polynomials.
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
