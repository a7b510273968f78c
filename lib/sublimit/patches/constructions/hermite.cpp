// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/hermite.h"

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/patches/constructions/power_coefficients.h"

namespace sublimit {

NetBuilder hermite_builder(HermiteVectors vectors) {
  const Eigen::Index width = vectors == HermiteVectors::sixteen ? 16 : 12;
  const auto datum = [&](int what, int corner) { return Eigen::RowVectorXd::Unit(width, 4 * what + corner); };
  // G by functionals in u and v: values at 0 and 1, derivatives at 0 and 1.
  const auto entry = [&](int k, int l) -> Eigen::RowVectorXd {
    const int a = k % 2, b = l % 2, corner = a + 2 * b, what = k / 2 + 2 * (l / 2);
    if (what < 3) return datum(what, corner);
    if (vectors == HermiteVectors::twelve) return Eigen::RowVectorXd::Zero(width);
    if (vectors == HermiteVectors::sixteen) return datum(3, corner);
    return (datum(1, a + 2) - datum(1, a)) + (datum(2, 1 + 2 * b) - datum(2, 2 * b)) -
           (datum(0, 0) - datum(0, 1) - datum(0, 2) + datum(0, 3));
  };
  const Eigen::Matrix4d H = hermite_to_bezier();
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(16, width);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      for (int l = 0; l < 4; ++l)
        for (int k = 0; k < 4; ++k) M.row(4 * j + i) += H(i, k) * H(j, l) * entry(k, l);
  const Knots<double> cubic = bezier_knots<double>(3);
  return {std::make_shared<const SplineSurface>(cubic, cubic), M.sparseView()};
}

SplineNet hermite_patch(HermiteVectors vectors, const Points& data) {
  const NetBuilder builder = hermite_builder(vectors);
  if (data.rows() != builder.M.cols() || data.cols() != 3)
    throw InvalidParameter(format_number(data.rows()) + " vectors of a Hermite patch: " +
                           format_number(builder.M.cols()) + " of 3 coordinates are needed");
  return built(builder, data, Coordinates::plain);
}

}  // namespace sublimit
