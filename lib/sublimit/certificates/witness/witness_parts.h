// SPDX-License-Identifier: Apache-2.0
#pragma once
// Data and steps of the witness checker (witness.h), which shares only arithmetic with the prover.
#include <array>
#include <map>
#include <string>
#include <vector>

#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/neighborhood/local_matrix.h"

namespace sublimit::witness {

using Spot = std::array<int, 2>;   ///< place in the plane: x, y in half edges
using Label = std::array<int, 3>;  ///< place around the centre: sector, x, y in half edges
using Exact = Algebraic;

/// A kind of piece of the regular limit.
struct Piece {
  std::array<Spot, 3> corners;                ///< corners u = v = 0, u = 1, v = 1, given by the partition
  std::vector<Spot> controls;                 ///< control points
  std::vector<std::vector<Exact>> functions;  ///< Bernstein coefficients of the function of each control point
};

/// A part of a piece on which the Jacobian determinant has a positive lower bound.
struct Leaf {
  size_t piece = 0;  ///< kind of piece
  Spot cell{};       ///< cell of the piece
  std::string path;  ///< numbers of quarters of quarters; "": the whole piece
  double least = 0;  ///< the claimed lower bound
};

/// A witness, parsed.
struct Parts {
  int n = 0, degree = 0, ring = 0;
  bool triangular = false, dual = false, squares = false;
  std::map<Spot, Exact> mask;
  std::vector<Piece> pieces;
  std::vector<Spot> labels;                     ///< labels of the rows in sector 0, without the centre
  std::map<Spot, std::map<Label, Exact>> rows;  ///< rows of the local matrix by label; the centre is (0, 0)
  Ball lambda;
  std::map<Spot, ComplexBall> net;
  std::vector<Leaf> leaves;
};

/// True if a point of the regular mesh lies at a place.
inline bool is_point(const Parts& w, Spot p) { return (p[0] % 2 != 0) == w.dual && (p[1] % 2 != 0) == w.dual; }
/// Computes the label of a place of the plane around sector 0. Returns false if it has none.
bool find_label(const Parts& w, Spot p, Label& label);
/// Returns the weights of the mask for point P of the refined plane, by point of the plane.
std::map<Spot, Exact> mask_row(const Parts& w, Spot P);
/// Returns u and v of the place `at` in a piece whose corners are `corners` times `scale`.
std::array<Exact, 2> place_in(const std::array<Spot, 3>& corners, int scale, const std::array<Exact, 2>& at);
/// Solves a square system exactly for several right-hand sides, in place. Returns false if it is singular.
bool solve(std::vector<std::vector<Exact>> M, std::vector<std::vector<Exact>>& right);

/// Returns the values of all Bernstein polynomials of a degree at a place, in the order of coefficients.
std::vector<Exact> basis(bool squares, int du, int dv, const Exact& u, const Exact& v);

/// Checks that the pieces satisfy the refinement equation and fit together. Like the two below, appends errors
/// to `problems`.
void check_pieces(const Parts& w, std::vector<std::string>& problems);
/// Checks eigenvalue, eigenvector and the order of the spectrum. Replaces `lambda` and `net` by its own
/// enclosures.
void check_spectrum(Parts& w, std::vector<std::string>& problems);
/// Checks that leaves cover a sector, that the Jacobian is positive on them, and that the boundary winds once.
void check_map(const Parts& w, std::vector<std::string>& problems);

}  // namespace sublimit::witness
