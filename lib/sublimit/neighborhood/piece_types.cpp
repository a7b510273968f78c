// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/piece_types.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/core/detail/sparse_lu.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/neighborhood/canonical_part.h"
#include "sublimit/neighborhood/closed_set.h"
#include "sublimit/neighborhood/piece_rings.h"
#include "sublimit/neighborhood/piece_rows.h"
#include "sublimit/neighborhood/polynomial_search.h"
#include "sublimit/neighborhood/regular_smoothness.h"
#include "sublimit/scheme/detail/check_scheme.h"
#include "sublimit/scheme/detail/refine_impl.h"
#include "sublimit/scheme/detail/sheet_part.h"
#include "sublimit/scheme/detail/subdivision_rows.h"

namespace sublimit {
namespace {

/// Factor of a map that only scales, as it lies; 0 of any other.
double pure_scale(const PieceMap& map) {
  if (!map.is_triangle)
    for (int i = 0; i < 2; ++i)
      if (map.axes[i].from != i || map.axes[i].reversed || map.axes[i].span > Span::upper) return 0;
  const PieceMap::Chain c = map.chain(PieceCoordinates{});
  return c.first[0][0] == c.first[1][1] && c.first[0][1] == 0 && c.first[1][0] == 0 ? c.first[0][0] : 0;
}

/// A basis of the null space of M by columns.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& M) {
  if (std::optional<Eigen::MatrixXd> clear = clear_null_space(M)) return *std::move(clear);
  const auto [sigma, right] = singular_values(M);
  Eigen::Index rank = 0;
  while (rank < sigma.size() && sigma[rank] > 1e-10 * sigma[0]) ++rank;
  return right.rightCols(M.cols() - rank);
}

/// Eigenvectors of one eigenvalue, left * right = 1.
struct Eigenspace {
  Eigen::MatrixXd left, right;
};

/// Nothing if the eigenvalue has not this multiplicity, or is defective.
std::optional<Eigenspace> eigenspace(const Eigen::MatrixXd& D, double lambda, Eigen::Index multiplicity) {
  const Eigen::MatrixXd shifted = D - lambda * Eigen::MatrixXd::Identity(D.rows(), D.cols());
  const Eigen::MatrixXd right = null_space(shifted);
  if (right.cols() != multiplicity) return std::nullopt;
  const Eigen::MatrixXd left = null_space(shifted.transpose());
  if (left.cols() != multiplicity) return std::nullopt;
  const Eigen::MatrixXd pairing = left.transpose() * right;
  if (!(std::abs(determinant(pairing)) > 1e-6)) return std::nullopt;
  return Eigenspace{inverse(pairing) * left.transpose(), right};
}

/// p = origin + p D: the left eigenvector of eigenvalue 1, in differences.
Eigen::RowVectorXd fixed_row(const PieceBlock& block) {
  const auto n = block.origin().size();
  const Eigen::MatrixXd equations = (RowMatrix::Identity(n, n) - block.differences()).transpose();
  return square_solution(equations, block.origin().transpose()).transpose();
}

/// The same of rows of S, by the points that one of them depends on: all rows tend to this one.
Eigen::RowVectorXd fixed_row(const SparseMatrix& B, Index slot) {
  const std::vector<Index> closed = closed_set({slot}, static_cast<Index>(B.rows()), [&](Index s, const auto& add) {
    for (SparseMatrix::InnerIterator it(B, s); it; ++it) add(static_cast<Index>(it.col()));
  });
  std::vector<Index> position(B.rows(), -1);
  for (size_t i = 0; i < closed.size(); ++i) position[closed[i]] = static_cast<Index>(i);
  // l (B - 1) = 0, one column of which follows from the others, and the sum of l is 1.
  const auto count = static_cast<Index>(closed.size());
  std::vector<Eigen::Triplet<double, Index>> entries;
  for (Index i = 0; i < count; ++i) {
    entries.push_back({0, i, 1.0});
    if (i > 0) entries.push_back({i, i, -1.0});
    for (SparseMatrix::InnerIterator it(B, closed[i]); it; ++it)
      if (position[it.col()] > 0) entries.push_back({position[it.col()], i, it.value()});
  }
  ColumnMatrix equations(count, count);
  equations.setFromTriplets(entries.begin(), entries.end());
  const SparseLu lu(equations);
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(B.cols() - 1);
  if (!lu.has_factors()) return Eigen::RowVectorXd::Constant(B.cols() - 1, INFINITY);
  const Eigen::VectorXd weights = lu.solve(Eigen::VectorXd::Unit(count, 0));
  for (Index i = 0; i < count; ++i)
    if (closed[i] > 0) row[closed[i] - 1] = weights[i];
  return row;
}

/// Homogeneous polynomials whose derivatives at 0 of this degree, (u, v) or (uu, uv, vv), are 1 each.
Eigen::RowVectorXd monomials(int degree, double u, double v) {
  if (degree == 1) return Eigen::RowVector2d(u, v);
  return Eigen::RowVector3d(u * u / 2, u * v, v * v / 2);
}

}  // namespace

