// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/detail/limit_masks.h"

#include <algorithm>
#include <deque>
#include <numbers>
#include <numeric>
#include <string>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/core/detail/submatrix.h"
#include "sublimit/limit/detail/eigen_structure.h"
#include "sublimit/limit/detail/sparse_spectrum.h"
#include "sublimit/limit/detail/tangents.h"
#include "sublimit/neighborhood/local_matrix.h"
#include "sublimit/neighborhood/local_patch.h"

namespace sublimit {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using Side = LimitMasks::Side;
using Plane = LimitMasks::Plane;

/// The rows of one sector, where all sectors are alike.
std::optional<SectorRows> symmetric_rows(const SparseMatrix& A, const CanonicalNeighborhood& type) {
  if (type.fans.size() != 1 || !type.fans[0].closed) return std::nullopt;
  for (const auto& spoke : type.spokes)
    if (is_sharp(spoke.sharpness)) return std::nullopt;
  return sector_rows(A, static_cast<int>(type.fans[0].corners.size()));
}

/// Where the slots of a side lie if its edges are spread evenly over `angle`: a plane picture to orient tangents by.
MatrixXd plane_picture(const CanonicalNeighborhood& type, const Side& side, double angle) {
  MatrixXd picture = MatrixXd::Zero(type.num_slots, 2);
  const double step = angle / side.num_corners;
  const auto& corners = type.fans[side.fan].corners;
  for (Index c = 0; c < side.num_corners; ++c) {
    const auto& corner = corners[(side.first_corner + c) % corners.size()];
    const Index last = static_cast<Index>(corner.slots.size()) - 1;
    for (Index i = 1; i <= last; ++i) {
      const double radius = i == 1 || i == last ? 1 : 1.4, at = step * (c + double(i - 1) / double(last - 1));
      if (i == last && c + 1 == side.num_corners && angle > 6) continue;  // a closed ring: that slot has its place
      picture.row(corner.slots[i]) << radius * std::cos(at), radius * std::sin(at);
    }
  }
  return picture;
}

/// One sharp edge in a closed ring (a dart): mirror images make even and odd modes, one tangent from each.
void add_tangents_by_reflection(Side& side, const SparseMatrix& A, const CanonicalNeighborhood& type) {
  const Index n = side.num_corners, size = static_cast<Index>(A.rows());
  const auto& corners = type.fans[side.fan].corners;
  const auto corner = [&](Index c) -> const auto& { return corners[((side.first_corner + c) % n + n) % n]; };
  Slots mirror(size, 0);
  for (Index c = 0; c < n; ++c) {
    const Slots& a = corner(c).slots;
    const Slots& b = corner(n - 1 - c).slots;
    for (size_t i = 1; i < a.size(); ++i) mirror[a[i]] = b[a.size() - i];
  }
  SparseMatrix even(size, size), odd(size, size);
  Index num_even = 0, num_odd = 0;
  for (Index i = 0; i < size; ++i) {
    if (mirror[i] < i) continue;
    even.startVec(num_even);
    if (mirror[i] == i) {
      even.insertBack(num_even++, i) = 1;
      continue;
    }
    const double h = std::numbers::sqrt2 / 2;
    even.insertBack(num_even, i) = h;
    even.insertBack(num_even++, mirror[i]) = h;
    odd.startVec(num_odd);
    odd.insertBack(num_odd, i) = h;
    odd.insertBack(num_odd++, mirror[i]) = -h;
  }
  even.finalize();
  odd.finalize();
  even = SparseMatrix(even.topRows(num_even));
  odd = SparseMatrix(odd.topRows(num_odd));
  // Of modes of one kind.
  const auto reduced = [&](const SparseMatrix& basis) {
    const SparseMatrix transposed = basis.transpose();
    return product(product(basis, A), transposed);
  };
  const EigenStructure evens = leading_clusters(reduced(even), 4);
  EigenStructure odds = leading_clusters(reduced(odd), 3);
  for (EigenCluster& cluster : odds.clusters) cluster.block = 1;
  const auto mask = [&](const SparseMatrix& basis, const EigenCluster& cluster) -> VectorXd {
    return basis.transpose() * made_real(cluster.left.col(0));
  };
  side.tangent1 = mask(even, evens.clusters[1]);
  side.tangent2 = mask(odd, odds.clusters[0]);
  side.lambda1 = std::abs(evens.clusters[1].value);
  side.lambda2 = std::abs(odds.clusters[0].value);
  const MatrixXd picture = plane_picture(type, side, 2 * std::numbers::pi);
  if ((side.tangent1.transpose() * picture)(0) < 0) side.tangent1 *= -1;
  if ((side.tangent2.transpose() * picture)(1) < 0) side.tangent2 *= -1;
  const double slower = std::min(side.lambda1, side.lambda2);
  const auto add_next = [&](const SparseMatrix& basis, const std::vector<EigenCluster>& clusters, size_t at) {
    if (at >= clusters.size()) return;  // three triangles around a dart have but one odd mode
    if (decays_like(std::abs(clusters[at].value), slower)) side.plane = Plane::no;
    side.second_order.push_back(mask(basis, clusters[at]));
  };
  add_next(even, evens.clusters, 2);
  add_next(odd, odds.clusters, 1);
  if (evens.clusters[1].multiplicity > 1 || odds.clusters[0].multiplicity > 1) side.plane = Plane::no;
}

/// One side between two sharp edges: its outline is the vertex and the ends of these edges.
void add_tangents_between_edges(Side& side, const SparseMatrix& A, const CanonicalNeighborhood& type, Rule rule) {
  const auto& corners = type.fans[side.fan].corners;
  const auto corner = [&](Index c) -> const auto& { return corners[(side.first_corner + c) % corners.size()]; };
  Outline outline;
  outline.first = corner(0).slots[1];
  outline.last = corner(side.num_corners - 1).slots.back();
  outline.curve = {0, outline.first, outline.last};
  for (Index c = 0; c < side.num_corners; ++c) {
    const Slots& slots = corner(c).slots;
    for (size_t i = 2; i < slots.size(); ++i)
      if (slots[i] != outline.last) outline.inner.push_back(slots[i]);
  }
  outline.inner_ring = outline.inner;
  add_border_tangents(side, A, outline, rule == Rule::corner);
}

/// Sides of a neighbourhood: runs of corners between infinitely sharp edges.
std::vector<Side> sides_of(const CanonicalNeighborhood& type, Rule rule) {
  std::vector<Side> sides;
  for (size_t f = 0; f < type.fans.size(); ++f) {
    const auto& fan = type.fans[f];
    const Index n = static_cast<Index>(fan.corners.size());
    const auto cut = [&](Index c) {  // before corner c
      return rule != Rule::smooth && rule != Rule::dart && is_infinite(type.spokes[fan.corners[c % n].spoke].sharpness);
    };
    Index start = 0;
    if (fan.closed) {
      while (start < n && !cut(start)) ++start;
      if (start == n) start = 0;  // not cut at all
    }
    Side side;
    side.fan = static_cast<Index>(f);
    side.first_corner = start;
    for (Index c = 0; c < n; ++c) {
      ++side.num_corners;
      if (c + 1 == n || cut(start + c + 1)) {
        sides.push_back(side);
        side.first_corner = (start + c + 1) % n;
        side.num_corners = 0;
      }
    }
  }
  return sides;
}

/// One fan of several that meet in a vertex, as a neighbourhood of its own, and its slots in the whole.
std::pair<CanonicalNeighborhood, Slots> single_fan(const CanonicalNeighborhood& type, Index fan) {
  CanonicalNeighborhood part;
  part.sharpness = type.sharpness;
  part.creasing = type.creasing;
  part.fans = {type.fans[fan]};
  Slots slots{0};
  std::vector<Index> slot_of(type.num_slots, -1), spoke_of(type.spokes.size(), -1);
  slot_of[0] = 0;
  for (auto& corner : part.fans[0].corners) {
    for (Index& slot : corner.slots) {
      if (slot_of[slot] < 0) {
        slot_of[slot] = part.num_slots++;
        slots.push_back(slot);
      }
      slot = slot_of[slot];
    }
    for (Index* spoke : {&corner.spoke, &corner.next_spoke}) {
      if (spoke_of[*spoke] < 0) {
        spoke_of[*spoke] = static_cast<Index>(part.spokes.size());
        part.spokes.push_back(type.spokes[*spoke]);
        part.spokes.back().slot = slot_of[type.spokes[*spoke].slot];
      }
      *spoke = spoke_of[*spoke];
    }
  }
  return {part, slots};
}

/// Tangents of a side that is a whole closed ring.
/// @param ring  where all sectors are alike
void add_tangents_of_ring(Side& side, const SparseMatrix& A, const CanonicalNeighborhood& type,
                          const std::optional<SectorRows>& ring) {
  if (type.fans.size() > 1) {
    const auto [part, slots] = single_fan(type, side.fan);
    const Index fan = side.fan;
    side.fan = 0;
    const SparseMatrix own = submatrix(A, slots, slots);
    add_tangents_of_ring(side, own, part, symmetric_rows(own, part));
    side.fan = fan;
    for (VectorXd* mask : {&side.tangent1, &side.tangent2}) *mask = embedded(*mask, slots, type.num_slots);
    for (VectorXd& mask : side.second_order) mask = embedded(mask, slots, type.num_slots);
    return;
  }
  if (ring) {
    add_ring_tangents(side, *ring);
    return;
  }
  const auto& corners = type.fans[0].corners;
  const auto sharp = std::find_if(corners.begin(), corners.end(),
                                  [&](const auto& c) { return is_sharp(type.spokes[c.spoke].sharpness); });
  if (sharp == corners.end()) throw AnalysisError("a smooth stationary ring is not rotationally symmetric");
  side.first_corner = static_cast<Index>(sharp - corners.begin());  // a dart starts, and ends, at its sharp edge
  add_tangents_by_reflection(side, A, type);
}

/// Masks at a stationary neighbourhood, over its own slots.
LimitMasks stationary_masks(const SparseMatrix& A, const CanonicalNeighborhood& type) {
  LimitMasks masks;
  masks.rule = type.rule();
  const std::optional<SectorRows> ring = symmetric_rows(A, type);
  masks.position = position_mask(A, {0}, ring);
  masks.sides = sides_of(type, masks.rule);
  for (Side& side : masks.sides) {
    const auto& fan = type.fans[side.fan];
    if (fan.closed && side.num_corners == static_cast<Index>(fan.corners.size())) {
      add_tangents_of_ring(side, A, type, ring);
    } else {
      add_tangents_between_edges(side, A, type, masks.rule);
    }
  }
  return masks;
}

/// A mask over the last neighbourhood of a path as one over the first. Sums are wider than what is kept, so that the
/// order of the points does not matter.
VectorXd pulled_back(const VectorXd& mask, const std::deque<SparseMatrix>& path) {
  using Wide = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  Wide weights = mask.cast<long double>();
  for (auto matrix = path.rbegin(); matrix != path.rend(); ++matrix) {
    Wide sums = Wide::Zero(matrix->cols());
    for (Eigen::Index row = 0; row < weights.size(); ++row)
      for (SparseMatrix::InnerIterator it(*matrix, row); it; ++it) sums[it.col()] += weights[row] * it.value();
    weights = std::move(sums);
  }
  return weights.cast<double>();
}

}  // namespace

