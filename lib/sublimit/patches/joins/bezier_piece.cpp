// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/joins/bezier_piece.h"

#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit::bezier_piece_detail {

void refuse_column_count(const char* which, std::size_t numbers, std::size_t points, int width) {
  throw InvalidParameter(std::string(which) + ": " + format_number(numbers) + " numbers for " + format_number(points) +
                         " control points" +
                         (width > 0 ? "; " + format_number(points * static_cast<std::size_t>(width)) + " are needed"
                                    : ": every point needs as many"));
}

void refuse_column(const char* which, std::size_t point, double value) {
  throw InvalidParameter(std::string(which) + ": control point " + format_number(point) + " has a coordinate " +
                         format_number(value) + "; coordinates and weights must be finite");
}

void refuse_length(const char* which, double length) {
  throw InvalidParameter(std::string(which) + ": the interval of its parameter has the length " +
                         format_number(length) + "; a length must be positive and finite");
}

void refuse_dimensions(int left, int right) {
  throw InvalidParameter("the pieces have points of " + format_number(left) + " and " + format_number(right) +
                         " coordinates; they must be in one space");
}

}  // namespace sublimit::bezier_piece_detail
