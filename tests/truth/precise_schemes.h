// SPDX-License-Identifier: Apache-2.0
#pragma once
// Templates of the registries' schemes, refinement and local matrices for 256-bit floats, instantiated once, to
// save compile time in every file that uses them.
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/neighborhood/local_patch.h"
#include "sublimit/schemes/schemes.h"
#include "truth/precise.h"

namespace sublimit {

extern template std::optional<Scheme<testing::Precise>> find_scheme<testing::Precise>(const std::string&,
                                                                                      const SchemeOptions&);
extern template std::optional<CurveScheme<testing::Precise>> find_curve_scheme<testing::Precise>(const std::string&,
                                                                                                 const SchemeOptions&);
extern template LevelOf<testing::Precise> control_level(const Scheme<testing::Precise>&, const Mesh&,
                                                        const SubdivisionOptions&);
extern template LevelOf<testing::Precise> next_level(const Scheme<testing::Precise>&, const LevelOf<testing::Precise>&);
extern template std::optional<LocalPatch<testing::Precise>> local_patch(const Scheme<testing::Precise>&, LocalType, int,
                                                                        const Mesh*);

}  // namespace sublimit
