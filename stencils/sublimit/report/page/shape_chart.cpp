// SPDX-License-Identifier: Apache-2.0
// The shape chart of Karciauskas, Peters and Reif 2004: near an extraordinary point a surface looks like its central
// surface, the graph of a f0 + b fc + c fs over the characteristic map. The sign of its Gauss curvature depends only on
// the direction of (a, b, c); (b, c) with b^2 + c^2 <= 1 and a = sqrt(1 - b^2 - c^2) make a disc.
#include <fmt/core.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/report/page/drawing.h"
#include "sublimit/report/page/figures.h"
#include "sublimit/report/page/map_net.h"

namespace sublimit::page {
namespace {

/// Second derivatives xx, xy, yy at points of the net, by least squares over their faces' points.
class Hessians {
 public:
  explicit Hessians(const MapNet& net) {
    std::vector<std::set<int>> around(net.points.size());
    std::vector<int> faces(net.points.size(), 0);
    for (const std::vector<int>& face : net.faces)
      for (int v : face) around[v].insert(face.begin(), face.end()), ++faces[v];
    double radius = 0;
    for (const Point& p : net.points) radius = std::max(radius, p.norm());
    for (std::size_t v = 0; v < net.points.size(); ++v) {
      std::set<int> near = around[v];
      if (near.size() < 7 || net.points[v].norm() < 1e-9 * radius) continue;  // the point itself has no curvature
      Eigen::MatrixXd rows(static_cast<Eigen::Index>(near.size()), 6);
      Eigen::Index r = 0;
      double size = 0;
      for (int w : near) size = std::max(size, (net.points[w] - net.points[v]).norm());
      for (int w : near) {
        const Point d = (net.points[w] - net.points[v]) / size;
        rows.row(r++) << 1, d.x(), d.y(), .5 * d.x() * d.x(), d.x() * d.y(), .5 * d.y() * d.y();
      }
      const PivotedQr solver(rows);
      if (solver.rank() < 6 || 2 * faces[v] < static_cast<int>(near.size()) - 1) continue;  // at the rim
      const Eigen::MatrixXd inverse = solver.solve(
          Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(near.size()), static_cast<Eigen::Index>(near.size())));
      points_.push_back({std::vector<int>(near.begin(), near.end()), inverse.bottomRows(3)});
    }
  }

  std::vector<Eigen::Vector3d> of(const std::vector<double>& heights) const {
    std::vector<Eigen::Vector3d> all;
    for (const auto& [near, weights] : points_) {
      Eigen::Vector3d h = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < near.size(); ++i) h += heights[near[i]] * weights.col(static_cast<Eigen::Index>(i));
      all.push_back(h);
    }
    return all;
  }
  bool empty() const { return points_.empty(); }

 private:
  struct ChartPoint {
    std::vector<int> near;
    Eigen::MatrixXd weights;
  };
  std::vector<ChartPoint> points_;
};

/// Heights scaled to curvature of size one, so that the disc shows all shapes.
void normalize(std::vector<Eigen::Vector3d>& hessians) {
  double sum = 0;
  for (const Eigen::Vector3d& h : hessians) sum += h[0] * h[0] + 2 * h[1] * h[1] + h[2] * h[2];
  const double scale = std::sqrt(sum / std::max<double>(1, static_cast<double>(hessians.size())));
  if (scale > 0)
    for (Eigen::Vector3d& h : hessians) h /= scale;
}

}  // namespace

