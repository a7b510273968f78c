// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/detail/free_form_patches.h"

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/free_form_counts.h"
#include "sublimit/patches/detail/basis_surface.h"
#include "sublimit/patches/detail/cut_patch.h"
#include "sublimit/patches/detail/spline_rows.h"
#include "sublimit/patches/spline_curve.h"
#include "sublimit/patches/spline_surface.h"

namespace sublimit {
namespace {

std::string at(const std::string& name, std::int64_t line) { return name + ":" + std::to_string(line) + ": "; }

std::shared_ptr<const Patch> patch_of(const FreeForm& shapes, const FreeFormSurface& s) {
  std::shared_ptr<const Patch> patch;
  if (s.basis == FreeFormBasis::bezier || s.basis == FreeFormBasis::bspline)
    patch = std::make_shared<const SplineSurface>(free_form_knots(s.basis, s.u), free_form_knots(s.basis, s.v));
  else
    patch = std::make_shared<const BasisSurface>(free_form_segments(shapes, s.basis, s.u),
                                                 free_form_segments(shapes, s.basis, s.v));
  const auto [u0, u1] = free_form_domain(s.basis, s.u);
  const auto [v0, v1] = free_form_domain(s.basis, s.v);
  if (s.u.first == u0 && s.u.last == u1 && s.v.first == v0 && s.v.last == v1) return patch;
  return std::make_shared<const CutPatch>(std::move(patch), Eigen::Array2d(s.u.first, s.v.first),
                                          Eigen::Array2d(s.u.last, s.v.last));
}

/// A vertex times its weight; a direction where that is 0.
Eigen::RowVector3d weighted(const std::string& name, const FreeForm& shapes, Index vertex, double weight) {
  const Eigen::RowVector3d product = (weight == 0 ? 1 : weight) * shapes.vertices.row(vertex);
  if (!product.allFinite())
    throw InvalidMesh(name + ": vertex " + format_number(vertex + 1) + ": its coordinates times its weight, " +
                      format_number(weight) + ", are beyond the largest number; scale the weights down");
  return product;
}

/// A column for each vertex of the file, so that patches share what they name together; and one more where a vertex
/// that has a weight is used by a surface that is not rational.
class ControlColumns {
 public:
  ControlColumns(const FreeForm& shapes, bool rational)
      : shapes_(shapes), rational_(rational), size_(static_cast<Index>(shapes.vertices.rows())) {}

  std::vector<Index> of(const FreeFormElement& element) {
    std::vector<Index> points = element.points;
    if (!rational_ || element.rational) return points;
    for (Index& v : points) {
      if (shapes_.weights[size_t(v)] == 1) continue;
      const auto [at, is_new] = plain_.try_emplace(v, size());
      if (is_new) append(shapes_.vertices.row(v));
      v = at->second;
    }
    return points;
  }
  /// More points of weight 1; where the first one is.
  Index append(const Points& points) {
    const Index first = size();
    for (const auto& point : points.rowwise()) more_.emplace_back(point[0], point[1], point[2], 1);
    return first;
  }
  Index size() const { return size_ + static_cast<Index>(more_.size()); }
  /// @throws InvalidMesh  products with weights that are beyond all numbers
  Points matrix(const std::string& name) const {
    Points columns(size(), rational_ ? 4 : 3);
    for (Index v = 0; v < size_; ++v) {
      const double w = rational_ ? shapes_.weights[size_t(v)] : 1;
      columns.row(v).head(3) = weighted(name, shapes_, v, w);
      if (rational_) columns(v, 3) = w;
    }
    for (size_t i = 0; i < more_.size(); ++i) columns.row(size_ + Eigen::Index(i)) = more_[i].head(columns.cols());
    return columns;
  }

