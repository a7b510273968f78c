// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/detail/conjugate_gradients.h"

#include <algorithm>
#include <vector>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/core/detail/sparse_product.h"

namespace sublimit {
namespace {

using Row = Eigen::RowVectorXd;

// Of eigenvalues of D^-1 S, whose largest ones are about 1.
constexpr double unseen = 1e-14;

Row sum_of(const std::vector<Row>& parts, Eigen::Index channels) {
  Row sum = Row::Zero(channels);
  for (const Row& part : parts) sum += part;
  return sum;
}

template <int Channels>
class Iteration {
 public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Channels, Channels == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
  using View = Eigen::Map<const Rows>;
  using Target = Eigen::Map<Rows>;
  using Few = Eigen::Matrix<double, 1, Channels>;

  Iteration(const Eigen::VectorXd& diagonal, Points& residual)
      : diagonal_(diagonal),
        inverse_(diagonal.unaryExpr([](double d) { return d > 0 ? 1 / d : 0; })),
        r_(residual),
        u_(Points::Zero(residual.rows(), residual.cols())),
        p_(Points::Zero(residual.rows(), residual.cols())),
        parts_(num_blocks(residual.rows())) {}

  const Points& direction() const { return p_; }
  Points& result() { return u_; }

  /// p = D^-1 r + beta p
  void turn(const Row& beta) {
    each_block([&](std::int64_t, auto begin, auto count) {
      const Few b = beta;
      auto p = target(p_).middleRows(begin, count);
      p = (p.array().rowwise() * b.array()).matrix() +
          (view(r_).middleRows(begin, count).array().colwise() * inverse_.segment(begin, count).array()).matrix();
    });
  }

  /// p^T other
  Row product_with(const Points& other) {
    each_block([&](std::int64_t block, auto begin, auto count) {
      parts_[block] =
          view(p_).middleRows(begin, count).cwiseProduct(view(other).middleRows(begin, count)).colwise().sum();
    });
    return sum_of(parts_, r_.cols());
  }

  /// p^T D p
  Row length() {
    each_block([&](std::int64_t block, auto begin, auto count) {
      parts_[block] =
          (view(p_).middleRows(begin, count).array().square().colwise() * diagonal_.segment(begin, count).array())
              .colwise()
              .sum();
    });
    return sum_of(parts_, r_.cols());
  }

  /// u += alpha p, r -= alpha q.
  /// @return  r^T D^-1 r
  Row advance(const Row& alpha, const Points& q) {
    each_block([&](std::int64_t, auto begin, auto count) {
      const Few a = alpha;
      target(u_).middleRows(begin, count).array() += view(p_).middleRows(begin, count).array().rowwise() * a.array();
      target(r_).middleRows(begin, count).array() -= view(q).middleRows(begin, count).array().rowwise() * a.array();
    });
    return square();
  }

  Row square() {
    each_block([&](std::int64_t block, auto begin, auto count) {
      parts_[block] =
          (view(r_).middleRows(begin, count).array().square().colwise() * inverse_.segment(begin, count).array())
              .colwise()
              .sum();
    });
    return sum_of(parts_, r_.cols());
  }

  double largest() {
    std::vector<double> most(parts_.size(), 0.0);
    each_block([&](std::int64_t block, auto begin, auto count) {
      for (Eigen::Index i = begin; i < begin + count; ++i)
        if (inverse_[i] > 0) most[block] = std::max(most[block], view(r_).row(i).cwiseAbs().maxCoeff());
    });
    return most.empty() ? 0 : *std::max_element(most.begin(), most.end());
  }

 private:
  static View view(const Points& points) { return {points.data(), points.rows(), points.cols()}; }
  static Target target(Points& points) { return {points.data(), points.rows(), points.cols()}; }
  template <class Body>
  void each_block(const Body& body) {
    parallel_for_blocks(r_.rows(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
      body(block, Eigen::Index(begin), Eigen::Index(end - begin));
    });
  }

