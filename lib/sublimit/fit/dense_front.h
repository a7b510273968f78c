// SPDX-License-Identifier: Apache-2.0
#pragma once
// Eliminates the first columns of a dense symmetric matrix: tiles in parallel, whose size does not depend on the number
// of threads, so neither do the bits.
#include <Eigen/Core>

namespace sublimit {

using Block = Eigen::Map<Eigen::MatrixXd>;

/// @param panel   height x width, lower half: becomes L
/// @param update  (height - width) squared, lower half: becomes what remains
/// @return  whether all pivots were positive
bool eliminate(Block panel, Block update);

}  // namespace sublimit
