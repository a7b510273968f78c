// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/detail/dense_decompositions.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

Eigen::EigenSolver<Eigen::MatrixXd> solved(const Eigen::MatrixXd& M, bool with_vectors) {
  Eigen::EigenSolver<Eigen::MatrixXd> solver(M, with_vectors);
  if (solver.info() != Eigen::Success) throw AnalysisError("the eigenvalues of a real matrix did not converge");
  return solver;
}

}  // namespace

SingularValues singular_values(const Eigen::MatrixXd& M) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(M, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

std::optional<Eigen::MatrixXd> clear_null_space(const Eigen::MatrixXd& M) {
  // Pivots fall, and follow the singular values within a factor of some hundreds.
  constexpr double surely_not_zero = 1e-6, surely_zero = 1e-12;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(Eigen::MatrixXd(M.transpose()));
  const Eigen::VectorXd pivots = qr.matrixQR().diagonal().cwiseAbs();
  if (pivots.size() == 0 || !(pivots[0] > 0)) return std::nullopt;
  Eigen::Index rank = 0;
  while (rank < pivots.size() && pivots[rank] > surely_not_zero * pivots[0]) ++rank;
  if (rank < pivots.size() && !(pivots[rank] < surely_zero * pivots[0])) return std::nullopt;
  const Eigen::MatrixXd Q = qr.householderQ();
  return Eigen::MatrixXd(Q.rightCols(pivots.size() - rank));
}

PivotedQr::PivotedQr(const Eigen::MatrixXd& M) : qr_(M) {}

Eigen::Index PivotedQr::rank() const { return qr_.rank(); }

Eigen::MatrixXd PivotedQr::solve(const Eigen::MatrixXd& right) const { return qr_.solve(right); }

Eigen::MatrixXd PivotedQr::last_directions(Eigen::Index count) const {
  Eigen::MatrixXd last = Eigen::MatrixXd::Identity(qr_.rows(), qr_.rows()).rightCols(count);
  last.applyOnTheLeft(qr_.householderQ());
  return last;
}

Eigen::VectorXd least_norm_solution(const Eigen::MatrixXd& M, const Eigen::VectorXd& right, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(threshold);
  solver.compute(M);
  return solver.solve(Eigen::MatrixXd(right));
}

Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& X) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(X);
  Eigen::MatrixXd Q = Eigen::MatrixXd::Identity(X.rows(), X.cols());
  Q.applyOnTheLeft(qr.householderQ());
  return Q;
}

Eigen::MatrixXd triangular_factor(const Eigen::MatrixXd& X) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(X);
  return qr.matrixQR().topRows(X.cols()).triangularView<Eigen::Upper>();
}

Eigen::MatrixXd square_solution(const Eigen::MatrixXd& M, const Eigen::MatrixXd& right) {
  return Eigen::PartialPivLU<Eigen::MatrixXd>(M).solve(right);
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& M) { return M.inverse(); }

double determinant(const Eigen::MatrixXd& M) { return M.determinant(); }

PivotedLu::PivotedLu(const Eigen::MatrixXd& M) : lu_(M) {}

bool PivotedLu::is_invertible() const { return lu_.isInvertible(); }

double PivotedLu::rcond() const { return lu_.rcond(); }

Eigen::MatrixXd PivotedLu::solve(const Eigen::MatrixXd& right) const { return lu_.solve(right); }

Eigen::MatrixXd PivotedLu::inverse() const { return lu_.inverse(); }

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& M) { return solved(M, false).eigenvalues(); }

Eigenvectors eigenvectors(const Eigen::MatrixXd& M) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver = solved(M, true);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricEigenvectors symmetric_eigenvectors(const Eigen::MatrixXd& M) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(M);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& M) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace sublimit
