// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/limit_surface.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "sublimit/analysis/limit_masks.h"
#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/limit/limit_patches.h"

namespace sublimit {
LimitSurface::LimitSurface(const Scheme<double>& scheme, const ControlMesh& mesh, const SubdivisionOptions& options,
                           std::shared_ptr<PieceTypes> types)
    : LimitSurface(scheme, control_level(scheme, mesh, options), std::move(types)) {}
LimitSurface::LimitSurface(const Scheme<double>& scheme, Level level, std::shared_ptr<PieceTypes> types)
    : parts_(std::make_unique<Parts>(scheme, std::move(level), std::move(types))) {}
LimitSurface::~LimitSurface() = default;
LimitSurface::LimitSurface(LimitSurface&&) noexcept = default;
LimitSurface& LimitSurface::operator=(LimitSurface&&) noexcept = default;

const Addresses& LimitSurface::addresses() const { return parts_->addresses; }
const Level& LimitSurface::level() const { return parts_->level; }

LimitStencil LimitSurface::Parts::stencil(const Sample& s, int order) const {
  LimitStencil result;
  const Target at = target(s);
  std::vector<Index> vertices;
  const PieceType* type = type_of(at.piece, vertices);
  PieceRows found = piece_rows(*type, at.place, order);
  const bool is_hole = base().holes[index(base().topology().face(at.piece.start))];
  if (on_crease(at)) result.status = LimitStatus::crease;

  // Rows over the vertices: what slot 0 has makes the sums right.
  const auto columns = static_cast<Eigen::Index>(vertices.size());
  RowMatrix rows(found.rows.rows(), columns);
  rows.rightCols(columns - 1) = found.rows;
  rows.col(0) = -found.rows.rowwise().sum();
  rows(0, 0) += 1;
  if (at.map && found.order > 0) apply_chain(at.map->chain(at.outer), rows);
  RowMatrix tangents;
  if (found.order >= 1) {
    tangents.resize(2, columns);
    tangents.rightCols(columns - 1) = found.tangents;
    tangents.col(0) = -found.tangents.rowwise().sum();
    if (at.map) {  // a turn, or none
      RowMatrix three(3, columns);
      three << rows.row(0), tangents;
      apply_chain(at.map->chain(at.outer), three);
      tangents = three.bottomRows(2);
    }
  }
  if (order >= 2 && found.order < 2 && result.status == LimitStatus::regular)
    result.status = LimitStatus::unbounded_second;
  if (order >= 2 && found.order == 2 && found.on_knot && scheme.claims.regular == 1) {
    rows.conservativeResize(3, columns);
    if (result.status == LimitStatus::regular) result.status = LimitStatus::unbounded_second;
  }

  // Where the piece has no derivatives at a corner, its limit masks have tangents, perhaps.
  std::vector<LimitRows::Row> masks;
  if (found.at_corner && (order == 0 || found.order == 0)) {
    const std::optional<Centre> centre = this->centre(at);
    const CornerLimit* limit = centre ? corners.at(*centre) : nullptr;
    if (limit) {
      result.status = limit->status;
      if (order >= 1 && limit->status != LimitStatus::undefined_normal) {
        masks = {limit->rows.tangent1, limit->rows.tangent2};
        masks.insert(masks.end(), limit->rows.second_order.begin(), limit->rows.second_order.end());
      }
    } else {
      result.status = LimitStatus::undefined_normal;
    }
  }
  if (is_hole) result.status = LimitStatus::hole;

  // Over the vertices of the level, columns ascending, those without weight left out.
  std::map<Index, Eigen::VectorXd> of_vertex;  // weights, then tangents
  const Eigen::Index num_weights = rows.rows(),
                     num_tangents = masks.empty() ? tangents.rows() : Eigen::Index(masks.size());
  const auto add = [&](Index v, Eigen::Index row, double weight) {
    if (weight == 0) return;
    const auto add_to = [&](Index column, double w) {
      const auto [entry, is_new] = of_vertex.try_emplace(column);
      if (is_new) entry->second.setZero(num_weights + num_tangents);
      entry->second[row] += w;
    };
    if (!prepared) return add_to(v, weight);
    for (SparseMatrix::InnerIterator it(prepared->S, v); it; ++it)
      add_to(static_cast<Index>(it.col()), weight * it.value());
  };
  for (Eigen::Index j = 0; j < columns; ++j) {
    for (Eigen::Index i = 0; i < num_weights; ++i) add(vertices[j], i, rows(i, j));
    if (masks.empty())
      for (Eigen::Index i = 0; i < num_tangents; ++i) add(vertices[j], num_weights + i, tangents(i, j));
  }
  for (size_t i = 0; i < masks.size(); ++i)
    for (const auto& [v, weight] : masks[i]) add(v, num_weights + Eigen::Index(i), weight);
  const auto n = static_cast<Eigen::Index>(of_vertex.size());
  result.weights.resize(num_weights, n);
  result.tangents.resize(num_tangents, n);
  for (const auto& [v, column] : of_vertex) {
    const auto j = static_cast<Eigen::Index>(result.vertices.size());
    result.vertices.push_back(v);
    result.weights.col(j) = column.head(num_weights);
    result.tangents.col(j) = column.tail(num_tangents);
  }
  return result;
}

LimitStencil LimitSurface::stencil(const Sample& sample, int order) const {
  if (order < 0 || order > 2)
    throw InvalidParameter("derivatives of order " + std::to_string(order) + "; 0, 1 or 2 are known");
  parts_->check(sample);
  return parts_->stencil(sample, order);
}

void LimitSurface::prepare() const { parts_->pieces(); }

namespace {

void resize(LimitSamples& out, std::int64_t count, int order, bool normals) {
  const auto sized = [&](Points& m, bool wanted) { m.resize(wanted ? count : 0, 3); };
  sized(out.position, true);
  sized(out.du, order >= 1);
  sized(out.dv, order >= 1);
  sized(out.duu, order >= 2);
  sized(out.duv, order >= 2);
  sized(out.dvv, order >= 2);
  sized(out.normal, order >= 1 && normals);
  out.status.resize(count);
  out.order.resize(count);
}

void check_request(const Level& level, const Points& points, int order) {
  if (order < 0 || order > 2)
    throw InvalidParameter("derivatives of order " + std::to_string(order) + "; 0, 1 or 2 are known");
  if (points.cols() != 3 || points.rows() != level.topology().num_vertices())
    throw InvalidParameter("points are " + std::to_string(points.rows()) + " x " + std::to_string(points.cols()) +
                           ", not " + std::to_string(level.topology().num_vertices()) + " x 3");
}

/// Samples in a block: some tens of microseconds.
constexpr std::int64_t samples_per_block = 2048;

}  // namespace

void LimitSurface::Parts::evaluate_row(const Points& points, const Sample& sample, int order, bool normals,
                                       LimitSamples& out, std::int64_t i) const {
  for (Points* m : {&out.position, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv, &out.normal})
    if (m->rows() > 0) m->row(i).setZero();
  out.order[i] = 0;
  if (!is_inside(sample)) {
    out.status[i] = LimitStatus::outside;
    return;
  }
  const LimitStencil stencil = this->stencil(sample, order);
  Points local(stencil.vertices.size(), 3);
  for (size_t j = 0; j < stencil.vertices.size(); ++j) local.row(j) = points.row(stencil.vertices[j]);
  const Points rows = stencil.weights * local;
  Points* const targets[] = {&out.position, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv};
  for (Eigen::Index k = 0; k < rows.rows(); ++k) targets[k]->row(i) = rows.row(k);
  out.status[i] = stencil.status;
  out.order[i] = rows.rows() == 6 ? 2 : rows.rows() == 3 ? 1 : 0;
  if (order == 0 || !normals || stencil.status == LimitStatus::undefined_normal) return;
  const Eigen::Vector3d normal = normal_of(stencil, local, sample, points);
  out.normal.row(i) = normal;
  if (normal.isZero(0) && stencil.status != LimitStatus::hole) out.status[i] = LimitStatus::undefined_normal;
}

LimitSamples LimitSurface::evaluate(const Points& points, std::span<const Sample> samples, int order,
                                    bool normals) const {
  check_request(parts_->level, points, order);
  LimitSamples out;
  const auto count = static_cast<std::int64_t>(samples.size());
  resize(out, count, order, normals);
  // Patches pay once a piece has a few samples.
  if (count >= 4 * std::int64_t(parts_->num_pieces())) {
    const LimitPatches patches(*parts_, points);
    parallel_for_blocks(
        count,
        [&](std::int64_t, std::int64_t begin, std::int64_t end) {
          patches.evaluate(samples, begin, end, order, normals, out);
        },
        samples_per_block);
  } else {
    parallel_for_blocks(
        count,
        [&](std::int64_t, std::int64_t begin, std::int64_t end) {
          for (std::int64_t i = begin; i < end; ++i) parts_->evaluate_row(points, samples[i], order, normals, out, i);
        },
        256);
  }
  return out;
}

BoundLimitSurface::BoundLimitSurface(const LimitSurface& surface, Points points) : points_(std::move(points)) {
  check_request(surface.parts_->level, points_, 0);
  patches_ = std::make_unique<LimitPatches>(*surface.parts_, points_);
}
BoundLimitSurface::~BoundLimitSurface() = default;

void BoundLimitSurface::evaluate(std::span<const Sample> samples, int order, bool normals, LimitSamples& out) const {
  if (order < 0 || order > 2)
    throw InvalidParameter("derivatives of order " + std::to_string(order) + "; 0, 1 or 2 are known");
  resize(out, static_cast<std::int64_t>(samples.size()), order, normals);
  parallel_for_blocks(
      static_cast<std::int64_t>(samples.size()),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        patches_->evaluate(samples, begin, end, order, normals, out);
      },
      samples_per_block);
}

