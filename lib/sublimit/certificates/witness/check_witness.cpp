// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "sublimit/base/error.h"
#include "sublimit/certificates/witness/witness.h"
#include "sublimit/certificates/witness/witness_parts.h"

namespace sublimit {
namespace witness {

bool find_label(const Parts& w, Spot p, Label& label) {
  // Turn the plane until the place is in the sector between its two axes; a place on the second one is the next one's.
  const int n = w.n;
  for (const int turn : {0, -1, 1}) {
    Spot q = p;
    if (turn == -1) q = w.triangular ? Spot{-p[1], p[0] + p[1]} : Spot{-p[1], p[0]};
    if (turn == 1) q = w.triangular ? Spot{p[0] + p[1], -p[0]} : Spot{p[1], -p[0]};
    if (q == Spot{0, 0}) return label = {0, 0, 0}, true;
    if (q[0] < 0 || q[1] < 0) continue;
    label = q[0] > 0 ? Label{(turn + n) % n, q[0], q[1]} : Label{(turn + 1 + n) % n, q[1], 0};
    return true;
  }
  return false;
}

std::map<Spot, Exact> mask_row(const Parts& w, Spot P) {
  std::map<Spot, Exact> row;
  for (const auto& [offset, weight] : w.mask) {
    const Spot twice{P[0] - offset[0], P[1] - offset[1]};
    if (twice[0] % 2 != 0 || twice[1] % 2 != 0) continue;
    const Spot Q{twice[0] / 2, twice[1] / 2};
    if (is_point(w, Q)) row[Q] = weight;
  }
  return row;
}

bool solve(std::vector<std::vector<Exact>> M, std::vector<std::vector<Exact>>& right) {
  const size_t n = M.size();
  for (size_t c = 0; c < n; ++c) {
    size_t r = c;
    while (r < n && M[r][c].is_zero()) ++r;
    if (r == n) return false;
    std::swap(M[r], M[c]);
    std::swap(right[r], right[c]);
    const Exact inverse = Exact(1) / M[c][c];
    for (Exact& x : M[c]) x *= inverse;
    for (Exact& x : right[c]) x *= inverse;
    for (size_t i = 0; i < n; ++i) {
      if (i == c || M[i][c].is_zero()) continue;
      const Exact f = M[i][c];
      for (size_t j = 0; j < n; ++j) M[i][j] -= f * M[c][j];
      for (size_t j = 0; j < right[i].size(); ++j) right[i][j] -= f * right[c][j];
    }
  }
  return true;
}

namespace {

using Json = nlohmann::json;

/// A whole number of moderate size; what else stands there is no witness.
int whole(const Json& j, int low, int high) {
  if (!j.is_number_integer() || j.get<long>() < low || j.get<long>() > high)
    throw FormatError(j.dump() + " is no whole number from " + std::to_string(low) + " to " + std::to_string(high));
  return j.get<int>();
}

Spot spot(const Json& j, size_t from = 0) { return {whole(j.at(from), -999, 999), whole(j.at(from + 1), -999, 999)}; }

Parts parts_of(const Json& j) {
  Parts w;
  if (j.at("format") != "sublimit-witness" || whole(j.at("version"), 1, 1) != 1 || j.at("kind") != "c1")
    throw FormatError("no witness of C^1, version 1");
  w.n = whole(j.at("n"), 3, 10000);
  w.degree = whole(j.at("degree"), 1, 12);
  w.ring = whole(j.at("ring"), 1, 8);
  w.triangular = j.at("grid") == "triangular";
  if (!w.triangular && j.at("grid") != "square") throw FormatError("grid is neither square nor triangular");
  w.dual = j.at("dual").get<bool>();
  for (const Json& m : j.at("mask")) w.mask[spot(m)] = Exact::parse(m.at(2).get<std::string>());
  const std::string partition = j.at("partition");
  std::vector<std::array<Spot, 3>> corners;
  if (partition == "squares" && !w.triangular) corners = {{{{0, 0}, {2, 0}, {0, 2}}}};
  if (partition == "triangles" && w.triangular) corners = {{{{0, 0}, {2, 0}, {0, 2}}}, {{{2, 2}, {0, 2}, {2, 0}}}};
  if (partition == "quarter-squares" && !w.triangular)
    corners = {
        {{{0, 0}, {2, 0}, {1, 1}}}, {{{2, 0}, {2, 2}, {1, 1}}}, {{{2, 2}, {0, 2}, {1, 1}}}, {{{0, 2}, {0, 0}, {1, 1}}}};
  if (corners.empty() || j.at("pieces").size() != corners.size()) throw FormatError("pieces do not fit the partition");
  w.squares = partition == "squares";
  const size_t d = static_cast<size_t>(w.degree) + 1, size = w.squares ? d * d : d * (d + 1) / 2;
  for (size_t k = 0; k < corners.size(); ++k) {
    const Json& from = j.at("pieces")[k];
    Piece piece{corners[k], {}, {}};
    for (const Json& p : from.at("controls")) piece.controls.push_back(spot(p));
    for (const Json& f : from.at("functions")) {
      std::vector<Exact> coefficients;
      for (const Json& c : f) coefficients.push_back(Exact::parse(c.get<std::string>()));
      if (coefficients.size() != size)
        throw FormatError("a function has not as many coefficients as its degree asks for");
      piece.functions.push_back(std::move(coefficients));
    }
    if (piece.functions.size() != piece.controls.size() || piece.controls.empty())
      throw FormatError("a piece needs control points, and one function each");
    w.pieces.push_back(std::move(piece));
  }
  for (const Json& r : j.at("rows")) {
    const Spot at = spot(r.at("at"));
    if (at != Spot{0, 0}) w.labels.push_back(at);
    for (const Json& a : r.at("weights"))
      w.rows[at][{whole(a.at(0), 0, w.n - 1), spot(a, 1)[0], spot(a, 1)[1]}] = Exact::parse(a.at(3).get<std::string>());
  }
  w.lambda = Ball::parse(j.at("lambda").get<std::string>());
  for (const Json& p : j.at("net")) w.net[spot(p)] = ComplexBall::parse(p.at(2).get<std::string>());
  for (const Json& l : j.at("leaves"))
    w.leaves.push_back({static_cast<size_t>(whole(l.at(0), 0, static_cast<int>(corners.size()) - 1)), spot(l, 1),
                        l.at(3).get<std::string>(), l.at(4).get<double>()});
  return w;
}

}  // namespace
}  // namespace witness

std::vector<std::string> check_witness(const std::string& json) {
  const PrecisionScope precision(256);
  std::vector<std::string> problems;
  try {
    witness::Parts w = witness::parts_of(nlohmann::json::parse(json));
    witness::check_pieces(w, problems);
    witness::check_spectrum(w, problems);
    if (problems.empty()) witness::check_map(w, problems);
  } catch (const nlohmann::json::exception& e) {
    problems.push_back(std::string("not a witness: ") + e.what());
  } catch (const Error& e) {
    problems.push_back(e.what());
  }
  return problems;
}

}  // namespace sublimit
