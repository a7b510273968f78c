// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/free_form_counts.h"

#include "sublimit/base/detail/format_number.h"

namespace sublimit {

std::string_view basis_name(FreeFormBasis basis) {
  switch (basis) {
    case FreeFormBasis::bmatrix:
      return "bmatrix";
    case FreeFormBasis::bezier:
      return "bezier";
    case FreeFormBasis::bspline:
      return "bspline";
    case FreeFormBasis::cardinal:
      return "cardinal";
    case FreeFormBasis::taylor:
      return "taylor";
  }
  return "";
}

FreeFormCounts::FreeFormCounts(FreeFormBasis basis, int degree, Index step)
    : basis_(basis), degree_(degree), first_(degree + 1), stride_(1) {
  if (basis == FreeFormBasis::bezier) stride_ = degree;
  if (basis == FreeFormBasis::taylor) stride_ = degree + 1;
  if (basis == FreeFormBasis::bmatrix) stride_ = step;
}

std::int64_t FreeFormCounts::parameters(std::int64_t points) const {
  return basis_ == FreeFormBasis::bspline ? points + degree_ + 1 : (points - first_) / stride_ + 2;
}

std::int64_t FreeFormCounts::points(std::int64_t parameters) const {
  if (parameters < least_parameters()) return 0;
  return basis_ == FreeFormBasis::bspline ? parameters - degree_ - 1 : first_ + stride_ * (parameters - 2);
}

std::string FreeFormCounts::points_beside(std::int64_t points) const {
  if (points < first_) return format_number(first_);
  const std::int64_t below = points - (points - first_) % stride_;
  return format_number(below) + " or " + format_number(below + stride_);
}

std::string FreeFormCounts::text() const {
  return "a " + std::string(basis_name(basis_)) + " of degree " + format_number(degree_);
}

std::pair<double, double> free_form_domain(FreeFormBasis basis, const FreeFormDirection& direction) {
  const std::vector<double>& t = direction.parameters;
  if (basis != FreeFormBasis::bspline) return {t.front(), t.back()};
  return {t[static_cast<std::size_t>(direction.degree)], t[static_cast<std::size_t>(direction.count)]};
}

std::size_t first_excess_knot(const std::vector<double>& knots, int degree) {
  const auto order = static_cast<std::size_t>(degree) + 1;
  for (std::size_t i = 1; i + order < knots.size(); ++i)
    if (!(knots[i] < knots[i + order - 1])) return i;
  return knots.size();
}

}  // namespace sublimit
