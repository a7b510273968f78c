// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/c1/characteristic_map.h"

#include <algorithm>

#include "sublimit/certificates/c1/regular_pieces.h"

namespace sublimit {
namespace {

bool is_centre(const SectorLabel& label) { return label.x2 == 0 && label.y2 == 0; }

std::map<SectorLabel, Eigen::Index> places(const LocalPatch<Algebraic>& patch) {
  std::map<SectorLabel, Eigen::Index> at;
  for (size_t i = 0; i < patch.labels.size(); ++i) at[patch.labels[i]] = static_cast<Eigen::Index>(i);
  return at;
}

/// Row of the child point P, seen from sector 0, is the regular mask. Nothing where P is outside the patch.
std::optional<bool> is_regular_row(const LocalPatch<Algebraic>& patch, const std::map<SectorLabel, Eigen::Index>& at,
                                   const RegularMask<Algebraic>& mask, LatticePoint P) {
  const int n = patch.type.faces;
  const auto label = label_at(P, mask.triangular, n);
  if (!label) return false;
  const auto row = at.find(*label);
  if (row == at.end()) return std::nullopt;
  std::map<Eigen::Index, Algebraic> expected;
  for (const auto& [key, weight] : mask.weights) {
    const auto parent = mask.parent(P, mask.doubled(key));
    if (!parent) continue;
    const LatticePoint Q = *parent;
    const auto from = label_at(Q, mask.triangular, n);
    if (!from) return false;
    const auto column = at.find(*from);
    if (column == at.end()) return false;  // a closed set would hold it
    expected[column->second] += weight;
  }
  for (Eigen::Index j = 0; j < patch.A.cols(); ++j) {
    const auto e = expected.find(j);
    if (e == expected.end() ? !patch.A(row->second, j).is_zero() : !(patch.A(row->second, j) == e->second))
      return false;
  }
  return true;
}

}  // namespace

std::optional<ComplexBall> CharacteristicMap::at(LatticePoint p) {
  const auto label = label_at(p, mask.triangular, n);
  if (!label) return std::nullopt;
  if (is_centre(*label)) return ComplexBall(0);
  const LatticePoint own{label->x2, label->y2};
  auto known = net.find(own);
  if (known == net.end()) {
    ComplexBall sum(0);
    for (const auto& [key, weight] : mask.weights) {
      const auto parent = mask.parent(own, mask.doubled(key));
      if (!parent) continue;
      const LatticePoint Q = *parent;
      const auto from = label_at(Q, mask.triangular, n);
      // Only what lies further in is known without going round in circles.
      if (!from || ring2({from->x2, from->y2}, mask.triangular) >= ring2(own, mask.triangular)) return std::nullopt;
      const auto value = at(Q);
      if (!value) return std::nullopt;
      sum += ComplexBall(weight.enclosure()) * *value;
    }
    known = net.emplace(own, sum / lambda).first;
  }
  return label->sector == 0 ? known->second : known->second * ComplexBall::root_of_unity(label->sector, n);
}

std::vector<SectorLabel> block_labels(const LocalPatch<Algebraic>& patch, int k) {
  std::vector<SectorLabel> labels;
  for (const SectorLabel& label : patch.labels)
    if (label.sector == 0 && (k == 0 || !is_centre(label))) labels.push_back(label);
  std::sort(labels.begin(), labels.end());
  return labels;
}

Orbits block_orbits(const LocalPatch<Algebraic>& patch, int k) {
  const auto at = places(patch);
  Orbits orbits;
  for (const SectorLabel& label : block_labels(patch, k)) {
    orbits.emplace_back();
    for (int s = 0; s < (is_centre(label) ? 1 : patch.type.faces); ++s)
      orbits.back().push_back(static_cast<Index>(at.at({s, label.x2, label.y2})));
  }
  return orbits;
}

DenseMatrix<ComplexBall> fourier_block(const LocalPatch<Algebraic>& patch, int k) {
  const Orbits orbits = block_orbits(patch, k);
  DenseMatrix<ComplexBall> B(std::ssize(orbits), std::ssize(orbits));
  for (size_t i = 0; i < orbits.size(); ++i)
    for (size_t j = 0; j < orbits.size(); ++j)
      for (size_t s = 0; s < orbits[j].size(); ++s)
        if (const Algebraic& a = patch.A(orbits[i][0], orbits[j][s]); !a.is_zero())
          B(i, j) += a.enclosure() * ComplexBall::root_of_unity(k * static_cast<long>(s), patch.type.faces);
  return B;
}

CharacteristicMap characteristic_map(const LocalPatch<Algebraic>& patch, const RegularMask<Algebraic>& mask,
                                     const LeadingPair& pair) {
  CharacteristicMap map{.n = patch.type.faces, .lambda = pair.value, .net = {}, .mask = mask};
  const std::vector<SectorLabel> labels = block_labels(patch, 1);
  // A point on the middle of the sector becomes 1: then the sector is symmetric to the real axis.
  ComplexBall scale(1);
  size_t one = pair.unit;
  for (size_t i = 0; i < labels.size(); ++i)
    if (labels[i].x2 == labels[i].y2 && !pair.vector[i].contains_zero()) {
      scale = pair.vector[i];
      one = i;
      break;
    }
  for (size_t i = 0; i < labels.size(); ++i)
    map.net[{labels[i].x2, labels[i].y2}] = i == one ? ComplexBall(1) : pair.vector[i] / scale;
  return map;
}

std::vector<PlacedPiece> sector_pieces(const RegularPieces& pieces, int r) {
  std::vector<PlacedPiece> placed;
  const bool triangular = pieces.mask.triangular;
  const int last = 2 * pieces.mask.dilation * r;
  for (int x = 0; x < last; x += 2)
    for (int y = 0; y < last; y += 2)
      for (size_t k = 0; k < pieces.pieces.size(); ++k) {
        // Squares and their quarters lie between two rings as a whole.
        int low = std::max(x, y), high = low + 2;
        if (triangular) {
          low = last, high = 0;
          for (const LatticePoint& c : pieces.pieces[k].corners) {
            low = std::min(low, ring2(c + LatticePoint{x, y}, true));
            high = std::max(high, ring2(c + LatticePoint{x, y}, true));
          }
        }
        if (low >= 2 * r && high <= last) placed.push_back({k, {x, y}});
      }
  return placed;
}

std::optional<int> regular_ring(const LocalPatch<Algebraic>& patch, const RegularPieces& pieces) {
  const auto at = places(patch);
  const std::vector<ChildPiece> children = child_pieces(pieces.pieces, pieces.mask.dilation);
  std::map<LatticePoint, std::optional<bool>> known;
  const auto is_regular = [&](const PlacedPiece& placed) {
    for (const LatticePoint& p : pieces.pieces[placed.piece].controls)
      if (!label_at(p + placed.cell, pieces.mask.triangular, patch.type.faces)) return false;
    for (const ChildPiece& child : children) {
      if (child.parent != placed.piece) continue;
      for (const LatticePoint& p : pieces.pieces[child.piece].controls) {
        const LatticePoint P = p + child.cell + pieces.mask.dilation * placed.cell;
        const auto [row, is_new] = known.try_emplace(P);
        if (is_new) row->second = is_regular_row(patch, at, pieces.mask, P);
        if (row->second && !*row->second) return false;
      }
    }
    return true;
  };
  for (int r = 1; r <= 4; ++r) {
    const std::vector<PlacedPiece> placed = sector_pieces(pieces, r);
    if (std::all_of(placed.begin(), placed.end(), is_regular)) return r;
  }
  return std::nullopt;
}

}  // namespace sublimit
