// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/detail/tangents.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "sublimit/core/detail/complex_decompositions.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/core/detail/submatrix.h"
#include "sublimit/limit/detail/sparse_spectrum.h"
#include "sublimit/neighborhood/closed_set.h"

namespace sublimit {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using Side = LimitMasks::Side;
using Plane = LimitMasks::Plane;

/// Two moduli this close (relative) decay at the same rate.
constexpr double same_rate = 1e-9;
/// Masks of second order that a closed ring has at most.
constexpr size_t most_second_order = 16;

/// Left eigenvector that takes the right one, scaled to be 1 at a slot, to 1: per unit of the edge to that slot.
VectorXd per_unit(const EigenCluster& cluster, const Slots& slots, Index slot) {
  const Eigen::Index at = std::find(slots.begin(), slots.end(), slot) - slots.begin();
  const VectorXd l = made_real(cluster.left.col(0)), r = made_real(cluster.right.col(0));
  const double taken = l.dot(r);
  if (std::abs(taken) < 1e-8 || std::abs(r[at]) < 1e-8) return l[at] < 0 ? VectorXd(-l) : l;
  return l * (r[at] / taken);
}

const EigenCluster& first_of_block_1(const EigenStructure& structure) {
  return *std::find_if(structure.clusters.begin(), structure.clusters.end(),
                       [](const EigenCluster& cluster) { return cluster.block == 1; });
}

bool is_constant(const EigenCluster& cluster) {
  return cluster.block == 0 && std::abs(cluster.value - 1.0) < same_rate;
}

Plane ring_plane(const EigenStructure& structure, int n) {
  if (n == 2) return Plane::no;  // block 1 is real: both tangents come from it
  const EigenCluster& first = first_of_block_1(structure);
  // Chains of a cluster: one may be as long as all others leave it, the longest is at least the mean.
  const auto longest = [](const EigenCluster& c) { return c.multiplicity - c.geometric() + 1; };
  const int chain = (first.multiplicity + first.geometric() - 1) / first.geometric();
  for (const EigenCluster& cluster : structure.clusters) {
    const bool conjugate = cluster.block == n - 1;
    if (&cluster == &first || is_constant(cluster) || conjugate ||
        !decays_like(std::abs(cluster.value), std::abs(first.value)))
      continue;
    const bool slower = std::abs(cluster.value) > std::abs(first.value) * (1 + same_rate);
    if (slower || longest(cluster) >= chain) return Plane::no;
  }
  return first.is_jordan() ? Plane::slow : first.multiplicity > 1 ? Plane::no : Plane::yes;
}

}  // namespace

bool decays_like(double modulus, double lambda) { return modulus >= lambda * (1 - same_rate); }

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

VectorXd position_mask(const SparseMatrix& A, const Slots& centre, const std::optional<SectorRows>& ring) {
  const Index size = static_cast<Index>(A.rows());
  const Slots slots = closed_set(A, centre);
  if (!ring || slots.size() == 1) return embedded(limit_weights(submatrix(A, slots, slots)), slots, size);
  // Orbits that the centre depends on: all their slots are in its closed set.
  const std::vector<bool> is_used = [&] {
    std::vector<bool> used(static_cast<size_t>(size), false);
    for (const Index slot : slots) used[static_cast<size_t>(slot)] = true;
    return used;
  }();
  std::vector<int> used;
  for (size_t i = 0; i < ring->orbits.size(); ++i)
    if (is_used[static_cast<size_t>(ring->orbits[i][0])]) used.push_back(static_cast<int>(i));
  VectorXcd l = VectorXcd::Zero(static_cast<Eigen::Index>(ring->orbits.size()));
  l(used) = limit_weights(MatrixXd(ring->block(0)(used, used).real())).cast<std::complex<double>>();
  return ring->mask(0, l).real();
}

