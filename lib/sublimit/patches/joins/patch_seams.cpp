// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/joins/patch_seams.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <numeric>
#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/patches/joins/line_samples.h"
#include "sublimit/patches/joins/line_search.h"
#include "sublimit/patches/joins/surface_join.h"

namespace sublimit {

std::string_view name(SeamKind kind) {
  constexpr std::string_view names[] = {"knot",    "period",       "sides",     "reparametrised",
                                        "partial", "non-manifold", "collapsed", "boundary"};
  return names[static_cast<size_t>(kind)];
}

std::string_view name(PatchSide side) {
  constexpr std::string_view names[] = {"u-begin", "u-end", "v-begin", "v-end"};
  return names[static_cast<size_t>(side)];
}

PatchLine side_line(std::span<const PatchColumns> patches, std::size_t patch, PatchSide side) {
  const bool at_end = side == PatchSide::u_end || side == PatchSide::v_end;
  PatchLine line{.patch = patch,
                 .along_v = side == PatchSide::u_begin || side == PatchSide::u_end,
                 .end = at_end ? KnotSide::right : KnotSide::left};
  if (at_end) line.face = patches[patch].across(line).num_faces() - 1;
  return line;
}

std::vector<PatchColumns> patch_columns(const PatchSet& set, const Points& columns) {
  if (columns.rows() != set.num_points())
    throw InvalidParameter(format_number(columns.rows()) + " control points for patches of " +
                           format_number(set.num_points()));
  std::vector<PatchColumns> result;
  for (size_t p = 0; p < set.members().size(); ++p) {
    const auto* const spline = dynamic_cast<const SplineSurface*>(set.members()[p].patch.get());
    if (!spline)
      throw UnsupportedTopology("patch " + format_number(p) +
                                " is no B-spline: joins are those of B-splines and Beziers");
    result.push_back({spline, set.columns_of(p, columns)});
  }
  return result;
}

namespace {

/// Of a line the parameter across it.
double knot_of(const PatchColumns& patch, const PatchLine& line) {
  const Knots<double>& across = patch.across(line);
  return across.all()[across.span(line.face) + (line.end == KnotSide::right ? 1 : 0)];
}

/// Finds seams and measures them.
class SeamFinder {
 public:
  SeamFinder(std::span<const PatchColumns> patches, Coordinates coordinates, const SeamOptions& options)
      : patches_(patches), coordinates_(coordinates), options_(options) {
    check();
    for (const PatchColumns& patch : patches_) nets_.emplace_back(patch, coordinates_);
    same_ = options_.same * result_.diagonal;
  }

  PatchSeams found() && {
    for (size_t p = 0; p < patches_.size(); ++p)
      for (const bool along_v : {true, false}) add_knot_lines(p, along_v);
    add_sides();
    std::ranges::stable_sort(result_.seams, {}, &PatchSeam::kind);
    return std::move(result_);
  }

 private:
  void check() {
    const Index width = coordinates_ == Coordinates::homogeneous ? 4 : 3;
    if (patches_.empty()) throw InvalidParameter("there are no patches");
    Eigen::RowVector3d low = Eigen::RowVector3d::Constant(INFINITY), high = -low;
    for (size_t p = 0; p < patches_.size(); ++p) {
      const Points& columns = patches_[p].columns;
      const Index points = patches_[p].surface->num_points();
      if (columns.rows() != points || columns.cols() != width)
        throw InvalidParameter("patch " + format_number(p) + ": columns are " + format_number(columns.rows()) + " x " +
                               format_number(columns.cols()) + ", not " + format_number(points) + " x " +
                               format_number(width));
      for (Index i = 0; i < points; ++i) {
        if (!columns.row(i).allFinite())
          throw InvalidParameter("patch " + format_number(p) + ": control point " + format_number(i) +
                                 " is not finite");
        const double w = width == 4 ? columns(i, 3) : 1;
        if (w == 0) continue;
        low = low.cwiseMin(columns.row(i).head(3) / w), high = high.cwiseMax(columns.row(i).head(3) / w);
      }
    }
    result_.diagonal = low[0] <= high[0] ? (high - low).norm() : 0;
  }

  PatchSeam seam(SeamKind kind, std::vector<PatchLine> lines, std::vector<bool> reversed) const {
    PatchSeam result{.kind = kind, .lines = std::move(lines)};
    result.reversed = std::move(reversed);
    result.knot = knot_of(patches_[result.lines[0].patch], result.lines[0]);
    if (result.lines.size() == 2)
      result.same_orientation =
          line_sign(result.lines[0], true, false) == line_sign(result.lines[1], false, result.reversed[1]);
    return result;
  }

