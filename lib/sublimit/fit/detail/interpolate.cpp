// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/detail/interpolate.h"

#include <algorithm>
#include <cmath>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/fit/detail/for_coordinates.h"
#include "sublimit/fit/detail/unit_frame.h"
#include "sublimit/fit/detail/vertex_conditions.h"
#include "sublimit/mesh/detail/points_in_space.h"
#include "sublimit/neighborhood/vertex_sides.h"
#include "sublimit/scheme/detail/check_levels.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit {
namespace {

constexpr double exact_position = 1e-12;  // of the targets' box
constexpr double exact_normal = 1e-10;    // radians

/// Steps towards the given points by what the limit misses: slow modes first, wiggles hardly.
constexpr int guess_steps = 3;

/// Normals that came out on the wrong side are asked for with a frame; others may then turn, which is done so often.
constexpr int most_turns = 3;

/// The targets with unit normals; throws at what no mesh could meet.
std::vector<VertexTarget> checked(const std::vector<VertexTarget>& targets, const Level& level) {
  const Topology& topology = level.topology();
  const std::vector<bool> outside = vertices_without_surface(topology, level.holes);
  std::vector<VertexTarget> result = targets;
  std::vector<bool> seen(topology.num_vertices(), false);
  for (size_t i = 0; i < result.size(); ++i) {
    VertexTarget& target = result[i];
    const std::string where = "target " + std::to_string(i) + ": ";
    if (target.vertex < 0 || target.vertex >= topology.num_vertices())
      throw InvalidParameter(where + "vertex " + std::to_string(target.vertex) + " does not exist; vertices are 0 to " +
                             std::to_string(topology.num_vertices() - 1) + ", counted from 0");
    const std::string at = where + "vertex " + std::to_string(target.vertex);
    if (seen[target.vertex]) throw InvalidParameter(at + " has a target already; a vertex has one");
    seen[target.vertex] = true;
    if (outside[target.vertex])
      throw InvalidParameter(at + " is in no face, or in holes alone: no surface passes there; leave it out");
    if (!target.position.allFinite()) throw InvalidParameter(at + ": its position is not finite");
    if (!target.normal) continue;
    if (!target.normal->allFinite()) throw InvalidParameter(at + ": its normal is not finite");
    const double largest = target.normal->cwiseAbs().maxCoeff();
    if (largest == 0) throw InvalidParameter(at + ": its normal has length 0; any other length will do");
    target.normal = (*target.normal / largest).normalized();
  }
  return result;
}

/// Vertices that a matrix of directions moves.
std::vector<Index> moved(const Points& directions, Index unknowns_per_vertex) {
  std::vector<Index> vertices;
  const double most = directions.size() ? directions.rowwise().norm().maxCoeff() : 0;
  for (Index r = 0; r < directions.rows(); ++r) {
    const Index v = r / unknowns_per_vertex;
    if (directions.row(r).norm() > 1e-3 * most && (vertices.empty() || vertices.back() != v)) vertices.push_back(v);
  }
  return vertices;
}

Points guess(const VertexLimits& limits, const std::vector<VertexTarget>& targets, Points points) {
  std::vector<Index> sheets(targets.size(), 0);
  for (const Index i : limits.position_vertex) ++sheets[i];
  for (int k = 0; k < guess_steps; ++k) {
    const Points at = apply(limits.position, points);
    for (size_t p = 0; p < limits.position_vertex.size(); ++p) {
      const Index i = limits.position_vertex[p];
      points.row(targets[i].vertex) += (targets[i].position.transpose() - at.row(Index(p))) / sheets[i];
    }
  }
  return points;
}

/// All that an attempt needs; points and targets are in the unit frame.
struct Problem {
  const Scheme<double>& scheme;
  const std::vector<Level>& levels;
  const InterpolationOptions& options;
  const std::vector<VertexTarget>& targets;
  const Points& x0;  // of the last level
};

/// The points nearest to x0 that meet the conditions, or the fairest of those.
/// @param linear  with the fairness of one coordinate, if any
Points meeting(const VertexConditions& conditions, FitProblem linear, const Points& x0, const FitSolverOptions& options,
               FitSolution& solution) {
  linear.C = conditions.C;
  linear.d = conditions.d;
  linear.x0 = conditions.coupled ? Points(x0.reshaped<Eigen::RowMajor>()) : x0;
  if (conditions.coupled && linear.H.rows() > 0) linear.H = for_coordinates(linear.H);
  solution = solve(linear, options);
  const Points x = std::exchange(solution.x, {});
  return conditions.coupled ? Points(x.reshaped<Eigen::RowMajor>(x0.rows(), 3)) : x;
}

void attempt(const Problem& problem, LimitCache& cache, Interpolation& result) {
  const std::vector<VertexTarget>& targets = problem.targets;
  std::vector<Index> vertices;
  for (const VertexTarget& target : targets) vertices.push_back(target.vertex);
  const Level& level = problem.levels.back();
  const VertexLimits limits = vertex_limits(problem.levels, cache, vertices);
  FitProblem linear;
  if (!problem.options.fairness.empty())
    linear.H = fairness_energy(LimitMap(problem.scheme, level), problem.options.fairness);
  VertexConditions conditions;
  std::map<Index, TangentFrame> frames;
  for (int turns = 0; turns <= most_turns; ++turns) {
    conditions = vertex_conditions(limits, targets, frames);
    result.points = meeting(conditions, linear, problem.x0, problem.options.solver, result.solution);
    if (!conditions.coupled) break;
    const size_t known = frames.size();
    frames.merge(turned_frames(limits, targets, result.points, problem.x0));
    if (frames.size() == known) break;
  }

  InterpolationAttempt tried{.refinements = level.number,
                             .unknowns = static_cast<Index>(conditions.C.cols()),
                             .conditions = static_cast<Index>(conditions.C.rows())};
  const VertexErrors errors = vertex_errors(limits, targets, result.points);
  const auto has_normal = [&](Index i) { return !std::isnan(errors.normal[i]); };
  for (Index i = 0; i < static_cast<Index>(targets.size()); ++i) {
    tried.position_error = std::max(tried.position_error, errors.position[i]);
    if (has_normal(i)) tried.normal_error = std::max(tried.normal_error, errors.normal[i]);
    if (!(errors.position[i] <= exact_position) || (has_normal(i) && !(errors.normal[i] <= exact_normal)))
      tried.contradictory.push_back(targets[i].vertex);
  }
  tried.solved = tried.contradictory.empty();
  if (problem.options.conditioning) {
    tried.conditioning = conditioning(conditions.C);
    if (tried.conditions >= tried.unknowns && tried.conditioning.rank < tried.unknowns)
      tried.undetermined = moved(tried.conditioning.free, conditions.coupled ? 3 : 1);
  }
  result.attempts.push_back(std::move(tried));
  result.level = level;
  result.position_error = errors.position;
  result.normal_error = errors.normal;
  result.without_plane = std::move(conditions.without_plane);
}

}  // namespace