namespace {

/// Leading modes of a ring: what is as slow as the tangents, and the slowest behind them if asked for.
EigenStructure leading_modes(const SectorRows& ring, bool with_next) {
  // Before their clusters are made eigenvalues are known to the root of rounding, or worse.
  constexpr double surely_apart = 1e-3;
  std::vector<std::vector<std::complex<double>>> values;
  for (int k = 0; 2 * k <= ring.n; ++k) values.push_back(ring.values(k));
  std::complex<double> first = 0;
  for (const auto& value : values[1])
    if (std::abs(value) > std::abs(first)) first = value;
  double least = std::abs(first), next = 0;
  for (size_t k = 0; with_next && k < values.size(); ++k)
    for (const auto& value : values[k]) {
      const bool is_one = k == 0 && std::abs(value - 1.0) < surely_apart;
      const bool is_first = k == 1 && std::abs(value - first) < 3 * cluster_tolerance * std::abs(first);
      if (!is_one && !is_first) next = std::max(next, std::abs(value));
    }
  if (next > 0) least = std::min(least, next);
  return leading_structure(ring, values, least * (1 - surely_apart));
}

}  // namespace

/// The whole ring of an interior vertex whose neighbourhood looks the same from every sector: the tangents are the
/// cosine and the sine mask of block 1.
void add_ring_tangents(Side& side, const SectorRows& fourier) {
  const EigenStructure structure = leading_modes(fourier, true);
  const EigenCluster* first = &first_of_block_1(structure);
  const double lambda = std::abs(first->value);
  side.lambda1 = side.lambda2 = lambda;
  VectorXcd l = first->left.col(0);
  const VectorXcd r = first->right.col(0);
  const std::complex<double> overlap = l.transpose() * r;
  // Characteristic parameter: the end of the first edge is at distance 1.
  if (std::abs(overlap) > 1e-8) l *= (std::abs(r[0]) > 1e-8 ? r[0] : 1.0) / overlap;
  if (fourier.n == 2) {  // a digon: block 1 is real, and both tangents must come from it
    side.tangent1 = fourier.mask(1, l).real();
    side.tangent2 = first->left.cols() > 1 ? VectorXd(fourier.mask(1, first->left.col(1)).real())
                                           : VectorXd::Zero(side.tangent1.size());
  } else {
    const VectorXcd mask = 2.0 * fourier.mask(1, l);
    side.tangent1 = mask.real();
    side.tangent2 = -mask.imag();
  }
  side.plane = ring_plane(structure, fourier.n);
  double next = 0;
  std::vector<std::pair<const EigenCluster*, Eigen::Index>> modes;
  for (const EigenCluster& cluster : structure.clusters) {
    const double modulus = std::abs(cluster.value);
    const bool conjugate = fourier.n > 2 && cluster.block == fourier.n - 1 && decays_like(modulus, lambda);
    if (&cluster == first || is_constant(cluster) || conjugate) continue;
    if (next == 0) next = modulus;
    if (modulus < next * (1 - same_rate) || 2 * cluster.block > fourier.n) continue;
    for (Eigen::Index c = 0; c < cluster.left.cols(); ++c) modes.emplace_back(&cluster, c);
  }
  const auto visit_masks = [&](const auto& visit) {
    for (const auto& [cluster, c] : modes) {
      const VectorXcd mask = fourier.mask(cluster->block, cluster->left.col(c));
      for (const VectorXd& part : {VectorXd(mask.real()), VectorXd(mask.imag())})
        if (part.norm() > 1e-9 * mask.norm()) visit(part);
    }
  };
  if (modes.size() <= most_second_order / 2) {
    visit_masks([&](const VectorXd& mask) { side.second_order.push_back(mask); });
    return;
  }
  // As many as the ring has faces, under Doo and Sabin's weights for one. What counts is the line or plane that they
  // span: so many sums of them with signs at random, the same at every run, span it too.
  std::mt19937 signs(1);
  side.second_order.assign(most_second_order, VectorXd::Zero(side.tangent1.size()));
  visit_masks([&](const VectorXd& mask) {
    for (VectorXd& sum : side.second_order) sum += (signs() & 1 ? 1 : -1) * mask;
  });
  for (VectorXd& sum : side.second_order) sum /= std::sqrt(static_cast<double>(modes.size()));
}

Plane ring_plane(const SectorRows& ring) { return ring_plane(leading_modes(ring, false), ring.n); }

