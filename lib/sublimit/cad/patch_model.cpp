// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/patch_model.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/cad/patch_integrals.h"
#include "sublimit/patches/joins/patch_seams.h"

namespace sublimit {
namespace {

/// Numbers in classes; of each also whether it is turned over, seen from the least of its class.
class SignedClasses {
 public:
  explicit SignedClasses(size_t count) : parent_(count), turned_(count, false) {
    std::iota(parent_.begin(), parent_.end(), size_t{0});
  }
  /// The least of the class, and whether i is turned over beside it.
  std::pair<size_t, bool> find(size_t i) const {
    bool turned = false;
    for (; parent_[i] != i; i = parent_[i]) turned ^= bool(turned_[i]);
    return {i, turned};
  }
  /// @return  whether that agrees with what was known
  bool join(size_t i, size_t j, bool turned = false) {
    const auto [a, turned_a] = find(i);
    const auto [b, turned_b] = find(j);
    turned ^= turned_a ^ turned_b;
    if (a == b) return !turned;
    parent_[std::max(a, b)] = std::min(a, b);
    turned_[std::max(a, b)] = turned;
    return true;
  }

 private:
  std::vector<size_t> parent_;
  std::vector<char> turned_;
};

PatchSide side_of(const PatchLine& line) {
  const bool at_end = line.end == KnotSide::right;
  if (line.along_v) return at_end ? PatchSide::u_end : PatchSide::u_begin;
  return at_end ? PatchSide::v_end : PatchSide::v_begin;
}

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
  const Eigen::VectorXd weights = columns.col(3);
  Points poles = columns.leftCols(3);
  if ((weights.array() == 1).all()) return {std::move(poles), {}};
  for (Eigen::Index i = 0; i < poles.rows(); ++i) poles.row(i) /= weights[i];
  return {std::move(poles), weights};
}

std::vector<double> all_of(const Knots<double>& knots) { return {knots.all().begin(), knots.all().end()}; }

class PatchModelMaker {
 public:
  PatchModelMaker(std::span<const NamedPatch> sources, const PatchModelOptions& options)
      : sources_(sources),
        clamped_(clamped_patches(sources)),
        fronts_(size()),
        corners_(4 * size()),
        sides_(4 * size()) {
    for (const ClampedPatch& patch : clamped_.patches) patches_.push_back({&patch.surface, patch.columns});
    // Lines of inner knots are no edges, however smooth they are.
    seams_ = patch_seams(patches_, clamped_.coordinates, {.same = options.same, .smooth = -1});
    model_.diagonal = seams_.diagonal;
    same_ = options.same * seams_.diagonal;
  }

  PatchModel make() && {
    for (const PatchSeam& seam : seams_.seams) take(seam);
    for (size_t p = 0; p < size(); ++p) join_corners(p);
    add_vertices();
    for (Side& side : sides_) add_edge(side);
    for (size_t p = 0; p < size(); ++p) add_face(p);
    return std::move(model_);
  }

 private:
  /// A side, and the edge that it is on.
  struct Side {
    PatchLine line;
    Side* first = nullptr;  ///< the other side that it shares an edge with, if that comes first
    bool reversed = false;  ///< against it
    bool is_point = false;
    double gap = 0;
    Index edge = -1;
  };

  size_t size() const { return clamped_.patches.size(); }
  Side& side(const PatchLine& line) { return sides_[4 * line.patch + size_t(side_of(line))]; }
  size_t corner(const PatchLine& line, bool at_end) const {
    return 4 * line.patch + ends_of(side_of(line))[at_end ? 1 : 0];
  }

