// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/free_form/free_form_report.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/certificates/c1/exact_joins.h"
#include "sublimit/certificates/spectra/for_all.h"
#include "sublimit/core/detail/finite_points.h"
#include "sublimit/patches/joins/line_samples.h"

namespace sublimit {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

void take_greater(std::optional<double>& all, double part) {
  if (!all || *all < part) all = part;
}

/// What is compared at a seam or a joint, in a report's units.
struct Deviations {
  std::optional<double> gap, angle_degrees, curvature;
  Eigen::Vector3d gap_at, angle_at, curvature_at;
};

Eigen::Vector3d point_of(const SeamMaximum& maximum) { return {maximum.point[0], maximum.point[1], maximum.point[2]}; }

Deviations deviations(const PatchSeam& seam, double diagonal) {
  Deviations result;
  if (seam.gap) result.gap = seam.gap->value, result.gap_at = point_of(*seam.gap);
  if (seam.angle) result.angle_degrees = degrees * seam.angle->value, result.angle_at = point_of(*seam.angle);
  if (seam.curvature_jump) {
    result.curvature =
        free_form_detail::part_of_curvature(seam.curvature_jump->value, seam.greatest_curvature, diagonal);
    result.curvature_at = point_of(*seam.curvature_jump);
  }
  return result;
}

Deviations deviations(const FreeFormJoint& joint, double diagonal) {
  Deviations result;
  result.gap_at = result.angle_at = result.curvature_at = joint.place;
  if (joint.measured.orders.obstacle == JoinObstacle::pole) return result;
  result.gap = joint.measured.gap;
  if (joint.measured.angle) result.angle_degrees = degrees * *joint.measured.angle;
  if (joint.measured.curvature_jump)
    result.curvature =
        free_form_detail::part_of_curvature(*joint.measured.curvature_jump, joint.greatest_curvature, diagonal);
  return result;
}

/// Collects deviations and holds them against the tolerance.
class Judge {
 public:
  Judge(FreeFormReport& report) : report_(report), diagonal_(report.diagonal()) {
    const SeamTolerance& t = report.tolerance;
    if (t.g0) allowed_[0] = t.g0_of_box ? *t.g0 * diagonal_ : *t.g0;
    allowed_[1] = t.g1_degrees, allowed_[2] = t.g2;
  }

  void take(bool is_joint, std::size_t number, const Deviations& found, JoinDeviation& all) {
    if (found.gap) ++all.compared, take_greater(all.gap, *found.gap);
    if (found.angle_degrees) take_greater(all.angle_degrees, *found.angle_degrees);
    if (found.curvature) take_greater(all.curvature, *found.curvature);
    hold(is_joint, number, 0, found.gap, found.gap_at);
    hold(is_joint, number, 1, found.angle_degrees, found.angle_at);
    hold(is_joint, number, 2, found.curvature, found.curvature_at);
  }
  void finish(Index listed) {
    report_.within_tolerance = within_.holds();
    for (std::vector<JoinExcess>& list : beyond_) {
      std::ranges::stable_sort(list, std::greater<>(), &JoinExcess::value);
      if (std::ssize(list) > listed) list.resize(size_t(listed));
      report_.beyond.insert(report_.beyond.end(), list.begin(), list.end());
    }
  }

 private:
  void hold(bool is_joint, std::size_t number, size_t k, const std::optional<double>& value,
            const Eigen::Vector3d& place) {
    constexpr const char* what[] = {"g0", "g1", "g2"};
    if (!value || !allowed_[k]) return;
    const bool is_within = *value <= *allowed_[k];
    within_.look(is_within);
    if (!is_within) beyond_[k].push_back({is_joint, number, what[k], *value, place});
  }

