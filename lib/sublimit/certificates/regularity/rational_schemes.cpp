// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/rational_schemes.h"

#include "sublimit/certificates/numbers/detail/flint_value.h"

namespace sublimit {

template std::vector<Scheme<Rational>> all_schemes<Rational>();
template std::optional<Scheme<Rational>> find_scheme<Rational>(const std::string&, const SchemeOptions&);
template std::optional<CurveScheme<Rational>> find_curve_scheme<Rational>(const std::string&, const SchemeOptions&);
template std::optional<LocalPatch<Rational>> local_patch<Rational>(const Scheme<Rational>&, LocalType, int,
                                                                   const Mesh*);

std::optional<RegularMask<Rational>> rational_mask(const RegularMask<Algebraic>& mask) {
  RegularMask<Rational> result{.triangular = mask.triangular, .dual = mask.dual, .dilation = mask.dilation};
  for (const auto& [key, weight] : mask.weights) {
    if (!weight.is_rational()) return std::nullopt;
    FlintRatio ratio;
    fmpq_poly_get_coeff_fmpq(ratio, weight.polynomial(), 0);
    result.weights.emplace(key, ratio);
  }
  return result;
}

}  // namespace sublimit