  void take(const PatchSeam& seam) {
    switch (seam.kind) {
      case SeamKind::sides:
        if (can_share(seam))
          share(seam);
        else
          ++model_.unsuitable;
        break;
      case SeamKind::collapsed:
        side(seam.lines[0]).is_point = true;
        ++model_.points;
        break;
      case SeamKind::boundary:
        ++model_.open;
        break;
      case SeamKind::partial:
        ++model_.partial;
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

  /// A face meets itself as a cylinder does, or not at all: files without curves in parameters say no more. Fronts go
  /// on across edges.
  bool can_share(const PatchSeam& seam) {
    const PatchLine &a = seam.lines[0], &b = seam.lines[1];
    if (a.patch == b.patch) return a.along_v == b.along_v && !seam.reversed[1];
    return fronts_.join(a.patch, b.patch, !seam.same_orientation);
  }

  void share(const PatchSeam& seam) {
    const PatchLine &a = seam.lines[0], &b = seam.lines[1];
    const bool reversed = seam.reversed[1];
    ++(a.patch == b.patch ? model_.seams : model_.shared);
    side(b).first = &side(a);
    side(b).reversed = reversed;
    for (const bool at_end : {false, true}) corners_.join(corner(a, at_end), corner(b, at_end != reversed));
    if (seam.gap) side(a).gap = seam.gap->value;
    model_.gap = std::max(model_.gap, side(a).gap);
    if (seam.angle && seam.angle->value > model_.angle)
      model_.angle = seam.angle->value, model_.angle_at = seam.angle->point;
  }

  Eigen::RowVector3d corner_point(size_t corner) const {
    const ClampedPatch& patch = clamped_.patches[corner / 4];
    const Index u = patch.surface.u().num_points(), v = patch.surface.v().num_points();
    const Index rows[] = {0, u - 1, u * v - 1, u * (v - 1)};
    const Eigen::RowVectorXd column = patch.columns.row(rows[corner % 4]);
    return column.size() == 4 ? column.head(3) / column[3] : column;
  }
  /// Corners of a patch where it is the same point: the ends of a circle, a pole.
  void join_corners(size_t p) {
    for (size_t b = 1; b < 4; ++b)
      for (size_t a = 0; a < b; ++a)
        if ((corner_point(4 * p + a) - corner_point(4 * p + b)).norm() <= same_) corners_.join(4 * p + a, 4 * p + b);
  }

  void add_vertices() {
    std::vector<Eigen::RowVector3d> points;
    vertex_.resize(4 * size());
    for (size_t c = 0; c < vertex_.size(); ++c) {
      const size_t least = corners_.find(c).first;
      if (least == c) {
        vertex_[c] = Index(points.size());
        points.push_back(corner_point(c));
      }
      vertex_[c] = vertex_[least];
    }
    model_.boundary.vertices.resize(Index(points.size()), 3);
    for (size_t v = 0; v < points.size(); ++v) model_.boundary.vertices.row(Index(v)) = points[v];
  }

  void add_edge(Side& side) {
    const size_t number = size_t(&side - sides_.data());
    side.line = side_line(patches_, number / 4, PatchSide(number % 4));
    if (side.first) {
      side.edge = side.first->edge;
      return;
    }
    side.edge = Index(model_.boundary.edges.size());
    const Knots<double>& along = patches_[side.line.patch].along(side.line);
    SplineEdge edge{.start = vertex_[corner(side.line, false)],
                    .end = vertex_[corner(side.line, true)],
                    .degree = along.degree(),
                    .knots = all_of(along),
                    .poles = {}};
    std::tie(edge.poles, edge.weights) = poles_of(side_columns(side.line));
    edge.gap = side.gap;
    edge.is_sharp = true;
    edge.is_point = side.is_point;
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
    const double u[] = {face.u_knots.front(), face.u_knots.back()}, v[] = {face.v_knots.front(), face.v_knots.back()};
    const Eigen::Vector2d corners[] = {{u[0], v[0]}, {u[1], v[0]}, {u[1], v[1]}, {u[0], v[1]}};
    for (const PatchSide at : {PatchSide::v_begin, PatchSide::u_end, PatchSide::v_end, PatchSide::u_begin}) {
      const Side& side = sides_[4 * p + size_t(at)];
      const bool falls = at == PatchSide::v_end || at == PatchSide::u_begin;
      const auto [begin, end] = ends_of(at);
      face.border.push_back(
          {side.edge, falls != side.reversed, corners[falls ? end : begin], corners[falls ? begin : end]});
    }
  }

  std::span<const NamedPatch> sources_;
  ClampedPatches clamped_;
  std::vector<PatchColumns> patches_;
  PatchSeams seams_;
  double same_ = 0;
  SignedClasses fronts_, corners_;  // patches; corners, four of each
  std::vector<Side> sides_;
  std::vector<Index> vertex_;  // by corner
  PatchModel model_;
};

}  // namespace

PatchModel patch_model(std::span<const NamedPatch> patches, const PatchModelOptions& options) {
  return PatchModelMaker(patches, options).make();
}

}  // namespace sublimit
