// SPDX-License-Identifier: Apache-2.0
#pragma once
// Checks that the parts of a baked table are consistent. Its weights and lattices were checked when they were made.
#include "sublimit/eval/table/baked_table.h"

namespace sublimit {

/// Checks a table.
/// @throws InvalidParameter  arrays that do not fit the table, a number out of range, statuses without a name
template <class Real>
void check_table(const BakedTable<Real>& table);

extern template void check_table(const BakedTable<float>&);
extern template void check_table(const BakedTable<double>&);

}  // namespace sublimit
