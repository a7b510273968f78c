// SPDX-License-Identifier: Apache-2.0
#include "sublimit/surface/limit_surface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <string>
#include <utility>

#include "sublimit/base/detail/huge_pages.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/limit/detail/limit_masks.h"
#include "sublimit/neighborhood/piece_rows.h"
#include "sublimit/scheme/detail/check_scheme.h"
#include "sublimit/scheme/detail/made_by.h"
#include "sublimit/source/detail/derivative_order.h"
#include "sublimit/surface/detail/limit_patches.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit {
namespace {

/// The level, which a scheme has made.
/// @throws InvalidParameter  another one has
Level made_by(const Scheme<double>& scheme, Level level) {
  check_made_by(level, check_scheme(scheme), "the limit surface");
  return level;
}

}  // namespace

LimitMap::LimitMap(const Scheme<double>& scheme, const Mesh& mesh, const SubdivisionOptions& options,
                   std::shared_ptr<LimitCache> types)
    : parts_(std::make_shared<const Parts>(scheme, control_level(scheme, mesh, options), std::move(types))) {}
LimitMap::LimitMap(const Scheme<double>& scheme, Level level, std::shared_ptr<LimitCache> types)
    : parts_(std::make_shared<const Parts>(scheme, made_by(scheme, std::move(level)), std::move(types))) {}

const Addresses& LimitMap::addresses() const { return parts_->addresses; }

FaceLengths LimitMap::lengths(Index address) const {
  if (addresses().place(address).corner < 0) return {};
  return {.u = 0.5, .v = 0.5};
}
const Level& LimitMap::level() const { return parts_->level; }

LimitMap::Parts::Found LimitMap::Parts::find(const Target& at, int order) const {
  try {
    std::vector<Index> vertices;
    const PieceType* type = type_of(at.piece, vertices);
    return find(at, order, *type, std::move(vertices));
  } catch (const AnalysisError& error) {
    throw without_limit(at.piece, error.what());
  }
}

LimitMap::Parts::Found LimitMap::Parts::find(const Place& place, int order, KnownRows* known) const {
  const Target at = target(place);
  if (!known || !known->pieces) return find(at, order);
  const Pieces& all = *known->pieces;
  const Index n = number(place, at);
  std::vector<Index> vertices(all.vertices.begin() + all.first[n], all.vertices.begin() + all.first[n + 1]);
  try {
    return find(at, order, *all.types[n], std::move(vertices), known);
  } catch (const AnalysisError& error) {
    throw without_limit(at.piece, error.what());
  }
}

LimitMap::Parts::Found LimitMap::Parts::find(const Target& at, int order, const PieceType& type,
                                             std::vector<Index> vertices, KnownRows* known) const {
  Found found;
  found.vertices = std::move(vertices);
  if (!known) {
    found.rows = piece_rows(type, at.place, order);
  } else {
    if (known->type != &type || known->order != order || !(known->place == at.place)) {
      known->rows = piece_rows(type, at.place, order);
      known->on_side.reset();
      known->type = &type;
      known->place = at.place;
      known->order = order;
      ++known->made;
    }
    found.rows = known->rows;
  }
  PieceRows& rows = found.rows;
  const unsigned sides = this->sides(at.piece);
  const bool on_cut = sides & sides_at(at.place, at.piece.kind == Kind::triangle);
  if (on_cut) found.status = LimitStatus::crease;
  if (at.map && rows.order > 0) {
    const PieceMap::Chain chain = at.map->chain(at.outer);
    apply_chain(chain, rows.rows);
    turn_tangents(chain, rows.tangents);
  }
  if (order >= 2 && (rows.order < 2 || (rows.on_knot && types->pieces().regular_smoothness() == 1))) {
    if (found.status == LimitStatus::regular) found.status = LimitStatus::unbounded_second;
    if (rows.order == 2) {
      rows.order = 1;
      rows.rows.conservativeResize(3, Eigen::NoChange);
    }
  }
  // Where the piece has no derivatives at a corner, its limit masks have tangents, perhaps.
  const std::optional<Centre> centre = rows.at_corner && rows.order == 0 ? this->centre(at) : std::nullopt;
  // Inside, where rounding ends the descent of a place at thirds at a corner, the position is all that was asked for.
  const bool is_deep = !centre && order == 0;
  if (on_cut && !centre && rows.order == 0) {
    if (order >= 1 && known && !known->on_side) known->on_side = tangents_on_side(type, at.place);
    if (order >= 1) rows.tangents = known ? *known->on_side : tangents_on_side(type, at.place);
    if (order >= 1 && rows.tangents.rows() == 0) found.status = LimitStatus::undefined_normal;
  } else if (rows.at_corner && rows.order == 0 && !is_deep) {
    const LimitRows* limit = centre ? corners.at(*centre) : nullptr;
    found.status = limit ? limit->status : LimitStatus::undefined_normal;
    if (order >= 1 && limit && limit->status != LimitStatus::undefined_normal) {
      for (size_t i = 1; i < limit->rows.size(); ++i) found.tangents.add_row(limit->rows[i]);
    }
  }
  if (sides & hole) found.status = LimitStatus::hole;
  return found;
}

