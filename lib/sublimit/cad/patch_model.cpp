// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/patch_model.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/cad/patch_integrals.h"
#include "sublimit/cad/side_cuts.h"
#include "sublimit/cad/signed_classes.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/patches/detail/spline_rows.h"
#include "sublimit/patches/joins/line_samples.h"

namespace sublimit {
namespace {

/// Corners (begin, begin), (end, begin), (end, end), (begin, end) of (u, v): from which to which a side runs as its
/// parameter rises.
std::array<size_t, 2> ends_of(PatchSide side) {
  switch (side) {
    case PatchSide::u_begin:
      return {0, 3};
    case PatchSide::u_end:
      return {1, 2};
    case PatchSide::v_begin:
      return {0, 1};
    default:
      return {3, 2};
  }
}

/// Poles of homogeneous columns, and their weights; none where all are 1.
std::pair<Points, Eigen::VectorXd> poles_of(const Points& columns) {
  if (columns.cols() == 3) return {columns, {}};
  Eigen::VectorXd weights = columns.col(3);
  Points poles = columns.leftCols(3);
  if ((weights.array() == 1).all()) return {std::move(poles), {}};
  for (Eigen::Index i = 0; i < poles.rows(); ++i) poles.row(i) /= weights[i];
  // A common factor means nothing, but kernels of CAD take none that are next to 0; powers of two change no digit.
  if (const double largest = weights.maxCoeff(); largest < 0x1p-20 || largest > 0x1p20)
    for (double& weight : weights) weight = std::ldexp(weight, -std::ilogb(largest));
  return {std::move(poles), weights};
}

std::vector<double> all_of(const Knots<double>& knots) { return {knots.all().begin(), knots.all().end()}; }

class PatchModelMaker {
 public:
  PatchModelMaker(std::span<const NamedPatch> sources, const PatchModelOptions& options)
      : sources_(sources), clamped_(clamped_patches(sources)), fronts_(size()) {
    for (const ClampedPatch& patch : clamped_.patches) patches_.push_back({&patch.surface, patch.columns});
    // Lines of inner knots are no edges, however smooth they are.
    seams_ = patch_seams(patches_, clamped_.coordinates, {.same = options.same, .smooth = -1});
    model_.diagonal = seams_.diagonal;
    same_ = options.same * seams_.diagonal;
    for (size_t p = 0; p < size(); ++p) add_corners(p);
    const std::vector<std::vector<double>> cuts = side_cuts(patches_, clamped_.coordinates, seams_, same_);
    for (size_t side = 0; side < cuts.size(); ++side) add_parts(side, cuts[side]);
  }

  PatchModel make() && {
    for (const PatchSeam& seam : seams_.seams) take(seam);
    add_vertices();
    for (std::vector<Part>& side : sides_)
      for (Part& part : side) add_edge(part);
    for (size_t p = 0; p < size(); ++p) add_face(p);
    return std::move(model_);
  }

 private:
  /// Of a side what lies between its cuts, mostly all of it: an edge.
  struct Part {
    SidePart at;
    size_t start = 0, end = 0;  ///< points
    Part* first = nullptr;      ///< the part that it shares an edge with, if that comes first
    bool reversed = false;      ///< against it
    bool is_shared = false, is_point = false;
    double gap = 0;
    Index edge = -1;
  };

  size_t size() const { return clamped_.patches.size(); }
  std::vector<Part>& side(const PatchLine& line) { return sides_[side_number(line)]; }

  size_t add_point(const Eigen::RowVector3d& x) {
    points_.push_back(x);
    return vertices_.add();
  }
  /// Those of a patch that are the same point are one: the ends of a circle, a pole.
  void add_corners(size_t p) {
    const ClampedPatch& patch = clamped_.patches[p];
    const Index u = patch.surface.u().num_points(), v = patch.surface.v().num_points();
    for (const Index row : {0, u - 1, u * v - 1, u * (v - 1)}) {
      const Eigen::RowVectorXd column = patch.columns.row(row);
      const size_t at = add_point(column.size() == 4 ? column.head(3) / column[3] : column);
      for (size_t other = 4 * p; other < at; ++other)
        if ((points_[other] - points_[at]).norm() <= same_) vertices_.join(other, at);
    }
  }
  void add_parts(size_t number, const std::vector<double>& cuts) {
    const PatchLine line = side_line(patches_, number / 4, PatchSide(number % 4));
    const auto [first, last] = ends_of(side_of(line));
    std::vector<Part> parts;
    size_t from = 4 * line.patch + first;
    for (size_t k = 0; k + 1 < cuts.size(); ++k) {
      const bool is_last = k + 2 == cuts.size();
      const size_t to = is_last ? 4 * line.patch + last : add_point(point_on(line, cuts[k + 1]));
      parts.push_back({.at = {line, cuts[k], cuts[k + 1]}, .start = from, .end = to});
      from = to;
    }
    sides_.push_back(std::move(parts));
  }
  Eigen::RowVector3d point_on(const PatchLine& line, double t) const {
    const PatchColumns& patch = patches_[line.patch];
    const Place at = line_place(patch, line, patch.along(line).place(t));
    return patch.surface->evaluate(patch.columns, {&at, 1}, 0, clamped_.coordinates).position.row(0);
  }

