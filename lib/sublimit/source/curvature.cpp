// SPDX-License-Identifier: Apache-2.0
#include "sublimit/source/curvature.h"

#include <Eigen/Geometry>
#include <Eigen/Jacobi>

#include <cmath>
#include <string>

#include "sublimit/base/error.h"

namespace sublimit {

std::optional<Curvature> curvature(const LimitSamples& s, Index row) {
  if (row < 0 || size_t(row) >= s.order.size())
    throw InvalidParameter("sample " + std::to_string(row) + " of " + std::to_string(s.order.size()));
  if (s.order[size_t(row)] < 2 || s.duu.rows() == 0) return std::nullopt;
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
  Eigen::Matrix2d form = J.transpose() * II * J;
  Eigen::JacobiRotation<double> axes;  // the columns of it are the eigenvectors
  axes.makeJacobi(form, 0, 1);
  form.applyOnTheLeft(0, 1, axes.adjoint());
  form.applyOnTheRight(0, 1, axes);
  Curvature c;
  const int first = form(0, 0) < form(1, 1) ? 1 : 0;
  const Vector3d directions[] = {axes.c() * e1 - axes.s() * e2, axes.s() * e1 + axes.c() * e2};
  c.k1 = form(first, first);
  c.k2 = form(1 - first, 1 - first);
  c.direction1 = directions[first];
  c.direction2 = directions[1 - first];
  c.gauss = (L * N - M * M) / area2;
  c.mean = (c.k1 + c.k2) / 2;
  return c;
}

}  // namespace sublimit
