// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where the points of a table are on its cage: (face, u, v) of each.
#include "sublimit/baked_table.h"

namespace sublimit {

/// Addresses of all points, in their order; none if the table does not know them. A point that several faces have is at
/// the one that makes it. Points of no face (isolated vertices) have the face -1.
/// @throws ResourceError  more memory than there is
template <class Real>
SampleAddresses addresses_of(const BakedTable<Real>& table);

}  // namespace sublimit
