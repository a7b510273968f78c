// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/detail/seen_net.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sublimit/nets/net_derivatives.h"

namespace sublimit {

RayFrame::RayFrame(const Eigen::Vector3d& from, const Eigen::Vector3d& direction)
    : origin(from), length(direction.stableNorm()) {
  const Eigen::Vector3d d = direction / length;
  Eigen::Index least = 0;
  d.cwiseAbs().minCoeff(&least);
  axes.row(0) = d.cross(Eigen::Vector3d(Eigen::Vector3d::Unit(least))).normalized();
  axes.row(1) = d.cross(Eigen::Vector3d(axes.row(0)));
  axes.row(2) = d;
}

Points RayFrame::seen(const Points& net) const {
  if (net.cols() == 3) return (net.rowwise() - origin.transpose()) * axes.transpose();
  Points seen(net.rows(), 4);
  seen << (net.leftCols<3>() - net.col(3) * origin.transpose()) * axes.transpose(), net.col(3);
  return seen;
}

Eigen::Vector2d nearest_inside(const Eigen::Vector2d& p, bool triangle) {
  if (!triangle) return p.cwiseMax(0).cwiseMin(1);
  if (p.x() >= 0 && p.y() >= 0 && p.x() + p.y() <= 1) return p;
  if (p.x() + p.y() <= 1 || p.x() - p.y() > 1 || p.y() - p.x() > 1) {
    const Eigen::Vector2d q = p.cwiseMax(0).cwiseMin(1);
    if (q.x() + q.y() <= 1) return q;
  }
  const double u = std::clamp((p.x() - p.y() + 1) / 2, 0.0, 1.0);
  return {u, 1 - u};
}

bool is_none(const Eigen::Vector2d& step, const Eigen::Vector2d& off, bool triangle) {
  // On a side of a square a step goes across it alone. Seen at an angle, one may be known to much less than the other.
  if (triangle) return step.cwiseAbs().maxCoeff() <= off.maxCoeff();
  return std::abs(step[0]) <= off[0] && std::abs(step[1]) <= off[1];
}

namespace {

constexpr std::array<std::array<double, 2>, 4> line_directions{
    {{1, 0}, {0, 1}, {0.70710678, 0.70710678}, {0.70710678, -0.70710678}}};

/// In the plane across the ray.
Eigen::Matrix<double, Eigen::Dynamic, 2> across(const Points& points) {
  Eigen::Matrix<double, Eigen::Dynamic, 2> result = points.leftCols<2>();
  if (points.cols() == 4) result.array().colwise() /= points.col(3).array();
  return result;
}

Eigen::VectorXd distances_of(const Points& points) {
  return points.cols() == 4 ? Eigen::VectorXd(points.col(2).array() / points.col(3).array())
                            : Eigen::VectorXd(points.col(2));
}

int sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// The rows of a net's corners, counter-clockwise.
std::array<Eigen::Index, 4> net_corners(const PolynomialBasis& basis) {
  const int d = basis.degree();
  return {net_row(basis, 0, 0), net_row(basis, d, 0), basis.total() ? net_row(basis, 0, d) : net_row(basis, d, d),
          net_row(basis, 0, d)};
}

}  // namespace

std::optional<Eigen::Vector2d> facing(const Eigen::Matrix<double, Eigen::Dynamic, 2>& points) {
  const auto cross = [](const Eigen::RowVector2d& a, const Eigen::RowVector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  Eigen::RowVector2d right = points.row(0), left = right;  // ends of the angle, as points
  for (Eigen::Index i = 1; i < points.rows(); ++i) {
    const Eigen::RowVector2d p = points.row(i);
    const bool beyond_left = cross(left, p) > 0, beyond_right = cross(right, p) < 0;
    if (beyond_left && beyond_right) return std::nullopt;
    if (beyond_left) left = p;
    if (beyond_right) right = p;
    if (cross(right, left) < 0 || left.dot(p) <= -left.norm() * p.norm() || right.dot(p) <= -right.norm() * p.norm())
      return std::nullopt;
  }
  const double l = left.norm(), r = right.norm();
  if (!(l > 0 && r > 0)) return std::nullopt;
  const Eigen::Vector2d middle = (left / l + right / r).transpose();
  const double length = middle.norm();
  if (!(length > 0)) return std::nullopt;
  return middle / length;
}

bool can_be_hit(const Points& points, double slack) {
  const Eigen::Matrix<double, Eigen::Dynamic, 2> seen = across(points);
  if (const std::optional<Eigen::Vector2d> d = facing(seen); d && (seen * *d).minCoeff() > slack) return false;
  return std::ranges::all_of(line_directions, [&](const std::array<double, 2>& d) {
    const Eigen::VectorXd side = d[0] * seen.col(0) + d[1] * seen.col(1);
    return side.minCoeff() <= slack && side.maxCoeff() >= -slack;
  });
}

std::optional<SeenStrip> strip_of(const Points& points, std::span<const Eigen::Index> corners, double within,
                                  double slack) {
  const Eigen::Matrix<double, Eigen::Dynamic, 2> seen = across(points);
  // Across the longest way from one of them to another.
  Eigen::Index far = 0;
  const double length = (seen.rowwise() - seen.row(0)).rowwise().norm().maxCoeff(&far);
  const Eigen::RowVector2d tangent =
      length > 0 ? Eigen::RowVector2d((seen.row(far) - seen.row(0)) / length) : Eigen::RowVector2d(1, 0);
  const Eigen::RowVector2d normal(-tangent.y(), tangent.x());
  if (!((seen * normal.transpose()).cwiseAbs().maxCoeff() + within <= 2 * slack)) return std::nullopt;
  size_t low = 0, high = 0;
  std::array<double, 4> place{};
  for (size_t k = 0; k < corners.size(); ++k) {
    place[k] = seen.row(corners[k]).dot(tangent);
    if (place[k] < place[low]) low = k;
    if (place[k] > place[high]) high = k;
  }
  if (place[low] > 2 * slack || place[high] < -2 * slack) return std::nullopt;
  const bool triangle = corners.size() == 3;
  const auto uv = [triangle](size_t k) {
    const CellCorner c = triangle ? triangle_corners[k] : square_corners[k];
    return Eigen::Vector2d(c.i, c.j);
  };
  const Eigen::VectorXd s = distances_of(points);
  constexpr double least_length =
      1000;  // in slacks: what is no longer is just small, and not known to go along the ray
  if (!(std::max(length, s.maxCoeff() - s.minCoeff()) >= least_length * slack)) return std::nullopt;
  const double width = place[high] - place[low];
  const double w = width > 0 ? std::clamp(-place[low] / width, 0.0, 1.0) : 0.5;
  return SeenStrip{s.minCoeff() - within, s.maxCoeff() + within, (1 - w) * uv(low) + w * uv(high)};
}

SeenZero SeenNet::zero(double slack) const {
  const NetDerivatives x(basis_, net_, 1);
  // Preconditioned, so that it is all the same from where the part is seen: by the mean of its derivatives first, then
  // by the middle of what these are then.
  Eigen::Matrix2d mean;
  for (int by = 0; by < 2; ++by)  // columns: derivatives across the ray, by u and by v
    mean.col(by) = x.net(1 - by, by).leftCols<2>().colwise().mean();
  if (!(std::abs(mean.determinant()) > 1e-12 * mean.squaredNorm())) return {SeenZero::Kind::unknown};
  const Eigen::Matrix2d first = mean.inverse();
  Eigen::Matrix2d middle, radius;
  for (int by = 0; by < 2; ++by) {
    const Eigen::Matrix<double, Eigen::Dynamic, 2> net = x.net(1 - by, by).leftCols<2>() * first.transpose();
    const Eigen::Vector2d low = net.colwise().minCoeff(), high = net.colwise().maxCoeff();
    middle.col(by) = (low + high) / 2;
    radius.col(by) = (high - low) / 2;
  }
  if (!(middle.determinant() > 0.01)) return {SeenZero::Kind::unknown};
  const Eigen::Matrix2d second = middle.inverse(), inverse = second * first;
  const double largest = is_rational() ? net_.col(3).maxCoeff() : 1;
  const Eigen::Vector2d off_by_slack = inverse.cwiseAbs().rowwise().sum() * (slack * largest);
  const Eigen::Matrix<double, Eigen::Dynamic, 2> flattened = net_.leftCols<2>() * inverse.transpose();
  for (int k = 0; k < 2; ++k)
    if (flattened.col(k).minCoeff() > off_by_slack[k] || flattened.col(k).maxCoeff() < -off_by_slack[k])
      return {SeenZero::Kind::none};
  // At most that much of the distance to a zero is left after a step by the inverse of the middle, and going back to
  // the nearest place of the domain adds nothing.
  if (!((second.cwiseAbs() * radius).norm() < 0.5)) return {SeenZero::Kind::unknown};
  const bool triangle = basis_.total();
  Eigen::Vector2d p = triangle ? Eigen::Vector2d(1. / 3, 1. / 3) : Eigen::Vector2d(0.5, 0.5), move;
  NetDerivatives::Jet jet;
  for (int step = 0; step < 64; ++step) {
    jet = x.at(p.x(), p.y());
    move = inverse * jet.x.head<2>();  // no denominator is 0: zeros are those of the numerators
    const Eigen::Vector2d next = nearest_inside(p - move, triangle);
    const bool done = (next - p).cwiseAbs().maxCoeff() < 1e-16;
    p = next;
    if (done) break;
  }
  // What the neighbour may miss by as much as rounding moves zeros is taken here too.
  const Eigen::Vector2d off = off_by_slack.array() + beyond_part;
  if (!is_none(move, off, triangle)) return {SeenZero::Kind::none};
  const double w = is_rational() ? jet.x[3] : 1, s = jet.x[2] / w;
  const double su = (jet.u[2] - s * jet.u[3]) / w, sv = (jet.v[2] - s * jet.v[3]) / w;
  return {SeenZero::Kind::one, p, s, std::abs(su) * off[0] + std::abs(sv) * off[1], sign(inverse.determinant())};
}

namespace {

/// A coefficient by its distance from a side, in steps, and by its place along it, counter-clockwise: v = 0, u = 1,
/// v = 1, u = 0 of squares; v = 0, u + v = 1, u = 0 of triangles.
struct FromSide {
  int steps = 0, place = 0;
};
FromSide from_side(const PolynomialBasis& basis, int side, int i, int j) {
  const int d = basis.degree();
  if (basis.total()) return side == 0 ? FromSide{j, i} : side == 1 ? FromSide{d - i - j, j} : FromSide{i, -j};
  return side == 0   ? FromSide{j, i}
         : side == 1 ? FromSide{d - i, j}
         : side == 2 ? FromSide{d - j, -i}
                     : FromSide{i, -j};
}

Eigen::Vector2d side_middle(bool triangle, int side) {
  if (side == 0) return {0.5, 0};
  if (triangle) return side == 1 ? Eigen::Vector2d(0.5, 0.5) : Eigen::Vector2d(0, 0.5);
  return side == 1 ? Eigen::Vector2d(1, 0.5) : side == 2 ? Eigen::Vector2d(0.5, 1) : Eigen::Vector2d(0, 0.5);
}

struct Coefficient {
  FromSide at;
  Eigen::Vector3d x;
};

/// Of a net that is 0 on the side: what it is over the distance from there, one degree less across.
/// @param degree  across, of the net
void divide_by_distance(std::vector<Coefficient>& net, int degree) {
  std::erase_if(net, [](const Coefficient& c) { return c.at.steps == 0; });
  for (Coefficient& c : net) {
    c.x *= double(degree) / c.at.steps;
    --c.at.steps;
  }
}

/// How far all of them are on one side of the ray, by the best of a few directions; negative if they are not.
double least_aside(const std::vector<Coefficient>& net) {
  Eigen::Matrix<double, Eigen::Dynamic, 2> points(net.size(), 2);
  for (size_t i = 0; i < net.size(); ++i) points.row(Eigen::Index(i)) = net[i].x.head<2>();
  double best = -INFINITY;
  const auto look = [&](const Eigen::Vector2d& direction) {
    double least = INFINITY;
    for (const Coefficient& c : net) least = std::min(least, c.x.head<2>().dot(direction));
    best = std::max(best, least);
  };
  if (const std::optional<Eigen::Vector2d> middle = facing(points)) look(*middle);
  for (const auto& [a, b] : line_directions) look({a, b}), look({-a, -b});
  return best;
}

/// The side of the surface that is seen next to a side that is a point: by how the directions away from it turn.
int seen_side(std::vector<Coefficient> net) {
  std::erase_if(net, [](const Coefficient& c) { return c.at.steps > 0; });
  std::ranges::sort(net, {}, [](const Coefficient& c) { return c.at.place; });
  int seen = 0;
  for (size_t k = 0; k + 1 < net.size(); ++k) {
    const int turn = -sign(net[k].x.x() * net[k + 1].x.y() - net[k].x.y() * net[k + 1].x.x());
    if (turn != 0 && seen == -turn) return 0;
    if (turn != 0) seen = turn;
  }
  return seen;
}

}  // namespace

std::optional<SeenNet::Side> SeenNet::side_on_ray(double slack) const {
  const bool triangle = basis_.total();
  const Eigen::Matrix<double, Eigen::Dynamic, 2> seen = across(net_);
  const Eigen::VectorXd distances = distances_of(net_);
  for (int side = 0; side < (triangle ? 3 : 4); ++side) {
    bool is_on = true;
    double low = INFINITY, high = -INFINITY;
    for_each_net_row(basis_, [&](int i, int j, Eigen::Index row) {
      if (!is_on || from_side(basis_, side, i, j).steps > 0) return;
      is_on = seen.row(row).norm() <= 2 * slack;
      low = std::min(low, distances[row]), high = std::max(high, distances[row]);
    });
    if (!is_on) continue;
    // Numerators, also of distances from the side's middle along the ray.
    const double s = (low + high) / 2, largest = is_rational() ? net_.col(3).maxCoeff() : 1;
    std::vector<Coefficient> rest;
    for_each_net_row(basis_, [&](int i, int j, Eigen::Index row) {
      const double w = is_rational() ? net_(row, 3) : 1;
      rest.push_back({from_side(basis_, side, i, j), {net_(row, 0), net_(row, 1), w * (distances[row] - s)}});
    });
    const auto is_zero_there = [&] {
      return std::ranges::all_of(
          rest, [&](const Coefficient& c) { return c.at.steps > 0 || c.x.head<2>().norm() <= 2 * slack * largest; });
    };
    double steepest = 0;
    int times = 0;  // that the map is 0 on the side
    for (int degree = basis_.degree(); degree > 0 && is_zero_there(); --degree, ++times) {
      divide_by_distance(rest, degree);
      if (times == 0)
        for (const Coefficient& c : rest) steepest = std::max(steepest, std::abs(c.x.z()));
    }
    const double least = least_aside(rest);
    if (!(least > slack * largest)) continue;
    const double near = std::pow(2 * slack * largest / least, 1.0 / times);  // that is as good as on the ray
    const bool is_point = high - low <= 4 * slack;
    return Side{{low, high, side_middle(triangle, side)}, 2 * slack + near * steepest, is_point ? seen_side(rest) : 0};
  }
  return std::nullopt;
}

SeenNet::Lengths SeenNet::lengths(Eigen::Index coordinates) const {
  Points x = net_.leftCols(coordinates);
  if (is_rational()) x.array().colwise() /= net_.col(3).array();
  const int d = basis_.degree();
  Lengths longest;
  for (int line = 0; line <= d; ++line) {
    double u = 0, v = 0;
    for (int k = 0; k < d; ++k) {
      u += (x.row(net_row(basis_, k + 1, line)) - x.row(net_row(basis_, k, line))).norm();
      v += (x.row(net_row(basis_, line, k + 1)) - x.row(net_row(basis_, line, k))).norm();
    }
    longest.u = std::max(longest.u, u), longest.v = std::max(longest.v, v);
  }
  return longest;
}

std::optional<SeenStrip> SeenNet::strip(double slack) const {
  const std::array<Eigen::Index, 4> corners = net_corners(basis_);
  return strip_of(net_, std::span(corners).first(basis_.total() ? 3 : 4), 0, slack);
}

}  // namespace sublimit
