// SPDX-License-Identifier: Apache-2.0
#include "sublimit/analysis/limit_masks.h"

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <numbers>
#include <string>

#include "sublimit/analysis/eigen_structure.h"
#include "sublimit/analysis/local_matrix.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using Slots = std::vector<Index>;
using Side = LimitMasks::Side;
using Plane = LimitMasks::Plane;

/// Two moduli this close (relative) decay at the same rate.
constexpr double same_rate = 1e-9;

bool decays_like(double modulus, double lambda) { return modulus >= lambda * (1 - same_rate); }

/// Slots that the given ones depend on, themselves included: the smallest closed set.
Slots closure(const MatrixXd& A, const Slots& seed) {
  std::vector<bool> in(A.rows(), false);
  Slots open = seed, result;
  while (!open.empty()) {
    const Index i = open.back();
    open.pop_back();
    if (in[i]) continue;
    in[i] = true;
    result.push_back(i);
    for (Index j = 0; j < A.cols(); ++j)
      if (A(i, j) != 0) open.push_back(j);
  }
  std::sort(result.begin(), result.end());
  return result;
}

VectorXd embedded(const VectorXd& weights, const Slots& slots, Index size) {
  VectorXd mask = VectorXd::Zero(size);
  for (size_t i = 0; i < slots.size(); ++i) mask[slots[i]] += weights[Eigen::Index(i)];
  return mask;
}

/// A complex vector that is real up to a phase, turned real.
VectorXd made_real(const VectorXcd& v) {
  Eigen::Index largest = 0;
  v.cwiseAbs().maxCoeff(&largest);
  return (v * (std::conj(v[largest]) / std::abs(v[largest]))).real();
}

std::optional<FourierBlocks> symmetric_blocks(const MatrixXd& A, const CanonicalNeighborhood& type) {
  if (type.fans.size() != 1 || !type.fans[0].closed) return std::nullopt;
  for (const auto& spoke : type.spokes)
    if (is_sharp(spoke.sharpness)) return std::nullopt;
  return fourier_blocks(A, static_cast<int>(type.fans[0].corners.size()));
}

VectorXd position_mask(const MatrixXd& A, const std::optional<FourierBlocks>& fourier) {
  const Slots slots = closure(A, {0});
  if (!fourier || static_cast<Index>(slots.size()) < A.rows()) {
    return embedded(limit_weights(A(slots, slots)), slots, static_cast<Index>(A.rows()));
  }
  const VectorXd orbits = limit_weights(fourier->blocks[0].real());  // total weight of every orbit
  VectorXd mask(A.rows());
  mask[0] = orbits[0];
  for (int s = 0; s < fourier->n; ++s)
    for (int i = 0; i < fourier->p; ++i) mask[1 + s * fourier->p + i] = orbits[1 + i] / fourier->n;
  return mask;
}

/// Mask of a left eigenvector l of block k, as a complex amplitude: sum_s sum_i l_i w^(-k s) x_(s,i), and the centre's.
VectorXcd amplitude(const FourierBlocks& fourier, int k, const VectorXcd& l) {
  const int n = fourier.n, p = fourier.p, centre = k == 0;
  VectorXcd mask = VectorXcd::Zero(1 + n * p);
  if (centre) mask[0] = l[0];
  for (int s = 0; s < n; ++s) {
    const int turn = static_cast<int>(static_cast<long long>(k) * s % n);
    const std::complex<double> w(Number<double>::cos_2pi(turn, n), -Number<double>::cos_2pi(4 * turn - n, 4 * n));
    for (int i = 0; i < p; ++i) mask[1 + s * p + i] = l[centre + i] * w / static_cast<double>(n);
  }
  return mask;
}

