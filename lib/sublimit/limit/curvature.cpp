// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Eigenvalues>

#include <cmath>

#include "sublimit/limit/limit_surface.h"

namespace sublimit {

std::optional<Curvature> curvature(const LimitSamples& s, Index row) {
  if (s.order[row] < 2 || s.duu.rows() == 0) return std::nullopt;
  using Eigen::Vector3d;
  const Vector3d xu = s.du.row(row), xv = s.dv.row(row), cross = xu.cross(xv);
  const double E = xu.dot(xu), F = xu.dot(xv), G = xv.dot(xv), area2 = E * G - F * F;
  if (!(cross.squaredNorm() > 1e-24 * E * G)) return std::nullopt;
  const Vector3d n = cross.normalized();
  const double L = n.dot(Vector3d(s.duu.row(row))), M = n.dot(Vector3d(s.duv.row(row))),
               N = n.dot(Vector3d(s.dvv.row(row)));
  // In an orthonormal frame of the tangent plane the second form is symmetric, and its eigenvectors are the directions.
  const Vector3d e1 = xu / std::sqrt(E), e2 = n.cross(e1);
  Eigen::Matrix2d J;  // parameters of e1, e2
  const double a = xv.dot(e1), b = xv.dot(e2);
  J << 1 / std::sqrt(E), -a / (b * std::sqrt(E)), 0, 1 / b;
  Eigen::Matrix2d II;
  II << L, M, M, N;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(J.transpose() * II * J);
  Curvature c;
  c.k1 = solver.eigenvalues()[1];
  c.k2 = solver.eigenvalues()[0];
  const Eigen::Matrix2d& V = solver.eigenvectors();
  c.direction1 = V(0, 1) * e1 + V(1, 1) * e2;
  c.direction2 = V(0, 0) * e1 + V(1, 0) * e2;
  c.gauss = (L * N - M * M) / area2;
  c.mean = (c.k1 + c.k2) / 2;
  return c;
}

}  // namespace sublimit