LimitMasks limit_masks(const Scheme<double>& scheme, const CanonicalNeighborhood& type) {
  if (type.fans.empty()) {  // an isolated vertex
    LimitMasks masks;
    masks.rule = Rule::corner;
    masks.position = VectorXd::Ones(1);
    return masks;
  }
  // Sharpness below 10 is gone after 10 levels under uniform creasing, and under Chaikin's, which averages; one step
  // more turns faces into the split's own.
  constexpr int enough = 32;
  CanonicalNeighborhood current = type;
  std::deque<SparseMatrix> path;
  for (int k = 0; k < enough; ++k) {
    SparseStep<double> step = sparse_step(scheme, current, k);
    if (step.child.signature() == current.signature()) {
      LimitMasks masks = stationary_masks(step.matrix, current);
      masks.steps = k;
      const auto pull_back = [&](VectorXd& mask) { mask = pulled_back(mask, path); };
      pull_back(masks.position);
      for (Side& side : masks.sides) {
        pull_back(side.tangent1);
        pull_back(side.tangent2);
        for (VectorXd& mask : side.second_order) pull_back(mask);
      }
      return masks;
    }
    path.emplace_back().swap(step.matrix);
    current = step.child;
  }
  throw AnalysisError(scheme.name + ": a vertex with " + std::to_string(type.spokes.size()) +
                      " edges has no stationary neighbourhood after " + std::to_string(enough) + " levels");
}

