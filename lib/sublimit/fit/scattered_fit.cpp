// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/scattered_fit.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

std::string shape(const Points& m) { return std::to_string(m.rows()) + " x " + std::to_string(m.cols()); }

void check(const PlaceTargets& targets, const Points& guess, Index num_points) {
  const size_t count = targets.places.size();
  if (guess.rows() != num_points || guess.cols() < 1)
    throw InvalidParameter("the first guess is " + shape(guess) + "; it needs a row for each of " +
                           std::to_string(num_points) + " control points and a column for each channel");
  if (!guess.allFinite()) {
    Index row = 0;
    while (guess.row(row).allFinite()) ++row;
    throw InvalidParameter("the first guess of control point " + std::to_string(row) + " is not finite");
  }
  if (targets.values.rows() != Eigen::Index(count) || (count > 0 && targets.values.cols() != guess.cols()))
    throw InvalidParameter("the targets' values are " + shape(targets.values) + "; " + std::to_string(count) + " x " +
                           std::to_string(guess.cols()) + " would fit places and first guess");
  if (!targets.weights.empty() && targets.weights.size() != count)
    throw InvalidParameter(std::to_string(targets.weights.size()) + " weights for " + std::to_string(count) +
                           " targets; one each, or none at all");
  for (size_t i = 0; i < count; ++i) {
    if (!targets.values.row(Eigen::Index(i)).allFinite())
      throw InvalidParameter("target " + std::to_string(i) + ": its values are not all finite numbers");
    if (!targets.weights.empty() && !(targets.weights[i] >= 0 && std::isfinite(targets.weights[i])))
      throw InvalidParameter("target " + std::to_string(i) + ": its weight is " + format_number(targets.weights[i]) +
                             "; it must be a number >= 0");
  }
}

void check(const Pins& pins, const Points& guess) {
  std::vector<bool> pinned(size_t(guess.rows()), false);
  for (const Index v : pins.vertices) {
    if (v < 0 || v >= guess.rows())
      throw InvalidParameter("a pin on control point " + std::to_string(v) + ", which does not exist; there are " +
                             std::to_string(guess.rows()) + ", counted from 0");
    if (pinned[size_t(v)])
      throw InvalidParameter("control point " + std::to_string(v) + " is pinned twice; leave one of the pins");
    pinned[size_t(v)] = true;
  }
  if (pins.values.size() == 0) return;
  if (pins.values.rows() != Eigen::Index(pins.vertices.size()) || pins.values.cols() != guess.cols())
    throw InvalidParameter("the pins' values are " + shape(pins.values) + "; " + std::to_string(pins.vertices.size()) +
                           " x " + std::to_string(guess.cols()) +
                           " would fit, or none: where the first guess has them");
  for (size_t i = 0; i < pins.vertices.size(); ++i)
    if (!pins.values.row(Eigen::Index(i)).allFinite())
      throw InvalidParameter("the pin of control point " + std::to_string(pins.vertices[i]) +
                             " is not at finite numbers");
}

/// The rows of A with weight, and C below them.
SparseMatrix conditions(const SparseMatrix& A, const std::vector<double>& weights, const SparseMatrix& C) {
  const Index columns = Index(A.cols());
  std::vector<Eigen::Triplet<double, Index>> entries;
  Index row = 0;
  const auto append = [&](const SparseMatrix& m, Eigen::Index i) {
    for (SparseMatrix::InnerIterator it(m, i); it; ++it) entries.push_back({row, Index(it.col()), it.value()});
    ++row;
  };
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    if (weights.empty() || weights[size_t(i)] > 0) append(A, i);
  for (Eigen::Index i = 0; i < C.rows(); ++i) append(C, i);
  SparseMatrix result(row, columns);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace

ScatteredFit fit_places(const LinearSource& surface, const PlaceTargets& targets, const Points& guess,
                        const ScatteredFitOptions& options) {
  const Index n = surface.num_points();
  check(targets, guess, n);
  check(options.pins, guess);
  FitProblem problem;
  problem.A = place_rows(surface, targets.places);
  problem.b = targets.values;
  if (targets.places.empty()) problem.b.resize(0, guess.cols());
  if (!targets.weights.empty())
    problem.weights = Eigen::Map<const Eigen::VectorXd>(targets.weights.data(), Eigen::Index(targets.weights.size()));
  if (!options.fairness.empty()) problem.H = fairness_energy(surface, options.fairness);
  const Pins& pins = options.pins;
  problem.C.resize(Index(pins.vertices.size()), n);
  problem.d.resize(Eigen::Index(pins.vertices.size()), guess.cols());
  for (size_t i = 0; i < pins.vertices.size(); ++i) {
    const auto row = Eigen::Index(i);
    problem.C.insert(row, pins.vertices[i]) = 1;
    problem.d.row(row) = pins.values.size() > 0 ? pins.values.row(row) : guess.row(pins.vertices[i]);
  }
  problem.C.makeCompressed();
  problem.x0 = guess;

  ScatteredFit fit;
  fit.solution = solve(problem, options.solver);
  fit.points = fit.solution.x;
  // A pin is a fact, not an equation that a solver meets to rounding.
  for (size_t i = 0; i < pins.vertices.size(); ++i) fit.points.row(pins.vertices[i]) = problem.d.row(Eigen::Index(i));
  fit.residuals = (problem.A * fit.points - problem.b).rowwise().norm();
  if (fit.residuals.size() > 0) {
    fit.largest = fit.residuals.maxCoeff();
    const Eigen::ArrayXd squares = fit.residuals.array().square();
    const double sum = problem.weights.size() > 0 ? problem.weights.sum() : double(squares.size());
    const double weighted = problem.weights.size() > 0 ? (squares * problem.weights.array()).sum() : squares.sum();
    fit.rms = sum > 0 ? std::sqrt(weighted / sum) : 0;
  }
  if (options.conditioning) fit.conditioning = conditioning(conditions(problem.A, targets.weights, problem.C));
  return fit;
}

}  // namespace sublimit
