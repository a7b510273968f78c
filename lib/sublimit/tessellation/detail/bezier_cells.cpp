// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/detail/bezier_cells.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/nets/net_derivatives.h"

namespace sublimit {
namespace {

/// Polynomials of bidegree d on the triangles below and above u = v, as Bezier triangles of degree 2 d.
class Halves {
 public:
  explicit Halves(const PolynomialBasis& square) : square_(square), triangle_(2 * square.degree(), true) {
    Eigen::MatrixXd values(triangle_.size(), triangle_.size());
    for_each_net_row(triangle_, [&](int i, int j, Eigen::Index row) {
      values.row(row) = triangle_.at(double(i) / triangle_.degree(), double(j) / triangle_.degree(), 0);
    });
    from_values_ = bernstein_from(triangle_) * PivotedLu(values).inverse();
  }
  BezierCell cell(const FlatCell& whole, int half) const {
    BezierCell cell{whole.address, whole.corners, true, true, triangle_.degree(), {}};
    if (half == 1) cell.corners = {whole.corners[0], whole.corners[2], whole.corners[3], whole.corners[3]};
    const NetDerivatives x(square_, whole.whole->nets[size_t(half)], 1);
    Points values(triangle_.size(), 3);
    for_each_net_row(triangle_, [&](int i, int j, Eigen::Index row) {
      const double s = double(i) / triangle_.degree(), t = double(j) / triangle_.degree();
      values.row(row) = (half == 0 ? x.at(s + t, t) : x.at(s, s + t)).x.head<3>();
    });
    cell.net = from_values_ * values;
    return cell;
  }

 private:
  PolynomialBasis square_, triangle_;
  Eigen::MatrixXd from_values_;
};

}  // namespace

BezierCells bezier_cells(const LimitMap& surface, const Points& control, double chord, std::int64_t max_cells) {
  if (!(chord > 0) || !std::isfinite(chord))
    throw InvalidParameter("the chord is " + format_number(chord) + "; a distance above 0 is right");
  const bool triangle = surface.faces().triangles;
  const size_t corners = triangle ? 3 : 4;
  FlatCellOptions options{.chord = chord, .max_triangles = max_cells, .whole_polynomials = true};
  std::vector<FlatCell> flat = flat_cells(surface, control, options);
  BezierCells made;
  std::optional<Halves> halves;
  std::vector<Place> places;  // corners of cells that are no polynomials
  for (FlatCell& cell : flat) {
    if (cell.whole && cell.whole->nets.size() == 2) {
      if (!halves) halves.emplace(cell.whole->basis);
      for (const int half : {0, 1}) made.cells.push_back(halves->cell(cell, half));
    } else if (cell.whole) {
      made.cells.push_back({cell.address, cell.corners, triangle, true, cell.whole->basis.degree(),
                            std::move(cell.whole->nets.front())});
    } else {
      made.bound = std::max(made.bound, cell.bound);
      made.cells.push_back({cell.address, cell.corners, triangle, false, 1, Points(Eigen::Index(corners), 3)});
      for (size_t k = 0; k < corners; ++k) places.push_back(cell.corners[k].in(cell.address));
    }
  }
  const Points points = surface.evaluate(control, places).position;
  Eigen::Index first = 0;
  for (BezierCell& cell : made.cells) {
    if (cell.exact) {
      ++made.exact;
      continue;
    }
    // From counter-clockwise to by i, then j.
    static constexpr std::array<Eigen::Index, 4> square{0, 3, 1, 2};
    static constexpr std::array<Eigen::Index, 3> own_triangle{0, 2, 1};
    for (size_t k = 0; k < corners; ++k)
      cell.net.row(Eigen::Index(k)) = points.row(first + (triangle ? own_triangle[k] : square[k]));
    first += Eigen::Index(corners);
  }
  return made;
}

}  // namespace sublimit