LimitSamples BoundLimitSurface::evaluate(std::span<const Sample> samples, int order, bool normals) const {
  LimitSamples out;
  evaluate(samples, order, normals, out);
  return out;
}

std::optional<Curvature> curvature(const LimitSamples& s, Index row) {
  if (s.order[row] < 2 || s.duu.rows() == 0) return std::nullopt;
  using Eigen::Vector3d;
  const Vector3d xu = s.du.row(row), xv = s.dv.row(row), cross = xu.cross(xv);
  const double E = xu.dot(xu), F = xu.dot(xv), G = xv.dot(xv), area2 = E * G - F * F;
  if (!(cross.squaredNorm() > 1e-24 * E * G)) return std::nullopt;
  const Vector3d n = cross.normalized();
  const double L = n.dot(Vector3d(s.duu.row(row))), M = n.dot(Vector3d(s.duv.row(row))),
               N = n.dot(Vector3d(s.dvv.row(row)));
  // In an orthonormal frame of the tangent plane the second form is symmetric, and its eigenvectors are the directions.
  const Vector3d e1 = xu / std::sqrt(E), e2 = n.cross(e1);
  Eigen::Matrix2d J;  // parameters of e1, e2
  const double a = xv.dot(e1), b = xv.dot(e2);
  J << 1 / std::sqrt(E), -a / (b * std::sqrt(E)), 0, 1 / b;
  Eigen::Matrix2d II;
  II << L, M, M, N;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(J.transpose() * II * J);
  Curvature c;
  c.k1 = solver.eigenvalues()[1];
  c.k2 = solver.eigenvalues()[0];
  const Eigen::Matrix2d& V = solver.eigenvectors();
  c.direction1 = V(0, 1) * e1 + V(1, 1) * e2;
  c.direction2 = V(0, 0) * e1 + V(1, 0) * e2;
  c.gauss = (L * N - M * M) / area2;
  c.mean = (c.k1 + c.k2) / 2;
  return c;
}

}  // namespace sublimit
