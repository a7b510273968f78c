// SPDX-License-Identifier: Apache-2.0
#pragma once
// The checker's own view of a witness (witness.h): it shares nothing with the prover but arithmetic.
#include <array>
#include <map>
#include <string>
#include <vector>

#include "sublimit/certificates/algebraic.h"
#include "sublimit/neighborhood/local_matrix.h"

namespace sublimit::witness {

using Spot = std::array<int, 2>;   ///< x, y in half edges
using Label = std::array<int, 3>;  ///< sector, x, y
using Exact = Algebraic;

struct Piece {
  std::array<Spot, 3> corners;  ///< by the partition's name
  std::vector<Spot> controls;
  std::vector<std::vector<Exact>> functions;
};

struct Leaf {
  size_t piece = 0;
  Spot cell{};
  std::string path;
  double least = 0;
};

struct Parts {
  int n = 0, degree = 0, ring = 0;
  bool triangular = false, dual = false, squares = false;
  std::map<Spot, Exact> mask;
  std::vector<Piece> pieces;
  std::vector<Spot> labels;                     ///< of the rows but the centre's
  std::map<Spot, std::map<Label, Exact>> rows;  ///< the centre is (0, 0)
  Ball lambda;
  std::map<Spot, ComplexBall> net;
  std::vector<Leaf> leaves;
};

inline bool is_point(const Parts& w, Spot p) { return (p[0] % 2 != 0) == w.dual && (p[1] % 2 != 0) == w.dual; }
/// Label of a place of the plane around sector 0; false where there is none.
bool find_label(const Parts& w, Spot p, Label& label);
/// Weights of the mask for the point P of the refined plane.
std::map<Spot, Exact> mask_row(const Parts& w, Spot P);
/// u and v in a piece that is `scale` times as large as corners say.
std::array<Exact, 2> place_in(const std::array<Spot, 3>& corners, int scale, const std::array<Exact, 2>& at);
/// Exact solution of a square system for several right sides, or false.
bool solve(std::vector<std::vector<Exact>> M, std::vector<std::vector<Exact>>& right);

/// Values of all Bernstein polynomials of a degree at a place, in the order of coefficients.
std::vector<Exact> basis(bool squares, int du, int dv, const Exact& u, const Exact& v);

/// The three halves of the check; each adds what it finds wrong.
void check_pieces(const Parts& w, std::vector<std::string>& problems);
/// Also replaces lambda and net by enclosures of its own.
void check_spectrum(Parts& w, std::vector<std::string>& problems);
void check_map(const Parts& w, std::vector<std::string>& problems);

}  // namespace sublimit::witness
