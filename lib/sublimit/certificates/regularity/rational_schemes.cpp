// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/rational_schemes.h"

namespace sublimit {

template std::vector<Scheme<Rational>> all_schemes<Rational>();
template std::optional<Scheme<Rational>> find_scheme<Rational>(const std::string&, const SchemeOptions&);
template std::optional<CurveScheme<Rational>> find_curve_scheme<Rational>(const std::string&, const SchemeOptions&);
template std::optional<LocalPatch<Rational>> local_patch<Rational>(const Scheme<Rational>&, LocalType, int,
                                                                   const ControlMesh*);

}  // namespace sublimit
