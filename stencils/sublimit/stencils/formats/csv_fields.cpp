// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/formats/csv_fields.h"

#include <cmath>

#include "sublimit/base/detail/format_number.h"

namespace sublimit {

void append_place(std::string& out, const Place& place) {
  append_number(out, place.face);
  out += ',';
  append_number(out, place.u);
  out += ',';
  append_number(out, place.v);
}

void append_fields(std::string& out, const double* numbers, int count, bool exist) {
  for (int i = 0; i < count; ++i) {
    out += ',';
    if (exist && std::isfinite(numbers[i])) append_number(out, numbers[i]);
  }
}

void append_point(std::string& out, const Points& points, Eigen::Index row) {
  append_fields(out, points.data() + 3 * row, 3);
}

void append_normal(std::string& out, const Points& normals, Eigen::Index row) {
  append_fields(out, normals.data() + 3 * row, 3, !normals.row(row).isZero(0));
}

std::vector<std::int64_t> owners_of_rows(const std::vector<std::int64_t>& first) {
  std::vector<std::int64_t> owners;
  for (size_t i = 0; i + 1 < first.size(); ++i) owners.resize(size_t(first[i + 1]), std::int64_t(i));
  return owners;
}

}  // namespace sublimit