  /// Parameters of the first line's patch.
  SeamMaximum maximum(const PatchSeam& seam, const EdgeMaximum& found, double begin, double end) const {
    const PatchLine& line = seam.lines[0];
    const Knots<double>& along = patches_[line.patch].along(line);
    const double t = along.begin() + (begin + found.s * (end - begin)) * (along.end() - along.begin());
    return {.value = found.value,
            .u = line.along_v ? seam.knot : t,
            .v = line.along_v ? t : seam.knot,
            .point = found.point};
  }
  static void take_greater(std::optional<SeamMaximum>& all, const SeamMaximum& part) {
    if (!all || all->value < part.value) all = part;
  }
  void add(PatchSeam& seam, const EdgeDeviation& found, const JoinOrders& orders, double begin, double end) const {
    seam.measured = seam.measured ? worst(*seam.measured, orders) : orders;
    take_greater(seam.gap, maximum(seam, found.gap, begin, end));
    if (found.angle) take_greater(seam.angle, maximum(seam, *found.angle, begin, end));
    if (found.curvature_jump) take_greater(seam.curvature_jump, maximum(seam, *found.curvature_jump, begin, end));
    seam.greatest_curvature = std::max(seam.greatest_curvature, found.greatest_curvature);
  }

  /// The line inside of one face of the knots along it.
  EdgeSide edge(const PatchLine& line, const LinePart<double>& part, bool is_left, bool reversed) const {
    const PatchColumns& patch = patches_[line.patch];
    const Knots<double>& along = patch.along(line);
    const double start = along.all()[along.span(part.face)], length = along.length(part.face);
    const double from = std::clamp((part.from - start) / length, 0.0, 1.0),
                 to = std::clamp((part.to - start) / length, 0.0, 1.0);
    const auto evaluate = [this, &patch, line, from, to, face = part.face](std::span<const double> s) {
      std::vector<Place> places;
      for (const double x : s) places.push_back(line_place(patch, line, {face, x == 1 ? to : from + x * (to - from)}));
      return patch.surface->evaluate(patch.columns, places, 2, coordinates_);
    };
    return {.evaluate = evaluate, .along_v = line.along_v, .sign = line_sign(line, is_left, reversed)};
  }

  /// Compares two lines that have a parameter in common.
  void compare(PatchSeam& seam) const {
    const PatchLine &l = seam.lines[0], &r = seam.lines[1];
    const int samples = 8 * (patches_[l.patch].along(l).degree() + patches_[r.patch].along(r).degree()) + 17;
    constexpr double same_knot = 1e-9;
    const auto visit = [&](const BezierPatch<double>& left, const BezierPatch<double>& right,
                           const CommonPart<double>& part) {
      const EdgeDeviation found =
          measured_deviation(edge(l, part.left, true, false), edge(r, part.right, false, seam.reversed[1]), samples);
      const RoundedOrder order = rounded_order(left, right, options_.tolerance.distance);
      const JoinOrders orders = measured_orders(found, order.c, order.is_same, result_.diagonal, options_.tolerance);
      add(seam, found, orders, part.begin, part.end);
    };
    for_each_strip(nets_[l.patch], nets_[r.patch], seam, same_knot, visit);
  }

  /// Compares two sides at nearest points, on a part of the first one.
  void compare_nearest(PatchSeam& seam, const SideCurve& second, double begin, double end) const {
    const PatchLine &l = seam.lines[0], &r = seam.lines[1];
    const auto on_left = [&](std::span<const double> s) {
      std::vector<double> own;
      for (const double x : s) own.push_back(begin + x * (end - begin));
      return line_samples(patches_[l.patch], coordinates_, l, own, 2);
    };
    const auto curve = [&](double s) -> Eigen::RowVector3d {
      return line_samples(patches_[r.patch], coordinates_, r, {&s, 1}, 0).position.row(0);
    };
    const auto on_right = [&](std::span<const double> s) {
      const LimitSamples at = on_left(s);
      std::vector<double> own;
      for (Index i = 0; i < std::ssize(s); ++i)
        own.push_back(nearest_on_line(curve, second.points, at.position.row(i)).s);
      return line_samples(patches_[r.patch], coordinates_, r, own, 2);
    };
    // In which direction the second side runs, by the tangents in the middle.
    const double middle = 0.5;
    const LimitSamples a = on_left({&middle, 1}), b = on_right({&middle, 1});
    const Eigen::RowVector3d tangent = (l.along_v ? a.dv : a.du).row(0), other = (r.along_v ? b.dv : b.du).row(0);
    seam.reversed[1] = tangent.dot(other) < 0;
    const EdgeSide left{.evaluate = on_left, .along_v = l.along_v, .sign = line_sign(l, true, false)};
    const EdgeSide right{.evaluate = on_right, .along_v = r.along_v, .sign = line_sign(r, false, seam.reversed[1])};
    seam.same_orientation = left.sign == right.sign;
    const EdgeDeviation found = measured_deviation(left, right, 33);
    add(seam, found, measured_orders(found, 0, false, result_.diagonal, options_.tolerance), begin, end);
  }