  void take(const PatchSeam& seam) {
    switch (seam.kind) {
      case SeamKind::sides:
        share(side(seam.lines[0])[0], side(seam.lines[1])[0], seam.reversed[1], seam.gap ? seam.gap->value : 0,
              seam.angle);
        break;
      case SeamKind::partial:
        share_parts(seam);
        break;
      case SeamKind::collapsed:
        side(seam.lines[0])[0].is_point = true;
        ++model_.points;
        break;
      case SeamKind::boundary:
        ++model_.open;
        break;
      case SeamKind::reparametrised:
        ++model_.reparametrised;
        break;
      case SeamKind::non_manifold:
        ++model_.non_manifold;
        break;
      default:
        break;
    }
  }

  /// Parts of two sides that are one curve in one parameter.
  void share_parts(const PatchSeam& seam) {
    bool is_one = false;
    for (Part& a : side(seam.lines[0]))
      for (Part& b : side(seam.lines[1])) {
        const PartDistance found = part_distance(patches_, clamped_.coordinates, a.at, b.at);
        if (found.distance > same_) continue;
        is_one = true;
        share(a, b, found.reversed, found.distance, seam.angle);
      }
    if (!is_one) ++model_.partial;
  }

  /// A face meets itself as a cylinder does, or not at all: files without curves in parameters say no more. Fronts go
  /// on across edges, and these have two faces.
  bool join_fronts(const Part& a, const Part& b, bool reversed) {
    if (a.is_shared || b.is_shared) return false;
    const PatchLine &l = a.at.line, &r = b.at.line;
    if (l.patch == r.patch) return l.along_v == r.along_v && !reversed && sides_[side_number(l)].size() == 1;
    const bool turned = line_sign(l, true, false) != line_sign(r, false, reversed);
    return fronts_.join(l.patch, r.patch, turned);
  }

  void share(Part& a, Part& b, bool reversed, double gap, const std::optional<SeamMaximum>& angle) {
    if (!join_fronts(a, b, reversed)) {
      ++model_.unsuitable;
      return;
    }
    const bool in_order = side_number(a.at.line) < side_number(b.at.line);
    Part &first = in_order ? a : b, &second = in_order ? b : a;
    ++(a.at.line.patch == b.at.line.patch ? model_.seams : model_.shared);
    first.is_shared = second.is_shared = true;
    second.first = &first;
    second.reversed = reversed;
    vertices_.join(first.start, reversed ? second.end : second.start);
    vertices_.join(first.end, reversed ? second.start : second.end);
    first.gap = gap;
    model_.gap = std::max(model_.gap, gap);
    if (angle && angle->value > model_.angle) model_.angle = angle->value, model_.angle_at = angle->point;
  }

  void add_vertices() {
    std::vector<Index> kept;
    vertex_.resize(points_.size());
    for (size_t at = 0; at < points_.size(); ++at) {
      const size_t least = vertices_.find(at).first;
      if (least == at) vertex_[at] = Index(kept.size()), kept.push_back(Index(at));
      vertex_[at] = vertex_[least];
    }
    model_.boundary.vertices.resize(Index(kept.size()), 3);
    for (size_t v = 0; v < kept.size(); ++v) model_.boundary.vertices.row(Index(v)) = points_[size_t(kept[v])];
  }