RowMatrix LimitMap::Parts::tangents_on_side(const PieceType& type, const PieceCoordinates& place) const {
  // Normals inside tend to the one on the side, at least like a root of the distance: as near as places are told apart.
  constexpr double near = 0x1p-50;
  PieceCoordinates inside = place;
  if (type.kind() == Piece::Kind::triangle) {
    double* const parts[] = {&inside.u, &inside.v, &inside.u1};
    double& largest = **std::ranges::max_element(parts, {}, [](const double* x) { return *x; });
    for (double* part : parts)
      if (*part == 0) *part = near, largest -= near;
  } else {
    if (place.u == 0) inside.u = near, inside.u1 = 1 - near;
    if (place.v == 0) inside.v = near, inside.v1 = 1 - near;
    if (place.u1 == 0) inside.u1 = near, inside.u = 1 - near;
    if (place.v1 == 0) inside.v1 = near, inside.v = 1 - near;
  }
  return piece_rows(type, inside, 1).tangents;
}

LimitStencil LimitMap::Parts::stencil(Found found, std::optional<LimitRows::Row> position) const {
  LimitStencil result;
  result.status = found.status;
  // Position, derivatives, tangents, one below the other: over the piece's vertices, slot 0 with what makes the sums
  // right, and then those of the masks.
  const RowMatrix &rows = found.rows.rows, &own_tangents = found.rows.tangents;
  const Eigen::Index num_weights = rows.rows(), slots = rows.cols() + 1;
  Eigen::Index columns = slots, row = num_weights;
  columns += Eigen::Index(found.tangents.num_terms());
  const Eigen::Index num_tangents = own_tangents.rows() + Eigen::Index(found.tangents.size());
  RowMatrix W = RowMatrix::Zero(num_weights + num_tangents, columns);
  W.block(0, 1, num_weights, slots - 1) = rows;
  if (own_tangents.rows() > 0) W.block(num_weights, 1, own_tangents.rows(), slots - 1) = own_tangents;
  W.col(0) = -W.rowwise().sum();
  W(0, 0) += 1;
  if (position) W.row(0).setZero();
  Eigen::Index column = slots;
  for (size_t i = 0; i < found.tangents.size(); ++i, ++row)
    for (const auto& [v, weight] : found.tangents[i]) {
      found.vertices.push_back(v);
      W(row, column++) = weight;
    }

  // Over the vertices of the level, ascending, those without weight left out.
  struct Term {
    Index vertex;
    Eigen::Index column;
    double factor;
  };
  std::vector<Term> terms;
  terms.reserve(columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    if (W.col(j).isZero(0)) continue;
    if (!prepared)
      terms.push_back({found.vertices[j], j, 1});
    else
      for (SparseMatrix::InnerIterator it(prepared->S, found.vertices[j]); it; ++it)
        terms.push_back({static_cast<Index>(it.col()), j, it.value()});
  }
  if (position)
    for (const auto& [vertex, weight] : *position) terms.push_back({vertex, columns, weight});
  std::stable_sort(terms.begin(), terms.end(), [](const Term& a, const Term& b) { return a.vertex < b.vertex; });
  Eigen::MatrixXd sums(W.rows(), terms.size());
  for (const Term& term : terms) {
    if (result.vertices.empty() || result.vertices.back() != term.vertex) {
      result.vertices.push_back(term.vertex);
      sums.col(Eigen::Index(result.vertices.size()) - 1).setZero();
    }
    auto sum = sums.col(Eigen::Index(result.vertices.size()) - 1);
    if (term.column == columns)
      sum[0] = term.factor;
    else
      sum += term.factor * W.col(term.column);
  }
  const auto n = static_cast<Eigen::Index>(result.vertices.size());
  result.weights = sums.topLeftCorner(num_weights, n);
  result.tangents = sums.bottomLeftCorner(num_tangents, n);
  return result;
}

