// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which pieces are polynomials. No spline is written down anywhere: the limit is taken at points enough for a
// polynomial through them, and the polynomial is believed if it satisfies the refinement equation
//
//   p(u,v) x = p_child(map(u,v)) B x      for all children, as many points of each as the degree asks for
//
// since the limit is the only solution of this equation that is continuous.
#include <vector>

#include "sublimit/neighborhood/piece_types.h"

namespace sublimit {

/// Its thread takes up no other work while it lives (tbb::this_task_arena::isolate): it holds a lock.
class PolynomialSearch {
 public:
  explicit PolynomialSearch(PieceTypes& types) : types_(types), lock_(types.polynomials_) {}
  /// Sets whether a type is a polynomial.
  void decide(const PieceType& type);

 private:
  struct Verdict {
    bool polynomial;
    size_t lowest;  ///< of the types on the stack that this was assumed for
  };
  Verdict verdict(const PieceType& type);
  /// Decides a regular piece between equal knot intervals, from whose polynomial all others are known.
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