namespace {

/// What a level's topology and sharpness take, about.
double bytes_of(const Topology& t) {
  return 24.0 * t.num_half_edges() + 24.0 * t.num_vertices() + 16.0 * t.num_edges();
}

}  // namespace

PieceType::Surroundings PieceType::found_surroundings() const {
  const Index face = index(met_.level->topology().face(met_.piece.start));
  const int rings = rings_ + types_->rings_beyond(*met_.level);
  const std::span<const Index> faces(&face, 1);
  Part around = apart_ ? sheet_part(*met_.level, faces, rings) : part(*met_.level, faces, rings);
  types_->take(bytes_of(around.level.topology()), num_slots());
  const auto position = [](const std::vector<Index>& list, Index i) {
    return static_cast<Index>(std::lower_bound(list.begin(), list.end(), i) - list.begin());
  };
  Surroundings own;
  for (const Index v : met_.slots) own.slots.push_back(position(around.vertices, v));
  own.piece = {kind_, HalfEdge{position(around.halves, index(met_.piece.start))}};
  if (decays_) {
    // Means of sharpness are float sums in the order of the mesh, as the reference has them.
    own.level = std::move(around.level);
  } else {
    CanonicalPart canonical = canonical_part(around.level, own.slots);
    own.level = std::move(canonical.level);
    own.piece.start = HalfEdge{canonical.half_edge[index(own.piece.start)]};
    std::iota(own.slots.begin(), own.slots.end(), 0);
  }
  static_assert(std::is_nothrow_move_constructible_v<Surroundings>, "what they were taken from is gone");
  met_ = {};
  return own;
}

PieceType::Refined PieceType::refined() const {
  const Scheme<double>& scheme = types_->scheme_;
  const auto& [level, piece, slots] = surroundings();
  Refined result;
  std::vector<LevelStep> steps;
  const std::optional<KnotSplit> knots = level.knots();
  for (int k = 0; k < scheme.period; ++k) {
    const Level& before = k == 0 ? level : *result.levels.back();
    result.levels.push_back(std::make_shared<const Level>(
        scheme.steps.size() > 1 ? next_level(scheme, before) : next_topology(scheme, before, [](const auto&...) {})));
    types_->take(bytes_of(result.levels.back()->topology()), num_slots());
    for (const Refinement& step : result.levels.back()->steps)
      steps.push_back({&step, before.number, knots ? &*knots : nullptr});
  }
  const std::optional<KnotSplit> child_knots = result.levels.back()->knots();
  steps.back().child_knots = child_knots ? &*child_knots : nullptr;
  result.slot_of.assign(level.topology().num_vertices(), -1);
  for (size_t s = 0; s < slots.size(); ++s) result.slot_of[slots[s]] = static_cast<Index>(s);
  result.children = sublimit::children(piece, level.topology(), steps);
  return result;
}

SparseMatrix PieceType::rows_of(const Refined& refined, std::vector<Index> vertices) const {
  const Scheme<double>& scheme = types_->scheme_;
  SparseMatrix S;
  for (size_t k = refined.levels.size(); k-- > 0;) {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    const Level &before = k == 0 ? level() : *refined.levels[k - 1], &after = *refined.levels[k];
    // Most of the points are around the children. Those of several steps are multiplied as a whole.
    const SparseMatrix rows = subdivision_rows(scheme, before, after, vertices);
    vertices.assign(rows.innerIndexPtr(), rows.innerIndexPtr() + rows.nonZeros());
    S = S.size() == 0 ? rows : product(S, rows);
  }
  return S;
}

