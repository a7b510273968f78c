// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patterns.h"

#include <algorithm>
#include <cmath>

#include "sublimit/base/error.h"
#include "sublimit/type_limits.h"

namespace sublimit {

bool Patterns::is_possible(const Scheme<double>& scheme) {
  return scheme.steps.size() == 1 && scheme.period == 1 &&
         (scheme.steps[0].split == Split::pqq || scheme.steps[0].split == Split::ptq);
}

Patterns::Patterns(const Scheme<double>& scheme) : scheme_(scheme), types_(std::make_shared<PieceTypes>(scheme)) {}

namespace {

/// Corners that the walk may begin with.
int num_turns(Piece::Kind kind) { return kind == Piece::Kind::quad ? 4 : kind == Piece::Kind::triangle ? 3 : 1; }

/// Walks around a piece, begun at any of its corners.
class Walks {
 public:
  Walks(const PieceTypes& types, const Level& level, const Piece& piece)
      : level_(level), piece_(piece), rings_(types.rings(level.sharpness)) {}
  Piece piece(int turn) const {
    Piece turned = piece_;
    for (int k = 0; k < turn; ++k) turned.start = level_.topology().next(turned.start);
    return turned;
  }
  const PieceWalk& operator()(int turn) const {
    static thread_local PieceWalker walker;
    return walker.walk(level_.topology(), level_.sharpness, piece(turn), rings_, 0);
  }

 private:
  const Level& level_;
  Piece piece_;
  int rings_;
};

}  // namespace

bool Patterns::find(const Level& level, const Piece& piece, Match& match) const {
  const Walks walk(*types_, level, piece);
  const PieceWalk* own = &walk(0);
  Turned found;
  {
    const std::shared_lock lock(mutex_);
    const auto known = turned_.find(own->signature);
    if (known == turned_.end()) return false;
    found = known->second;
  }
  if (found.turn != 0) own = &walk(found.turn);
  match.type = found.type;
  match.turn = found.turn;
  match.vertices = own->vertices;
  return true;
}

Patterns::Match Patterns::match(const Level& level, const Piece& piece) {
  if (Match known; find(level, piece, known)) return known;
  // New: the least of its rotations is the type; the next face may be seen from any of them.
  const Walks walk(*types_, level, piece);
  const int turns = num_turns(piece.kind);
  std::vector<std::vector<std::uint32_t>> signatures;
  std::vector<std::vector<Index>> vertices;
  for (int turn = 0; turn < turns; ++turn) {
    const PieceWalk& turned = walk(turn);
    signatures.push_back(turned.signature);
    vertices.push_back(turned.vertices);
  }
  const int least = static_cast<int>(std::min_element(signatures.begin(), signatures.end()) - signatures.begin());
  const PieceType* type = types_->type(level, walk.piece(least), walk(least));
  const std::unique_lock lock(mutex_);
  if (turned_.try_emplace(signatures[least], Turned{type, 0}).second) ++num_types_;
  for (int turn = 0; turn < turns; ++turn)
    turned_.try_emplace(signatures[turn], Turned{type, (least - turn + turns) % turns});
  return {type, least, vertices[least]};
}

const RowMatrix& Patterns::differences(const PieceType& type, int levels, Ends ends) {
  const RowsKey key{&type, levels, ends};
  {
    const std::lock_guard lock(rows_mutex_);
    if (const auto known = differences_.find(key); known != differences_.end()) return *known->second;
  }
  auto made = std::make_unique<const RowMatrix>(made_rows(type, levels, ends));
  const std::lock_guard lock(rows_mutex_);
  return *differences_.try_emplace(key, std::move(made)).first->second;
}

/// In differences (piece_block.h).
RowMatrix Patterns::made_rows(const PieceType& type, int levels, Ends ends) {
  const Lattice lattice{Index{1} << levels, type.kind() == Piece::Kind::triangle};
  const Eigen::Index slots = type.num_slots();
  RowMatrix R = RowMatrix::Zero(lattice.size(), slots - 1);
  if (levels == 0) {  // its own corners come first, counter-clockwise
    for (int k = 0; k < lattice.num_sides(); ++k) {
      if (ends == Ends::limits)
        R.row(lattice.on_side(k, 0)) = type.corner_limit(k);
      else if (k > 0)
        R(lattice.on_side(k, 0), k - 1) = 1;
    }
    return R;
  }
  const Lattice half{lattice.n / 2, lattice.triangle};
  const double n = lattice.n;
  std::vector<bool> made(lattice.size(), false);
  for (const PieceLink& link : type.children()) {
    const RowMatrix& child = differences(*link.type, levels - 1, ends);
    std::vector<Index> own, of_child;
    lattice.for_each([&](Index i, Index j) {
      const Place place = lattice.triangle ? triangle_place(i / n, j / n) : quad_place(i / n, j / n);
      if (made[lattice.row(i, j)] || !link.map.contains(place)) return;
      const Place inside = link.map(place);
      own.push_back(lattice.row(i, j));
      of_child.push_back(half.row(static_cast<Index>(std::lround(inside.u * half.n)),
                                  static_cast<Index>(std::lround(inside.v * half.n))));
      made[own.back()] = true;
    });
    const RowMatrix rows = child(of_child, Eigen::all);
    R(own, Eigen::all) = link.block.derivatives_pulled_back(rows).rowwise() + link.block.origin();
  }
  return R;
}

const RowMatrix& Patterns::whole_rows(const PieceType& type, int levels, Ends ends) {
  const RowsKey key{&type, levels, ends};
  {
    const std::lock_guard lock(rows_mutex_);
    if (const auto known = rows_.find(key); known != rows_.end()) return *known->second;
  }
  const RowMatrix& D = differences(type, levels, ends);
  auto made = std::make_unique<RowMatrix>(D.rows(), D.cols() + 1);
  made->rightCols(D.cols()) = D;
  made->col(0) = 1 - D.rowwise().sum().array();
  const std::lock_guard lock(rows_mutex_);
  return *rows_.try_emplace(key, std::move(made)).first->second;
}

const RowMatrix& Patterns::rows(const PieceType& type, int levels) { return whole_rows(type, levels, Ends::points); }

const RowMatrix& Patterns::limit_rows(const PieceType& type, int levels) {
  return whole_rows(type, levels, Ends::limits);
}

const Patterns::LimitBlock* Patterns::limit_block(const PieceType& type, const Lattice& lattice,
                                                  const LatticePlace& place, bool by_address, int derivatives) {
  const LimitKey key{&type, lattice.n, place.turn, place.quarter, by_address, derivatives};
  {
    const std::lock_guard lock(rows_mutex_);
    if (const auto known = limits_.find(key); known != limits_.end()) return known->second.get();
  }
  std::unique_ptr<const LimitBlock> made;
  if (std::optional<LimitBlock> block = limits_of_type(types_, type, lattice, place, by_address, derivatives))
    made = std::make_unique<const LimitBlock>(std::move(*block));
  const std::lock_guard lock(rows_mutex_);
  return limits_.try_emplace(key, std::move(made)).first->second.get();
}

size_t Patterns::num_types() const {
  const std::shared_lock lock(mutex_);
  return num_types_;
}

}  // namespace sublimit
