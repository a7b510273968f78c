// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/free_form/free_form_joints.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sublimit/certificates/c1/exact_joins.h"

namespace sublimit {
namespace {

struct FreeEnd {
  std::size_t curve = 0;
  bool at_end = false;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
};

/// The point of an end; nothing at a pole.
std::optional<Eigen::Vector3d> end_point(const CurveBezier& curve, bool at_end) {
  const BezierPiece<double>& piece = at_end ? curve.pieces.back() : curve.pieces.front();
  const bool rational = piece.coordinates == Coordinates::homogeneous;
  const size_t width = rational ? 4 : 3, at = at_end ? piece.columns.size() - width : 0;
  const Eigen::Vector3d x(piece.columns[at], piece.columns[at + 1], piece.columns[at + 2]);
  const double w = rational ? piece.columns[at + 3] : 1;
  if (w == 0) return std::nullopt;
  return x / w;
}

double norm_of(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}

/// Joins of pieces in doubles and, if there are any, in ratios.
void compare(FreeFormJoint& joint, const BezierPiece<double>& left, const BezierPiece<double>& right,
             const BezierPiece<Rational>* exact_left, const BezierPiece<Rational>* exact_right) {
  joint.measured = curve_join(left, right);
  if (exact_left != nullptr && exact_right != nullptr) joint.exact = exact_curve_join(*exact_left, *exact_right).orders;
  joint.greatest_curvature = std::max(norm_of(joint.measured.left_curvature), norm_of(joint.measured.right_curvature));
  for (size_t k = 0; k < joint.measured.point.size() && k < 3; ++k)
    joint.place[Eigen::Index(k)] = joint.measured.point[k];
}

/// Groups of ends of which each is as near as `same` to another one, by first ends.
std::vector<std::vector<size_t>> groups_of(const std::vector<FreeEnd>& ends, double same) {
  std::vector<size_t> first(ends.size()), by_x(ends.size());
  std::iota(first.begin(), first.end(), size_t{0});
  std::iota(by_x.begin(), by_x.end(), size_t{0});
  std::ranges::stable_sort(by_x, {}, [&](size_t i) { return ends[i].point.x(); });
  const auto root = [&](size_t i) {
    while (first[i] != i) i = first[i];
    return i;
  };
  for (size_t a = 0; a < by_x.size(); ++a)
    for (size_t b = a + 1; b < by_x.size(); ++b) {
      if (ends[by_x[b]].point.x() - ends[by_x[a]].point.x() > same) break;
      if ((ends[by_x[a]].point - ends[by_x[b]].point).norm() > same) continue;
      const auto [low, high] = std::minmax({root(by_x[a]), root(by_x[b])});
      first[high] = low;
    }
  std::vector<std::vector<size_t>> members(ends.size()), result;
  for (size_t i = 0; i < ends.size(); ++i) members[root(i)].push_back(i);
  for (std::vector<size_t>& group : members)
    if (!group.empty()) result.push_back(std::move(group));
  return result;
}

FreeFormJoint ends_joint(std::span<const CurveBezier> curves, FreeEnd a, FreeEnd b) {
  // The end of one and the start of the other, where there is such a pair.
  if (!a.at_end && b.at_end) std::swap(a, b);
  FreeFormJoint joint{.kind = FreeFormJoint::Kind::ends, .left = a.curve, .right = b.curve, .measured = {}};
  joint.left_reversed = !a.at_end, joint.right_reversed = b.at_end;
  const CurveBezier &l = curves[a.curve], &r = curves[b.curve];
  joint.left_parameter = a.at_end ? l.breaks.back() : l.breaks.front();
  joint.right_parameter = b.at_end ? r.breaks.back() : r.breaks.front();
  const auto pair_of = [&](const auto& left, const auto& right) {
    return std::pair{joint.left_reversed ? reversed(left.front()) : left.back(),
                     joint.right_reversed ? reversed(right.back()) : right.front()};
  };
  const auto [left, right] = pair_of(l.pieces, r.pieces);
  if (l.exact.empty() || r.exact.empty()) {
    compare(joint, left, right, nullptr, nullptr);
  } else {
    const auto [exact_left, exact_right] = pair_of(l.exact, r.exact);
    compare(joint, left, right, &exact_left, &exact_right);
  }
  return joint;
}

}  // namespace

const char* name(FreeFormJoint::Kind kind) { return kind == FreeFormJoint::Kind::knot ? "knot" : "ends"; }

FreeFormJoints free_form_joints(std::span<const CurveBezier> curves, double same, double near) {
  FreeFormJoints result;
  std::vector<FreeEnd> ends;
  for (size_t c = 0; c < curves.size(); ++c) {
    const CurveBezier& curve = curves[c];
    for (size_t i = 0; i + 1 < curve.pieces.size(); ++i) {
      FreeFormJoint joint{.left = c, .right = c, .measured = {}};
      joint.left_parameter = joint.right_parameter = curve.breaks[i + 1];
      const bool is_exact = !curve.exact.empty();
      compare(joint, curve.pieces[i], curve.pieces[i + 1], is_exact ? &curve.exact[i] : nullptr,
              is_exact ? &curve.exact[i + 1] : nullptr);
      result.joints.push_back(std::move(joint));
    }
    for (const bool at_end : {false, true})
      if (const std::optional<Eigen::Vector3d> point = end_point(curve, at_end)) ends.push_back({c, at_end, *point});
  }
  std::vector<FreeEnd> alone;
  for (const std::vector<size_t>& group : groups_of(ends, same)) {
    if (group.size() == 1) alone.push_back(ends[group[0]]);
    if (group.size() == 2) result.joints.push_back(ends_joint(curves, ends[group[0]], ends[group[1]]));
    if (group.size() > 2) ++result.branches;
  }
  for (const std::vector<size_t>& group : groups_of(alone, near)) {
    if (group.size() == 2)
      result.joints.push_back(ends_joint(curves, alone[group[0]], alone[group[1]]));
    else
      result.free_ends += group.size();
  }
  return result;
}

std::size_t free_ends_of_pairs(std::span<const CurveBezier> curves, double same) {
  std::size_t count = 0;
  for (size_t c = 0; c + 1 < curves.size(); c += 2) {
    const std::optional<Eigen::Vector3d> start = end_point(curves[c], false), end = end_point(curves[c + 1], true);
    const bool closes = start && end && (*start - *end).norm() <= same;
    if (!closes) count += start.has_value() + end.has_value();
  }
  return count;
}

FreeFormJoint end_to_start(std::span<const CurveBezier> curves, std::size_t left, std::size_t right) {
  return ends_joint(curves, {.curve = left, .at_end = true}, {.curve = right, .at_end = false});
}

}  // namespace sublimit