  void add_knot_lines(size_t p, bool along_v) {
    PatchLine left{.patch = p, .along_v = along_v};
    const Knots<double>& across = patches_[p].across(left);
    for (left.face = 0; left.face < across.num_faces(); ++left.face) {
      const std::optional<int> c = across.continuity(left.face, KnotSide::right);
      if (!c) continue;
      const bool is_last = left.face + 1 == across.num_faces();
      if (*c >= options_.smooth && has_normals(left)) {
        ++result_.smooth_lines;
        continue;
      }
      PatchLine right = left;
      right.face = is_last ? 0 : left.face + 1, right.end = KnotSide::left;
      PatchSeam found = seam(is_last ? SeamKind::period : SeamKind::knot, {left, right}, {false, false});
      found.columns_c = *c;
      compare(found);
      result_.seams.push_back(std::move(found));
    }
  }
  bool has_normals(const PatchLine& line) const {
    std::vector<double> s;
    const Knots<double>& along = patches_[line.patch].along(line);
    const int samples = 4 * along.num_faces() + 1;
    for (int i = 0; i < samples; ++i) s.push_back(i / (samples - 1.0));
    const LimitSamples at = line_samples(patches_[line.patch], coordinates_, line, s, 1);
    return std::ranges::all_of(
        at.status, [](LimitStatus status) { return has_position(status) && status != LimitStatus::undefined_normal; });
  }

  void add_sides() {
    const std::vector<SideCurve> sides = side_curves(patches_, coordinates_, same_);
    const std::vector<std::pair<size_t, size_t>> pairs = near_pairs(sides, same_);
    // Classes of sides that are one curve.
    std::vector<size_t> first(sides.size());
    std::iota(first.begin(), first.end(), size_t{0});
    const auto is_curve = [&](size_t i) { return sides[i].is_there && !sides[i].is_collapsed; };
    const auto root = [&](size_t i) {
      while (first[i] != i) i = first[i];
      return i;
    };
    for (const auto& [i, j] : pairs)
      if (is_curve(i) && is_curve(j) && same_curve(sides[i], sides[j], same_)) {
        const auto [low, high] = std::minmax({root(i), root(j)});
        first[high] = low;
      }
    std::map<size_t, std::vector<size_t>> classes;
    for (size_t i = 0; i < sides.size(); ++i) classes[root(i)].push_back(i);
    std::vector<char> is_alone(sides.size()), has_partner(sides.size());
    for (const auto& [least, members] : classes) {
      is_alone[least] = members.size() == 1 && is_curve(least);
      if (members.size() == 1) continue;
      std::vector<PatchLine> lines;
      std::vector<bool> reversed;
      for (const size_t i : members) {
        lines.push_back(sides[i].line);
        reversed.push_back(i != least && same_curve(sides[least], sides[i], same_).value_or(false));
      }
      PatchSeam found = seam(members.size() == 2 ? SeamKind::sides : SeamKind::non_manifold, lines, reversed);
      if (found.kind == SeamKind::sides) compare(found);
      result_.seams.push_back(std::move(found));
    }
    for (const auto& [i, j] : pairs) {
      if (!is_alone[i] || !is_alone[j]) continue;
      std::optional<SideOverlap> overlap = side_overlap(patches_, coordinates_, sides[i], sides[j], same_);
      if (!overlap) continue;
      size_t a = i, b = j;
      const bool all_of_first = overlap->begin == 0 && overlap->end == 1;
      if (!all_of_first && overlap->all_of_second) {
        std::swap(a, b);
        *overlap = {};
      }
      has_partner[i] = has_partner[j] = true;
      PatchSeam found = seam(all_of_first && overlap->all_of_second ? SeamKind::reparametrised : SeamKind::partial,
                             {sides[a].line, sides[b].line}, {false, false});
      compare_nearest(found, sides[b], overlap->begin, overlap->end);
      if (found.kind == SeamKind::partial) {
        const Knots<double>& along = patches_[sides[a].line.patch].along(sides[a].line);
        const double length = along.end() - along.begin();
        found.part = {along.begin() + overlap->begin * length, along.begin() + overlap->end * length};
      }
      result_.seams.push_back(std::move(found));
    }
    for (size_t i = 0; i < sides.size(); ++i) {
      if (sides[i].is_collapsed) {
        PatchSeam found = seam(SeamKind::collapsed, {sides[i].line}, {false});
        found.has_plane = has_normals(sides[i].line);
        result_.seams.push_back(std::move(found));
      } else if (!sides[i].is_there || (is_alone[i] && !has_partner[i])) {
        result_.seams.push_back(seam(SeamKind::boundary, {sides[i].line}, {false}));
      }
    }
  }

  std::span<const PatchColumns> patches_;
  Coordinates coordinates_;
  SeamOptions options_;
  double same_ = 0;
  std::vector<SeamNet<double>> nets_;
  PatchSeams result_{};
};

}  // namespace

PatchSeams patch_seams(std::span<const PatchColumns> patches, Coordinates coordinates, const SeamOptions& options) {
  return SeamFinder(patches, coordinates, options).found();
}

}  // namespace sublimit
