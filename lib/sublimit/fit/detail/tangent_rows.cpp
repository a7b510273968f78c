// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/detail/tangent_rows.h"

#include <Eigen/Geometry>

#include <limits>
#include <string>

#include "sublimit/base/error.h"

namespace sublimit {

void add_tangent_rows(FitProblem& problem, const SparseMatrix& A, const Points& targets, const Points& normals,
                      const Eigen::VectorXd& weights, double tangential) {
  const Index count = Index(A.rows());
  if (9 * double(A.nonZeros()) > double(std::numeric_limits<Index>::max()))
    throw ResourceError("a cloud of " + std::to_string(count) +
                        " points has more weights than 32-bit indices count; tangential = 1 needs a ninth of them");
  problem.A.resize(3 * count, 3 * A.cols());
  problem.A.reserve(9 * A.nonZeros());
  problem.b.resize(3 * count, 1);
  problem.weights.resize(3 * count);
  for (Index i = 0; i < count; ++i) {
    Eigen::Vector3d normal = normals.row(i);
    const bool has_plane = !normal.isZero(0);
    if (!has_plane) normal = Eigen::Vector3d::UnitZ();
    Eigen::Matrix3d frame;
    frame.row(0) = normal;
    frame.row(1) = normal.unitOrthogonal();
    frame.row(2) = normal.cross(Eigen::Vector3d(frame.row(1)));
    for (Index k = 0; k < 3; ++k) {
      const Index row = 3 * i + k;
      problem.A.startVec(row);
      for (SparseMatrix::InnerIterator it(A, i); it; ++it)
        for (Index c = 0; c < 3; ++c) problem.A.insertBack(row, 3 * Index(it.col()) + c) = it.value() * frame(k, c);
      problem.b(row, 0) = frame.row(k).dot(targets.row(i));
      problem.weights[row] = weights[i] * (k == 0 || !has_plane ? 1 : tangential);
    }
  }
  problem.A.finalize();
}

}  // namespace sublimit
