// SPDX-License-Identifier: Apache-2.0
// What is said first: how smooth most seams are, and which ones are not.
#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/report/free_form/free_form_report.h"

namespace sublimit::free_form_detail {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

std::string line_words(const SplinePatches& patches, const PatchLine& line) {
  return fmt::format("{} = {}", line.along_v ? "u" : "v", format_number(line_parameter(patches, line)));
}

/// The greatest order that fewer than half of them lack.
int common_order(const std::vector<int>& orders) {
  int g = -1;
  for (const int k : {0, 1, 2}) {
    const auto less = std::ranges::count_if(orders, [&](int order) { return order < k; });
    if (2 * less < std::ssize(orders)) g = k;
  }
  return g;
}

/// @param worst  what keeps the worst one from that order
/// @param all_same  each of them is of one map
JoinVerdict verdict_of(const std::vector<int>& orders, bool all_same, const std::string& one,
                       const std::string& worst) {
  JoinVerdict verdict;
  verdict.compared = orders.size();
  if (orders.empty()) {
    verdict.says = "no " + one + "s to compare";
    return verdict;
  }
  verdict.g = common_order(orders);
  verdict.exceptions = size_t(std::ranges::count_if(orders, [&](int order) { return order < verdict.g; }));
  const auto all = [&](size_t count) { return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s"); };
  if (verdict.g < 0)
    verdict.says = fmt::format("most of {} have a gap: {}", all(orders.size()), worst);
  else if (verdict.exceptions == 0)
    verdict.says = fmt::format("{} at {}{}",
                               verdict.g < 2 ? "G^" + std::to_string(verdict.g)
                               : all_same    ? "C^infinity, G^infinity"
                                             : "G^2 at least",
                               orders.size() == 1 ? "its only " + one : "all " + all(orders.size()),
                               verdict.g == 2 ? "" : ": " + worst);
  else
    verdict.says = fmt::format("G^{} everywhere but {}: {}", verdict.g, all(verdict.exceptions), worst);
  return verdict;
}

std::string angle_words(double radians) { return fmt::format("largest angle {:.4g} degrees", degrees * radians); }

}  // namespace

std::string words_of(const PatchSeam& seam, const SplinePatches& patches) {
  const PatchLine& left = seam.lines[0];
  if (seam.lines.size() < 2) return fmt::format("at patch {}, {}", left.patch, line_words(patches, left));
  const PatchLine& right = seam.lines[1];
  if (seam.kind == SeamKind::knot) return fmt::format("inside patch {} at {}", left.patch, line_words(patches, left));
  if (left.patch == right.patch)
    return fmt::format("in patch {} between {} and {}", left.patch, line_words(patches, left),
                       line_words(patches, right));
  return fmt::format("between patch {} and patch {}", left.patch, right.patch);
}

std::string words_of(const FreeFormJoint& joint) {
  if (joint.kind == FreeFormJoint::Kind::knot)
    return fmt::format("in curve {} at t = {}", joint.left, format_number(joint.left_parameter));
  if (joint.left == joint.right) return fmt::format("where curve {} closes", joint.left);
  return fmt::format("between curve {} and curve {}", joint.left, joint.right);
}

JoinVerdict seam_verdict(const FreeFormReport& report) {
  std::vector<int> orders;
  bool all_same = true;
  for (const ReportedSeam& seam : report.seams)
    if (seam.seam.is_compared()) {
      orders.push_back(std::min(2, seam.seam.measured->g));
      all_same &= seam.seam.measured->is_same;
    }
  std::string worst;
  if (!orders.empty()) {  // the worst first
    const PatchSeam& seam = report.seams.front().seam;
    const JoinOrders& found = *seam.measured;
    const std::string where = words_of(seam, report.patches);
    if (found.obstacle == JoinObstacle::gap && seam.gap)
      worst = fmt::format("largest gap {:.4g} {}", seam.gap->value, where);
    else if (found.obstacle == JoinObstacle::angle && seam.angle)
      worst = angle_words(seam.angle->value) + " " + where;
    else if (found.obstacle == JoinObstacle::curvature && seam.curvature_jump)
      worst = fmt::format("largest jump of curvature {:.4g} {}", seam.curvature_jump->value, where);
    else
      worst = fmt::format("{} {}", name(found.obstacle), where);
  }
  return verdict_of(orders, all_same, "seam", worst);
}

JoinVerdict joint_verdict(const FreeFormReport& report) {
  std::vector<int> orders;
  bool all_same = true;
  for (const FreeFormJoint& joint : report.joints.joints) {
    orders.push_back(std::min(2, joint.measured.orders.g));
    all_same &= joint.measured.orders.is_same;
  }
  std::string worst;
  if (!orders.empty()) {
    const FreeFormJoint& joint = report.joints.joints.front();
    const JoinOrders& found = joint.measured.orders;
    if (found.obstacle == JoinObstacle::gap)
      worst = fmt::format("largest gap {:.4g} {}", joint.measured.gap, words_of(joint));
    else if (found.obstacle == JoinObstacle::angle || found.obstacle == JoinObstacle::folded_back)
      worst = angle_words(*joint.measured.angle) + " " + words_of(joint);
    else if (found.obstacle == JoinObstacle::curvature && joint.measured.curvature_jump)
      worst = fmt::format("largest jump of curvature {:.4g} {}", *joint.measured.curvature_jump, words_of(joint));
    else
      worst = fmt::format("{} {}", name(found.obstacle), words_of(joint));
  }
  return verdict_of(orders, all_same, "joint", worst);
}

std::size_t count_boundary_loops(const FreeFormReport& report, double same) {
  // Ends of sides by the points where they meet.
  std::vector<Eigen::Vector3d> points;
  std::vector<size_t> component;
  const auto root = [&](size_t i) {
    while (component[i] != i) i = component[i];
    return i;
  };
  const auto point_at = [&](const Eigen::Vector3d& p) {
    for (size_t i = 0; i < points.size(); ++i)
      if ((points[i] - p).norm() <= same) return i;
    points.push_back(p);
    component.push_back(points.size() - 1);
    return points.size() - 1;
  };
  for (const ReportedSeam& seam : report.seams) {
    if (seam.seam.kind != SeamKind::boundary || seam.line.size() < 2) continue;
    const size_t a = root(point_at(seam.line.front())), b = root(point_at(seam.line.back()));
    component[std::max(a, b)] = std::min(a, b);
  }
  size_t loops = 0;
  for (size_t i = 0; i < component.size(); ++i) loops += root(i) == i;
  return loops;
}

}  // namespace sublimit::free_form_detail