  Eigen::VectorXd diagonal_, inverse_;
  Points& r_;
  Points u_, p_;
  std::vector<Row> parts_;
};

/// Sums of squares, by column.
Row squares(const Points& a) {
  std::vector<Row> parts(num_blocks(a.rows()));
  parallel_for_blocks(a.rows(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    const Eigen::Index channels = a.cols();
    Row sum = Row::Zero(channels);
    for (const double* x = a.data() + begin * channels; x < a.data() + end * channels; x += channels)
      for (Eigen::Index c = 0; c < channels; ++c) sum[c] += x[c] * x[c];
    parts[block] = sum;
  });
  return sum_of(parts, a.cols());
}

/// a = a * scale + b * factor, by column.
void combine(Points& a, const Row& scale, const Points& b, const Row& factor) {
  parallel_for_blocks(a.rows(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    const Eigen::Index channels = a.cols();
    for (Eigen::Index i = begin * channels; i < end * channels; i += channels)
      for (Eigen::Index c = 0; c < channels; ++c)
        a.data()[i + c] = a.data()[i + c] * scale[c] + b.data()[i + c] * factor[c];
  });
}

template <int Channels>
Points run(const std::function<Points(const Points&)>& S, const Eigen::VectorXd& diagonal, Points& residual,
           const std::function<bool(int, double)>& go_on) {
  Iteration<Channels> state(diagonal, residual);
  Row square = state.square(), beta = Row::Zero(residual.cols());
  for (int iteration = 1; square.maxCoeff() > 0; ++iteration) {
    state.turn(beta);
    const Points q = S(state.direction());
    const Row curvature = state.product_with(q), length = state.length();
    // A channel that is solved stays where it is, and so does one whose direction S does not see: rounding put it
    // there.
    Row alpha(square.size());
    for (Eigen::Index c = 0; c < alpha.size(); ++c)
      alpha[c] = curvature[c] > unseen * length[c] ? square[c] / curvature[c] : 0;
    if (alpha.maxCoeff() == 0) break;
    const Row next = state.advance(alpha, q);
    for (Eigen::Index c = 0; c < alpha.size(); ++c) beta[c] = square[c] > 0 ? next[c] / square[c] : 0;
    square = next;
    if (!go_on(iteration, state.largest())) break;
  }
  return state.result();
}

}  // namespace

Points conjugate_gradients(const std::function<Points(const Points&)>& S, const Eigen::VectorXd& diagonal,
                           Points& residual, const std::function<bool(int, double)>& go_on) {
  if (residual.size() == 0) return residual;
  if (residual.cols() == 3) return run<3>(S, diagonal, residual, go_on);
  return run<Eigen::Dynamic>(S, diagonal, residual, go_on);
}

Points least_squares_gradients(const SparseMatrix& C, const SparseMatrix& Ct, Points& gap,
                               const std::function<bool(int, double, double)>& go_on) {
  const Row ones = Row::Ones(gap.cols());
  Points u = Points::Zero(C.cols(), gap.cols());
  if (gap.size() == 0 || u.size() == 0) return u;
  Points s = apply(Ct, gap), p = s;
  Row square = squares(s), alpha(gap.cols()), beta(gap.cols());
  const double norm = C.cwiseAbs().sum() / double(std::max<Eigen::Index>(1, C.rows()));
  for (int iteration = 1;; ++iteration) {
    const Points q = apply(C, p);
    const Row seen = squares(q), length = squares(p);
    for (Eigen::Index c = 0; c < alpha.size(); ++c)
      alpha[c] = seen[c] > unseen * norm * norm * length[c] ? square[c] / seen[c] : 0;
    if (alpha.maxCoeff() == 0) break;
    combine(u, ones, p, alpha);
    combine(gap, ones, q, -alpha);
    s = apply(Ct, gap);
    const Row next = squares(s);
    for (Eigen::Index c = 0; c < alpha.size(); ++c) beta[c] = square[c] > 0 ? next[c] / square[c] : 0;
    combine(p, beta, s, ones);
    square = next;
    if (!go_on(iteration, gap.cwiseAbs().maxCoeff(), s.cwiseAbs().maxCoeff())) break;
  }
  return u;
}

}  // namespace sublimit