std::optional<IsolatedLimit> isolated_limit(const Scheme<double>& scheme, const LocalType& type) {
  const bool is_face = type.kind == Centre::Kind::face;
  const bool open = type.open || type.kind == Centre::Kind::border;
  // Around closed centres one ring more is looked at besides: what is there may decay as slowly as the tangents, and is
  // not in the smallest closed set.
  const int rings = is_face ? 0 : 1;
  const auto patches = sparse_patches(
      scheme, type, {.rings = open ? std::vector<int>{rings} : std::vector<int>{rings, rings + 1}, .labels = false});
  if (!patches) return std::nullopt;
  const SparsePatch<double>* const patch = &patches->front();
  IsolatedLimit limit{type, patch->depth, patch->places.signature, patch->slots, {}};
  LimitMasks& masks = limit.masks;
  masks.rule = type.corner ? Rule::corner : open ? Rule::crease : Rule::smooth;
  Side side;
  side.num_corners = type.faces;
  Slots centre(patch->places.ring_end[0]);
  std::iota(centre.begin(), centre.end(), 0);
  Slots ring;  // around the centre, in the closed set
  for (Index s = patch->places.ring_end[0]; s < patch->places.ring_end[1]; ++s)
    if (const auto at = std::lower_bound(patch->slots.begin(), patch->slots.end(), s);
        at != patch->slots.end() && *at == s)
      ring.push_back(static_cast<Index>(at - patch->slots.begin()));
  if (!open) {
    const auto blocks = sector_rows(patch->A, patch->orbits);
    if (!blocks) throw AnalysisError(scheme.name + ": an isolated neighbourhood is not rotationally symmetric");
    masks.position = position_mask(patch->A, centre, blocks);
    add_ring_tangents(side, *blocks);
    const SparsePatch<double>& wider = patches->back();
    if (const auto wide = sector_rows(wider.A, wider.orbits)) side.plane = std::max(side.plane, ring_plane(*wide));
  } else {
    masks.position = position_mask(patch->A, centre, std::nullopt);
    Outline outline;
    outline.curve = patch->outline;
    for (Index i = 0; i < static_cast<Index>(patch->slots.size()); ++i)
      if (!std::binary_search(outline.curve.begin(), outline.curve.end(), i)) outline.inner.push_back(i);
    outline.centre = centre;
    // On a border edge: the other corners of its face, which the walk finds first.
    const size_t near = type.kind == Centre::Kind::border ? 2 : ring.size();
    for (const Index i : Slots(ring.begin(), ring.begin() + Index(std::min(near, ring.size()))))
      if (!std::binary_search(outline.curve.begin(), outline.curve.end(), i)) outline.inner_ring.push_back(i);
    const bool on_vertex = type.kind == Centre::Kind::vertex;
    outline.first = 1;
    outline.last = on_vertex ? ring.back() : 0;
    if (submatrix(patch->A, outline.curve, outline.inner).nonZeros() == 0) {
      add_border_tangents(side, patch->A, outline, type.corner);
    } else {
      add_free_tangents(side, patch->A, ring);
    }
  }
  masks.sides.push_back(std::move(side));
  return limit;
}

}  // namespace sublimit
