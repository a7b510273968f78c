// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/files/field_samples.h"

#include <cmath>
#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/formats/csv_rows.h"
#include "sublimit/stencils/formats/row_file.h"

namespace sublimit {
namespace {

/// Numbers after a comma each, or only the commas.
template <class Numbers>
void append_numbers(std::string& row, const Numbers& numbers, bool there) {
  for (Eigen::Index i = 0; i < numbers.size(); ++i) {
    row += ',';
    if (there) append_number(row, numbers[i] + 0.);  // -0 is 0
  }
}

}  // namespace

std::int64_t write_field_samples(const std::filesystem::path& in, const std::filesystem::path& out, const Field& field,
                                 const std::function<void(std::int64_t)>& progress) {
  constexpr std::int64_t told = 10'000;
  CsvRows rows(in, {"x", "y", "z"});
  RowFile file(out, "x,y,z,value,gx,gy,gz,hxx,hxy,hxz,hyy,hyz,hzz,nx,ny,nz,gauss,mean\n");
  std::int64_t count = 0;
  for (; rows.next(); ++count) {
    if (progress && count % told == 0) progress(count);
    const Eigen::Vector3d x(rows.finite(0), rows.finite(1), rows.finite(2));
    const FieldJet jet = field.jet(x);
    if (!std::isfinite(jet.value))
      throw FormatError(rows.place() + "the field is " + format_number(jet.value) + " there; it should be a number");
    std::string row;
    for (int i = 0; i < 3; ++i) append_number(row, x[i]), row += ',';
    append_number(row, jet.value + 0.);
    const Eigen::Matrix3d& H = jet.hessian;
    Eigen::Matrix<double, 6, 1> upper;
    upper << H(0, 0), H(0, 1), H(0, 2), H(1, 1), H(1, 2), H(2, 2);
    const std::optional<Eigen::Vector3d> normal = level_normal(jet);
    const std::optional<LevelCurvature> curvature = level_curvature(jet);
    append_numbers(row, jet.gradient, jet.order >= 1 && jet.gradient.allFinite());
    append_numbers(row, upper, jet.order >= 2 && upper.allFinite());
    append_numbers(row, normal.value_or(Eigen::Vector3d::Zero()), normal.has_value());
    append_numbers(row, curvature ? Eigen::Vector2d(curvature->gauss, curvature->mean) : Eigen::Vector2d::Zero().eval(),
                   curvature.has_value());
    file.write(row + "\n");
  }
  file.commit();
  return count;
}

}  // namespace sublimit