 private:
  const FreeForm& shapes_;
  bool rational_;
  Index size_;
  std::vector<Eigen::RowVector4d> more_;
  std::map<Index, Index> plain_;
};

PatchSet::Member member_of(const FreeForm& shapes, const FreeFormSurface& s, bool rational, ControlColumns& columns) {
  std::shared_ptr<const Patch> patch = patch_of(shapes, s);
  if (!rational || s.rational || patch->is_affine()) return {std::move(patch), columns.of(s)};
  // Coefficients are no points that a weight of 1 could stand beside: the Bezier pieces' control points are.
  const Patch::Refined pieces = patch->refined();
  if (!pieces.patch)
    throw InvalidParameter(
        "a part of a polynomial by its coefficients beside rational surfaces; put them in files of "
        "their own, or take all of its range");
  const Points net = pieces.S * Points(shapes.vertices(s.points, Eigen::all));
  std::vector<Index> points(size_t(net.rows()));
  std::iota(points.begin(), points.end(), columns.append(net));
  return {pieces.patch, std::move(points)};
}

/// Knots and points of a direction with its ends open.
FreeFormDirection direction_of(const Knots<double>& knots) {
  FreeFormDirection direction;
  direction.degree = knots.degree();
  direction.count = knots.num_functions();
  direction.parameters.assign(knots.all().begin(), knots.all().end());
  direction.first = knots.begin(), direction.last = knots.end();
  return direction;
}

}  // namespace

Knots<double> free_form_knots(FreeFormBasis basis, const FreeFormDirection& direction) {
  const std::vector<double>& values = direction.parameters;
  if (basis == FreeFormBasis::bspline) return Knots<double>::open(direction.degree, direction.count, values);
  // Pieces side by side share a control point, so that inner ends are there once for each degree.
  std::vector<double> knots{values.front()};
  for (const double t : values) knots.insert(knots.end(), size_t(direction.degree), t);
  knots.push_back(values.back());
  return Knots<double>::open(direction.degree, direction.count, std::move(knots));
}

SegmentBasis free_form_segments(const FreeForm& shapes, FreeFormBasis basis, const FreeFormDirection& direction) {
  if (basis == FreeFormBasis::cardinal) return SegmentBasis::cardinal(direction.parameters);
  if (basis == FreeFormBasis::taylor) return SegmentBasis::taylor(direction.degree, direction.parameters);
  return SegmentBasis(direction.degree, direction.step, shapes.matrices[size_t(direction.matrix)].values,
                      direction.parameters);
}

FreeForm to_free_form(const PatchSet& patches, const Points& columns) {
  check_columns(columns, patches.num_points(), patches.coordinates());
  const bool rational = patches.coordinates() == Coordinates::homogeneous;
  FreeForm file;
  file.vertices = columns.leftCols(3);
  file.weights.assign(size_t(columns.rows()), 1);
  for (Eigen::Index i = 0; i < columns.rows() && rational; ++i) {
    const double w = columns(i, 3);
    file.weights[size_t(i)] = w;
    if (w != 0) file.vertices.row(i) /= w;  // else a direction, as it is
  }
  for (size_t p = 0; p < patches.members().size(); ++p) {
    const auto& [patch, points] = patches.members()[p];
    const auto* const spline = dynamic_cast<const SplineSurface*>(patch.get());
    if (!spline) throw UnsupportedTopology("patch " + std::to_string(p) + " is no B-spline, which a file could have");
    for (const auto& [name, knots] : {std::pair('u', &spline->u()), std::pair('v', &spline->v())})
      if (knots->degree() < 1)
        throw UnsupportedTopology("patch " + std::to_string(p) + " has degree 0 in " + name +
                                  ", which OBJ does not have");
    FreeFormSurface surface;
    surface.basis = FreeFormBasis::bspline;
    surface.rational = rational;
    surface.u = direction_of(spline->u());
    surface.v = direction_of(spline->v());
    for (Index j = 0; j < surface.v.count; ++j)
      for (Index i = 0; i < surface.u.count; ++i)
        surface.points.push_back(
            points[size_t(spline->u().point(i) + spline->u().num_points() * spline->v().point(j))]);
    file.surfaces.push_back(std::move(surface));
  }
  return file;
}

FreeFormPatches free_form_patches(const FreeForm& shapes, const std::string& name) {
  if (shapes.surfaces.empty())
    throw UnsupportedTopology(name + ": " + std::to_string(shapes.curves.size()) +
                              " curves and no surfaces; give a file with `surf`");
  const bool rational =
      std::ranges::any_of(shapes.surfaces, [](const FreeFormSurface& surface) { return surface.rational; });
  std::int64_t points = 0;
  for (const FreeFormSurface& surface : shapes.surfaces) points += std::ssize(surface.points);
  constexpr double bytes_of_point = 4 + 4 * 8;  // which it is, and its column
  check_memory(name + ": surfaces of " + format_number(points) + " control points", bytes_of_point * double(points),
               "put them into several files");
  std::vector<PatchSet::Member> members;
  std::vector<std::int64_t> lines;
  ControlColumns columns(shapes, rational);
  for (const FreeFormSurface& surface : shapes.surfaces) {
    try {
      members.push_back(member_of(shapes, surface, rational, columns));
    } catch (const InvalidParameter& error) {
      throw FormatError(at(name, surface.line) + error.what());
    }
    lines.push_back(surface.line);
  }
  const Index num_points = columns.size();
  return {PatchSet(std::move(members), num_points, rational ? Coordinates::homogeneous : Coordinates::plain),
          columns.matrix(name), std::move(lines)};
}

FreeFormCurves free_form_curves(const FreeForm& shapes, const std::string& name) {
  if (shapes.curves.empty())
    throw UnsupportedTopology(name + ": " + std::to_string(shapes.surfaces.size()) +
                              " surfaces and no curves; give a file with `curv`");
  const bool rational = std::ranges::any_of(shapes.curves, [](const FreeFormCurve& curve) { return curve.rational; });
  std::vector<std::shared_ptr<const LinearCurve>> curves;
  std::vector<Points> parts;
  std::vector<std::int64_t> lines;
  Eigen::Index size = 0;
  for (const FreeFormCurve& curve : shapes.curves) {
    Points own(std::ssize(curve.points), rational ? 4 : 3);
    for (Eigen::Index i = 0; i < own.rows(); ++i) {
      const Index v = curve.points[size_t(i)];
      const double w = curve.rational ? shapes.weights[size_t(v)] : 1;
      own.row(i).head(3) = weighted(name, shapes, v, w);
      if (rational) own(i, 3) = w;
    }
    try {
      const auto [first, last] = free_form_domain(curve.basis, curve.u);
      std::optional<SplineCurve> whole;
      if (curve.basis == FreeFormBasis::bezier || curve.basis == FreeFormBasis::bspline) {
        whole.emplace(free_form_knots(curve.basis, curve.u));
      } else {
        const SegmentBasis basis = free_form_segments(shapes, curve.basis, curve.u);
        whole.emplace(basis.knots_of_pieces());
        own = basis.matrix_of_pieces() * own;
      }
      if (curve.u.first != first || curve.u.last != last) {
        // The part inside: other ends, which are knots of full multiplicity then.
        const Knots<double> part = part_knots(whole->knots(), curve.u.first, curve.u.last);
        own = part_matrix(whole->knots(), part) * own;
        whole.emplace(part);
      }
      curves.push_back(std::make_shared<const SplineCurve>(*std::move(whole)));
    } catch (const InvalidParameter& error) {
      throw FormatError(at(name, curve.line) + error.what());
    }
    size += own.rows();
    parts.push_back(std::move(own));
    lines.push_back(curve.line);
  }
  Points columns(size, rational ? 4 : 3);
  Eigen::Index row = 0;
  for (const Points& own : parts) {
    columns.middleRows(row, own.rows()) = own;
    row += own.rows();
  }
  return {CurveSet(std::move(curves)), std::move(columns), rational ? Coordinates::homogeneous : Coordinates::plain,
          std::move(lines)};
}

}  // namespace sublimit
