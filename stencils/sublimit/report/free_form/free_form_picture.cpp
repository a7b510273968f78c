// SPDX-License-Identifier: Apache-2.0
// What pictures of free-form shapes are drawn from: points of the patches on grids, control nets, curves with their
// curvature.
#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "sublimit/patches/spline_curve.h"
#include "sublimit/report/free_form/free_form_report.h"

namespace sublimit::free_form_detail {
namespace {

/// Grids of n + 1 by n + 1 points of every face; n is even.
class SurfaceGrids {
 public:
  SurfaceGrids(FreeFormPicture& picture, const SplinePatches& patches, int n)
      : picture_(picture), patches_(patches), n_(n) {}

  void add_all() {
    Index faces = 0;
    for (const PatchColumns& patch : patches_.patches) faces += patch.surface->num_faces();
    picture_.surface.positions.resize(Eigen::Index(faces) * (n_ + 1) * (n_ + 1), 3);
    picture_.surface.normals.resizeLike(picture_.surface.positions);
    for (const PatchColumns& patch : patches_.patches) add(patch);
    picture_.surface.curvature.resize(size_t(picture_.surface.positions.rows()));
  }

 private:
  void add(const PatchColumns& patch) {
    std::vector<Place> places;
    for (Index f = 0; f < patch.surface->num_faces(); ++f)
      for (int j = 0; j <= n_; ++j)
        for (int i = 0; i <= n_; ++i) places.push_back({.face = f, .u = double(i) / n_, .v = double(j) / n_});
    const LimitSamples at = patch.surface->evaluate(patch.columns, places, 1, patches_.coordinates);
    std::vector<char> is_there;
    for (const LimitStatus status : at.status) is_there.push_back(has_position(status));
    const auto count = Eigen::Index(places.size());
    picture_.surface.positions.middleRows(next_, count) = at.position;
    picture_.surface.normals.middleRows(next_, count) = at.normal;
    const Index m = patch.surface->u().num_faces(), faces = patch.surface->num_faces();
    for (Index f = 0; f < faces; ++f) {
      const auto local = [&](int i, int j) { return (f * (n_ + 1) + j) * (n_ + 1) + i; };
      for (int j = 0; j < n_; ++j)
        for (int i = 0; i < n_; ++i)
          add_face({local(i, j), local(i + 1, j), local(i + 1, j + 1), local(i, j + 1)}, is_there);
      // The face's first sides, its middle lines, and the patch's last sides.
      for (const int k : {0, n_ / 2, n_}) {
        std::vector<Index> in_u, in_v;
        for (int i = 0; i <= n_; ++i) in_u.push_back(local(i, k)), in_v.push_back(local(k, i));
        if (k < n_ || f + m >= faces) add_line(in_u, is_there);
        if (k < n_ || f % m == m - 1) add_line(in_v, is_there);
      }
    }
    next_ += static_cast<Index>(count);
  }
  void add_face(const std::vector<Index>& corners, const std::vector<char>& is_there) {
    if (!std::ranges::all_of(corners, [&](Index v) { return is_there[size_t(v)] != 0; })) return;
    picture_.surface.face_sizes.push_back(4);
    for (const Index v : corners) picture_.surface.face_vertices.push_back(next_ + v);
  }
  void add_line(const std::vector<Index>& line, const std::vector<char>& is_there) {
    if (!std::ranges::all_of(line, [&](Index v) { return is_there[size_t(v)] != 0; })) return;
    std::vector<Index>& added = picture_.isolines.emplace_back();
    for (const Index v : line) added.push_back(next_ + v);
  }

  FreeFormPicture& picture_;
  const SplinePatches& patches_;
  int n_;
  Index next_ = 0;
};

/// Control points of all elements and the edges of their nets and polygons.
class ControlNets {
 public:
  explicit ControlNets(const FreeForm& shapes) : shapes_(shapes), number_(size_t(shapes.vertices.rows()), -1) {}

