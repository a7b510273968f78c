// SPDX-License-Identifier: Apache-2.0
#pragma once
// Witnesses: the data that a proof of C^1 rests on, as JSON, with an independent checker. The checker shares
// only arithmetic with the prover: it interpolates where the prover multiplies Bernstein polynomials, and
// encloses the eigenvector by its own Newton step.
//
//   {"format": "sublimit-witness", "version": 1, "kind": "c1", "scheme": name, "n": valence,
//    "grid": "square" | "triangular", "dual": whether points lie around a face,
//    "mask": [[x, y, weight] ...],                   of regular meshes; x, y in half edges; numbers as exact_text
//    "partition": "squares" | "triangles" | "quarter-squares", "degree": of the pieces,
//    "pieces": [{"controls": [[x, y] ...], "functions": [[Bernstein coefficient ...] ...]} ...],    by control
//    "rows": [{"at": [x, y], "weights": [[sector, x, y, weight] ...]} ...],      of the local matrix: centre, sector 0
//    "lambda": ball, "net": [[x, y, complex ball] ...],                          of sector 0, where the rows are
//    "ring": r, "leaves": [[piece, x, y, path, least] ...]}                      cells, quarters of quarters, bounds
//
// The checker cannot verify that the rows are those of the scheme, that rules far from the centre are the mask,
// and that the mask converges.
#include <string>
#include <vector>

#include "sublimit/certificates/c1/c1_certificate.h"

namespace sublimit {

/// Returns the witness of a proof.
/// @param scheme       name of the scheme
/// @param certificate  a certificate whose verdict is `proved`
std::string c1_witness(const std::string& scheme, const C1Certificate& certificate, const RegularPieces& pieces);

/// Returns the errors of a witness; none if it proves its statement.
std::vector<std::string> check_witness(const std::string& json);

}  // namespace sublimit
