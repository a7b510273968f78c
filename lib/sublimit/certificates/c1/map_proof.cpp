// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/c1/map_proof.h"

#include <algorithm>

namespace sublimit {
namespace {

constexpr int deepest = 7;

Ball least_of(const Bernstein<Ball>& f) {
  Ball least = f.coefficients().front();
  for (const Ball& c : f.coefficients())
    if (c.lower() < least.lower()) least = c;
  return least;
}

Ball greatest_of(const Bernstein<Ball>& f) {
  Ball greatest = f.coefficients().front();
  for (const Ball& c : f.coefficients())
    if (c.upper() > greatest.upper()) greatest = c;
  return greatest;
}

/// Some corner has it: coefficients of corners are values.
template <class Sign>
bool at_a_corner(const Bernstein<Ball>& f, const Sign& sign) {
  const int d = f.degree_u();
  return sign(f(0, 0)) || sign(f(d, 0)) || sign(f(0, f.last(0))) || sign(f(d, f.last(d)));
}

class SignSearch {
 public:
  explicit SignSearch(MapProof& proof) : proof_(proof) {}
  bool positive = false, negative = false, failed = false;
  void look(size_t piece, const Bernstein<Ball>& f, const std::string& path) {
    const Ball least = least_of(f);
    positive |= at_a_corner(f, certainly_positive);
    // All of them: a coefficient that is no number has no least end to be found by.
    if (std::all_of(f.coefficients().begin(), f.coefficients().end(), certainly_positive)) {
      proof_.leaves.push_back({piece, path, least, greatest_of(f)});
      return;
    }
    if (!negative && at_a_corner(f, certainly_negative)) {
      negative = true;
      const LatticePoint cell = proof_.placed[piece].cell;
      proof_.fold = "cell (" + std::to_string(cell.x2 / 2) + ", " + std::to_string(cell.y2 / 2) + ") of a sector" +
                    (path.empty() ? "" : ", part " + path) + ", where it goes down to " + least.text(6);
    }
    if (negative) return;  // one place is enough
    if (path.size() == deepest) {
      failed = true;
      return;
    }
    const auto quarters = f.quarters();
    for (size_t q = 0; q < 4 && !failed && !negative; ++q) look(piece, quarters[q], path + static_cast<char>('0' + q));
  }

