// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/measure.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/integrals/detail/quadrature.h"
#include "sublimit/patches/detail/blossom.h"

namespace sublimit {
namespace {

using Columns3 = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Weights of Bernstein polynomials at t, and of their derivatives.
struct BernsteinWeights {
  Eigen::RowVectorXd value, slope;
  BernsteinWeights(int degree, double t) : value(degree + 1), slope(degree + 1) {
    const auto fill = [&](int points, Eigen::RowVectorXd& w) {
      w[0] = 1;
      for (int q = 1; q <= points; ++q) blossom_step(UnitSpan<double>{}, q, UnitArgument<double>::point(t), w.data());
      for (int q = points + 1; q <= degree; ++q) {
        blossom_step(UnitSpan<double>{}, q, UnitArgument<double>::direction(), w.data());
        w *= degree;
      }
    };
    fill(degree, value);
    if (degree > 0) fill(degree - 1, slope);
  }
};

struct QuadJet {
  Eigen::RowVector3d x, s, t;
};
QuadJet jet_of(const LimitQuad& quad, double s, double t) {
  const int d = quad.degree;
  const BernsteinWeights a(d, s), b(d, t);
  QuadJet jet{Eigen::RowVector3d::Zero(), Eigen::RowVector3d::Zero(), Eigen::RowVector3d::Zero()};
  const Eigen::RowVector3d origin = quad.net.row(0);
  for (int i = 0; i <= d; ++i) {
    const Columns3 row = quad.net.middleRows(i * (d + 1), d + 1).rowwise() - origin;
    const Eigen::RowVector3d value = b.value * row;
    jet.x += a.value[i] * value;
    jet.s += a.slope[i] * value;
    jet.t += a.value[i] * (b.slope * row);
  }
  jet.x += origin;
  return jet;
}

double angle_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// Rows of values and derivatives at the nodes of a product rule.
struct AreaRule {
  std::vector<QuadraturePoint> nodes;
  Eigen::MatrixXd x, s, t;
  explicit AreaRule(int degree) : nodes(square_rule(std::max(6, 3 * degree / 2 + 1))) {
    const auto count = Eigen::Index(nodes.size());
    const Eigen::Index size = (degree + 1) * (degree + 1);
    x.resize(count, size), s.resize(count, size), t.resize(count, size);
    for (Eigen::Index q = 0; q < count; ++q) {
      const BernsteinWeights a(degree, nodes[size_t(q)].u), b(degree, nodes[size_t(q)].v);
      for (int i = 0; i <= degree; ++i)
        for (int j = 0; j <= degree; ++j) {
          const Eigen::Index c = i * (degree + 1) + j;
          x(q, c) = a.value[i] * b.value[j];
          s(q, c) = a.slope[i] * b.value[j];
          t(q, c) = a.value[i] * b.slope[j];
        }
    }
  }
};

void add_areas(std::vector<LimitQuad>& quads, QuadMeasures& measures) {
  if (quads.empty()) return;
  std::map<int, AreaRule> rules;
  for (const LimitQuad& quad : quads) rules.try_emplace(quad.degree, quad.degree);
  const Eigen::RowVector3d origin = quads[0].net.row(0);
  constexpr std::int64_t quads_a_block = 64;
  std::vector<double> areas(quads.size(), 0);
  parallel_for_blocks(
      std::ssize(quads),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t k = begin; k < end; ++k) {
          LimitQuad& quad = quads[size_t(k)];
          const AreaRule& rule = rules.at(quad.degree);
          const Columns3 net = quad.net.rowwise() - origin;
          const Columns3 x = rule.x * net, s = rule.s * net, t = rule.t * net;
          for (Eigen::Index q = 0; q < x.rows(); ++q) {
            const Eigen::Vector3d a = s.row(q), b = t.row(q), N = a.cross(b);
            const double w = rule.nodes[size_t(q)].weight;
            areas[size_t(k)] += w * N.norm();
            quad.volume += w * x.row(q).dot(N) / 3;
          }
        }
      },
      quads_a_block);
  for (size_t k = 0; k < quads.size(); ++k) measures.area += areas[k], measures.volume += quads[k].volume;
}

}  // namespace

QuadMeasures measure(std::vector<LimitQuad>& quads, QuadEdges& edges) {
  constexpr int points = 5;
  QuadMeasures result;
  std::vector<double> angles(edges.edges.size(), 0);
  parallel_for_blocks(
      std::ssize(edges.edges),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t e = begin; e < end; ++e) {
          QuadEdge& edge = edges.edges[size_t(e)];
          const int d = static_cast<int>(edge.net.rows()) - 1;
          for (int k = 0; k < points; ++k) {
            const double at = k / (points - 1.0);
            const Eigen::RowVector3d x =
                edge.net.row(0) + BernsteinWeights(d, at).value * Columns3(edge.net.rowwise() - edge.net.row(0));
            std::vector<Eigen::Vector3d> normals;
            for (const QuadSide& use : edge.uses) {
              const double own = use.reversed ? 1 - at : at;
              const auto [s, t] = on_side(use.side, use.begin + own * (use.end - use.begin));
              const QuadJet jet = jet_of(quads[size_t(use.quad)], s, t);
              edge.gap = std::max(edge.gap, (jet.x - x).norm());
              normals.push_back(jet.s.transpose().cross(jet.t.transpose()));
            }
            if (!edge.is_sharp && normals.size() == 2)
              angles[size_t(e)] = std::max(angles[size_t(e)], angle_of(normals[0], normals[1]));
          }
        }
      },
      256);
  for (size_t e = 0; e < edges.edges.size(); ++e) {
    const QuadEdge& edge = edges.edges[e];
    result.largest_gap = std::max(result.largest_gap, edge.gap);
    if (edge.uses.size() != 2) ++result.open_edges;
    if (edge.is_sharp) ++result.sharp_edges;
    size_t caps = 0;
    for (const QuadSide& use : edge.uses) caps += quads[size_t(use.quad)].is_exact ? 0 : 1;
    if (angles[e] > std::max({result.exact_angle, result.cap_angle, result.between_caps}))
      result.worst = edge.net.row(edge.net.rows() / 2);
    double& angle = caps == 0 ? result.exact_angle : caps == 1 ? result.cap_angle : result.between_caps;
    angle = std::max(angle, angles[e]);
  }
  add_areas(quads, result);
  return result;
}

}  // namespace sublimit
