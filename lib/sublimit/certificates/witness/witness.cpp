// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/witness/witness.h"

#include <nlohmann/json.hpp>

namespace sublimit {

std::string c1_witness(const std::string& scheme, const C1Certificate& certificate, const RegularPieces& pieces) {
  using Json = nlohmann::ordered_json;
  const MapProof& proof = *certificate.proof;
  const LocalPatch<Algebraic>& patch = certificate.patch;
  Json w{{"format", "sublimit-witness"}, {"version", 1}, {"kind", "c1"}, {"scheme", scheme}, {"n", patch.type.faces}};
  w["grid"] = pieces.mask.triangular ? "triangular" : "square";
  w["dual"] = pieces.mask.dual;
  w["mask"] = Json::array();
  for (const auto& [at, weight] : pieces.mask.plane_weights()) w["mask"].push_back({at.x2, at.y2, weight.exact_text()});
  w["partition"] = pieces.mask.triangular ? "triangles" : pieces.pieces.size() == 1 ? "squares" : "quarter-squares";
  w["degree"] = pieces.degree;
  w["pieces"] = Json::array();
  for (const RegularPiece& piece : pieces.pieces) {
    Json of{{"controls", Json::array()}, {"functions", Json::array()}};
    for (const LatticePoint& p : piece.controls) of["controls"].push_back({p.x2, p.y2});
    for (const Bernstein<Algebraic>& f : piece.functions) {
      Json coefficients = Json::array();
      for (const Algebraic& c : f.coefficients()) coefficients.push_back(c.exact_text());
      of["functions"].push_back(std::move(coefficients));
    }
    w["pieces"].push_back(std::move(of));
  }
  w["rows"] = Json::array();
  for (size_t i = 0; i < patch.labels.size(); ++i) {
    if (patch.labels[i].sector != 0) continue;
    Json row{{"at", {patch.labels[i].x2, patch.labels[i].y2}}, {"weights", Json::array()}};
    for (size_t j = 0; j < patch.labels.size(); ++j) {
      const Algebraic& a = patch.A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      const SectorLabel& from = patch.labels[j];
      if (!a.is_zero()) row["weights"].push_back({from.sector, from.x2, from.y2, a.exact_text()});
    }
    w["rows"].push_back(std::move(row));
  }
  w["lambda"] = certificate.map->lambda.re().exact_text();
  w["net"] = Json::array();
  for (const SectorLabel& label : block_labels(patch, 1))
    w["net"].push_back({label.x2, label.y2, certificate.map->net.at({label.x2, label.y2}).exact_text()});
  w["ring"] = proof.ring;
  w["leaves"] = Json::array();
  for (const SignedLeaf& leaf : proof.leaves) {
    const PlacedPiece& placed = proof.placed[leaf.piece];
    w["leaves"].push_back({placed.piece, placed.cell.x2, placed.cell.y2, leaf.path, leaf.least.lower()});
  }
  return w.dump();
}

}  // namespace sublimit
