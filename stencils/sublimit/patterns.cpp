// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patterns.h"

#include <algorithm>
#include <cmath>

#include "sublimit/base/error.h"

namespace sublimit {

bool Patterns::is_possible(const Scheme<double>& scheme) {
  return scheme.steps.size() == 1 && scheme.period == 1 &&
         (scheme.steps[0].split == Split::pqq || scheme.steps[0].split == Split::ptq);
}

Patterns::Patterns(const Scheme<double>& scheme)
    : scheme_(scheme), types_(scheme), kind_(scheme.face_size() == 3 ? Piece::Kind::triangle : Piece::Kind::quad) {
  if (!is_possible(scheme))
    throw InvalidParameter(scheme.name + ": patterns are of schemes that cut a face into four of its kind");
}

Patterns::Match Patterns::match(const Level& level, Face face) {
  static thread_local PieceWalker walker;
  const Topology& t = level.topology();
  const int rings = types_.rings(level.sharpness);
  const auto walk = [&](int turn) -> const PieceWalk& {
    return walker.walk(t, level.sharpness, {kind_, t.corner(face, turn)}, rings, 0);
  };
  const PieceWalk* own = &walk(0);
  {
    const std::shared_lock lock(mutex_);
    if (const auto known = turned_.find(own->signature); known != turned_.end()) {
      const Turned found = known->second;
      if (found.turn != 0) own = &walk(found.turn);
      return {found.type, found.turn, own->vertices};
    }
  }
  // New: the least of its rotations is the type; the next face may be seen from any of them.
  const int sides = t.size(face);
  std::vector<std::vector<std::uint32_t>> signatures;
  std::vector<std::vector<Index>> vertices;
  for (int turn = 0; turn < sides; ++turn) {
    const PieceWalk& turned = walk(turn);
    signatures.push_back(turned.signature);
    vertices.push_back(turned.vertices);
  }
  const int least = static_cast<int>(std::min_element(signatures.begin(), signatures.end()) - signatures.begin());
  const Piece piece{kind_, t.corner(face, least)};
  const PieceType* type = types_.type(level, piece, walk(least));
  const std::unique_lock lock(mutex_);
  if (turned_.try_emplace(signatures[least], Turned{type, 0}).second) ++num_types_;
  for (int turn = 0; turn < sides; ++turn)
    turned_.try_emplace(signatures[turn], Turned{type, (least - turn + sides) % sides});
  return {type, least, vertices[least]};
}

const RowMatrix& Patterns::differences(const PieceType& type, int levels) {
  const std::pair key{&type, levels};
  {
    const std::lock_guard lock(rows_mutex_);
    if (const auto known = differences_.find(key); known != differences_.end()) return *known->second;
  }
  auto made = std::make_unique<const RowMatrix>(made_rows(type, levels));
  const std::lock_guard lock(rows_mutex_);
  return *differences_.try_emplace(key, std::move(made)).first->second;
}

/// In differences (piece_block.h).
RowMatrix Patterns::made_rows(const PieceType& type, int levels) {
  const Lattice lattice{Index{1} << levels, kind_ == Piece::Kind::triangle};
  const Eigen::Index slots = type.num_slots();
  RowMatrix R = RowMatrix::Zero(lattice.size(), slots - 1);
  if (levels == 0) {  // its own corners come first, counter-clockwise
    for (int k = 1; k < lattice.num_sides(); ++k) R(lattice.on_side(k, 0), k - 1) = 1;
    return R;
  }
  const Lattice half{lattice.n / 2, lattice.triangle};
  const double n = lattice.n;
  std::vector<bool> made(lattice.size(), false);
  for (const PieceLink& link : type.children()) {
    const RowMatrix& child = differences(*link.type, levels - 1);
    std::vector<Index> own, of_child;
    for (Index j = 0; j <= lattice.n; ++j)
      for (Index i = 0; i <= (lattice.triangle ? lattice.n - j : lattice.n); ++i) {
        const Place place = lattice.triangle ? triangle_place(i / n, j / n) : quad_place(i / n, j / n);
        if (made[lattice.row(i, j)] || !link.map.contains(place)) continue;
        const Place inside = link.map(place);
        own.push_back(lattice.row(i, j));
        of_child.push_back(half.row(static_cast<Index>(std::lround(inside.u * half.n)),
                                    static_cast<Index>(std::lround(inside.v * half.n))));
        made[own.back()] = true;
      }
    const RowMatrix rows = child(of_child, Eigen::all);
    R(own, Eigen::all) = link.block.derivatives_pulled_back(rows).rowwise() + link.block.origin();
  }
  return R;
}

const RowMatrix& Patterns::rows(const PieceType& type, int levels) {
  const std::pair key{&type, levels};
  {
    const std::lock_guard lock(rows_mutex_);
    if (const auto known = rows_.find(key); known != rows_.end()) return *known->second;
  }
  const RowMatrix& D = differences(type, levels);
  auto made = std::make_unique<RowMatrix>(D.rows(), D.cols() + 1);
  made->rightCols(D.cols()) = D;
  made->col(0) = 1 - D.rowwise().sum().array();
  const std::lock_guard lock(rows_mutex_);
  return *rows_.try_emplace(key, std::move(made)).first->second;
}

size_t Patterns::num_types() const {
  const std::shared_lock lock(mutex_);
  return num_types_;
}

}  // namespace sublimit
