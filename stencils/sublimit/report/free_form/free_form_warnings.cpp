// SPDX-License-Identifier: Apache-2.0
// Degenerate data of free-form shapes, named as what they are.
#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "sublimit/report/free_form/free_form_report.h"

namespace sublimit::free_form_detail {
namespace {

using Severity = AssetWarning::Severity;

/// Counts places of one kind, keeping the first ones.
class FreeFormWarnings {
 public:
  FreeFormWarnings(std::vector<FreeFormWarning>& out, Index listed) : out_(out), listed_(size_t(listed)) {
    current_.count = 0;
  }

  void begin(Severity severity, std::string says, std::string advice) {
    finish();
    current_ = {.severity = severity, .says = std::move(says), .advice = std::move(advice)};
    current_.count = 0;
  }
  void add_patch(size_t patch, const std::optional<Eigen::Vector3d>& place = {}) {
    add(current_.patches, patch, place);
  }
  void add_curve(size_t curve, const std::optional<Eigen::Vector3d>& place = {}) { add(current_.curves, curve, place); }
  void count_only(std::int64_t count) { current_.count += count; }
  void finish() {
    if (current_.count > 0) out_.push_back(current_);
    current_ = {};
    current_.count = 0;
  }

 private:
  void add(std::vector<size_t>& list, size_t i, const std::optional<Eigen::Vector3d>& place) {
    ++current_.count;
    if (!current_.place) current_.place = place;
    if (list.size() < listed_ && std::ranges::find(list, i) == list.end()) list.push_back(i);
  }

  std::vector<FreeFormWarning>& out_;
  size_t listed_;
  FreeFormWarning current_;
};

/// Rows of a control net, either way: inner ones that are one point, and those that repeat the row before.
struct ControlRows {
  const FreeForm& shapes;
  const FreeFormSurface& surface;