  FreeFormReport& report_;
  double diagonal_;
  std::optional<double> allowed_[3];
  std::vector<JoinExcess> beyond_[3];
  ForAll within_;
};

/// The worst first: the least order, then the greatest of what stands in the way of a higher one.
auto rank_of(const PatchSeam& seam) {
  const int g = seam.measured ? std::min(2, seam.measured->g) : 3;
  const auto& decisive = g < 0 ? seam.gap : g == 0 ? seam.angle : seam.curvature_jump;
  return std::tuple(g, decisive ? -decisive->value : 0, static_cast<int>(seam.kind));
}
auto rank_of(const FreeFormJoint& joint) {
  const int g = joint.measured.orders.g;
  const double decisive = g < 0    ? joint.measured.gap
                          : g == 0 ? joint.measured.angle.value_or(0)
                                   : joint.measured.curvature_jump.value_or(0);
  return std::tuple(g, -decisive);
}

/// Seams between sides without a partner that are near one another.
std::vector<PatchSeam> near_seams(std::span<const PatchColumns> patches, Coordinates coordinates,
                                  const PatchSeams& found, const SeamOptions& options, double near) {
  std::vector<PatchSeam> result;
  const auto is_boundary = [&](const PatchLine& line) {
    return std::ranges::any_of(
        found.seams, [&](const PatchSeam& seam) { return seam.kind == SeamKind::boundary && seam.lines[0] == line; });
  };
  if (std::ranges::none_of(found.seams, [](const PatchSeam& seam) { return seam.kind == SeamKind::boundary; }))
    return result;
  SeamOptions wider = options;
  wider.same = near;
  for (PatchSeam& seam : patch_seams(patches, coordinates, wider).seams) {
    const bool is_compared =
        seam.kind == SeamKind::sides || seam.kind == SeamKind::reparametrised || seam.kind == SeamKind::partial;
    if (!is_compared || !seam.gap || !std::ranges::all_of(seam.lines, is_boundary)) continue;
    // Sides that follow each other on a boundary are near at their common end.
    if (seam.part) {
      const Knots<double>& along = patches[seam.lines[0].patch].along(seam.lines[0]);
      if ((*seam.part)[1] - (*seam.part)[0] < 0.25 * (along.end() - along.begin())) continue;
    }
    // Opposite sides of a small patch are near too: a gap is small against the sides.
    const std::vector<double> s{0, 0.25, 0.5, 0.75, 1};
    const Points at = line_samples(patches[seam.lines[0].patch], coordinates, seam.lines[0], s, 0).position;
    double length = 0;
    for (Eigen::Index i = 1; i < at.rows(); ++i) length += (at.row(i) - at.row(i - 1)).norm();
    if (seam.gap->value <= 0.05 * length) result.push_back(std::move(seam));
  }
  return result;
}

/// Points of a seam for pictures.
std::vector<Eigen::Vector3d> seam_points(const SplinePatches& patches, const PatchSeam& seam) {
  const PatchLine& line = seam.lines[0];
  const PatchColumns& patch = patches.patches[line.patch];
  const Knots<double>& along = patch.along(line);
  double begin = 0, end = 1;
  if (seam.part) {
    const double length = along.end() - along.begin();
    begin = ((*seam.part)[0] - along.begin()) / length, end = ((*seam.part)[1] - along.begin()) / length;
  }
  const int count = seam.kind == SeamKind::collapsed ? 0 : std::clamp(8 * along.num_faces(), 8, 128);
  std::vector<double> s;
  for (int i = 0; i <= count; ++i) s.push_back(begin + (end - begin) * (count > 0 ? double(i) / count : 0));
  const LimitSamples at = line_samples(patch, patches.coordinates, line, s, 0);
  std::vector<Eigen::Vector3d> points;
  for (size_t i = 0; i < s.size(); ++i)
    if (has_position(at.status[i])) points.emplace_back(at.position.row(Eigen::Index(i)));
  return points;
}

/// Of the first patches.
void find_seams(FreeFormReport& report, size_t count, const FreeFormReportOptions& options,
                std::span<const std::optional<SeamNet<Rational>>> nets) {
  const SplinePatches& patches = report.patches;
  const std::span<const PatchColumns> first = std::span(patches.patches).first(count);
  const SeamOptions seam_options;
  PatchSeams found = patch_seams(first, patches.coordinates, seam_options);
  report.smooth_lines = found.smooth_lines;
  report.vertices = seam_vertices(first, patches.coordinates, found);

  // Exact verdicts are about the file's numbers.
  std::vector<PatchSeam> own;
  std::vector<size_t> own_number;
  for (size_t i = 0; i < found.seams.size() && own.size() < options.exact_seams; ++i) {
    const PatchSeam& seam = found.seams[i];
    if (!seam.is_compared() ||
        std::ranges::any_of(seam.lines, [&](const PatchLine& line) { return patches.is_converted[line.patch]; }))
      continue;
    own.push_back(seam);
    own_number.push_back(i);
  }
  std::vector<std::optional<JoinOrders>> exact(found.seams.size());
  const std::vector<std::optional<JoinOrders>> decided = exact_seams(first, patches.coordinates, own, nets);
  for (size_t i = 0; i < own.size(); ++i) exact[own_number[i]] = decided[i];

  const std::vector<PatchSeam> near = near_seams(first, patches.coordinates, found, seam_options, options.near);
  const auto is_near = [&](const PatchSeam& boundary) {
    return std::ranges::any_of(near, [&](const PatchSeam& seam) {
      return std::ranges::find(seam.lines, boundary.lines[0]) != seam.lines.end();
    });
  };
  for (size_t i = 0; i < found.seams.size(); ++i)
    if (found.seams[i].kind != SeamKind::boundary || !is_near(found.seams[i]))
      report.seams.push_back({.seam = std::move(found.seams[i]), .exact = exact[i]});
  for (const PatchSeam& seam : near) {
    report.seams.push_back({.seam = seam, .exact = std::nullopt, .is_gap = true});
    // Sides of different patches are no join, however near.
    report.seams.back().seam.measured = JoinOrders{};
  }
  for (ReportedSeam& seam : report.seams) seam.line = seam_points(patches, seam.seam);
  report.boundary_loops = free_form_detail::count_boundary_loops(report, seam_options.same * found.diagonal);
}

ReportedSeam given_seam(const SplinePatches& patches, size_t left, const GivenJoins::Surfaces& given) {
  const SurfaceJoin& found = given.found;
  ReportedSeam result;
  PatchSeam& seam = result.seam;
  seam.kind = SeamKind::sides;
  seam.lines = {side_line(patches.patches, left, PatchSide::u_end),
                side_line(patches.patches, left + 1, PatchSide::u_begin)};
  seam.reversed = {false, false};
  seam.knot = patches.surfaces[left]->u().end();
  seam.measured = found.measured;
  const Knots<double>& along = patches.surfaces[left]->v();
  const auto maximum = [&](const EdgeMaximum& at) {
    return SeamMaximum{.value = at.value,
                       .u = seam.knot,
                       .v = along.begin() + at.s * (along.end() - along.begin()),
                       .point = at.point};
  };
  const EdgeDeviation& deviation = found.deviation;
  seam.gap = maximum(deviation.gap);
  if (deviation.angle) seam.angle = maximum(*deviation.angle);
  if (deviation.curvature_jump) seam.curvature_jump = maximum(*deviation.curvature_jump);
  seam.greatest_curvature = deviation.greatest_curvature;
  result.exact = found.exact;
  result.line = seam_points(patches, seam);
  result.recipe = given.recipe;
  return result;
}

/// A curve that is one piece over [0, length].
CurveBezier one_piece(const BezierPiece<double>& piece, const BezierPiece<Rational>& exact) {
  return {.pieces = {piece}, .breaks = {0, piece.length}, .exact = {exact}};
}

/// @param same  ends as near as that are one point
void add_joins(FreeFormReport& report, const GivenJoins& joins, double same) {
  const size_t other_curves = report.curves.size();
  size_t patch = report.shapes.surfaces.size() - 2 * joins.surfaces.size();
  for (const GivenJoins::Surfaces& join : joins.surfaces) {
    report.seams.push_back(given_seam(report.patches, patch, join));
    patch += 2;
  }
  for (const GivenJoins::Curves& join : joins.curves) {
    const size_t left = report.curves.size();
    report.curves.push_back(one_piece(join.left, join.exact_left));
    report.curves.push_back(one_piece(join.right, join.exact_right));
    report.joints.joints.push_back(end_to_start(report.curves, left, left + 1));
    report.joints.joints.back().recipe = join.recipe;
  }
  report.joints.free_ends += free_ends_of_pairs(std::span(report.curves).subspan(other_curves), same);
}

/// Of each patch its net without rounding, if it is known and has the same faces; patches without one are converted.
std::vector<std::optional<SeamNet<Rational>>> exact_nets(const ExactShapes& exact, SplinePatches& patches) {
  std::vector<std::optional<SeamNet<Rational>>> nets = exact.surfaces;
  for (size_t p = 0; p < nets.size(); ++p) {
    const auto is_like = [](const Knots<Rational>& own, const Knots<double>& rounded) {
      return own.degree() == rounded.degree() && own.num_faces() == rounded.num_faces() &&
             own.num_points() == rounded.num_points();
    };
    const SplineSurface& surface = *patches.surfaces[p];
    if (nets[p] && !(is_like(nets[p]->u, surface.u()) && is_like(nets[p]->v, surface.v()))) nets[p].reset();
    patches.is_converted[p] = !nets[p];
  }
  return nets;
}

/// Pieces without rounding in the place of those of rounded numbers; none where they are not known.
void use_exact(const std::optional<std::vector<BezierPiece<Rational>>>& pieces, CurveBezier& curve) {
  curve.exact.clear();
  if (pieces && pieces->size() == curve.pieces.size()) curve.exact = *pieces;
}

void find_box(FreeFormReport& report) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(INFINITY), high = -low;
  const auto take = [&](const FreeFormElement& element) {
    for (const Index v : element.points) {
      const Eigen::Vector3d p = report.shapes.vertices.row(v);
      low = low.cwiseMin(p), high = high.cwiseMax(p);
    }
  };
  for (const FreeFormSurface& surface : report.shapes.surfaces) take(surface);
  for (const FreeFormCurve& curve : report.shapes.curves) take(curve);
  if (low.x() <= high.x()) report.box_min = low, report.box_max = high;
}

