// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/cloud_fit.h"
#include "sublimit/fit/detail/for_coordinates.h"
#include "sublimit/fit/detail/tangent_rows.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/patches/detail/weighted_source.h"

namespace sublimit {
namespace {

/// What keeps points where they are along the surface, when all goes well.
constexpr double least_tangential = 1e-6;

void check(const Cloud& cloud, const CloudFitOptions& o) {
  const auto count = size_t(cloud.points.rows());
  if (count == 0) throw InvalidParameter("a cloud without points; one is needed at least");
  if (!cloud.weights.empty() && cloud.weights.size() != count)
    throw InvalidParameter(std::to_string(cloud.weights.size()) + " weights for a cloud of " + std::to_string(count) +
                           " points; one each, or none at all");
  double sum = cloud.weights.empty() ? 1 : 0;
  for (size_t i = 0; i < cloud.weights.size(); ++i) {
    if (!(cloud.weights[i] >= 0 && std::isfinite(cloud.weights[i])))
      throw InvalidParameter("point " + std::to_string(i) + " has the weight " + format_number(cloud.weights[i]) +
                             "; it must be a number >= 0");
    sum += cloud.weights[i];
  }
  if (!(sum > 0)) throw InvalidParameter("no point of the cloud has a weight > 0");
  if (!(o.tangential > 0 && o.tangential <= 1))
    throw InvalidParameter("what is along the surface counts " + format_number(o.tangential) +
                           "; it must be > 0 and <= 1");
  if (o.iterations < 0 || !(o.tolerance >= 0))
    throw InvalidParameter("at most " + std::to_string(o.iterations) + " iterations to the tolerance " +
                           format_number(o.tolerance) + "; both must be >= 0");
  for (const double factor : o.schedule)
    if (!(factor >= 0 && std::isfinite(factor)))
      throw InvalidParameter("the schedule has the factor " + format_number(factor) + "; they must be numbers >= 0");
}

/// The rows of every coordinate of every vertex: columns by vertex, then coordinate.
class Iteration {
 public:
  Iteration(const LinearSource& surface, const Cloud& cloud, const CloudFitOptions& options)
      : surface_(surface), cloud_(cloud), options_(options) {
    const Eigen::Index count = cloud.points.rows();
    weights_ = Eigen::VectorXd::Ones(count);
    if (!cloud.weights.empty()) weights_ = Eigen::Map<const Eigen::VectorXd>(cloud.weights.data(), count);
    weights_ /= weights_.sum();
    if (!options.fairness.empty()) H_ = fairness_energy(surface, options.fairness);
  }

  CloudIteration measure(const ClosestPoints& foot_points, const Points& x, double factor) const {
    CloudIteration result;
    const double mean = weights_.dot(foot_points.distances.cwiseAbs2());
    result.rms = std::sqrt(mean);
    result.largest = foot_points.distances.maxCoeff();
    result.fairness = factor;
    result.energy = mean;
    if (H_.rows() > 0) result.energy += factor * (x.transpose() * (H_ * x)).trace();
    return result;
  }

  /// New control points, with the projections that there are.
  Points step(const ClosestPoints& foot_points, const Points& x, double factor, double tangential) const {
    const SparseMatrix A = place_rows(surface_, foot_points.places);
    FitProblem problem;
    const bool coupled = tangential < 1;
    if (coupled) {
      couple(A, foot_points, tangential, problem);
    } else {
      problem.A = A;
      problem.b = cloud_.points;
      problem.weights = weights_;
      if (H_.rows() > 0) problem.H = factor * H_;
    }
    const Index n = Index(x.rows());
    const Pins& pins = options_.pins;
    const Index pinned = Index(pins.vertices.size());
    if (coupled && H_.rows() > 0) problem.H = for_coordinates(factor * H_);
    problem.C.resize(coupled ? 3 * pinned : pinned, coupled ? 3 * n : n);
    problem.d.resize(problem.C.rows(), coupled ? 1 : 3);
    for (Index i = 0; i < pinned; ++i) {
      const Index v = pins.vertices[size_t(i)];
      for (Index k = 0; k < (coupled ? 3 : 1); ++k)
        problem.C.insert(coupled ? 3 * i + k : i, coupled ? 3 * v + k : v) = 1;
      if (coupled)
        problem.d.middleRows(3 * i, 3) = x.row(v).transpose();
      else
        problem.d.row(i) = x.row(v);
    }
    problem.C.makeCompressed();
    problem.x0 = coupled ? Points(Eigen::Map<const Points>(x.data(), 3 * n, 1)) : x;
    const FitSolution solution = solve(problem, options_.solver);
    Points result = Eigen::Map<const Points>(solution.x.data(), n, 3);
    for (const Index v : pins.vertices) result.row(v) = x.row(v);
    return result;
  }