 private:
  MapProof& proof_;
};

}  // namespace

std::vector<std::array<PiecePlace<Ball>, 2>> outer_edges(const RegularPiece& piece, LatticePoint cell, int ring,
                                                         bool triangular) {
  std::vector<std::array<PiecePlace<Ball>, 2>> edges;
  std::vector<std::pair<LatticePoint, PiecePlace<Ball>>> corners{{piece.corners[0], {Ball(0), Ball(0)}},
                                                                 {piece.corners[1], {Ball(1), Ball(0)}}};
  if (piece.shape == PieceShape::square)
    corners.push_back({piece.corners[1] + piece.corners[2] - piece.corners[0], {Ball(1), Ball(1)}});
  corners.push_back({piece.corners[2], {Ball(0), Ball(1)}});
  for (size_t k = 0; k < corners.size(); ++k) {
    const auto& a = corners[k];
    const auto& b = corners[(k + 1) % corners.size()];
    const LatticePoint p = a.first + cell, q = b.first + cell;
    const bool outer = triangular ? ring2(p, true) == 4 * ring && ring2(q, true) == 4 * ring
                                  : (p.x2 == 4 * ring && q.x2 == 4 * ring) || (p.y2 == 4 * ring && q.y2 == 4 * ring);
    if (outer) edges.push_back({a.second, b.second});
  }
  return edges;
}

Bernstein<Ball> along(const Bernstein<Ball>& f, const std::array<PiecePlace<Ball>, 2>& edge) {
  const bool by_u = !(edge[0].u == edge[1].u);
  if (f.shape() == PieceShape::triangle) return f.restricted(edge[0], edge[1], edge[0]);
  return by_u ? f.restricted(edge[0], edge[1], edge[0]) : f.restricted(edge[0], edge[0], edge[1]);
}

BallFunctions in_balls(const RegularPieces& pieces) {
  BallFunctions functions;
  for (const RegularPiece& piece : pieces.pieces) {
    std::vector<Bernstein<Ball>> of_piece;
    for (const Bernstein<Algebraic>& f : piece.functions) {
      Bernstein<Ball> g(f.shape(), f.degree_u(), f.degree_v());
      for (size_t c = 0; c < f.coefficients().size(); ++c) g.coefficients()[c] = f.coefficients()[c].real_enclosure();
      of_piece.push_back(std::move(g));
    }
    functions.push_back(std::move(of_piece));
  }
  return functions;
}

std::optional<MapPiece> map_piece(CharacteristicMap& map, const RegularPieces& pieces, const BallFunctions& functions,
                                  const PlacedPiece& placed) {
  const RegularPiece& piece = pieces.pieces[placed.piece];
  MapPiece result{Bernstein<Ball>(piece.shape, pieces.degree, pieces.degree),
                  Bernstein<Ball>(piece.shape, pieces.degree, pieces.degree)};
  for (size_t q = 0; q < piece.controls.size(); ++q) {
    const auto z = map.at(piece.controls[q] + placed.cell);
    if (!z) return std::nullopt;
    const Ball x = z->re(), y = z->im();
    const auto& weights = functions[placed.piece][q].coefficients();
    for (size_t c = 0; c < weights.size(); ++c) {
      result.x.coefficients()[c] += weights[c] * x;
      result.y.coefficients()[c] += weights[c] * y;
    }
  }
  return result;
}

Bernstein<Ball> jacobian(const MapPiece& piece) {
  Bernstein<Ball> J = piece.x.du() * piece.y.dv();
  return J -= piece.x.dv() * piece.y.du();
}

MapProof prove_map(CharacteristicMap& map, const RegularPieces& pieces, const BallFunctions& functions, int ring) {
  MapProof proof;
  proof.ring = ring;
  proof.placed = sector_pieces(pieces, ring);
  SignSearch search(proof);
  std::vector<MapPiece> of;
  for (size_t k = 0; k < proof.placed.size(); ++k) {
    auto piece = map_piece(map, pieces, functions, proof.placed[k]);
    if (!piece) return proof;
    of.push_back(std::move(*piece));
    search.look(k, jacobian(of.back()), "");
  }
  proof.parts = proof.leaves.size();
  // The map folds where the sign changes; a map that only turns the plane over does not.
  if (search.negative && search.positive) proof.regular = MapProof::Regular::folds;
  if (!search.negative && !search.failed && !proof.leaves.empty()) proof.regular = MapProof::Regular::yes;
  if (!proof.leaves.empty()) {
    proof.least = proof.leaves.front().least;
    proof.greatest = proof.leaves.front().greatest;
    for (const SignedLeaf& leaf : proof.leaves) {
      if (leaf.least.lower() < proof.least.lower()) proof.least = leaf.least;
      if (leaf.greatest.upper() > proof.greatest.upper()) proof.greatest = leaf.greatest;
    }
  }
  // The half-plane around the middle of the sector: 1 where the sector is symmetric to the real axis.
  const ComplexBall middle = ComplexBall::root_of_unity(1, 2L * map.n);
  std::optional<ComplexBall> start;
  std::vector<Bernstein<Ball>> xs, ys;
  for (size_t k = 0; k < of.size(); ++k)
    for (const auto& edge :
         outer_edges(pieces.pieces[proof.placed[k].piece], proof.placed[k].cell, ring, pieces.mask.triangular)) {
      xs.push_back(along(of[k].x, edge));
      ys.push_back(along(of[k].y, edge));
      const RegularPiece& piece = pieces.pieces[proof.placed[k].piece];
      // The curve starts on spoke 0: at (2 r, 0).
      const std::array<LatticePoint, 3>& c = piece.corners;
      const std::array<PiecePlace<Ball>, 3> at{{{Ball(0), Ball(0)}, {Ball(1), Ball(0)}, {Ball(0), Ball(1)}}};
      for (size_t i = 0; i < 3; ++i)
        if (c[i] + proof.placed[k].cell == LatticePoint{4 * ring, 0})
          start = ComplexBall(of[k].x.at(at[i]), of[k].y.at(at[i]));
    }
  if (!start) return proof;
  const ComplexBall direction = conj(*start * middle);
  proof.winds_once = !xs.empty();
  for (size_t e = 0; e < xs.size(); ++e)
    for (size_t c = 0; c < xs[e].coefficients().size(); ++c)
      if (!certainly_positive((ComplexBall(xs[e].coefficients()[c], ys[e].coefficients()[c]) * direction).re()))
        proof.winds_once = false;
  return proof;
}

}  // namespace sublimit