/// @throws InvalidMesh  coordinates whose squares are no numbers
void check_box(const FreeFormReport& report, const std::string& name) {
  const double farthest = std::max(report.box_min.cwiseAbs().maxCoeff(), report.box_max.cwiseAbs().maxCoeff());
  if (!(farthest <= farthest_coordinate))
    throw InvalidMesh(name + ": a control point has the coordinate " + format_number(farthest) +
                      ", above 1e150 in size, whose square is no number; give points in another unit of length");
}

/// @throws InvalidMesh  a gap or an angle is no number, naming where
void check_numbers(const FreeFormReport& report, const std::string& name) {
  const auto check = [&](double value, const char* what, const std::string& where) {
    if (!std::isfinite(value))
      throw InvalidMesh(name + ": the " + what + " " + where +
                        " is no number: control points, weights or knot intervals there are so large, or so small, "
                        "that their products are none; numbers nearer to 1 are right");
  };
  for (const ReportedSeam& reported : report.seams) {
    const PatchSeam& seam = reported.seam;
    if (seam.measured && seam.measured->obstacle == JoinObstacle::pole) continue;
    if (seam.gap) check(seam.gap->value, "gap", free_form_detail::words_of(seam, report.patches));
    if (seam.angle) check(seam.angle->value, "angle", free_form_detail::words_of(seam, report.patches));
  }
  for (const FreeFormJoint& joint : report.joints.joints) {
    if (joint.measured.orders.obstacle == JoinObstacle::pole) continue;
    check(joint.measured.gap, "gap", free_form_detail::words_of(joint));
    if (joint.measured.angle) check(*joint.measured.angle, "angle", free_form_detail::words_of(joint));
  }
}

}  // namespace

