// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fields that files of samples, nearest points and hits share. Fields of values that do not exist are empty.
#include <cstdint>
#include <string>
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/source/address.h"

namespace sublimit {

/// Appends `face,u,v`.
void append_place(std::string& out, const Place& place);
/// Appends numbers, each after a comma. Fields of numbers that are not finite are empty; all are if `exist` is
/// false.
void append_fields(std::string& out, const double* numbers, int count, bool exist = true);
/// Appends the coordinates of a row, each after a comma.
void append_point(std::string& out, const Points& points, Eigen::Index row);
/// Appends the fields of a normal; empty ones if it is zero, which means undefined.
void append_normal(std::string& out, const Points& normals, Eigen::Index row);
/// Returns the owner of each row, where owner i has rows [first[i], first[i + 1]).
std::vector<std::int64_t> owners_of_rows(const std::vector<std::int64_t>& first);

}  // namespace sublimit