  Eigen::RowVector3d point(bool in_u, Index row, Index i) const {
    const Index number = in_u ? i + row * surface.u.count : row + i * surface.u.count;
    return shapes.vertices.row(surface.points[size_t(number)]);
  }
  Index rows(bool in_u) const { return in_u ? surface.v.count : surface.u.count; }
  Index width(bool in_u) const { return in_u ? surface.u.count : surface.v.count; }
  bool is_point(bool in_u, Index row) const {
    for (Index i = 1; i < width(in_u); ++i)
      if (point(in_u, row, i) != point(in_u, row, 0)) return false;
    return width(in_u) > 1;
  }
  bool repeats(bool in_u, Index row) const {
    for (Index i = 0; i < width(in_u); ++i)
      if (point(in_u, row, i) != point(in_u, row - 1, i)) return false;
    return true;
  }
};

Eigen::Vector3d first_point(const ReportedSeam& seam) {
  return seam.line.empty() ? Eigen::Vector3d::Zero() : seam.line.front();
}

void add_seams(FreeFormWarnings& all, const FreeFormReport& report) {
  const auto each = [&](const auto& is_one) {
    for (const ReportedSeam& seam : report.seams)
      if (is_one(seam)) all.add_patch(seam.seam.lines[0].patch, first_point(seam));
  };
  all.begin(Severity::warning, "sides of patches nearly meet: there is a gap",
            "move their control points together, or allow it with --tolerance g0=");
  each([](const ReportedSeam& seam) { return seam.is_gap; });
  all.begin(Severity::warning, "three or more sides are one curve: not compared",
            "leave two sides there, as surfaces have them");
  each([](const ReportedSeam& seam) { return seam.seam.kind == SeamKind::non_manifold; });
  all.begin(Severity::warning, "T-junction: a side lies on a part of another one",
            "cut the longer side's patch there, so that whole sides meet");
  each([](const ReportedSeam& seam) { return seam.seam.kind == SeamKind::partial; });
  all.begin(Severity::warning, "a side is one point, and the surface has no tangent plane there",
            "the apex of a cone is such a point; else move the control points next to it into one plane");
  each([](const ReportedSeam& seam) { return seam.seam.kind == SeamKind::collapsed && !seam.seam.has_plane; });
  all.begin(Severity::hint, "a side is one point, a pole with a limit of normals",
            "derivatives vanish there; normals are their limits");
  each([](const ReportedSeam& seam) { return seam.seam.kind == SeamKind::collapsed && seam.seam.has_plane; });
  all.begin(Severity::hint, "normals of neighbouring patches are on opposite sides of the surface",
            "reverse u or v of one of them");
  each([](const ReportedSeam& seam) { return seam.seam.is_compared() && !seam.seam.same_orientation; });
  all.begin(Severity::hint,
            fmt::format("sides without a partner: the surface ends there, in {} {}", report.boundary_loops,
                        report.boundary_loops == 1 ? "loop" : "loops"),
            "nothing to do if the surface is meant to be open");
  each([](const ReportedSeam& seam) { return seam.seam.kind == SeamKind::boundary; });
}

void add_surfaces(FreeFormWarnings& all, const FreeFormReport& report) {
  const FreeForm& shapes = report.shapes;
  const auto each_row = [&](const auto& is_one) {
    for (size_t p = 0; p < shapes.surfaces.size(); ++p) {
      const ControlRows rows{shapes, shapes.surfaces[p]};
      for (const bool in_u : {true, false})
        for (Index row = 0; row < rows.rows(in_u); ++row)
          if (is_one(rows, in_u, row)) all.add_patch(p, rows.point(in_u, row, 0).transpose());
    }
  };
  all.begin(Severity::warning, "an inner row of control points is one point",
            "the surface may have no normal beside it; spread the points");
  each_row([](const ControlRows& rows, bool in_u, Index row) {
    return row > 0 && row + 1 < rows.rows(in_u) && rows.is_point(in_u, row);
  });
  all.begin(Severity::warning, "a row of control points repeats the one before",
            "derivatives vanish where as many rows as the degree are equal; use a knot of that multiplicity");
  each_row([](const ControlRows& rows, bool in_u, Index row) { return row > 0 && rows.repeats(in_u, row); });
}

void add_elements(FreeFormWarnings& all, const FreeFormReport& report) {
  const FreeForm& shapes = report.shapes;
  const auto has_bad_weight = [&](const FreeFormElement& element) {
    return element.rational &&
           std::ranges::any_of(element.points, [&](Index v) { return !(shapes.weights[size_t(v)] > 0); });
  };
  all.begin(Severity::warning, "weights that are not positive: no convex hull, and there may be poles",
            "positive weights make the same shape where there is no pole");
  for (size_t p = 0; p < shapes.surfaces.size(); ++p)
    if (has_bad_weight(shapes.surfaces[p])) all.add_patch(p);
  for (size_t c = 0; c < shapes.curves.size(); ++c)
    if (has_bad_weight(shapes.curves[c])) all.add_curve(c);
  all.begin(Severity::hint, "trimming loops: this is about the untrimmed surfaces",
            "seams along trimming curves are not looked for");
  for (size_t p = 0; p < shapes.surfaces.size(); ++p)
    if (is_trimmed(shapes.surfaces[p])) all.add_patch(p);
  all.begin(Severity::hint, "nets that are computed, with rounding: joins are measured, and not decided exactly",
            "give Bezier or B-spline curves and surfaces over their whole domain for exact verdicts");
  for (size_t p = 0; p < shapes.surfaces.size(); ++p)
    if (report.patches.is_converted[p]) all.add_patch(p);
  for (size_t c = 0; c < shapes.curves.size(); ++c)
    if (report.curves[c].exact.empty()) all.add_curve(c);
  all.begin(Severity::warning, "three or more curves end at one point: not compared", "");
  all.count_only(std::int64_t(report.joints.branches));
  all.begin(Severity::hint, fmt::format("the file has a mesh too, of {} faces", shapes.num_faces),
            "name a scheme with -s to analyse its limit");
  all.count_only(shapes.num_faces > 0 ? 1 : 0);
}

}  // namespace

std::vector<FreeFormWarning> warnings(const FreeFormReport& report, const FreeFormReportOptions& options) {
  std::vector<FreeFormWarning> found;
  FreeFormWarnings all(found, options.listed);
  add_seams(all, report);
  add_surfaces(all, report);
  add_elements(all, report);
  all.finish();
  std::ranges::stable_sort(found, {}, &FreeFormWarning::severity);
  return found;
}

}  // namespace sublimit::free_form_detail