/// The whole ring of an interior vertex whose neighbourhood looks the same from every sector: the tangents are the cosine
/// and the sine mask of block 1.
void add_tangents(Side& side, const FourierBlocks& fourier) {
  const EigenStructure structure = eigen_structure(fourier);
  const EigenCluster* first = nullptr;
  for (const EigenCluster& cluster : structure.clusters)
    if (cluster.block == 1 && !first) first = &cluster;
  const double lambda = std::abs(first->value);
  side.lambda1 = side.lambda2 = lambda;
  VectorXcd l = first->left.col(0);
  const VectorXcd r = first->right.col(0);
  const std::complex<double> overlap = l.transpose() * r;
  // Characteristic parameter: the end of the first edge is at distance 1.
  if (std::abs(overlap) > 1e-8) l *= (std::abs(r[0]) > 1e-8 ? r[0] : 1.0) / overlap;
  if (fourier.n == 2) {  // a digon: block 1 is real, and both tangents must come from it
    side.tangent1 = amplitude(fourier, 1, l).real();
    side.tangent2 = first->left.cols() > 1 ? VectorXd(amplitude(fourier, 1, first->left.col(1)).real())
                                           : VectorXd::Zero(side.tangent1.size());
    side.plane = Plane::no;
  } else {
    const VectorXcd mask = 2.0 * amplitude(fourier, 1, l);
    side.tangent1 = mask.real();
    side.tangent2 = -mask.imag();
    side.plane = first->is_jordan() ? Plane::slow : first->multiplicity > 1 ? Plane::no : Plane::yes;
  }
  double next = 0;
  for (const EigenCluster& cluster : structure.clusters) {
    const bool constant = cluster.block == 0 && std::abs(cluster.value - 1.0) < same_rate;
    if (&cluster == first || constant || (fourier.n > 2 && cluster.block == fourier.n - 1 && std::abs(cluster.value) >= lambda * (1 - same_rate)))
      continue;
    const double modulus = std::abs(cluster.value);
    if (decays_like(modulus, lambda)) side.plane = Plane::no;
    if (next == 0) next = modulus;
    if (modulus < next * (1 - same_rate) || 2 * cluster.block > fourier.n) continue;
    for (Eigen::Index c = 0; c < cluster.left.cols(); ++c) {
      const VectorXcd mask = amplitude(fourier, cluster.block, cluster.left.col(c));
      for (const VectorXd& part : {VectorXd(mask.real()), VectorXd(mask.imag())})
        if (part.norm() > 1e-9 * mask.norm()) side.second_order.push_back(part);
    }
  }
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
void add_tangents_by_reflection(Side& side, const MatrixXd& A, const CanonicalNeighborhood& type) {
  const Index n = side.num_corners, size = static_cast<Index>(A.rows());
  const auto& corners = type.fans[side.fan].corners;
  const auto corner = [&](Index c) -> const auto& { return corners[((side.first_corner + c) % n + n) % n]; };
  Slots mirror(size, 0);
  for (Index c = 0; c < n; ++c) {
    const Slots& a = corner(c).slots;
    const Slots& b = corner(n - 1 - c).slots;
    for (size_t i = 1; i < a.size(); ++i) mirror[a[i]] = b[a.size() - i];
  }
  MatrixXd even = MatrixXd::Zero(size, size), odd = MatrixXd::Zero(size, size);
  Index num_even = 0, num_odd = 0;
  for (Index i = 0; i < size; ++i) {
    if (mirror[i] < i) continue;
    if (mirror[i] == i) {
      even(i, num_even++) = 1;
      continue;
    }
    const double h = std::numbers::sqrt2 / 2;
    even(i, num_even) = even(mirror[i], num_even) = h;
    odd(i, num_odd) = h;
    odd(mirror[i], num_odd) = -h;
    ++num_even, ++num_odd;
  }
  even.conservativeResize(size, num_even);
  odd.conservativeResize(size, num_odd);
  const EigenStructure evens = eigen_structure(MatrixXcd(even.transpose() * A * even), 0, 4);
  const EigenStructure odds = eigen_structure(MatrixXcd(odd.transpose() * A * odd), 1, 3);
  const auto mask = [&](const MatrixXd& basis, const EigenCluster& cluster) -> VectorXd {
    return basis * made_real(cluster.left.col(0));
  };
  side.tangent1 = mask(even, evens.clusters[1]);
  side.tangent2 = mask(odd, odds.clusters[0]);
  side.lambda1 = std::abs(evens.clusters[1].value);
  side.lambda2 = std::abs(odds.clusters[0].value);
  const MatrixXd picture = plane_picture(type, side, 2 * std::numbers::pi);
  if ((side.tangent1.transpose() * picture)(0) < 0) side.tangent1 *= -1;
  if ((side.tangent2.transpose() * picture)(1) < 0) side.tangent2 *= -1;
  const double slower = std::min(side.lambda1, side.lambda2);
  for (const EigenCluster* cluster : {&evens.clusters[2], &odds.clusters[1]}) {
    if (decays_like(std::abs(cluster->value), slower)) side.plane = Plane::no;
    side.second_order.push_back(mask(cluster == &odds.clusters[1] ? odd : even, *cluster));
  }
  if (evens.clusters[1].multiplicity > 1 || odds.clusters[0].multiplicity > 1) side.plane = Plane::no;
}

/// One side between two sharp edges. Its outline (the vertex and the ends of these edges) is a curve scheme of its own and
/// gives the tangent along a crease, or the two tangents of a corner; the leading mode of the interior crosses a crease.
void add_tangents_between_edges(Side& side, const MatrixXd& whole, const CanonicalNeighborhood& type, Rule rule) {
  const Index size = type.num_slots;
  const auto& corners = type.fans[side.fan].corners;
  const auto corner = [&](Index c) -> const auto& { return corners[(side.first_corner + c) % corners.size()]; };
  const Index first = corner(0).slots[1], last = corner(side.num_corners - 1).slots.back();
  const Slots curve{0, first, last};
  Slots inner;
  for (Index c = 0; c < side.num_corners; ++c) {
    const Slots& slots = corner(c).slots;
    for (size_t i = 2; i < slots.size(); ++i)
      if (slots[i] != last) inner.push_back(slots[i]);
  }
  Slots all = curve;
  all.insert(all.end(), inner.begin(), inner.end());
  side.tangent1 = side.tangent2 = VectorXd::Zero(size);
  const double outside = (whole(all, Eigen::all).cwiseAbs().sum() - whole(all, all).cwiseAbs().sum());
  if (outside > 1e-12) {  // the crease that passes here is not this side's outline
    side.plane = Plane::no;
    return;
  }
  const MatrixXd C = whole(curve, curve), B = whole(inner, curve), D = whole(inner, inner);
  const MatrixXd picture = plane_picture(type, side, rule == Rule::crease ? std::numbers::pi : std::numbers::pi / 2);
  const EigenStructure interior = eigen_structure(D.cast<std::complex<double>>(), 0, 3);
  const auto modulus = [&](size_t i) {
    return i < interior.clusters.size() ? std::abs(interior.clusters[i].value) : 0.0;
  };

  if (rule == Rule::corner) {
    VectorXd* tangents[] = {&side.tangent1, &side.tangent2};
    for (int i = 0; i < 2; ++i) {
      const Slots leg = closure(whole, {0, curve[1 + i]});
      const EigenStructure modes = eigen_structure(whole(leg, leg).cast<std::complex<double>>());
      *tangents[i] = embedded(made_real(modes.clusters[1].left.col(0)), leg, size);
      if ((*tangents[i])[curve[1 + i]] < 0) *tangents[i] *= -1;
      *tangents[i] /= (*tangents[i])[curve[1 + i]];
      (i == 0 ? side.lambda1 : side.lambda2) = std::abs(modes.clusters[1].value);
    }
    const double lambda = std::min(side.lambda1, side.lambda2);
    if (modulus(0) > lambda * (1 + same_rate)) side.plane = Plane::no;
    if (std::abs(modulus(0) - lambda) <= lambda * same_rate) side.plane = Plane::slow;
    for (const EigenCluster& cluster : interior.clusters) {
      const VectorXd d = made_real(cluster.left.col(0));
      side.second_order.push_back(embedded(d, inner, size));
    }
    return;
  }

  // Along: the left eigenvector of the outline's second eigenvalue, towards the first edge.
  const EigenStructure outline = eigen_structure(C.cast<std::complex<double>>());
  side.tangent1 = embedded(made_real(outline.clusters[1].left.col(0)), curve, size);
  side.lambda1 = std::abs(outline.clusters[1].value);
  if (side.tangent1[first] < 0) side.tangent1 *= -1;
  side.tangent1 /= side.tangent1[first] * 2;  // half the difference of the ends: per unit of the first edge
  if (interior.clusters.empty()) {  // a single triangle: only the bend of the outline is left
    VectorXd bend = embedded(made_real(outline.clusters.back().left.col(0)), curve, size);
    side.tangent2 = bend[first] < 0 ? VectorXd(-bend) : bend;
    side.lambda2 = std::abs(outline.clusters.back().value);
    return;
  }
  // Across: (x, d) with d^T D = mu d^T and x^T (C - mu) = -d^T B.
  const auto across = [&](const EigenCluster& cluster, VectorXd& mask) {
    const double mu = cluster.value.real();
    const VectorXd d = made_real(cluster.left.col(0));
    const MatrixXd shifted = (C - mu * MatrixXd::Identity(3, 3)).transpose();
    const VectorXd right = -(B.transpose() * d);
    Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver;
    solver.setThreshold(1e-10);
    solver.compute(shifted);
    const VectorXd x = solver.solve(right);
    mask = embedded(x, curve, size) + embedded(d, inner, size);
    return (shifted * x - right).norm() <= 1e-9 * d.norm();
  };
  const EigenCluster& leading = interior.clusters[0];
  side.lambda2 = std::abs(leading.value);
  VectorXd mask;
  const bool solvable = across(leading, mask);
  VectorXd d = embedded(made_real(leading.left.col(0)), inner, size);
  const double inward = (d.transpose() * picture)(1) < 0 ? -1 : 1;
  if (solvable) {
    side.tangent2 = inward * mask;
  } else {
    // A Jordan block with the outline's mode q of the same eigenvalue: it feeds the interior, k mu^k (d^T B q), and wins. So
    // the surface leaves the crease in the direction of that mode.
    for (const EigenCluster& mode : outline.clusters) {
      if (std::abs(mode.value - leading.value) > cluster_tolerance) continue;
      const VectorXd l = made_real(mode.left.col(0)), q = made_real(mode.right.col(0));
      const double fed = inward * made_real(leading.left.col(0)).dot(B * q) / l.dot(q);
      side.tangent2 = (fed < 0 ? -1 : 1) * embedded(l, curve, size);
    }
    side.second_order.push_back(inward * mask);
  }
  if (leading.multiplicity > 1) side.plane = Plane::no;
  // The second sine mode against the tangent along the crease: slower, and interior normals keep an angle to the crease's.
  if (modulus(1) > side.lambda1 * (1 + same_rate)) side.plane = Plane::no;
  if (std::abs(modulus(1) - side.lambda1) <= side.lambda1 * same_rate) side.plane = Plane::slow;
  for (size_t i = 1; i < interior.clusters.size(); ++i)
    if (across(interior.clusters[i], mask)) side.second_order.push_back(mask);
  side.second_order.push_back(embedded(made_real(outline.clusters.back().left.col(0)), curve, size));
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
void add_tangents_of_ring(Side& side, const MatrixXd& A, const CanonicalNeighborhood& type) {
  if (type.fans.size() > 1) {
    const auto [part, slots] = single_fan(type, side.fan);
    const Index fan = side.fan;
    side.fan = 0;
    add_tangents_of_ring(side, A(slots, slots), part);
    side.fan = fan;
    for (VectorXd* mask : {&side.tangent1, &side.tangent2}) *mask = embedded(*mask, slots, type.num_slots);
    for (VectorXd& mask : side.second_order) mask = embedded(mask, slots, type.num_slots);
    return;
  }
  if (const auto fourier = symmetric_blocks(A, type)) {
    add_tangents(side, *fourier);
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
LimitMasks stationary_masks(const MatrixXd& A, const CanonicalNeighborhood& type) {
  LimitMasks masks;
  masks.rule = type.rule();
  masks.position = position_mask(A, symmetric_blocks(A, type));
  masks.sides = sides_of(type, masks.rule);
  for (Side& side : masks.sides) {
    const auto& fan = type.fans[side.fan];
    if (fan.closed && side.num_corners == static_cast<Index>(fan.corners.size())) {
      add_tangents_of_ring(side, A, type);
    } else {
      add_tangents_between_edges(side, A, type, masks.rule);
    }
  }
  return masks;
}

}  // namespace

LimitMasks limit_masks(const Scheme<double>& scheme, const CanonicalNeighborhood& type) {
  if (type.fans.empty()) {  // an isolated vertex
    LimitMasks masks;
    masks.rule = Rule::corner;
    masks.position = VectorXd::Ones(1);
    return masks;
  }
  // Sharpness below 10 is gone after 10 levels under uniform creasing, and under Chaikin's, which averages; one step more
  // turns faces into the split's own.
  constexpr int enough = 32;
  CanonicalNeighborhood current = type;
  MatrixXd path = MatrixXd::Identity(type.num_slots, type.num_slots);
  for (int k = 0; k < enough; ++k) {
    const LocalStep<double> step = local_step(scheme, current, k);
    if (step.child.signature() == current.signature()) {
      LimitMasks masks = stationary_masks(step.matrix, current);
      masks.steps = k;
      const auto pull_back = [&](VectorXd& mask) { mask = path.transpose() * mask; };
      pull_back(masks.position);
      for (Side& side : masks.sides) {
        pull_back(side.tangent1);
        pull_back(side.tangent2);
        for (VectorXd& mask : side.second_order) pull_back(mask);
      }
      return masks;
    }
    path = (step.matrix * path).eval();
    current = step.child;
  }
  throw AnalysisError(scheme.name + ": a vertex with " + std::to_string(type.spokes.size()) +
                      " edges has no stationary neighbourhood after " + std::to_string(enough) + " levels");
}

const LimitMasks& LimitMaskCache::masks(const CanonicalNeighborhood& type) {
  std::vector<std::uint32_t> key = type.signature();
  const auto found = types_.find(key);
  if (found != types_.end()) return *found->second;
  auto masks = std::make_shared<const LimitMasks>(limit_masks(scheme_, type));
  return *types_.emplace(std::move(key), std::move(masks)).first->second;
}

}  // namespace sublimit