namespace {

/// Several modes across that decay alike, at the middle of a border edge: where the points beside the outline go from
/// their neighbours on it, at this rate, each for itself, and in the mean. Nothing is added where that is not to be
/// seen.
/// @param rate   eigenvalue of the modes
/// @param along  by slot, how far along the outline points are
bool add_ways_inwards(Side& side, const SparseMatrix& whole, const Outline& outline, std::complex<double> rate,
                      const VectorXd& along) {
  if (outline.centre.size() != 2 || outline.inner_ring.empty()) return false;
  const EigenStructure structure = eigen_structure(MatrixXd(whole).cast<std::complex<double>>());
  const auto modes = std::find_if(structure.clusters.begin(), structure.clusters.end(),
                                  [&](const EigenCluster& c) { return std::abs(c.value - rate) <= cluster_tolerance; });
  if (modes == structure.clusters.end() || modes->is_jordan()) return false;
  const MatrixXcd pairing = modes->left.transpose() * modes->right;
  const MatrixXd projector = (modes->right * pivoted_solution(pairing, modes->left.transpose())).real();
  VectorXd mean = VectorXd::Zero(whole.rows());
  std::vector<VectorXd> ways;
  for (const Index i : outline.inner) {
    const auto beside = std::find_if(outline.curve.begin(), outline.curve.end(), [&](Index c) {
      return std::abs(along[i] - along[c]) <= cluster_tolerance * along.cwiseAbs().maxCoeff();
    });
    const bool is_next = std::find(outline.inner_ring.begin(), outline.inner_ring.end(), i) != outline.inner_ring.end();
    if (beside == outline.curve.end()) {
      if (is_next) return false;
      continue;
    }
    ways.push_back((projector.row(i) - projector.row(*beside)).transpose());
    if (is_next) mean += ways.back();
  }
  side.tangent2 = mean;
  side.second_order = std::move(ways);
  return true;
}

}  // namespace

