// SPDX-License-Identifier: Apache-2.0
#include "sublimit/implicit/field.h"

#include <cmath>
#include <limits>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

class CallbackField final : public Field {
 public:
  CallbackField(std::function<FieldJet(const Eigen::Vector3d&)> jet, std::optional<Eigen::AlignedBox3d> box)
      : jet_(std::move(jet)), box_(std::move(box)) {}
  double value(const Eigen::Vector3d& x) const override { return jet_(x).value; }
  FieldJet jet(const Eigen::Vector3d& x) const override { return jet_(x); }
  std::optional<Eigen::AlignedBox3d> extent(double level) const override {
    return level <= 0 ? box_ : std::nullopt;  // the box is of the surface, not of others around it
  }

 private:
  std::function<FieldJet(const Eigen::Vector3d&)> jet_;
  std::optional<Eigen::AlignedBox3d> box_;
};

}  // namespace

void Field::pieces(const Eigen::Vector3d& x, double, std::vector<FieldPiece>& out) const { out.push_back({jet(x), 0}); }

std::vector<FieldPiece> Field::pieces(const Eigen::Vector3d& x, double width) const {
  std::vector<FieldPiece> all;
  pieces(x, width, all);
  return all;
}

std::optional<Eigen::Vector3d> level_normal(const FieldJet& jet) {
  const double length = jet.gradient.norm();
  if (jet.order < 1 || !(length > 0) || !std::isfinite(length)) return std::nullopt;
  return Eigen::Vector3d(jet.gradient / length);
}

std::optional<LevelCurvature> level_curvature(const FieldJet& jet) {
  const std::optional<Eigen::Vector3d> normal = level_normal(jet);
  if (!normal || jet.order < 2) return std::nullopt;
  const double length = jet.gradient.norm();
  // Divided by |g| before products are taken: steep fields do not overflow.
  const Eigen::Vector3d n = *normal;
  const Eigen::Matrix3d H = jet.hessian / length;
  Eigen::Matrix3d adjugate;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    adjugate.col(i) = Eigen::Vector3d(H.row(j)).cross(Eigen::Vector3d(H.row(k)));
  }
  return LevelCurvature{n, n.dot(adjugate * n), -(H.trace() - n.dot(H * n)) / 2};
}

Projection project(const Field& field, const Eigen::Vector3d& x, double reach) {
  constexpr int most_steps = 20;
  constexpr double eps = std::numeric_limits<double>::epsilon();
  Projection result{x, field.jet(x)};
  for (int step = 0; step < most_steps; ++step) {
    const double squared = result.jet.gradient.squaredNorm();
    if (!(squared > 0) || !std::isfinite(squared) || !std::isfinite(result.jet.value)) return result;
    const Eigen::Vector3d move = -result.jet.value / squared * result.jet.gradient;
    if (move.norm() <= 4 * eps * (reach + result.point.norm())) {
      result.converged = true;
      return result;
    }
    Eigen::Vector3d next = result.point + move;
    const double distance = (next - x).norm();
    if (distance > reach) next = x + reach / distance * (next - x);
    result.point = next;
    result.jet = field.jet(next);
  }
  // Fields whose second derivatives jump turn back and forth by a little.
  const double length = result.jet.gradient.norm();
  result.converged = length > 0 && std::abs(result.jet.value) / length <= 1e-10 * reach;
  return result;
}

FieldPointer callback_field(std::function<FieldJet(const Eigen::Vector3d&)> jet,
                            std::optional<Eigen::AlignedBox3d> box) {
  if (!jet) throw InvalidParameter("a field without a function; give it one");
  return std::make_shared<const CallbackField>(std::move(jet), std::move(box));
}

}  // namespace sublimit
