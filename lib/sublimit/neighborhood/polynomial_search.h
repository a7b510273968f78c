// SPDX-License-Identifier: Apache-2.0
#pragma once
// Decides which pieces are polynomials. No spline basis is built in: the limit is interpolated by a polynomial,
// which is accepted if it satisfies the refinement equation
//
//   p(u,v) x = p_child(map(u,v)) B x      for all children, at as many points of each as the degree requires
//
// since the limit is the only continuous solution of this equation.
#include <vector>

#include "sublimit/neighborhood/piece_types.h"

namespace sublimit {

/// A search for polynomials. It holds a lock: create it only inside tbb::this_task_arena::isolate, so that its
/// thread executes no task that needs the lock again.
class PolynomialSearch {
 public:
  explicit PolynomialSearch(PieceTypes& types) : types_(types), lock_(types.polynomials_) {}
  /// Decides whether a type is a polynomial, and stores the answer in the type.
  void decide(const PieceType& type);

 private:
  struct Verdict {
    bool polynomial;
    size_t lowest;  ///< lowest type on the stack whose being a polynomial was assumed for this verdict
  };
  Verdict verdict(const PieceType& type);
  /// Decides a regular piece between equal knot intervals, whose polynomial gives degree and shape of all
  /// others.
  void start_from_equal_intervals();
  const PiecePolynomial* candidate(const PieceType& type);
  std::optional<PiecePolynomial> found_candidate(const PieceType& type);
  std::optional<PiecePolynomial> interpolated(const PieceType& type, const PolynomialBasis& basis, bool halves,
                                              bool wide) const;
  bool satisfies_refinement(const PieceType& type, const PiecePolynomial& p, double tolerance);

  PieceTypes& types_;
  std::unique_lock<std::mutex> lock_;
  std::vector<const PieceType*> stack_;
};

}  // namespace sublimit