SparseMatrix PieceType::rows_over_slots(const Refined& refined, const SparseMatrix& S,
                                        std::span<const Index> vertices) const {
  SparseMatrix B(std::ssize(vertices), num_slots());
  std::vector<std::pair<Index, double>> row;
  for (Index i = 0; i < B.rows(); ++i) {
    row.clear();
    for (SparseMatrix::InnerIterator it(S, vertices[i]); it; ++it) {
      if (it.value() == 0) continue;
      const Index slot = refined.slot_of[it.col()];
      if (slot < 0)
        throw AnalysisError(types_->scheme_.name + ": a piece of the limit depends on points beyond " +
                            std::to_string(rings_) + " rings");
      row.push_back({slot, it.value()});
    }
    std::sort(row.begin(), row.end());
    B.startVec(i);
    for (const auto& [slot, weight] : row) B.insertBack(i, slot) = weight;
  }
  B.finalize();
  return B;
}

PieceType::ChildCorners PieceType::child_corners() const {
  const Refined after = refined();
  const Topology& t = after.levels.back()->topology();
  ChildCorners result;
  std::vector<Index> vertices;
  for (const PieceChild& child : after.children) {
    result.maps.push_back(child.map);
    HalfEdge h = child.piece.start;
    do {
      vertices.push_back(index(t.tail(h)));
      h = t.next(h);
    } while (h != child.piece.start);
  }
  result.rows = RowMatrix(rows_over_slots(after, rows_of(after, vertices), vertices));
  return result;
}

std::deque<PieceLink> PieceType::found_children() const {
  const Refined after = refined();
  const Level& fine = *after.levels.back();
  PieceWalker walker;
  std::deque<PieceLink> links;
  std::vector<std::vector<Index>> vertices;  // of the children
  std::vector<Index> all;
  for (const PieceChild& child : after.children) {
    const PieceWalk& walk = walker.walk(fine, child.piece, types_->rings(fine.sharpness), types_->scheme_.period);
    PieceLink& link = links.emplace_back();
    link.map = child.map;
    link.type = types_->type(after.levels.back(), child.piece, walk);
    link.repeats = link.type == this && pure_scale(link.map) != 0;
    link.begins_new = std::none_of(vertices.begin(), vertices.end(),
                                   [&](const auto& before) { return before[0] == walk.vertices[0]; });
    all.insert(all.end(), walk.vertices.begin(), walk.vertices.end());
    vertices.push_back(walk.vertices);
  }
  constexpr double bytes_of_slot = 64, bytes_of_row = 16, bytes_of_weight = 12;
  types_->take(bytes_of_row * double(all.size()) + bytes_of_slot * double(links.size()) * num_slots(), num_slots());
  const SparseMatrix S = rows_of(after, std::move(all));
  // Beside vertices of many edges a row may have as many weights; blocks have each of the rows that they share.
  double weights = double(S.nonZeros());
  for (const std::vector<Index>& child : vertices)
    for (const Index v : child) weights += double(S.outerIndexPtr()[v + 1] - S.outerIndexPtr()[v]);
  types_->take(bytes_of_weight * weights, num_slots());
  for (size_t i = 0; i < links.size(); ++i) links[i].block = PieceBlock(rows_over_slots(after, S, vertices[i]));
  return links;
}

const PieceLink& PieceType::child(const PieceCoordinates& place) const {
  const std::deque<PieceLink>& all = children();
  for (const PieceLink& link : all)
    if (link.map.contains(place)) return link;
  // Between two triangles by rounding: the one that it is least outside of.
  const PieceLink* best = &all[0];
  double least = 1e300;
  for (const PieceLink& link : all) {
    const PieceCoordinates p = link.map(place);
    const double outside = -std::min({p.u, p.v, p.u1, kind_ == Piece::Kind::triangle ? 0 : p.v1});
    if (outside < least) least = outside, best = &link;
  }
  return *best;
}

const PiecePolynomial* PieceType::polynomial() const {
  if (polynomial_state_.load(std::memory_order_acquire) == 0) {
    // Children of pieces with many points take long: they are found before, while others search.
    if (!decays_ && !types_->has_no_polynomials()) children();
    // Isolated, for a search holds a lock: its thread must not come back for it with other work.
    tbb::this_task_arena::isolate([this] { PolynomialSearch(*types_).decide(*this); });
  }
  return known_polynomial();
}

/// The types that a corner comes through, until it comes to one that has been there: a cycle, of one step but at the
/// borders of dual schemes.
struct PieceType::CornerPath {
  struct Visit {
    const PieceType* type;
    int corner;
    const PieceLink* link;
    PieceCoordinates place;
  };
  std::vector<Visit> visits;
  size_t first = 0;  // of the cycle

