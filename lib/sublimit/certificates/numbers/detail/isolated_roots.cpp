// SPDX-License-Identifier: Apache-2.0
// Roots of polynomials, enclosed: Arb's Durand-Kerner with interval Newton validation, at growing precision.
#include <acb_poly.h>

#include "sublimit/certificates/numbers/detail/flint_value.h"
#include "sublimit/certificates/numbers/detail/polynomial.h"

namespace sublimit {
namespace {

using AcbPolynomial = FlintValue<acb_poly_struct, acb_poly_init, acb_poly_clear>;

std::vector<ComplexBall> roots_at(const Polynomial& p, bool is_real, long bits) {
  const PrecisionScope scope(bits);
  AcbPolynomial enclosed;
  for (int i = 0; i <= p.degree(); ++i) {
    ComplexBall c = p.coefficients()[i].enclosure();
    if (is_real) arb_zero(acb_imagref(c.get()));
    acb_poly_set_coeff_acb(enclosed, i, c.get());
  }
  const acb_ptr roots = _acb_vec_init(p.degree());
  const bool isolated = acb_poly_find_roots(roots, enclosed, nullptr, 0, bits) == p.degree() &&
                        (!is_real || acb_poly_validate_real_roots(roots, enclosed, bits));
  std::vector<ComplexBall> result;
  for (int i = 0; isolated && i < p.degree(); ++i) {
    ComplexBall root(roots + i);
    if (is_real && root.im().contains_zero()) arb_zero(acb_imagref(root.get()));
    result.push_back(std::move(root));
  }
  _acb_vec_clear(roots, p.degree());
  return result;
}

}  // namespace

bool has_isolated_roots(const Polynomial& p) {
  return p.degree() < 2 || static_cast<int>(roots_at(p, p.is_real(), 256).size()) == p.degree();
}

std::vector<ComplexBall> isolated_roots(const Polynomial& squarefree, long bits) {
  const bool is_real = squarefree.is_real();
  if (squarefree.degree() == 1) {
    const PrecisionScope scope(bits + 10);
    ComplexBall root = (-squarefree.coefficients()[0] / squarefree.coefficients()[1]).enclosure();
    if (is_real) arb_zero(acb_imagref(root.get()));
    return {root};
  }
  for (long working = bits + 32;; working *= 2) {
    std::vector<ComplexBall> roots = roots_at(squarefree, is_real, working);
    bool fine = static_cast<int>(roots.size()) == squarefree.degree();
    for (const ComplexBall& root : roots)
      fine = fine && mag_cmp_2exp_si(arb_radref(acb_realref(root.get())), -bits) < 0 &&
             mag_cmp_2exp_si(arb_radref(acb_imagref(root.get())), -bits) < 0;
    if (fine) return roots;
  }
}

}  // namespace sublimit