Interpolation interpolate(const Scheme<double>& scheme, const Mesh& mesh, const std::vector<VertexTarget>& targets,
                          const InterpolationOptions& options) {
  if (options.least_refinements < 0 || options.most_refinements < options.least_refinements)
    throw InvalidParameter("refinements from " + std::to_string(options.least_refinements) + " to " +
                           std::to_string(options.most_refinements) + "; the first is 0 or more, the second not less");
  // Only then does a level lie as a control mesh does.
  const int last = options.most_refinements / scheme.period * scheme.period;
  if (last < options.least_refinements)
    throw InvalidParameter(scheme.name + " repeats every " + std::to_string(scheme.period) +
                           " refinements, so that its control points are added by as many; allow " +
                           std::to_string(last + scheme.period));
  std::vector<Level> levels{control_level(scheme, mesh, options.rules)};
  const Points control = points_in_space(mesh);
  std::vector<VertexTarget> asked = checked(targets, levels[0]);
  const UnitFrame frame = unit_frame(asked, control);
  for (VertexTarget& target : asked) target.position = frame.inside(target.position.transpose()).transpose();

  LimitCache cache(scheme);
  Interpolation result;
  std::int64_t conditions = 0;
  for (const VertexTarget& target : asked) conditions += target.normal ? 5 : 3;
  check_levels(scheme, levels[0].topology(), options.least_refinements);
  Points x0 = frame.inside(control);
  for (int k = 0; k <= last; ++k) {
    if (k == 1) {
      std::vector<Index> vertices;
      for (const VertexTarget& target : asked) vertices.push_back(target.vertex);
      x0 = guess(vertex_limits(levels, cache, vertices), asked, x0);
    }
    if (k > 0) {
      check_levels(scheme, levels[0].topology(), k);
      levels.push_back(next_level(scheme, levels.back()));
      x0 = apply(levels.back().S, x0);
    }
    const bool crowded = conditions > 3 * std::int64_t(x0.rows());
    if (k % scheme.period != 0 || k < options.least_refinements || (crowded && k < last)) continue;
    attempt({scheme, levels, options, asked, x0}, cache, result);
    if (result.solved()) break;
  }
  for (InterpolationAttempt& tried : result.attempts) tried.position_error *= frame.unit;
  result.position_error *= frame.unit;
  result.points = frame.outside(result.points);
  return result;
}

std::string listed_vertices(const std::vector<Index>& vertices) {
  constexpr size_t most = 8;
  std::string text = vertices.size() == 1 ? "vertex " : "vertices ";
  for (size_t i = 0; i < std::min(most, vertices.size()); ++i) text += (i ? ", " : "") + std::to_string(vertices[i]);
  if (vertices.size() > most) text += " and " + std::to_string(vertices.size() - most) + " more";
  return text;
}

std::string why_unsolved(const InterpolationAttempt& attempt) {
  if (attempt.solved) return "";
  std::string text;
  if (!attempt.undetermined.empty())
    text += "the limits of " + listed_vertices(attempt.undetermined) + " depend on each other (rank " +
            std::to_string(attempt.conditioning.rank) + " of " + std::to_string(attempt.unknowns) + "); ";
  text += "the targets of " + listed_vertices(attempt.contradictory) + " cannot be met with the control points of " +
          std::to_string(attempt.refinements) + (attempt.refinements == 1 ? " refinement" : " refinements") +
          ": allow another refinement, or leave a target out";
  return text;
}

}  // namespace sublimit