  CornerPath(const PieceType* type, int corner) {
    for (;;) {
      first = 0;
      while (first < visits.size() && !(visits[first].type == type && visits[first].corner == corner)) ++first;
      if (first < visits.size()) return;
      // Around faces that visit a vertex twice each step may double what there is.
      const bool grows = !visits.empty() && type->num_slots() > 4 * visits[0].type->num_slots() + 1000;
      if (visits.size() > 64 || grows)
        throw AnalysisError(type->types_->scheme_.name + ": a neighbourhood never comes to repeat itself");
      const PieceCoordinates place = corner_place(type->kind_, corner);
      const PieceLink& link = type->child(place);
      visits.push_back({type, corner, &link, place});
      corner = nearest_corner(link.type->kind_, link.map(place));
      type = link.type;
    }
  }
  bool is_large() const {
    return std::all_of(visits.begin() + Eigen::Index(first), visits.end(),
                       [](const Visit& visit) { return visit.link->block.is_large(); });
  }
  PieceBlock cycle() const {
    PieceBlock block = visits[first].link->block;
    for (size_t i = first + 1; i < visits.size(); ++i) block = block.then(visits[i].link->block);
    return block;
  }
  /// Whether what a slot is after k cycles tends to a fixed row: one that repels is a fixed row as well.
  bool attracts(const RowMatrix& fixed, Index slot) const {
    const bool large = is_large();
    if (large && averages(fixed, slot)) return true;
    RowMatrix rest = -fixed;
    if (slot > 0) rest(0, slot - 1) += 1;
    const double small = 0x1p-20 * rest.norm();
    constexpr int enough = 1024;  // cycles: but for averages the slowest of our schemes shrink by 0.9
    for (int k = 0; k < enough; ++k) {
      if (rest.norm() <= small || (k == 64 && !large && averages(fixed, slot))) return true;
      for (size_t i = visits.size(); i-- > first;) rest = visits[i].link->block.derivatives_pulled_back(rest);
    }
    return false;
  }
  static constexpr double least = 1e-15;  // weights that are less are rounding

  /// Whether weights are non-negative and all slots that this one depends on have, after some cycles, a positive weight
  /// of one and the same slot, so that cycles contract differences (Doeblin 1937). Averages of a polygon of n vertices
  /// shrink by as little as cos(pi/n).
  bool averages(const RowMatrix& fixed, Index slot) const {
    for (size_t i = first; i < visits.size(); ++i)
      if (visits[i].link->block.least_weight() < -least) return false;
    RowMatrix after = fixed;  // in differences: fixed = origin + fixed D
    for (size_t i = visits.size(); i-- > first;) after = visits[i].link->block.pulled_back(after);
    if (!((after - fixed).norm() <= 1e-9)) return false;  // that is, it was not solved for
    const SparseMatrix B = rows();
    const std::vector<Index> needed = closed_set(B, {slot});
    Eigen::Index heaviest = 0;
    const double largest = fixed.row(0).maxCoeff(&heaviest);
    std::vector<char> has(B.rows(), false);
    const Index common = fixed.sum() > 1 - largest ? Index(heaviest) + 1 : 0;
    if (!(B.coeff(common, common) > least)) return false;  // with it, what has a weight of it keeps one
    has[common] = true;
    for (bool grows = true; grows;) {
      grows = false;
      for (const Index s : needed) {
        if (has[s]) continue;
        for (SparseMatrix::InnerIterator it(B, s); it && !has[s]; ++it) has[s] = it.value() > least && has[it.col()];
        grows |= bool(has[s]);
      }
    }
    return std::all_of(needed.begin(), needed.end(), [&](Index s) { return bool(has[s]); });
  }
  /// The rows of a block, of differences too.
  static SparseMatrix rows_of(const PieceBlock& block) {
    if (block.rows().rows() > 0) return block.rows();
    const RowMatrix D = block.differences();
    RowMatrix rows(D.rows() + 1, D.cols() + 1);
    rows.bottomRightCorner(D.rows(), D.cols()) = D;
    rows.row(0).tail(D.cols()).setZero();
    rows.rightCols(D.cols()).rowwise() += block.origin();
    rows.col(0) = 1 - rows.rightCols(D.cols()).rowwise().sum().array();
    return SparseMatrix(rows.sparseView(1, least));
  }
  /// The rows of the cycle.
  SparseMatrix rows() const {
    SparseMatrix B = rows_of(visits[first].link->block);
    for (size_t i = first + 1; i < visits.size(); ++i) SparseMatrix(product(rows_of(visits[i].link->block), B)).swap(B);
    return B;
  }
};

