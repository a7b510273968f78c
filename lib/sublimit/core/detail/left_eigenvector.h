// SPDX-License-Identifier: Apache-2.0
#pragma once
// Left eigenvectors of small matrices for a known eigenvalue: masks of limits and of their derivatives.
#include <Eigen/Core>

#include <optional>

namespace sublimit {

/// Returns l with l^T A = value l^T and l^T scale = 1; nothing if there is none or more than one. The solution is
/// refined in more digits than are kept, so that it is the same in whichever order the unknowns come.
std::optional<Eigen::VectorXd> left_eigenvector(const Eigen::MatrixXd& A, double value, const Eigen::VectorXd& scale);

}  // namespace sublimit