  void add_edge(Part& part) {
    if (part.first) {
      part.edge = part.first->edge;
      return;
    }
    part.edge = Index(model_.boundary.edges.size());
    const Knots<double>& along = patches_[part.at.line.patch].along(part.at.line);
    const bool is_whole = part.at.begin == along.begin() && part.at.end == along.end();
    const Knots<double> knots = is_whole ? along : part_knots(along, part.at.begin, part.at.end);
    const Points columns = side_columns(part.at.line);
    SplineEdge edge{.start = vertex_[part.start],
                    .end = vertex_[part.end],
                    .degree = knots.degree(),
                    .knots = all_of(knots),
                    .poles = {}};
    std::tie(edge.poles, edge.weights) = poles_of(is_whole ? columns : apply(part_matrix(along, knots), columns));
    edge.gap = part.gap;
    edge.is_sharp = true;
    edge.is_point = part.is_point;
    model_.boundary.edges.push_back(std::move(edge));
  }
  Points side_columns(const PatchLine& line) const {
    const PatchColumns& patch = patches_[line.patch];
    const Index u = patch.surface->u().num_points(), v = patch.surface->v().num_points();
    const bool at_end = line.end == KnotSide::right;
    std::vector<Index> rows;
    if (line.along_v)
      for (Index j = 0; j < v; ++j) rows.push_back(u * j + (at_end ? u - 1 : 0));
    else
      for (Index i = 0; i < u; ++i) rows.push_back(i + (at_end ? u * (v - 1) : 0));
    return patch.columns(rows, Eigen::all);
  }

  void add_face(size_t p) {
    const SplineSurface& surface = clamped_.patches[p].surface;
    SplineFace face{.u_degree = surface.u().degree(),
                    .v_degree = surface.v().degree(),
                    .u_knots = all_of(surface.u()),
                    .v_knots = all_of(surface.v()),
                    .poles = {}};
    const Index u = surface.u().num_points(), v = surface.v().num_points();
    std::vector<Index> rows;  // v fastest
    for (Index i = 0; i < u; ++i)
      for (Index j = 0; j < v; ++j) rows.push_back(i + u * j);
    std::tie(face.poles, face.weights) = poles_of(clamped_.patches[p].columns(rows, Eigen::all));
    add_border(face, p);
    face.reversed = fronts_.find(p).second;
    face.name = sources_[clamped_.patches[p].source].name;
    const SurfaceIntegrals integrals =
        surface_integrals(surface, clamped_.patches[p].columns, clamped_.coordinates, model_.boundary.vertices.row(0));
    constexpr double rounding = 1e-15;
    if (!(integrals.area > rounding * seams_.diagonal * seams_.diagonal))
      throw UnsupportedTopology(sources_[clamped_.patches[p].source].place +
                                " is a curve or a point, without area, and CAD files have no such faces; leave it out");
    face.volume = face.reversed ? -integrals.volume : integrals.volume;
    model_.area += integrals.area;
    model_.boundary.faces.push_back(std::move(face));
  }
  /// Counter-clockwise.
  void add_border(SplineFace& face, size_t p) const {
    for (const PatchSide at : {PatchSide::v_begin, PatchSide::u_end, PatchSide::v_end, PatchSide::u_begin}) {
      const bool falls = at == PatchSide::v_end || at == PatchSide::u_begin;
      std::vector<EdgeUse> uses;
      for (const Part& part : sides_[4 * p + size_t(at)]) {
        const PatchLine& line = part.at.line;
        const std::vector<double>& across = line.along_v ? face.u_knots : face.v_knots;
        const double knot = line.end == KnotSide::right ? across.back() : across.front();
        const auto place = [&](double t) { return line.along_v ? Eigen::Vector2d(knot, t) : Eigen::Vector2d(t, knot); };
        uses.push_back({part.edge, falls != part.reversed, place(falls ? part.at.end : part.at.begin),
                        place(falls ? part.at.begin : part.at.end)});
      }
      if (falls) std::ranges::reverse(uses);
      face.border.insert(face.border.end(), uses.begin(), uses.end());
    }
  }

  std::span<const NamedPatch> sources_;
  ClampedPatches clamped_;
  std::vector<PatchColumns> patches_;
  PatchSeams seams_;
  double same_ = 0;
  SignedClasses fronts_, vertices_;         // patches; points that are one
  std::vector<Eigen::RowVector3d> points_;  // corners, four of each patch, then those at cuts
  std::vector<std::vector<Part>> sides_;    // four of each patch
  std::vector<Index> vertex_;               // by point
  PatchModel model_;
};

}  // namespace

PatchModel patch_model(std::span<const NamedPatch> patches, const PatchModelOptions& options) {
  return PatchModelMaker(patches, options).make();
}

}  // namespace sublimit
