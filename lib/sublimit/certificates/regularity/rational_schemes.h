// SPDX-License-Identifier: Apache-2.0
#pragma once
// The registries' schemes and local matrices in rational numbers, instantiated once: saves every file that uses
// them the instantiation. Also conversion of regular masks from algebraic numbers.
#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/certificates/numbers/detail/rational_number.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/neighborhood/regular_mask.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit {

extern template std::vector<Scheme<Rational>> all_schemes<Rational>();
extern template std::optional<Scheme<Rational>> find_scheme<Rational>(const std::string&, const SchemeOptions&);
extern template std::optional<CurveScheme<Rational>> find_curve_scheme<Rational>(const std::string&,
                                                                                 const SchemeOptions&);
extern template std::optional<LocalPatch<Rational>> local_patch<Rational>(const Scheme<Rational>&, LocalType, int,
                                                                          const Mesh*);

/// Returns the mask in rational numbers; nothing if a weight is irrational.
std::optional<RegularMask<Rational>> rational_mask(const RegularMask<Algebraic>& mask);

}  // namespace sublimit