Eigen::RowVectorXd PieceType::found_corner_limit(int corner) const {
  const CornerPath path(this, corner);
  RowMatrix row;
  if (path.first > 0) {  // where the cycle begins the limit is known, or becomes known for all that come there
    row = path.visits[path.first].type->corner_limit(path.visits[path.first].corner);
    for (size_t i = path.first; i-- > 0;) row = path.visits[i].link->block.pulled_back(row);
  } else {
    const bool begins_here = kind_ == Piece::Kind::quad || kind_ == Piece::Kind::triangle;
    row = path.is_large() ? fixed_row(path.rows(), begins_here ? corner : 0) : fixed_row(path.cycle());
    const Index slot = begins_here ? corner : 0;
    if (row.size() > 0 && !(row.cwiseAbs().maxCoeff() < 1e8 && path.attracts(row, slot)))
      throw AnalysisError(types_->scheme_.name +
                          ": no limit where a neighbourhood repeats itself: eigenvalue 1 is not simple and dominant");
  }
  return row;
}

bool PieceType::is_extraordinary(int corner) const {
  if (kind_ != Piece::Kind::quad && kind_ != Piece::Kind::triangle) return false;
  const Topology& t = level().topology();
  HalfEdge h = piece().start;
  for (int i = 0; i < corner; ++i) h = t.next(h);
  const HalfEdge first = h;
  Index valence = 0;
  do {
    ++valence;
    h = t.ccw(h);
  } while (exists(h) && h != first);
  return exists(h) && valence != types_->scheme_.regular_valence();
}

std::optional<PieceType::Modes> PieceType::modes(int corner, const Eigen::MatrixXd& D, double scale, int degree) const {
  const auto space = eigenspace(D, std::pow(scale, -degree), degree + 1);
  if (!space) return std::nullopt;
  const int corners = kind_ == Piece::Kind::triangle ? 3 : 4;
  const PieceCoordinates here = corner_place(kind_, corner);
  const Eigen::RowVectorXd& origin = corner_limit(corner);
  const auto there = [&](double u, double v) { return corners == 3 ? triangle_place(u, v) : quad_place(u, v); };
  const auto value = [&](const PieceCoordinates& p) -> Eigen::RowVectorXd {
    return (piece_rows(*this, p, 0, false).rows.row(0) - origin) * space->right;
  };
  const auto polynomials = [&](const PieceCoordinates& p) { return monomials(degree, p.u - here.u, p.v - here.v); };
  // Their coefficients, by two other corners and the middle between these.
  const PieceCoordinates a = corner_place(kind_, (corner + 1) % corners),
                         b = corner_place(kind_, (corner + corners - 1) % corners);
  const PieceCoordinates known[] = {a, b, there((a.u + b.u) / 2, (a.v + b.v) / 2)};
  Eigen::MatrixXd places(degree + 1, degree + 1), values(degree + 1, degree + 1);
  for (int i = 0; i <= degree; ++i) {
    places.row(i) = polynomials(known[i]);
    values.row(i) = value(known[i]);
  }
  const Eigen::MatrixXd coefficients = inverse(places) * values;
  // They are polynomials of the parameters where the neighbourhood is regular; around an extraordinary vertex whose
  // eigenvalue happens to be the same, they are not.
  for (const auto& [u, v] : {std::pair{0.5, 0.25}, {0.25, 0.5}, {0.5, 0.5}}) {
    const PieceCoordinates p = there(u, v);
    if (!((value(p) - polynomials(p) * coefficients).norm() < 1e-9 * coefficients.norm())) return std::nullopt;
  }
  return Modes{coefficients * space->left, space->right * inverse(coefficients)};
}

PieceType::CornerRows PieceType::found_corner(int corner) const {
  const CornerPath path(this, corner);
  const auto& [at, own, link, ignored] = path.visits[path.first];
  const double scale = path.visits.size() == path.first + 1 ? pure_scale(link->map) : 0;
  const int smoothness = types_->regular_smoothness();
  CornerRows result;
  RowMatrix& rows = result.rows;
  rows = path.first > 0 ? at->corner(own).rows : RowMatrix(corner_limit(corner));
  if (path.first == 0 && scale != 0 && !at->is_extraordinary(own) && types_->has_no_polynomials() && smoothness >= 1 &&
      !link->block.is_large()) {
    const Eigen::MatrixXd D = link->block.differences();
    const std::optional<Modes> linear = at->modes(own, D, scale, 1);
    const std::optional<Modes> quadratic = linear && smoothness >= 2 ? at->modes(own, D, scale, 2) : std::nullopt;
    rows.conservativeResize(quadratic ? 6 : linear ? 3 : 1, Eigen::NoChange);
    if (linear) rows.middleRows(1, 2) = linear->derivatives;
    if (quadratic) rows.bottomRows(3) = quadratic->derivatives;
    if (linear) result.linear = linear->functions;
  }
  for (size_t i = path.first; i-- > 0;) {
    rows = path.visits[i].link->block.pulled_back(rows);
    apply_chain(path.visits[i].link->map.chain(path.visits[i].place), rows);
  }
  return result;
}

