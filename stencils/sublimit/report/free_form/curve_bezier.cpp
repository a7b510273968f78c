// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/free_form/curve_bezier.h"

#include "sublimit/patches/detail/free_form_patches.h"

namespace sublimit {
namespace {

/// Columns (x, y, z) or (w x, w y, w z, w) of control points. Of weight 0 they are directions.
template <class T>
std::vector<T> columns_of(const FreeForm& shapes, const FreeFormCurve& curve) {
  std::vector<T> columns;
  for (const Index v : curve.points) {
    const double w = curve.rational ? shapes.weights[size_t(v)] : 1;
    for (Eigen::Index k = 0; k < 3; ++k) columns.push_back(T(w == 0 ? 1 : w) * T(shapes.vertices(v, k)));
    if (curve.rational) columns.push_back(T(w));
  }
  return columns;
}

template <class T>
std::vector<BezierPiece<T>> pieces_of(const Knots<T>& knots, const std::vector<T>& columns, const FreeFormCurve& curve,
                                      std::vector<T>& ends) {
  return bezier_pieces_of(knots, columns, curve.rational, T(curve.u.first), T(curve.u.last), ends);
}

/// Knots of pieces that share nothing, and their control points.
std::pair<Knots<double>, std::vector<double>> separate_pieces(const SegmentBasis& basis,
                                                              const std::vector<double>& columns, int width) {
  const int p = basis.degree();
  std::vector<double> knots, net;
  for (const double t : basis.breaks()) knots.insert(knots.end(), size_t(p) + 1, t);
  for (Index face = 0; face < basis.num_faces(); ++face)
    for (int i = 0; i <= p; ++i)
      for (int k = 0; k < width; ++k) {
        double sum = 0;
        for (int m = 0; m <= p; ++m)
          sum += basis.to_bezier()(i, m) * columns[size_t((basis.first_point(face) + m) * width + k)];
        net.push_back(sum);
      }
  const auto points = static_cast<Index>(net.size()) / width;
  return {Knots<double>::open(p, points, std::move(knots)), std::move(net)};
}

}  // namespace

CurveBezier curve_bezier(const FreeForm& shapes, const FreeFormCurve& curve) {
  CurveBezier result{.pieces = {}, .breaks = {curve.u.first}, .exact = {}};
  const std::vector<double> columns = columns_of<double>(shapes, curve);
  if (curve.basis == FreeFormBasis::bezier || curve.basis == FreeFormBasis::bspline) {
    const Knots<double> knots = free_form_knots(curve.basis, curve.u);
    result.pieces = pieces_of(knots, columns, curve, result.breaks);
    std::vector<Rational> ends;
    result.exact = pieces_of(converted<Rational>(knots), columns_of<Rational>(shapes, curve), curve, ends);
  } else {
    const auto [knots, net] =
        separate_pieces(free_form_segments(shapes, curve.basis, curve.u), columns, curve.rational ? 4 : 3);
    result.pieces = pieces_of(knots, net, curve, result.breaks);
  }
  return result;
}

}  // namespace sublimit
