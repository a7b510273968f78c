// SPDX-License-Identifier: Apache-2.0
#pragma once
// The registry's schemes and local matrices in exact numbers, instantiated once: saves every file that uses
// them the instantiation.
#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/neighborhood/local_patch.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit {

extern template std::vector<Scheme<Algebraic>> all_schemes<Algebraic>();
extern template std::optional<Scheme<Algebraic>> find_scheme<Algebraic>(const std::string&, const SchemeOptions&);
extern template std::optional<LocalPatch<Algebraic>> local_patch<Algebraic>(const Scheme<Algebraic>&, LocalType, int,
                                                                            const Mesh*);

}  // namespace sublimit
