// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/fairness.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/integrals/detail/quadrature.h"

namespace sublimit {
namespace {

/// A part of a square or triangle without a jump inside, as it may be: corner, and sides.
struct Cell {
  Eigen::Vector2d corner, a, b;
  bool triangle = false;
};

/// How second derivatives along the parameters become those of the natural plane.
struct Metric {
  double area = 1;       ///< of du dv
  double uv[2][2] = {};  ///< (x, y) from (u, v)
  double uu[3][3] = {};  ///< (xx, xy, yy) from (uu, uv, vv)
};

Metric square_metric(const FaceLengths& sides) {
  const double u = 1 / sides.u, v = 1 / sides.v;
  return {sides.u * sides.v, {{u, 0}, {0, v}}, {{u * u, 0, 0}, {0, u * v, 0}, {0, 0, v * v}}};
}

/// x = u + v/2, y = sqrt(3)/2 v.
Metric triangle_metric() {
  const double r = std::sqrt(3.0);
  return {r / 2, {{1, 0}, {-1 / r, 2 / r}}, {{1, 0, 0}, {-1 / r, 2 / r, 0}, {1. / 3, -4. / 3, 4. / 3}}};
}

bool jumps(const LinearSource& surface, Index address, const Eigen::Vector2d& at) {
  return surface.stencil({address, at.x(), at.y()}, 2).status == LimitStatus::unbounded_second;
}

/// Polynomials of dual schemes meet at the middle of a quadrilateral, those of four-direction splines on the diagonals
/// too. The surface tells by what it says of places there.
std::vector<Cell> cells(const LinearSource& surface, Index address) {
  if (surface.faces().triangles) return {{{0, 0}, {1, 0}, {0, 1}, true}};
  constexpr double off = 5. / 16;  // where nothing else is
  const int halves = jumps(surface, address, {0.5, off}) ? 2 : 1;
  const double side = 1. / halves;
  std::vector<Cell> result;
  for (int j = 0; j < halves; ++j)
    for (int i = 0; i < halves; ++i) {
      const Eigen::Vector2d o(i * side, j * side), x(side, 0), y(0, side);
      if (jumps(surface, address, o + off * (x + y))) {
        result.push_back({o, x, x + y, true});
        result.push_back({o, x + y, y, true});
      } else if (jumps(surface, address, o + off * x + (1 - off) * y)) {
        result.push_back({o, x, y, true});
        result.push_back({o + x + y, -x, -y, true});
      } else {
        result.push_back({o, x, y, false});
      }
    }
  return result;
}

/// Energy of one address over the vertices that it depends on.
struct LocalEnergy {
  std::vector<Index> vertices;  ///< ascending
  Eigen::MatrixXd H;
  bool has_second = false;
};

class Assembly {
 public:
  Assembly(const LinearSource& surface, const Fairness& fairness)
      : surface_(surface),
        fairness_(fairness),
        square_(square_rule(fairness.quadrature)),
        triangle_(triangle_rule(fairness.quadrature)) {}

  LocalEnergy local(Index address) const {
    LocalEnergy energy;
    const bool triangles = surface_.faces().triangles;
    if (surface_.stencil({address, triangles ? 0.3125 : 0.4375, 0.3125}).status == LimitStatus::hole) return energy;
    const Metric metric = triangles ? triangle_metric() : square_metric(surface_.lengths(address));
    const int order = fairness_.thin_plate > 0 ? 2 : 1;
    std::vector<LimitStencil> stencils;
    std::vector<double> weights;
    for (const Cell& cell : cells(surface_, address)) {
      const double area = std::abs(cell.a.x() * cell.b.y() - cell.a.y() * cell.b.x());
      for (const QuadraturePoint& p : cell.triangle ? triangle_ : square_) {
        const Eigen::Vector2d at = cell.corner + p.u * cell.a + p.v * cell.b;
        stencils.push_back(surface_.stencil({address, at.x(), at.y()}, order));
        weights.push_back(p.weight * area * metric.area);
        const std::vector<Index>& v = stencils.back().vertices;
        energy.vertices.insert(energy.vertices.end(), v.begin(), v.end());
      }
    }
    std::sort(energy.vertices.begin(), energy.vertices.end());
    energy.vertices.erase(std::unique(energy.vertices.begin(), energy.vertices.end()), energy.vertices.end());
    // H = B^T B, the rows of B scaled derivatives.
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(Eigen::Index(5 * stencils.size()), Eigen::Index(energy.vertices.size()));
    for (size_t k = 0; k < stencils.size(); ++k) {
      const LimitStencil& stencil = stencils[k];
      const Eigen::Index row = Eigen::Index(5 * k);
      const double m = std::sqrt(weights[k] * fairness_.membrane), t = std::sqrt(weights[k] * fairness_.thin_plate);
      const bool second = stencil.weights.rows() == 6;
      energy.has_second |= second;
      for (size_t j = 0; j < stencil.vertices.size(); ++j) {
        const auto at = std::lower_bound(energy.vertices.begin(), energy.vertices.end(), stencil.vertices[j]);
        const Eigen::Index column = at - energy.vertices.begin();
        const auto w = stencil.weights.col(Eigen::Index(j));
        if (stencil.weights.rows() >= 3)
          for (int i = 0; i < 2; ++i) B(row + i, column) = m * (metric.uv[i][0] * w[1] + metric.uv[i][1] * w[2]);
        if (second)
          for (int i = 0; i < 3; ++i)
            B(row + 2 + i, column) = (i == 1 ? std::sqrt(2.0) : 1.0) * t *
                                     (metric.uu[i][0] * w[3] + metric.uu[i][1] * w[4] + metric.uu[i][2] * w[5]);
      }
    }
    energy.H = Eigen::MatrixXd::Zero(B.cols(), B.cols());
    energy.H.selfadjointView<Eigen::Lower>().rankUpdate(B.transpose());
    energy.H.triangularView<Eigen::StrictlyUpper>() = energy.H.transpose();
    return energy;
  }

