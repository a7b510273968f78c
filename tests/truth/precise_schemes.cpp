// SPDX-License-Identifier: Apache-2.0
#include "truth/precise_schemes.h"

namespace sublimit {

template std::optional<Scheme<testing::Precise>> find_scheme<testing::Precise>(const std::string&,
                                                                               const SchemeOptions&);
template std::optional<CurveScheme<testing::Precise>> find_curve_scheme<testing::Precise>(const std::string&,
                                                                                          const SchemeOptions&);
template LevelOf<testing::Precise> control_level(const Scheme<testing::Precise>&, const Mesh&,
                                                 const SubdivisionOptions&);
template LevelOf<testing::Precise> next_level(const Scheme<testing::Precise>&, const LevelOf<testing::Precise>&);
template std::optional<LocalPatch<testing::Precise>> local_patch(const Scheme<testing::Precise>&, LocalType, int,
                                                                 const Mesh*);

}  // namespace sublimit
