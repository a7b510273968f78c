// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/polynomial_search.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/neighborhood/piece_rows.h"
#include "sublimit/neighborhood/sector_mesh.h"

namespace sublimit {
namespace {

constexpr int largest_degree = 10;
/// Of coefficients and values, relative to the weights: a few hundred roundings.
constexpr double tolerance = 1e-12, rough_tolerance = 1e-8;

/// Chebyshev's points on [0, 1], moved to multiples of a power of two that are reached in few steps.
double node(int i, int count, double denominator) {
  const double x = 0.5 - 0.5 * std::cos(std::numbers::pi * (2 * i + 1) / (2 * count));
  return std::round(x * denominator) / denominator;
}

/// From this degree on second derivatives would lose too many digits: 4 d^4 roundings.
constexpr int wide_degree = 6;
using Wide = long double;
using WideMatrix = Eigen::Matrix<Wide, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

WideMatrix wide_values(const PolynomialBasis& basis, const PieceCoordinates& p) {
  std::vector<Wide> a{1, 2 * Wide(p.u) - 1}, b{1, 2 * Wide(p.v) - 1};
  for (std::vector<Wide>* T : {&a, &b})
    while (int(T->size()) <= basis.degree()) T->push_back(2 * (*T)[1] * T->back() - (*T)[T->size() - 2]);
  WideMatrix row(1, basis.size());
  for (int i = 0, k = 0; i <= basis.degree(); ++i)
    for (int j = 0; j <= (basis.total() ? basis.degree() - i : basis.degree()); ++j) row(0, k++) = a[i] * b[j];
  return row;
}

/// Limit row of a place that comes to a known polynomial or to a corner that repeats itself.
WideMatrix wide_row(const PieceType& type, const PieceCoordinates& place) {
  const PieceLink& link = type.child(place);
  WideMatrix row;
  if (const PiecePolynomial* p = type.known_polynomial()) {
    const bool second = p->coefficients.size() > 1 && place.u < place.v;
    return wide_values(p->basis, place) * p->coefficients[second ? 1 : 0].cast<Wide>();
  }
  const WideMatrix D = link.block.differences().cast<Wide>(), origin = link.block.origin().cast<Wide>();
  const PieceCoordinates next = link.map(place);
  if (link.type == &type && next.u == place.u && next.v == place.v) {
    const WideMatrix I = WideMatrix::Identity(D.rows(), D.cols());
    return Eigen::PartialPivLU<WideMatrix>((I - D).transpose()).solve(origin.transpose()).transpose();
  }
  return wide_row(*link.type, next) * D + origin;
}

bool is_regular(const PieceType& type) {
  return std::all_of(type.children().begin(), type.children().end(),
                     [&](const PieceLink& c) { return c.type == &type; });
}

}  // namespace

void PolynomialSearch::decide(const PieceType& type) {
  if (type.polynomial_state_.load() != 0) return;
  // Between unequal intervals types may come back in turns, without one that is its own children's.
  if (!types_.searched_ && !type.level().intervals.empty()) start_from_equal_intervals();
  if (types_.searched_ && !types_.basis_) {
    type.polynomial_state_.store(1, std::memory_order_release);
    return;
  }
  const bool is = verdict(type).polynomial;
  type.polynomial_state_.store(is ? 2 : 1, std::memory_order_release);
}

void PolynomialSearch::start_from_equal_intervals() {
  const Scheme<double>& scheme = types_.scheme();
  const bool is_dual = scheme.is_dual();
  const Centre::Kind middle = is_dual ? Centre::Kind::face : Centre::Kind::vertex;
  constexpr int rings = 4;
  const SectorMesh around = sector_mesh(middle, scheme.regular_valence(), 4, rings);
  const auto level = std::make_shared<const Level>(control_level(scheme, around.mesh));
  const Topology& t = level->topology();
  const Index first = around.find.at(is_dual ? SectorLabel{0, 1, 1} : SectorLabel{0, 0, 0});
  const Piece piece{is_dual ? Piece::Kind::corner : Piece::Kind::quad, t.outgoing(Vertex{first})};
  PieceWalker walker;
  const PieceWalk& walk = walker.walk(*level, piece, types_.rings(level->sharpness), scheme.period);
  verdict(*types_.type(level, piece, walk));
}

PolynomialSearch::Verdict PolynomialSearch::verdict(const PieceType& type) {
  const auto on_stack = std::find(stack_.begin(), stack_.end(), &type);
  if (on_stack != stack_.end()) return {true, size_t(on_stack - stack_.begin())};
  const size_t own = stack_.size();
  if (const int state = type.polynomial_state_.load(); state != 0) return {state == 2, own};
  Verdict result{!type.decays_, own};
  stack_.push_back(&type);
  if (result.polynomial)
    for (const PieceLink& child : type.children()) {
      if (child.type == &type) continue;
      const Verdict v = verdict(*child.type);
      result.lowest = std::min(result.lowest, v.lowest);
      if (!v.polynomial) {
        result.polynomial = false;
        break;
      }
    }
  if (result.polynomial) {
    const PiecePolynomial* p = candidate(type);
    result.polynomial = p && satisfies_refinement(type, *p, tolerance);
  }
  stack_.pop_back();
  // What rests on an assumption about a type below is not written down: it is found again when that one is known.
  if (!result.polynomial || result.lowest >= own)
    type.polynomial_state_.store(result.polynomial ? 2 : 1, std::memory_order_release);
  if (!result.polynomial) result.lowest = own;
  return result;
}

const PiecePolynomial* PolynomialSearch::candidate(const PieceType& type) {
  if (!type.has_candidate_) {
    type.has_candidate_ = true;  // and while it is looked for, there is none: types may come back in turns
    try {
      type.candidate_ = found_candidate(type);
    } catch (...) {  // no memory, or interrupted: nothing is known of it
      type.has_candidate_ = false;
      throw;
    }
  }
  return type.candidate_ ? &*type.candidate_ : nullptr;
}

std::optional<PiecePolynomial> PolynomialSearch::found_candidate(const PieceType& type) {
  const bool total = type.kind() == Piece::Kind::triangle;
  const auto found = [&](const PolynomialBasis& basis, bool halves) {
    std::optional<PiecePolynomial> p = interpolated(type, basis, halves, false);
    if (!p || total || halves || basis.degree() < wide_degree) return p;
    return satisfies_refinement(type, *p, rough_tolerance) ? interpolated(type, basis, halves, true) : std::nullopt;
  };
  if (types_.basis_) return found(*types_.basis_, types_.halves_);
  if (!is_regular(type)) return std::nullopt;
  for (int pieces = 1; pieces <= (total ? 1 : 2); ++pieces)
    for (int degree = 1; degree <= (pieces == 1 ? largest_degree : 3); ++degree) {
      const PolynomialBasis basis(degree, total);
      std::optional<PiecePolynomial> p = found(basis, pieces == 2);
      if (!p || !satisfies_refinement(type, *p, tolerance)) continue;
      types_.basis_ = basis;
      types_.halves_ = pieces == 2;
      types_.searched_ = true;
      return p;
    }
  types_.has_none_ = true;
  types_.searched_ = true;
  return std::nullopt;
}

std::optional<PiecePolynomial> PolynomialSearch::interpolated(const PieceType& type, const PolynomialBasis& basis,
                                                              bool halves, bool wide) const {
  PiecePolynomial p{basis, {}};
  const int n = basis.degree() + 1;
  // Weights k/64 make four steps without a rounding, ten with many; second derivatives multiply them by d^4.
  const double denominator = n <= 4 && !basis.total() && !halves ? 16 : 1024;
  for (int half = 0; half < (halves ? 2 : 1); ++half) {
    std::vector<PieceCoordinates> places;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        double u = node(i, n, denominator), v = node(j, n, denominator);
        if (basis.total() || halves) v = std::round(u * v * denominator) / denominator;  // below the diagonal
        if (basis.total()) u = 1 - u;  // a triangle's corners are (0,0), (1,0), (0,1)
        if (half == 1) std::swap(u, v);
        places.push_back(basis.total() ? triangle_place(u, v) : quad_place(u, v));
      }
    const auto count = static_cast<Eigen::Index>(places.size());
    if (wide) {
      WideMatrix values(count, basis.size()), rows(count, type.num_slots() - 1);
      for (Eigen::Index k = 0; k < count; ++k) {
        values.row(k) = wide_values(basis, places[k]);
        rows.row(k) = wide_row(type, places[k]);
      }
      p.coefficients.push_back(Eigen::PartialPivLU<WideMatrix>(values).solve(rows).cast<double>());
      continue;
    }
    Eigen::MatrixXd values(count, basis.size());
    RowMatrix rows(count, type.num_slots() - 1);
    for (Eigen::Index k = 0; k < count; ++k) {
      values.row(k) = basis.at(places[k].u, places[k].v, 0);
      rows.row(k) = piece_rows(type, places[k], 0, false).rows.row(0);
    }
    const PivotedQr qr(values);
    if (qr.rank() < basis.size()) return std::nullopt;
    Eigen::MatrixXd coefficients = qr.solve(rows);
    const WideMatrix left = rows.cast<Wide>() - values.cast<Wide>() * coefficients.cast<Wide>();
    p.coefficients.push_back(coefficients + qr.solve(left.cast<double>()));
  }
  return p;
}

bool PolynomialSearch::satisfies_refinement(const PieceType& type, const PiecePolynomial& p, double allowed) {
  const bool total = p.basis.total();
  const int cells = (type.children().size() == 9 ? 3 : 2) * (p.basis.degree() + 2);
  double size = 1;
  for (const RowMatrix& C : p.coefficients) size = std::max(size, C.size() > 0 ? C.cwiseAbs().maxCoeff() : 0);
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const double u = (i + 0.37) / cells, v = (j + 0.61) / cells;
      if (total && u + v >= 1) continue;
      const PieceCoordinates at = total ? triangle_place(u, v) : quad_place(u, v);
      const PieceLink& link = type.child(at);
      const PiecePolynomial* fine = link.type == &type ? &p : candidate(*link.type);
      if (!fine) return false;
      const RowMatrix difference = p.rows(at, 0) - link.block.pulled_back(fine->rows(link.map(at), 0));
      if (difference.size() > 0 && !(difference.cwiseAbs().maxCoeff() <= allowed * size)) return false;
    }
  return true;
}

}  // namespace sublimit
