// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/graph.h"

#include <utility>
#include <vector>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {

SplineNet functional_surface(const Knots<double>& u, const Knots<double>& v, const Eigen::VectorXd& values) {
  if (u.is_closed() || v.is_closed()) throw InvalidParameter("closed knots: graphs of functions are open");
  const Index m = u.num_points(), n = v.num_points();
  if (values.size() != Eigen::Index{m} * n)
    throw InvalidParameter(format_number(values.size()) + " values: " + format_number(m) + " x " + format_number(n) +
                           " are needed");
  const std::vector<double> g = u.greville(), h = v.greville();
  Points columns(values.size(), 3);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < m; ++i) {
      const Eigen::Index at = Eigen::Index{j} * m + i;
      columns.row(at) << g[size_t(i)], h[size_t(j)], values[at];
    }
  return spline_net(u, v, std::move(columns));
}

}  // namespace sublimit