Json shape_chart_figure(const Json& neighborhood, const std::string& name) {
  const std::optional<double> mu = number(at(neighborhood, "mu"));
  const MapNet net = map_net(at(neighborhood, "characteristic_map"));
  if (!mu || net.faces.empty()) return {};
  const int n = whole(at(neighborhood, "n"));
  std::vector<std::vector<double>> bowl, saddle;  // of block 0, of other blocks
  std::vector<double> other;
  std::set<int> blocks;
  for (const Json& f : at(neighborhood, "eigenfunctions")) {
    const double modulus =
        std::hypot(number(at(at(f, "value"), 0)).value_or(0), number(at(at(f, "value"), 1)).value_or(0));
    const std::vector<double> heights = heights_of(f, net);
    if (heights.empty() || std::abs(modulus - *mu) > 1e-4 * *mu) continue;
    const int block = whole(at(f, "block"), -1), folded = std::min(block, n - block);
    if (folded == 0) bowl.push_back(heights);
    if (folded < 2) continue;
    saddle.push_back(heights);
    blocks.insert(folded);
    if (2 * folded == n || saddle.size() > 1) continue;
    // One function of the pair is enough: turned by a sector it is cos(a) fc + sin(a) fs with a = 2 pi k/n.
    const double angle = 2 * std::numbers::pi * folded / n;
    other = turned_by_a_sector(heights, net, n);
    for (std::size_t v = 0; v < other.size(); ++v)
      other[v] = (other[v] - std::cos(angle) * heights[v]) / std::sin(angle);
  }
  if (saddle.size() == 1 && !other.empty()) saddle.push_back(other);
  if (bowl.size() > 1 || saddle.size() > 2 || blocks.size() > 1 || (bowl.empty() && saddle.empty())) return {};
  const Hessians hessians(net);
  if (hessians.empty()) return {};
  std::vector<Eigen::Vector3d> f0, fc, fs;
  const std::size_t places = hessians.of(std::vector<double>(net.points.size(), 0)).size();
  f0 = fc = fs = std::vector<Eigen::Vector3d>(places, Eigen::Vector3d::Zero());
  if (!bowl.empty()) f0 = hessians.of(bowl[0]), normalize(f0);
  if (!saddle.empty()) fc = hessians.of(saddle[0]), normalize(fc);
  if (saddle.size() > 1) fs = hessians.of(saddle[1]), normalize(fs);

  constexpr int cells = 36;
  constexpr double size = 250, left = 65, top = 18, cell = size / cells;
  std::string parts[3];  // elliptic, hyperbolic, both
  const auto kind_at = [&](int row, int column) {
    const double b = (2. * column + 1) / cells - 1, c = 1 - (2. * row + 1) / cells;
    if (b * b + c * c > 1) return -1;
    const double a = std::sqrt(1 - b * b - c * c);
    bool bowls = true, saddles = true;
    for (std::size_t i = 0; i < places; ++i) {
      const Eigen::Vector3d h = a * f0[i] + b * fc[i] + c * fs[i];
      const double det = h[0] * h[2] - h[1] * h[1], noise = 1e-9 * h.squaredNorm();
      bowls &= det > -noise, saddles &= det < noise;
    }
    return bowls && !saddles ? 0 : saddles && !bowls ? 1 : 2;
  };
  const auto tenths = [&](double pixels) { return static_cast<int>(std::lround(10 * pixels)); };
  for (int row = 0; row < cells; ++row) {
    std::array<int, cells + 1> kinds;
    for (int column = 0; column < cells; ++column) kinds[column] = kind_at(row, column);
    kinds[cells] = -2;
    for (int begin = 0, end = 0; begin < cells; begin = end) {  // runs of one kind
      while (kinds[end] == kinds[begin]) ++end;
      if (kinds[begin] < 0) continue;
      const svg::Spot low{tenths(left + begin * cell), tenths(top + row * cell)},
          high{tenths(left + end * cell), tenths(top + (row + 1) * cell)};
      parts[kinds[begin]] +=
          fmt::format("M{} {}h{}v{}h{}z", low.x, low.y, high.x - low.x, high.y - low.y, low.x - high.x);
    }
  }
  const char* const css[3] = {"minus-soft", "plus-soft", "mix-soft"};
  std::string body;
  for (int i = 0; i < 3; ++i)
    if (!parts[i].empty())
      body += "<path transform=\"scale(.1)\" class=\"" + std::string(css[i]) + "\" d=\"" + parts[i] + "\"/>\n";
  body += "<circle cx=\"190\" cy=\"143\" r=\"125\" class=\"frame\"/>";
  if (!parts[0].empty()) body += text(190, 147, "bowls", {"middle", nullptr});
  if (!parts[1].empty()) body += text(190, 38, "saddles", {"middle", nullptr});
  Legend items;
  const char* const words[3] = {"elliptic", "hyperbolic", "both in one surface"};
  for (int i = 0; i < 3; ++i)
    if (!parts[i].empty()) items.emplace_back(swatch(css[i]), words[i]);
  Json drawn = figure(drawing(380, 286, "Shape chart, " + name, "", body), items);
  drawn["bowls"] = !bowl.empty();
  drawn["saddles"] = !saddle.empty();
  return drawn;
}

}  // namespace sublimit::page