/// One side between two sharp edges. Its outline (the vertex and the ends of these edges) is a curve scheme of its own
/// and gives the tangent along a crease, or the two tangents of a corner; the leading mode of the interior crosses a
/// crease.
void add_border_tangents(Side& side, const SparseMatrix& whole, const Outline& outline, bool is_corner) {
  const Index size = static_cast<Index>(whole.rows()), first = outline.first, last = outline.last;
  const Slots &curve = outline.curve, &inner = outline.inner;
  side.tangent1 = side.tangent2 = VectorXd::Zero(size);
  Slots all = curve;
  all.insert(all.end(), inner.begin(), inner.end());
  std::vector<bool> is_inside(static_cast<size_t>(size), false);
  for (const Index i : all) is_inside[static_cast<size_t>(i)] = true;
  double beyond = 0;
  for (const Index i : all)
    for (SparseMatrix::InnerIterator it(whole, i); it; ++it)
      if (!is_inside[static_cast<size_t>(it.col())]) beyond += std::abs(it.value());
  if (beyond > 1e-12) {
    side.plane = Plane::no;  // the crease that passes here is not this side's outline
    return;
  }
  const MatrixXd C = submatrix(whole, curve, curve);
  const SparseMatrix B = submatrix(whole, inner, curve), D = submatrix(whole, inner, inner);
  const EigenStructure interior = leading_clusters(D, 3);
  const auto modulus = [&](size_t i) {
    return i < interior.clusters.size() ? std::abs(interior.clusters[i].value) : 0.0;
  };

  // Across: (x, d) with d^T D = mu d^T and x^T (C - mu) = -d^T B.
  const auto across = [&](const EigenCluster& cluster, VectorXd& mask) {
    const double mu = cluster.value.real();
    const VectorXd d = made_real(cluster.left.col(0));
    const MatrixXd shifted = (C - mu * MatrixXd::Identity(C.rows(), C.cols())).transpose();
    const VectorXd right = -(B.transpose() * d);
    const VectorXd x = least_norm_solution(shifted, right, 1e-10);
    mask = embedded(x, curve, size) + embedded(d, inner, size);
    return (shifted * x - right).norm() <= 1e-9 * d.norm();
  };

  const EigenStructure modes = eigen_structure(C.cast<std::complex<double>>());
  // An outline of two slowest modes has no tangent: it has a corner here, whatever the rule.
  if (is_corner || modes.clusters[1].geometric() > 1) {
    VectorXd* tangents[] = {&side.tangent1, &side.tangent2};
    for (int i = 0; i < 2; ++i) {
      const Index end = i == 0 ? first : last;
      const Slots border = closed_set(whole, {0, end});
      const EigenStructure along = leading_clusters(submatrix(whole, border, border), 2);
      *tangents[i] = embedded(per_unit(along.clusters[1], border, end), border, size);
      (i == 0 ? side.lambda1 : side.lambda2) = std::abs(along.clusters[1].value);
    }
    const double lambda = std::min(side.lambda1, side.lambda2);
    VectorXd mask;
    for (const EigenCluster& cluster : interior.clusters) {
      const double mu = std::abs(cluster.value);
      const bool is_own = across(cluster, mask);
      if (is_own) side.second_order.push_back(mask);
      if (mu < lambda * (1 - same_rate)) continue;
      // As slow as the tangents: a direction of its own, unless it is fed by these, k lambda^k.
      if (mu > lambda * (1 + same_rate) || is_own)
        side.plane = Plane::no;
      else
        side.plane = std::max(side.plane, Plane::slow);
    }
    // There is no crease either to take a normal along.
    if (!is_corner && side.plane == Plane::no) side.tangent1 = side.tangent2 = VectorXd::Zero(size);
    return;
  }

  // Along: the left eigenvector of the outline's second eigenvalue, towards the first edge.
  side.tangent1 = embedded(per_unit(modes.clusters[1], curve, first), curve, size);
  side.lambda1 = std::abs(modes.clusters[1].value);
  const EigenCluster& bending = modes.clusters[std::min<size_t>(2, modes.clusters.size() - 1)];
  if (interior.clusters.empty()) {  // a single triangle: only the bend of the outline is left
    VectorXd bend = embedded(made_real(bending.left.col(0)), curve, size);
    side.tangent2 = bend[first] < 0 ? VectorXd(-bend) : bend;
    side.lambda2 = std::abs(bending.value);
    return;
  }
  const EigenCluster& leading = interior.clusters[0];
  side.lambda2 = std::abs(leading.value);
  VectorXd mask;
  const bool solvable = across(leading, mask);
  // The leading mode is one-signed, its heights over the outline; the mask that takes it to a positive number points
  // inwards.
  const VectorXd d = made_real(leading.left.col(0)), heights = made_real(leading.right.col(0));
  const double taken = d.dot(heights) * (heights.sum() < 0 ? -1 : 1);
  const double inward = (std::abs(taken) > 1e-8 ? taken : d.sum()) < 0 ? -1 : 1;
  const auto shared = std::find_if(modes.clusters.begin(), modes.clusters.end(), [&](const EigenCluster& mode) {
    return std::abs(mode.value - leading.value) <= cluster_tolerance;
  });
  const auto extended = [&](const EigenCluster& mode, Eigen::Index k) {  // a mode of the outline over the inner points
    const VectorXd right = made_real(mode.right.col(k));
    return VectorXd(embedded(right, curve, size) +
                    embedded(shifted_solution(D, mode.value.real(), -(B * right)), inner, size));
  };
  // How far points next to the centre stand off the outline. Those of a border edge lie beside its ends; around a
  // vertex they lie elsewhere along the outline, and what a parabola along it does is taken off.
  const auto height_of = [&](const VectorXd& values, const VectorXd& along) {
    if (outline.centre.size() > 1) return values(outline.inner_ring).mean() - values(outline.centre).mean();
    const VectorXd squares = along.cwiseAbs2();
    MatrixXd parabola(curve.size(), 2);
    parabola << VectorXd::Ones(std::ssize(curve)), squares(curve);
    const Eigen::Vector2d fit = PivotedQr(parabola).solve(values(curve));
    return (values - fit[1] * squares)(outline.inner_ring).mean() - fit[0];
  };
  if (solvable && shared != modes.clusters.end() && !outline.inner_ring.empty()) {
    // The outline bends at the same rate, by its mode b, so that the mask is known up to multiples of b's: the one that
    // does not see a bend that all points next to the centre follow alike gives the direction across.
    const VectorXd along = extended(modes.clusters[1], 0), rise = embedded(heights, inner, size);
    const Eigen::Index count = shared->geometric();
    MatrixXd bends(size, count), takes(size, count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const VectorXd bend = extended(*shared, k);
      bends.col(k) = bend - rise * (height_of(bend, along) / height_of(rise, along));
      takes.col(k) = embedded(made_real(shared->left.col(k)), curve, size);
    }
    const MatrixXd seen = bends.transpose() * takes;
    const PivotedLu lu(seen);
    if (lu.is_invertible()) mask -= takes * lu.solve(bends.transpose() * mask);
  }
  if (solvable) {
    side.tangent2 = inward * mask;
  } else if (shared != modes.clusters.end()) {
    // A Jordan block with the outline's mode of the same eigenvalue: it feeds the interior, k mu^k, and wins. So the
    // surface leaves the crease in the direction of that mode; to which side, some steps tell.
    const VectorXd l = embedded(made_real(shared->left.col(0)), curve, size);
    VectorXd fed = l;
    for (size_t i = 0; i < 2 && i < modes.clusters.size(); ++i) {  // without the constant and the mode along
      const VectorXd left = made_real(modes.clusters[i].left.col(0)), right = made_real(modes.clusters[i].right.col(0));
      fed -= left.dot(fed(curve)) / left.dot(right) * extended(modes.clusters[i], 0);
    }
    for (int k = 0; k < 10; ++k) fed = VectorXd(whole * fed) / std::abs(leading.value);
    const double height =
        fed(outline.inner_ring.empty() ? inner : outline.inner_ring).mean() - fed(outline.centre).mean();
    side.tangent2 = (height < 0 ? -1 : 1) * l;
    side.second_order.push_back(inward * mask);
  }
  // The outline's bend decays slower than what leaves it: the surface is thinner than it is bent.
  if (modes.clusters[1].multiplicity == 1 && std::abs(bending.value) > side.lambda2 * (1 + same_rate))
    side.plane = Plane::no;
  // The second sine mode against the tangent along the crease: slower, and interior normals keep an angle to the
  // crease's.
  if (modulus(1) > side.lambda1 * (1 + same_rate)) side.plane = Plane::no;
  if (std::abs(modulus(1) - side.lambda1) <= side.lambda1 * same_rate) side.plane = Plane::slow;
  if (leading.multiplicity > 1) {
    side.plane =
        side.plane != Plane::no && add_ways_inwards(side, whole, outline, leading.value, extended(modes.clusters[1], 0))
            ? Plane::tied
            : Plane::no;
    if (side.plane == Plane::tied) return;
  }
  double lowest = 0, highest = 0;
  for (const Index i : outline.inner_ring) {
    const double height = heights[std::find(inner.begin(), inner.end(), i) - inner.begin()];
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  if (-lowest * highest > 1e-9) side.plane = Plane::no;  // a mode on both sides of the outline folds the surface
  for (size_t i = 1; i < interior.clusters.size(); ++i)
    if (across(interior.clusters[i], mask)) side.second_order.push_back(mask);
  side.second_order.push_back(embedded(made_real(bending.left.col(0)), curve, size));
}

void add_free_tangents(Side& side, const SparseMatrix& A, const Slots& ring) {
  const Index size = static_cast<Index>(A.rows());
  const EigenStructure structure = leading_clusters(A, 6);
  std::vector<VectorXd> left, right;
  std::vector<double> moduli;
  for (const EigenCluster& cluster : structure.clusters) {
    if (std::abs(cluster.value - 1.0) < same_rate) continue;
    for (Eigen::Index k = 0; k < cluster.left.cols(); ++k) {
      left.push_back(made_real(cluster.left.col(k)));
      right.push_back(made_real(cluster.right.col(k)));
      moduli.push_back(std::abs(cluster.value));
    }
  }
  side.tangent1 = side.tangent2 = VectorXd::Zero(size);
  if (left.size() < 2) {
    side.plane = Plane::no;
    return;
  }
  MatrixXd L(size, 2), R(size, 2);
  L << left[0], left[1];
  R << right[0], right[1];
  const Eigen::Matrix2d taken = L.transpose() * R;
  if (std::abs(taken.determinant()) < 1e-9)
    side.plane = Plane::slow;
  else
    L = L * taken.inverse().transpose();
  double area = 0;  // of the characteristic map around the centre
  for (size_t i = 0; i + 1 < ring.size(); ++i) {
    const Eigen::RowVector2d a = R.row(ring[i]) - R.row(0), b = R.row(ring[i + 1]) - R.row(0);
    area += a[0] * b[1] - a[1] * b[0];
  }
  side.tangent1 = L.col(0);
  side.tangent2 = area < 0 ? VectorXd(-L.col(1)) : VectorXd(L.col(1));
  side.lambda1 = moduli[0];
  side.lambda2 = moduli[1];
  for (size_t i = 2; i < left.size(); ++i) side.second_order.push_back(left[i]);
  if (moduli.size() > 2 && decays_like(moduli[2], moduli[1])) side.plane = Plane::no;
}

}  // namespace sublimit