double free_form_detail::part_of_curvature(double jump, double greatest, double diagonal) {
  const double of_box = diagonal > 0 ? 2 / diagonal : 0;
  const double whole = std::max(greatest, of_box);
  return whole > 0 ? jump / whole : jump;
}

double free_form_detail::line_parameter(const SplinePatches& patches, const PatchLine& line) {
  const Knots<double>& across = patches.patches[line.patch].across(line);
  return across.all()[size_t(across.span(line.face)) + (line.end == KnotSide::right ? 1 : 0)];
}

FreeFormReport free_form_report(FreeForm shapes, const std::string& name, const FreeFormReportOptions& options,
                                const GivenJoins& joins, const ExactShapes* exact) {
  if (shapes.surfaces.empty() && shapes.curves.empty())
    throw UnsupportedTopology(name + ": neither curves in space nor surfaces; give a file with `surf` or `curv`");
  FreeFormReport report;
  report.shapes = std::move(shapes);
  report.tolerance = options.tolerance;
  find_box(report);
  check_box(report, name);
  std::vector<std::optional<SeamNet<Rational>>> nets;
  if (!report.shapes.surfaces.empty()) {
    report.patches = spline_patches(report.shapes, name);
    if (exact) nets = exact_nets(*exact, report.patches);
    if (const size_t count = report.shapes.surfaces.size() - 2 * joins.surfaces.size(); count > 0)
      find_seams(report, count, options, nets);
  }
  for (size_t c = 0; c + 2 * joins.curves.size() < report.shapes.curves.size(); ++c) {
    const FreeFormCurve& curve = report.shapes.curves[c];
    try {
      report.curves.push_back(curve_bezier(report.shapes, curve));
      if (exact) use_exact(exact->curves[c], report.curves.back());
    } catch (const InvalidParameter& error) {
      throw InvalidParameter(name + ":" + std::to_string(curve.line) + ": " + error.what());
    }
  }
  constexpr double same = 1e-6;
  report.joints = free_form_joints(report.curves, same * report.diagonal(), options.near * report.diagonal());
  add_joins(report, joins, same * report.diagonal());
  check_numbers(report, name);
  std::ranges::stable_sort(report.seams, {}, [](const ReportedSeam& seam) { return rank_of(seam.seam); });
  std::ranges::stable_sort(report.joints.joints, {}, [](const FreeFormJoint& joint) { return rank_of(joint); });

  Judge judge(report);
  for (size_t i = 0; i < report.seams.size(); ++i)
    judge.take(false, i, deviations(report.seams[i].seam, report.diagonal()), report.seam_deviation);
  for (size_t i = 0; i < report.joints.joints.size(); ++i)
    judge.take(true, i, deviations(report.joints.joints[i], report.diagonal()), report.joint_deviation);
  judge.finish(options.listed);
  if (!report.shapes.surfaces.empty()) report.seam_verdict = free_form_detail::seam_verdict(report);
  if (!report.shapes.curves.empty()) report.joint_verdict = free_form_detail::joint_verdict(report);
  report.warnings = free_form_detail::warnings(report, options);
  report.picture = free_form_detail::picture(report, options);
  return report;
}

}  // namespace sublimit