  void add(const FreeFormSurface& surface) {
    for (Index j = 0; j < surface.v.count; ++j)
      for (Index i = 0; i < surface.u.count; ++i) {
        const Index a = surface.points[size_t(i + surface.u.count * j)];
        if (i + 1 < surface.u.count) add_edge(a, surface.points[size_t(i + 1 + surface.u.count * j)]);
        if (j + 1 < surface.v.count) add_edge(a, surface.points[size_t(i + surface.u.count * (j + 1))]);
      }
  }
  void add(const FreeFormCurve& curve) {
    for (size_t i = 0; i + 1 < curve.points.size(); ++i) add_edge(curve.points[i], curve.points[i + 1]);
  }
  void put_into(FreeFormPicture& picture) const {
    picture.net.resize(Eigen::Index(points_.size()), 3);
    for (size_t i = 0; i < points_.size(); ++i) picture.net.row(Eigen::Index(i)) = shapes_.vertices.row(points_[i]);
    picture.net_edges.assign(edges_.begin(), edges_.end());
  }

 private:
  void add_edge(Index a, Index b) {
    if (a == b || shapes_.weights[size_t(a)] == 0 || shapes_.weights[size_t(b)] == 0) return;
    const auto [low, high] = std::minmax({number(a), number(b)});
    edges_.insert({low, high});
  }
  Index number(Index vertex) {
    Index& found = number_[size_t(vertex)];
    if (found < 0) {
      found = static_cast<Index>(points_.size());
      points_.push_back(vertex);
    }
    return found;
  }

  const FreeForm& shapes_;
  std::vector<Index> number_, points_;
  std::set<std::array<Index, 2>> edges_;
};

CurvePicture curve_picture(const CurveBezier& curve) {
  CurvePicture picture;
  for (const BezierPiece<double>& piece : curve.pieces) {
    const bool rational = piece.coordinates == Coordinates::homogeneous;
    const Eigen::Index width = rational ? 4 : 3;
    const Points columns = Eigen::Map<const Points>(piece.columns.data(), piece.degree + 1, width);
    const int count = piece.degree == 1 && !rational ? 1 : 24;
    std::vector<CurvePlace> places;
    for (int i = 0; i <= count; ++i) places.push_back({0, double(i) / count});
    const CurveSamples at =
        SplineCurve(bezier_knots<double>(piece.degree)).evaluate(columns, places, 2, piece.coordinates);
    auto& points = picture.points.emplace_back();
    auto& curvature = picture.curvature.emplace_back();
    for (Eigen::Index i = 0; i <= count; ++i) {
      if (!has_position(at.status[size_t(i)])) continue;
      points.emplace_back(at.position.row(i));
      const Eigen::Vector3d first = at.first.row(i), second = at.second.row(i);
      const double speed = first.squaredNorm();
      std::optional<Eigen::Vector3d>& K = curvature.emplace_back();
      if (speed > 0) K = (second - second.dot(first) / speed * first) / speed;
    }
  }
  return picture;
}

}  // namespace

FreeFormPicture picture(const FreeFormReport& report, const FreeFormReportOptions& options) {
  FreeFormPicture result;
  Index faces = 0;
  for (const PatchColumns& patch : report.patches.patches) faces += patch.surface->num_faces();
  if (faces > 0 && std::int64_t{4} * faces <= options.surface_faces) {
    const int n = std::clamp(2 * int(std::sqrt(options.surface_faces / double(faces)) / 2), 2, 12);
    SurfaceGrids(result, report.patches, n).add_all();
  }
  ControlNets nets(report.shapes);
  for (const FreeFormSurface& surface : report.shapes.surfaces) nets.add(surface);
  for (const FreeFormCurve& curve : report.shapes.curves) nets.add(curve);
  nets.put_into(result);
  for (const CurveBezier& curve : report.curves) result.curves.push_back(curve_picture(curve));
  return result;
}

}  // namespace sublimit::free_form_detail