PieceTypes::PieceTypes(const Scheme<double>& scheme, size_t max_types)
    : scheme_(check_scheme(scheme)), max_types_(max_types) {
  scheme_.preparation.clear();  // surfaces begin behind it
}

PieceTypes::~PieceTypes() = default;

int PieceTypes::regular_smoothness() const {
  return smoothness_.get([this] { return sublimit::regular_smoothness(scheme_); });
}

int PieceTypes::rings(const Sharpness& sharpness) const {
  // Under Chaikin creasing the sharpness of an edge's far half depends on the edges around its far end.
  return std::max(rings_.get([this] { return piece_rings(scheme_); }), sharpness.creasing == Creasing::chaikin ? 2 : 1);
}

int PieceTypes::rings_beyond(const Level& level) const {
  // Masks near the rim of a part are not the mesh's: one more ring a level, where they look further, and one for knots.
  const bool narrow = scheme_.has_one_ring_limits() || (scheme_.is_dual() && scheme_.steps.size() == 1);
  return (level.intervals.empty() ? 0 : 1) + (narrow ? 0 : scheme_.period);
}

int PieceTypes::rings_around_corner(const Level& level) const {
  if (scheme_.has_one_ring_limits() && level.intervals.empty()) return 1;
  // The tangents of a closed ring look one ring further.
  const int of_piece = std::max(rings(level.sharpness), level.intervals.empty() ? 1 : 2) + rings_beyond(level);
  return 1 + std::max(of_piece, rings_for_refinement_.get([this] { return rings_for_refinement(scheme_); }));
}

void PieceTypes::take(double bytes, Index slots) {
  double before = memory_.load(std::memory_order_relaxed);
  while (!memory_.compare_exchange_weak(before, before + bytes)) continue;
  if (before + bytes <= memory_limit()) return;
  throw ResourceError(scheme_.name + ": the limit of pieces that depend on up to " + std::to_string(slots) +
                      " points takes more than " + bytes_in_words(before + bytes) + " of memory; " +
                      memory_limit_in_words() + "; vertices of fewer edges, or faces of fewer corners, need less");
}

size_t PieceTypes::size() const {
  const std::shared_lock lock(mutex_);
  return types_.size();
}

const PieceType* PieceTypes::find(const std::vector<std::uint32_t>& signature) const {
  const std::shared_lock lock(mutex_);
  const auto at = types_.find(signature);
  return at == types_.end() ? nullptr : at->second.get();
}

std::unique_ptr<PieceType> PieceTypes::made(std::shared_ptr<const Level> level, const Piece& piece,
                                            const PieceWalk& walk) {
  auto type = std::make_unique<PieceType>();
  type->num_slots_ = static_cast<Index>(walk.vertices.size());
  take(4.0 * double(walk.signature.size() + walk.vertices.size()), type->num_slots_);
  type->types_ = this;
  type->kind_ = piece.kind;
  type->rings_ = walk.rings;
  type->decays_ = walk.decays;
  type->apart_ = walk.apart;
  type->met_ = {std::move(level), piece, walk.vertices};
  return type;
}

const PieceType* PieceTypes::kept(const PieceWalk& walk, std::unique_ptr<PieceType> type) {
  const std::unique_lock lock(mutex_);
  return types_.try_emplace(walk.signature, std::move(type)).first->second.get();
}

const PieceType* PieceTypes::type(const std::shared_ptr<const Level>& level, const Piece& piece,
                                  const PieceWalk& walk) {
  if (const PieceType* known = find(walk.signature)) return known;
  return kept(walk, made(level, piece, walk));
}

const PieceType* PieceTypes::type(const Level& level, const Piece& piece, const PieceWalk& walk) {
  if (const PieceType* known = find(walk.signature)) return known;
  std::unique_ptr<PieceType> type = made({std::shared_ptr<const Level>(), &level}, piece, walk);
  type->surroundings();
  return kept(walk, std::move(type));
}

}  // namespace sublimit
