// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/swept.h"

#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/patches/constructions/common_space.h"
#include "sublimit/patches/constructions/interpolation.h"

namespace sublimit {

SplineNet translational(CurveNet c, CurveNet d, const Eigen::RowVector3d& origin) {
  check_space_curve(c, "c");
  check_space_curve(d, "d");
  CurveNet* const both[] = {&c, &d};
  const Coordinates coordinates = make_alike(both);
  const bool rational = coordinates == Coordinates::homogeneous;
  const Index m = c.knots.num_points(), n = d.knots.num_points();
  Points columns(Eigen::Index{m} * n, c.columns.cols());
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < m; ++i) {
      const double w = rational ? c.columns(i, 3) : 1, z = rational ? d.columns(j, 3) : 1;
      auto column = columns.row(Eigen::Index{j} * m + i);
      column.head(3) = z * c.columns.row(i).head(3) + w * d.columns.row(j).head(3) - w * z * origin;
      if (rational) column[3] = w * z;
    }
  return spline_net(c.knots, d.knots, std::move(columns), coordinates);
}

SplineNet sweep(const CurveNet& section, const Knots<double>& path, const Points& origins,
                std::span<const Eigen::Matrix3d> matrices) {
  check_space_curve(section, "section");
  const Index m = section.knots.num_points(), n = path.num_points();
  if (origins.rows() != n || origins.cols() != 3)
    throw InvalidParameter(format_number(origins.rows()) + " origins: " + format_number(n) + " are needed");
  if (std::ssize(matrices) != n)
    throw InvalidParameter(format_number(matrices.size()) + " matrices: " + format_number(n) + " are needed");
  const bool rational = section.coordinates == Coordinates::homogeneous;
  Points columns(Eigen::Index{m} * n, section.columns.cols());
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < m; ++i) {
      const double w = rational ? section.columns(i, 3) : 1;
      auto column = columns.row(Eigen::Index{j} * m + i);
      column.head(3) =
          w * origins.row(j) + section.columns.row(i).head(3) * matrices[static_cast<size_t>(j)].transpose();
      if (rational) column[3] = w;
    }
  return spline_net(section.knots, path, std::move(columns), section.coordinates);
}

SplineNet loft(std::vector<CurveNet> sections, int degree_v, std::span<const double> parameters) {
  if (sections.empty() || sections.size() != parameters.size())
    throw InvalidParameter(format_number(parameters.size()) + " parameters for " + format_number(sections.size()) +
                           " sections: one is needed for each");
  std::vector<CurveNet*> all;
  for (size_t k = 0; k < sections.size(); ++k) {
    check_space_curve(sections[k], "section " + format_number(k));
    all.push_back(&sections[k]);
  }
  const Coordinates coordinates = make_compatible(all);
  const Knots<double> v = averaged_knots(degree_v, parameters);
  // Along v for each control point of the sections at once: a row of values is a section.
  const Eigen::Index m = sections[0].columns.rows(), width = sections[0].columns.cols();
  Points values(std::ssize(sections), m * width);
  for (size_t k = 0; k < sections.size(); ++k)
    values.row(Eigen::Index(k)) = sections[k].columns.reshaped<Eigen::RowMajor>();
  const Points net = interpolating_points(v, parameters, values);
  return spline_net(sections[0].knots, v, net.reshaped<Eigen::RowMajor>(net.rows() * m, width), coordinates);
}

}  // namespace sublimit
