// SPDX-License-Identifier: Apache-2.0
#pragma once
// Places of the points of a table on the limit of its control mesh.
#include "sublimit/eval/table/baked_table.h"

namespace sublimit {

/// Returns the places of all points; empty if they are not recorded. A point that several faces share is on the face
/// that owns it. Points of no face (isolated vertices) have the face -1.
/// @throws ResourceError  not enough memory
template <class Real>
SampleAddresses addresses_of(const BakedTable<Real>& table);

}  // namespace sublimit
