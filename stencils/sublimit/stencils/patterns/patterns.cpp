// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/patterns/patterns.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/stencils/patterns/type_limits.h"

namespace sublimit {

Lattice Patterns::lattice_of(const Scheme<double>& scheme, int levels) {
  Lattice lattice{1, scheme.face_size() == 3};
  for (; levels > 0; levels -= scheme.period) lattice.n *= scheme.dilation();
  return lattice;
}

Patterns::Patterns(const Scheme<double>& scheme) : scheme_(scheme), types_(std::make_shared<LimitCache>(scheme)) {}

namespace {

/// Corners that the walk may begin with.
int num_turns(Piece::Kind kind) { return kind == Piece::Kind::quad ? 4 : kind == Piece::Kind::triangle ? 3 : 1; }

/// Throws unless the level was made by the scheme of these types. A thread remembers the last pair that was right, by
/// who owns them, which costs no lock: find() asks for every face.
void check_level(const std::shared_ptr<LimitCache>& types, const Level& level) {
  static thread_local std::weak_ptr<const LimitCache> last_types;
  static thread_local std::weak_ptr<const Scheme<double>> last_scheme;
  const auto is_owner = [](const auto& a, const auto& b) { return !a.owner_before(b) && !b.owner_before(a); };
  if (!level.made_by || (is_owner(last_scheme, level.made_by) && is_owner(last_types, types))) return;
  types->check(level);
  last_types = types;
  last_scheme = level.made_by;
}

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

Level Patterns::control_level(const Mesh& mesh, const SubdivisionOptions& options) const {
  Level control = sublimit::control_level(scheme_, mesh, options);
  types_->trust(control);
  return control;
}

bool Patterns::find(const Level& level, const Piece& piece, Match& match) const {
  check_level(types_, level);
  const Walks walk(types_->pieces(), level, piece);
  const PieceWalk* own = &walk(0);
  match.size = own->signature.size();
  Turned found;
  {
    const std::shared_lock lock(mutex_);
    const auto known = by_signature_.find(own->signature);
    if (known == by_signature_.end()) return false;
    found = known->second;
  }
  if (found.turn != 0) own = &walk(found.turn);
  if (own->vertices.size() != size_t(found.pattern->num_slots))
    throw FormatError("dictionary: a pattern is of " + std::to_string(found.pattern->num_slots) +
                      " points, but pieces of its type have " + std::to_string(own->vertices.size()));
  match.pattern = found.pattern;
  match.turn = found.turn;
  match.vertices = own->vertices;
  return true;
}

Pattern& Patterns::add_pattern(Piece::Kind kind, Index num_slots, bool decays) {
  Pattern& pattern = patterns_.emplace_back();
  pattern.number = patterns_.size() - 1;
  pattern.kind = kind;
  pattern.num_slots = num_slots;
  pattern.decays = decays;
  return pattern;
}

Patterns::Match Patterns::match(const Level& level, const Piece& piece) {
  if (Match known; find(level, piece, known)) return known;
  // New: the least of its rotations is the type; the next face may be seen from any of them.
  const Walks walk(types_->pieces(), level, piece);
  const int turns = num_turns(piece.kind);
  std::vector<std::vector<std::uint32_t>> signatures;
  std::vector<std::vector<Index>> vertices;
  for (int turn = 0; turn < turns; ++turn) {
    const PieceWalk& turned = walk(turn);
    signatures.push_back(turned.signature);
    vertices.push_back(turned.vertices);
  }
  const int least = static_cast<int>(std::min_element(signatures.begin(), signatures.end()) - signatures.begin());
  const PieceType* type = types_->pieces().type(level, walk.piece(least), walk(least));
  const std::unique_lock lock(mutex_);
  if (const auto known = by_signature_.find(signatures[least]);
      known != by_signature_.end())  // another thread was faster
    return {known->second.pattern, least, vertices[least], signatures[0].size()};
  Pattern& pattern = add_pattern(piece.kind, type->num_slots(), type->decays());
  pattern.type = type;
  for (const auto& signature : signatures) pattern.size = std::max(pattern.size, signature.size());
  for (int turn = 0; turn < turns; ++turn) {
    // To the next least one: where a type is symmetric there are several, and which is taken must not depend on the
    // piece that was met first.
    int next = 0;
    while (signatures[(turn + next) % turns] != signatures[least]) ++next;
    by_signature_.try_emplace(signatures[turn], Turned{&pattern, next});
  }
  return {&pattern, least, vertices[least], signatures[0].size()};
}

const PieceType& Patterns::type(const Pattern& pattern, const Example& example) {
  if (const PieceType* known = pattern.type) return *known;
  check_level(types_, example.level);
  const Walks walk(types_->pieces(), example.level, example.piece);
  const PieceType* type = types_->pieces().type(example.level, walk.piece(example.turn), walk(example.turn));
  pattern.type = type;
  return *type;
}

const RowMatrix& Patterns::differences(const PieceType& type, int levels, Ends ends) {
  return differences_.get({&type, levels, ends}, [&] { return made_rows(type, levels, ends); });
}

namespace {

/// Calls visit(row, row of the child) for the points of a lattice that a child has and no child before it.
/// @param of_child  its lattice
template <class Visit>
void visit_share(const Lattice& lattice, const Lattice& of_child, const PieceMap& map, std::vector<bool>& made,
                 const Visit& visit) {
  const double n = lattice.n;
  // Halves are exact, thirds are not: places in triangles in steps of the lattice, which their linear maps take as
  // well.
  const double steps = lattice.triangle ? n : 1;
  lattice.for_each([&](Index i, Index j) {
    const Index row = lattice.row(i, j);
    if (made[row]) return;
    const PieceCoordinates place =
        lattice.triangle ? PieceCoordinates{double(i), double(j), n - i - j, 0} : quad_place(i / n, j / n);
    if (!map.contains(place)) return;
    const PieceCoordinates inside = map(place);
    visit(row, of_child.row(static_cast<Index>(std::lround(inside.u / steps * of_child.n)),
                            static_cast<Index>(std::lround(inside.v / steps * of_child.n))));
    made[row] = true;
  });
}

/// Points of the first period: rows of S, whatever the types of the children are, which need not be made.
RowMatrix first_rows(const PieceType& type, const Lattice& lattice) {
  const PieceType::ChildCorners corners = type.child_corners();
  const Lattice cell{1, lattice.triangle};
  const Index sides = lattice.num_sides();
  RowMatrix R = RowMatrix::Zero(lattice.size(), type.num_slots() - 1);
  std::vector<bool> made(lattice.size(), false);
  for (size_t c = 0; c < corners.maps.size(); ++c) {
    const Index first = static_cast<Index>(c) * sides;
    const auto row_of = [&](Index k) { return corners.rows.row(first + k).tail(R.cols()); };
    visit_share(lattice, cell, corners.maps[c], made, [&](Index row, Index of_child) {
      Index k = 0;
      while (cell.on_side(k, 0) != of_child) ++k;
      // In the order of the sums of blocks, so that either way has the same bits.
      R.row(row) = row_of(k);
      if (k > 0) R.row(row) = (R.row(row) - row_of(0)) + row_of(0);
    });
  }
  return R;
}

}  // namespace

RowMatrix Patterns::made_corner_rows(const PieceType& type, int levels, Ends ends) {
  std::vector<RowMatrix> parts;
  Eigen::Index count = 0;
  for (const PieceLink& link : type.children()) {
    if (link.map.is_repeated()) continue;
    const RowMatrix* child =
        levels > scheme_.period ? &differences(*link.type, levels - scheme_.period, ends) : nullptr;
    RowMatrix limit;
    if (!child && !link.begins_new) continue;
    if (!child)
      limit = ends == Ends::limits ? link.type->corner_limit(0) : RowMatrix::Zero(1, link.type->num_slots() - 1);
    parts.push_back(link.block.derivatives_pulled_back(child ? *child : limit).rowwise() + link.block.origin());
    count += parts.back().rows();
  }
  RowMatrix R(count, type.num_slots() - 1);
  Eigen::Index row = 0;
  for (const RowMatrix& part : parts) {
    R.middleRows(row, part.rows()) = part;
    row += part.rows();
  }
  return R;
}

std::int64_t Patterns::num_corner_rows(const Pattern& pattern, const Example& example, int levels) {
  for (const Ends ends : {Ends::points, Ends::limits})
    if (const RowMatrix* rows = rows_.known({pattern.number, levels, ends})) return rows->rows();
  std::map<std::pair<const PieceType*, int>, std::int64_t> known;
  const std::function<std::int64_t(const PieceType&, int)> count = [&](const PieceType& type, int left) {
    if (const auto at = known.find({&type, left}); at != known.end()) return at->second;
    std::int64_t rows = 0;
    for (const PieceLink& link : type.children()) {
      if (link.map.is_repeated()) continue;
      rows += left > scheme_.period ? count(*link.type, left - scheme_.period) : link.begins_new;
    }
    return known[{&type, left}] = rows;
  };
  return count(type(pattern, example), levels);
}

/// In differences (piece_block.h).
RowMatrix Patterns::made_rows(const PieceType& type, int levels, Ends ends) {
  if (type.kind() == Piece::Kind::corner) return made_corner_rows(type, levels, ends);
  const Lattice lattice = lattice_of(scheme_, levels);
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
  const Lattice of_child = lattice_of(scheme_, levels - scheme_.period);
  if (levels == scheme_.period && ends == Ends::points) return first_rows(type, lattice);
  std::vector<bool> made(lattice.size(), false);
  for (const PieceLink& link : type.children()) {
    const RowMatrix& child = differences(*link.type, levels - scheme_.period, ends);
    std::vector<Index> own, child_rows;
    visit_share(lattice, of_child, link.map, made, [&](Index row, Index child_row) {
      own.push_back(row);
      child_rows.push_back(child_row);
    });
    const RowMatrix rows = child(child_rows, Eigen::all);
    R(own, Eigen::all) = link.block.derivatives_pulled_back(rows).rowwise() + link.block.origin();
  }
  return R;
}

const RowMatrix& Patterns::whole_rows(const Pattern& pattern, const Example& example, int levels, Ends ends) {
  return rows_.get({pattern.number, levels, ends}, [&] {
    // Limits of vertices have the weights that they have everywhere.
    if (levels == 0 && ends == Ends::limits && pattern.kind != Piece::Kind::corner)
      if (std::optional<LimitBlock> block =
              limits_of_type(types_, type(pattern, example), {.lattice = lattice_of(scheme_, 0), .place = {}}))
        return std::move(block->weights);
    const RowMatrix& D = differences(type(pattern, example), levels, ends);
    RowMatrix made(D.rows(), D.cols() + 1);
    made.rightCols(D.cols()) = D;
    made.col(0) = 1 - D.rowwise().sum().array();
    return made;
  });
}

const RowMatrix& Patterns::rows(const Pattern& pattern, const Example& example, int levels) {
  return whole_rows(pattern, example, levels, Ends::points);
}

const RowMatrix* Patterns::known_rows(const Pattern& pattern, int levels) const {
  return rows_.known({pattern.number, levels, Ends::points});
}

const RowMatrix& Patterns::limit_rows(const Pattern& pattern, const Example& example, int levels) {
  return whole_rows(pattern, example, levels, Ends::limits);
}

const Patterns::LimitBlock* Patterns::limit_block(const Pattern& pattern, const Example& example,
                                                  const LimitRequest& request) {
  const auto& [lattice, place, by_address, derivatives] = request;
  const LimitKey key{pattern.number, lattice.n, place.turn, place.quarter, by_address, derivatives};
  const std::optional<LimitBlock>& block =
      limits_.get(key, [&] { return limits_of_type(types_, type(pattern, example), request); });
  return block ? &*block : nullptr;
}

std::optional<Patterns::LimitBlock> Patterns::limits_at(const Pattern& pattern, const Example& example,
                                                        const LatticePlace& place,
                                                        std::span<const AddressParameters> parameters,
                                                        int derivatives) {
  return limits_of_type(types_, type(pattern, example), place, parameters, derivatives);
}

size_t Patterns::num_types() const {
  const std::shared_lock lock(mutex_);
  return patterns_.size();
}

size_t Patterns::num_matrices() const { return rows_.size() + limits_.size(); }

std::vector<Patterns::Stored> Patterns::stored() const {
  const std::shared_lock lock(mutex_);
  std::vector<Stored> all(patterns_.size());
  for (const Pattern& pattern : patterns_) {
    all[pattern.number].kind = pattern.kind;
    all[pattern.number].num_slots = pattern.num_slots;
    all[pattern.number].decays = pattern.decays;
  }
  for (const auto& [words, turned] : by_signature_)
    all[turned.pattern->number].signatures.push_back({turned.turn, words});
  for (Stored& one : all)  // the same file whatever the order of a hash table
    std::sort(one.signatures.begin(), one.signatures.end(),
              [](const auto& a, const auto& b) { return std::tie(a.turn, a.words) < std::tie(b.turn, b.words); });
  rows_.for_each([&](const auto& key, const RowMatrix& rows) {
    all[std::get<0>(key)].rows.push_back({std::get<1>(key), std::get<2>(key), rows});
  });
  limits_.for_each([&](const LimitKey& key, const std::optional<LimitBlock>& block) {
    if (!block) return;
    const auto& [number, n, turn, quarter, by_address, derivatives] = key;
    const bool triangle = all[number].kind == Piece::Kind::triangle;
    all[number].limits.push_back({{{n, triangle},
                                   {0, static_cast<std::int8_t>(turn), static_cast<std::int8_t>(quarter)},
                                   by_address,
                                   derivatives},
                                  *block});
  });
  return all;
}

void Patterns::add(Stored stored) {
  std::unique_lock lock(mutex_);
  const Pattern* pattern = nullptr;
  for (const Stored::Signature& signature : stored.signatures)
    if (const auto known = by_signature_.find(signature.words); known != by_signature_.end())
      pattern = known->second.pattern;
  if (pattern && pattern->num_slots != stored.num_slots) return;
  if (!pattern) {
    Pattern& added = add_pattern(stored.kind, stored.num_slots, stored.decays);
    for (Stored::Signature& signature : stored.signatures) {
      added.size = std::max(added.size, signature.words.size());
      by_signature_.try_emplace(std::move(signature.words), Turned{&added, signature.turn});
    }
    pattern = &added;
  }
  lock.unlock();
  for (Stored::Rows& rows : stored.rows) rows_.add({pattern->number, rows.levels, rows.ends}, std::move(rows.weights));
  for (Stored::Limits& limits : stored.limits) {
    const LimitRequest& r = limits.request;
    limits_.add({pattern->number, r.lattice.n, r.place.turn, r.place.quarter, r.by_address, r.derivatives},
                std::move(limits.block));
  }
}

}  // namespace sublimit