Index LimitMap::num_points() const { return level().topology().num_vertices(); }

std::unique_ptr<BoundSource> LimitMap::bound(const Points& points) const& {
  return std::make_unique<LimitSurface>(*this, points);
}

LimitStencil LimitMap::stencil(const Place& place, int order) const {
  check_order(order);
  check_inside(addresses(), place);
  return parts_->stencil(parts_->find(place, order), parts_->vertex_position(parts_->target(place)));
}

void LimitMap::prepare() const { parts_->pieces(); }

void resize(LimitSamples& out, std::int64_t count, int order, bool normals) {
  const auto sized = [&](Points& m, bool wanted) {
    const double* const before = m.data();
    m.resize(wanted ? count : 0, 3);
    if (m.data() != before) prefer_huge_pages(m.data(), size_t(m.size()) * sizeof(double));
  };
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

void check_points(const Level& level, const Points& points) {
  if (points.cols() != 3 || points.rows() != level.topology().num_vertices())
    throw InvalidParameter("points are " + std::to_string(points.rows()) + " x " + std::to_string(points.cols()) +
                           ", not " + std::to_string(level.topology().num_vertices()) + " x 3: a row for each vertex");
}

bool LimitMap::Parts::evaluate_plain_row(const Points& points, const Found& found, int order, bool normals,
                                         LimitSamples& out, std::int64_t i) const {
  if (prepared) return false;
  if (order > 0 && found.rows.order == 0) return false;
  const auto n = found.rows.rows.cols();
  Points differences(n, 3);
  const Eigen::RowVector3d origin = points.row(found.vertices[0]);
  for (Eigen::Index j = 0; j < n; ++j) differences.row(j) = points.row(found.vertices[j + 1]) - origin;
  if (order > 0 && normals) {
    const Points tangents = found.rows.tangents.lazyProduct(differences);
    const Eigen::Vector3d a = tangents.row(0), b = tangents.row(1), cross = a.cross(b);
    if (!is_sound_normal(cross.squaredNorm(), a.squaredNorm() * b.squaredNorm())) return false;
    out.normal.row(i) = cross.normalized();
  }
  Points* const targets[] = {&out.position, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv};
  for (Eigen::Index k = 0; k < found.rows.rows.rows(); ++k) {
    // Not straight into a row of `out`, where Eigen sums by how it is aligned, and zeros of odd rows have other signs.
    const Eigen::RowVector3d x = found.rows.rows.row(k).lazyProduct(differences);
    targets[k]->row(i) = x;
  }
  out.position.row(i) += origin;
  out.status[i] = found.status;
  out.order[i] = static_cast<std::int8_t>(found.rows.order);
  return true;
}

void LimitMap::Parts::evaluate_row(const Points& points, const Place& place, int order, bool normals, LimitSamples& out,
                                   std::int64_t i, KnownRows* known) const {
  for (Points* m : {&out.position, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv, &out.normal})
    if (m->rows() > 0) m->row(i).setZero();
  out.order[i] = 0;
  if (!is_inside(place)) {
    out.status[i] = LimitStatus::outside;
    return;
  }
  Found found = find(place, order, known);
  if (evaluate_plain_row(points, found, order, normals, out, i)) return;
  const LimitStencil stencil = this->stencil(std::move(found));
  Points local(stencil.vertices.size(), 3);
  for (size_t j = 0; j < stencil.vertices.size(); ++j) local.row(j) = points.row(stencil.vertices[j]);
  const Points rows = stencil.weights * local;
  Points* const targets[] = {&out.position, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv};
  for (Eigen::Index k = 0; k < rows.rows(); ++k) targets[k]->row(i) = rows.row(k);
  out.status[i] = stencil.status;
  out.order[i] = rows.rows() == 6 ? 2 : rows.rows() == 3 ? 1 : 0;
  if (order == 0 || !normals || stencil.status == LimitStatus::undefined_normal) return;
  const Eigen::Vector3d normal = normal_of(stencil, local, place, points);
  out.normal.row(i) = normal;
  if (normal.isZero(0) && stencil.status != LimitStatus::hole) out.status[i] = LimitStatus::undefined_normal;
}

LimitSamples LimitMap::evaluate(const Points& points, std::span<const Place> samples, int order, bool normals) const {
  check_order(order);
  check_points(parts_->level, points);
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

}  // namespace sublimit