 private:
  const LinearSource& surface_;
  const Fairness& fairness_;
  std::vector<QuadraturePoint> square_, triangle_;
};

/// Sum of the parts, every entry in the order of the addresses.
SparseMatrix sum(const std::vector<LocalEnergy>& parts, Index n) {
  struct Slot {
    Index part, row;
  };
  std::vector<std::vector<Slot>> of_vertex(n);
  for (size_t a = 0; a < parts.size(); ++a)
    for (size_t i = 0; i < parts[a].vertices.size(); ++i)
      of_vertex[parts[a].vertices[i]].push_back({static_cast<Index>(a), static_cast<Index>(i)});
  std::vector<std::vector<std::pair<Index, double>>> rows(n);
  parallel_for_blocks(
      n,
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        std::vector<double> values(n, 0.0);
        std::vector<Index> columns;
        std::vector<bool> met(n, false);
        for (std::int64_t v = begin; v < end; ++v) {
          columns.clear();
          for (const Slot& p : of_vertex[v]) {
            const LocalEnergy& part = parts[p.part];
            for (size_t j = 0; j < part.vertices.size(); ++j) {
              const Index c = part.vertices[j];
              if (!met[c]) {
                met[c] = true;
                columns.push_back(c);
              }
              values[c] += part.H(p.row, Eigen::Index(j));
            }
          }
          std::sort(columns.begin(), columns.end());
          for (const Index c : columns) {
            rows[v].push_back({c, values[c]});
            values[c] = 0;
            met[c] = false;
          }
        }
      },
      std::max<std::int64_t>(256, n / 64));
  SparseMatrix H(n, n);
  double entries = 0;
  for (const auto& row : rows) entries += double(row.size());
  if (entries > double(std::numeric_limits<Index>::max()))
    throw ResourceError("an energy of " + std::to_string(std::int64_t(entries)) +
                        " entries, more than 32-bit indices count");
  H.reserve(Eigen::Index(entries));
  for (Index v = 0; v < n; ++v) {
    H.startVec(v);
    for (const auto& [column, value] : rows[v]) H.insertBack(v, column) = value;
  }
  H.finalize();
  return H;
}

void check(const Fairness& f) {
  const auto weight = [](double w, const char* name) {
    if (!(w >= 0) || !std::isfinite(w))
      throw InvalidParameter("the weight of " + std::string(name) + " energy is " + format_number(w) +
                             "; it must be a number >= 0");
  };
  weight(f.thin_plate, "thin plate");
  weight(f.membrane, "membrane");
  if (f.quadrature < 1 || f.quadrature > 8)
    throw InvalidParameter(std::to_string(f.quadrature) + " quadrature points a side; there are rules of 1 to 8");
}

}  // namespace

SparseMatrix fairness_energy(const LinearSource& surface, const Fairness& fairness) {
  check(fairness);
  const Index n = surface.num_points(), count = surface.faces().size;
  if (fairness.empty()) return SparseMatrix(n, n);
  const Assembly assembly(surface, fairness);
  std::vector<LocalEnergy> parts(count);
  parallel_for_blocks(
      count,
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t a = begin; a < end; ++a) parts[a] = assembly.local(static_cast<Index>(a));
      },
      16);
  const auto is_present = [](const LocalEnergy& part) { return !part.vertices.empty(); };
  if (fairness.thin_plate > 0 && std::any_of(parts.begin(), parts.end(), is_present) &&
      std::none_of(parts.begin(), parts.end(), [](const LocalEnergy& part) { return part.has_second; }))
    throw InvalidParameter(
        "thin plate energy needs second derivatives, which this surface has at no quadrature point; its membrane "
        "energy "
        "exists");
  return sum(parts, n);
}

}  // namespace sublimit
