// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme/detail/subdivision_matrix_impl.h"

namespace sublimit {

template SparseMatrixOf<double> subdivision_matrix(const Scheme<double>&, const Step<double>&, const Topology&,
                                                   const Refinement&, const Sharpness&, const Sharpness&, int,
                                                   const KnotSplit*);

}  // namespace sublimit
