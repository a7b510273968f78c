// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/exact_schemes.h"

namespace sublimit {

template std::vector<Scheme<Algebraic>> all_schemes<Algebraic>();
template std::optional<Scheme<Algebraic>> find_scheme<Algebraic>(const std::string&, const SchemeOptions&);
template std::optional<LocalPatch<Algebraic>> local_patch<Algebraic>(const Scheme<Algebraic>&, LocalType, int,
                                                                     const Mesh*);

}  // namespace sublimit