 private:
  /// Along borders, and where there is no plane, distances are from points.
  void couple(const SparseMatrix& A, const ClosestPoints& foot_points, double tangential, FitProblem& problem) const {
    Points normals = foot_points.normals;
    for (Eigen::Index i = 0; i < normals.rows(); ++i)
      if (foot_points.status[size_t(i)] == LimitStatus::crease) normals.row(i).setZero();
    add_tangent_rows(problem, A, cloud_.points, normals, weights_, tangential);
  }

  const LinearSource& surface_;
  const Cloud& cloud_;
  const CloudFitOptions& options_;
  Eigen::VectorXd weights_;  // of the mean
  SparseMatrix H_;
};

/// Finds the nearest points of the surface with these control points.
using Nearest = std::function<ClosestPoints(const Points& control, const ClosestPointOptions& options)>;

CloudFit fit_cloud(const LinearSource& surface, const Nearest& nearest, const Cloud& cloud, const Points& guess,
                   const CloudFitOptions& options) {
  check(cloud, options);
  if (guess.cols() != 3)
    throw InvalidParameter("the first guess has " + std::to_string(guess.cols()) + " columns, not 3");
  CloudFit fit;
  // Pins are set, and everything else is checked, by a fit to nothing.
  fit.points = fit_places(surface, {{}, Points(0, 3)}, guess, {.pins = options.pins}).points;
  const Iteration iteration(surface, cloud, options);
  fit.foot_points = nearest(fit.points, {.prove = false});
  const double size = (cloud.points.colwise().maxCoeff() - cloud.points.colwise().minCoeff()).norm();
  const auto factor = [&](size_t k) {
    return options.schedule.empty() ? 1 : options.schedule[std::min(k, options.schedule.size() - 1)];
  };
  const auto tell = [&] {
    if (options.progress) options.progress(int(fit.iterations.size()) - 1, fit.iterations.back());
  };
  fit.iterations.push_back(iteration.measure(fit.foot_points, fit.points, factor(0)));
  tell();
  double tangential = options.tangential;
  for (int k = 0; k < options.iterations && !fit.converged; ++k) {
    const double f = factor(size_t(k));
    const double before = iteration.measure(fit.foot_points, fit.points, f).energy;
    const bool at_end = size_t(k) + 1 >= options.schedule.size();
    for (;;) {
      Points x = iteration.step(fit.foot_points, fit.points, f, tangential);
      ClosestPoints foot_points = nearest(x, {.guess = fit.foot_points.places, .prove = false});
      const CloudIteration now = iteration.measure(foot_points, x, f);
      if (now.energy <= before) {
        fit.points = std::move(x);
        fit.foot_points = std::move(foot_points);
        fit.iterations.push_back(now);
        if (options.tangential < 1) tangential = std::max(least_tangential, tangential / 4);
        tell();
        fit.converged = at_end && (before - now.energy <= options.tolerance * now.energy || now.rms <= 1e-14 * size);
        break;
      }
      if (tangential >= 1) {  // rounding is all that is left
        fit.converged = at_end;
        break;
      }
      tangential = std::min(1.0, 10 * tangential);
    }
  }
  return fit;
}

}  // namespace

CloudFit fit_cloud(const LimitMap& surface, const Cloud& cloud, const Points& guess, const CloudFitOptions& options) {
  return fit_cloud(
      surface,
      [&](const Points& control, const ClosestPointOptions& search) {
        return closest(surface, control, cloud.points, search);
      },
      cloud, guess, options);
}

CloudFit fit_cloud(const Patches& guess, const Cloud& cloud, const CloudFitOptions& options) {
  CloudFitOptions own = options;
  own.fairness.quadrature = std::max(own.fairness.quadrature, 8);  // of degrees above 3 too
  const auto near = [&](Points columns, const ClosestPointOptions& search) {
    return closest(guess.with(std::move(columns)), cloud.points, search);
  };
  if (!guess.rational()) return fit_cloud(guess.set(), near, cloud, guess.points(), own);
  const Eigen::VectorXd weights = guess.points().col(3);
  const WeightedSource surface(guess.set(), weights);
  CloudFit fit = fit_cloud(
      surface,
      [&](const Points& control, const ClosestPointOptions& search) {
        return near(homogeneous(control, weights), search);
      },
      cloud, guess.points().leftCols(3).array().colwise() / weights.array(), own);
  fit.points = homogeneous(fit.points, weights);
  return fit;
}

}  // namespace sublimit
