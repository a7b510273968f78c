// SPDX-License-Identifier: Apache-2.0
#pragma once
// Whether the parts of a baked table go together. Its table and its lattices have checked themselves when they were
// made.
#include "sublimit/baked_table.h"

namespace sublimit {

/// @throws InvalidParameter  arrays that do not fit the table, a number out of range, statuses without a name
template <class Real>
void check_table(const BakedTable<Real>& table);

extern template void check_table(const BakedTable<float>&);
extern template void check_table(const BakedTable<double>&);

}  // namespace sublimit
