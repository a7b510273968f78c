// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/c1/valence_family.h"

#include <algorithm>

#include "sublimit/certificates/numbers/detail/flint_value.h"
#include "sublimit/certificates/spectra/fourier_blocks.h"

namespace sublimit {
namespace {

/// Rows that begin in sector 0, in the order of labels; nothing unless the matrix is the same for all sectors.
std::optional<ExactRows> rows_by_label(const LocalPatch<Algebraic>& patch) {
  return exact_rows(patch.A, block_orbits(patch, 0));
}

/// Coefficient of zeta^k of an element of the field of order p, or of the rationals.
Algebraic coefficient(const Algebraic& e, int k) {
  FlintRatio q;
  fmpq_poly_get_coeff_fmpq(q, e.polynomial(), k);
  return Algebraic(q);
}

/// e = sum of x_j w^j, j = -2 ... 2, at n = 11: w^10 = -(1 + ... + w^9) there, and w^5 is free.
TurnPolynomial turn_polynomial(const Algebraic& e) {
  const Algebraic back = -coefficient(e, 5);
  return {coefficient(e, 9) + back, back, coefficient(e, 0) + back, coefficient(e, 1) + back, coefficient(e, 2) + back};
}

Algebraic at(const TurnPolynomial& p, int k, int n) {
  Algebraic sum;
  for (int j = -2; j <= 2; ++j)
    if (const Algebraic& x = p[static_cast<size_t>(j + 2)]; !x.is_zero())
      sum += j == 0 ? x : x * Algebraic::root_of_unity(static_cast<long>(k) * j, n);
  return sum;
}

/// e = f0 + f1 c + f2 c^2, c = cos(2 pi/p), at a prime p >= 7.
std::array<Algebraic, 3> in_cosine(const Algebraic& e) {
  const Algebraic y1 = -coefficient(e, 3), y2 = coefficient(e, 2) + y1, y0 = coefficient(e, 0) + y1;
  return {y0 - Algebraic(2) * y2, Algebraic(2) * y1, Algebraic(4) * y2};
}

/// Through three values of a polynomial in t of degree 2, by divided differences.
std::array<Algebraic, 3> through(const std::array<Algebraic, 3>& t, const std::array<Algebraic, 3>& f) {
  const Algebraic d01 = (f[1] - f[0]) / (t[1] - t[0]), d12 = (f[2] - f[1]) / (t[2] - t[1]);
  const Algebraic d = (d12 - d01) / (t[2] - t[0]);
  return {f[0] - d01 * t[0] + d * t[0] * t[1], d01 - d * (t[0] + t[1]), d};
}

Algebraic at(const RingPolynomial& p, int n) {
  const Algebraic c = Number<Algebraic>::cos_2pi(1, n), t = Algebraic::ratio(1, n);
  Algebraic sum;
  for (size_t a = 3; a-- > 0;) sum = sum * c + (p[a][2] * t + p[a][1]) * t + p[a][0];
  return sum;
}

bool of_order(const DenseMatrix<Algebraic>& B, int p) {
  for (const Algebraic& e : B.reshaped())
    if (e.order() != 1 && e.order() != p) return false;
  return true;
}

std::optional<MatrixRows<RingPolynomial>> block_zero(const std::array<int, 3>& primes,
                                                     const std::array<DenseMatrix<Algebraic>, 3>& B) {
  for (size_t k = 0; k < 3; ++k)
    if (B[k].rows() != B[0].rows() || !of_order(B[k], primes[k])) return std::nullopt;
  const auto size = static_cast<size_t>(B[0].rows());
  MatrixRows<RingPolynomial> Z(size, std::vector<RingPolynomial>(size));
  const std::array<Algebraic, 3> t{Algebraic::ratio(1, primes[0]), Algebraic::ratio(1, primes[1]),
                                   Algebraic::ratio(1, primes[2])};
  for (size_t i = 0; i < Z.size(); ++i)
    for (size_t j = 0; j < Z.size(); ++j) {
      const std::array<std::array<Algebraic, 3>, 3> f{in_cosine(B[0](i, j)), in_cosine(B[1](i, j)),
                                                      in_cosine(B[2](i, j))};
      for (size_t a = 0; a < 3; ++a) Z[i][j][a] = through(t, {f[0][a], f[1][a], f[2][a]});
    }
  return Z;
}

bool is_member(const ValenceFamily& family, const LocalPatch<Algebraic>& patch) {
  const int n = patch.type.faces;
  if (block_labels(patch, 1) != family.labels) return false;
  const std::optional<ExactRows> rows = rows_by_label(patch);
  if (!rows) return false;
  for (int k = 0; 2 * k <= n; ++k) {
    const DenseMatrix<Algebraic> B = rows->block(k);
    const auto size = static_cast<size_t>(B.rows());
    if (k == 0 && size != family.zero.size()) return false;
    for (size_t i = 0; i < size; ++i)
      for (size_t j = 0; j < size; ++j)
        if (!(B(i, j) == (k == 0   ? at(family.zero[i][j], n)
                          : k == 1 ? at(family.first[i][j], 1, n)
                                   : at(family.other[i][j], k, n))))
          return false;
  }
  return true;
}

/// a + i s b with polynomials in h, s^2 = 1 - h^2.
struct Turned {
  Polynomial a, b;
};

Turned operator*(const Turned& x, const Turned& y) {
  const Polynomial square({1, 0, -1});  // of s
  return {x.a * y.a - square * (x.b * y.b), x.a * y.b + x.b * y.a};
}

/// Place of the mirror image of label i; i itself on the two axes.
std::optional<std::vector<size_t>> mirror_images(const std::vector<SectorLabel>& labels) {
  std::vector<size_t> mirror;
  for (const SectorLabel& p : labels) {
    const SectorLabel m = p.y2 == 0 ? p : SectorLabel{0, p.y2, p.x2};
    const auto found = std::find(labels.begin(), labels.end(), m);
    if (found == labels.end()) return std::nullopt;
    mirror.push_back(static_cast<size_t>(found - labels.begin()));
  }
  return mirror;
}

}  // namespace

std::optional<MatrixRows<Polynomial>> real_block(const std::vector<SectorLabel>& labels,
                                                 const MatrixRows<TurnPolynomial>& block) {
  const auto mirror = mirror_images(labels);
  if (!mirror) return std::nullopt;
  const Polynomial h = Polynomial::x(), one({1}), none;
  const Turned half{h, one}, back{h, none - one}, i{none, one};
  // w^-2 ... w^2
  std::array<Turned, 5> powers{Turned{}, Turned{}, Turned{one, none}, half * half, {}};
  powers[4] = powers[3] * powers[3];
  powers[1] = back * back;
  powers[0] = powers[1] * powers[1];
  const size_t size = labels.size();
  const auto on_spoke = [&](size_t p) { return labels[p].y2 == 0; };
  const auto in_middle = [&](size_t p) { return labels[p].x2 == labels[p].y2; };
  MatrixRows<Polynomial> R(size, std::vector<Polynomial>(size));
  for (size_t j = 0; j < size; ++j) {
    // Basis vector j: of two mirror images the one with x > y holds a, the other b.
    std::vector<Turned> v(size);
    const size_t m = (*mirror)[j];
    if (on_spoke(j)) {
      v[j] = {one, none};
    } else if (in_middle(j)) {
      v[j] = half;
    } else if (labels[j].x2 > labels[j].y2) {
      v[j] = {one, none};
      v[m] = powers[3];
    } else {
      v[m] = i;
      v[j] = powers[3] * Turned{none, none - one};
    }
    std::vector<Turned> image(size);
    for (size_t p = 0; p < size; ++p)
      for (size_t q = 0; q < size; ++q)
        for (size_t e = 0; e < 5; ++e)
          if (const Algebraic& x = block[p][q][e]; !x.is_zero()) {
            const Turned part = powers[e] * v[q];
            image[p].a += x * part.a;
            image[p].b += x * part.b;
          }
    for (size_t p = 0; p < size; ++p) {
      if (on_spoke(p) || in_middle(p)) {
        const Turned own = on_spoke(p) ? image[p] : back * image[p];
        if (!own.b.is_zero()) return std::nullopt;
        R[p][j] = own.a;
      } else if (labels[p].x2 > labels[p].y2) {
        const size_t q = (*mirror)[p];
        const Turned image_of = powers[3] * Turned{image[p].a, none - image[p].b};
        if (!(image_of.a == image[q].a) || !(image_of.b == image[q].b)) return std::nullopt;
        R[p][j] = image[p].a;
        R[q][j] = image[p].b;
      }
    }
  }
  return R;
}

std::optional<ValenceFamily> valence_family(const C1Prover& prover, const std::vector<int>& valences) {
  const std::array<int, 3> primes{7, 11, 13};
  ValenceFamily family;
  std::array<DenseMatrix<Algebraic>, 3> zero;
  for (size_t p = 0; p < 3; ++p) {
    const LocalPatch<Algebraic> patch = prover.patch(primes[p]);
    const std::optional<ExactRows> rows = rows_by_label(patch);
    if (!rows) return std::nullopt;
    zero[p] = rows->block(0);
    if (primes[p] != 11) continue;
    family.labels = block_labels(patch, 1);
    family.has_centre = block_labels(patch, 0).size() > family.labels.size();
    for (const int k : {1, 2}) {
      const DenseMatrix<Algebraic> B = rows->block(k);
      if (!of_order(B, 11)) return std::nullopt;
      MatrixRows<TurnPolynomial>& block = k == 1 ? family.first : family.other;
      for (Eigen::Index i = 0; i < B.rows(); ++i) {
        block.emplace_back();
        // w^2 -> w, as 2*6 = 1 modulo 11
        for (const Algebraic& e : B.row(i))
          block.back().push_back(turn_polynomial(k == 1 || e.is_rational() ? e : e.galois(6)));
      }
    }
  }
  auto Z = block_zero(primes, zero);
  if (!Z) return std::nullopt;
  family.zero = std::move(*Z);
  for (const int n : valences) {
    const LocalPatch<Algebraic> patch = prover.patch(n);
    if (!is_member(family, patch)) return std::nullopt;
    const auto ring = prover.pieces() ? regular_ring(patch, *prover.pieces()) : std::nullopt;
    if (family.checked.empty()) family.ring = ring;
    if (ring != family.ring) family.ring.reset();
    family.checked.push_back(n);
  }
  return family;
}

}  // namespace sublimit
