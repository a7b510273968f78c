// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fields at places, from and to CSV files of any length:
//
//   in    x,y,z
//   out   x,y,z,value,gx,gy,gz,hxx,hxy,hxz,hyy,hyz,hzz,nx,ny,nz,gauss,mean
//
// Fields of values that do not exist are empty: derivatives where two arguments of a minimum tie, normals where
// the gradient is zero. The mean curvature of a sphere with outward normals is -1/r.
#include <cstdint>
#include <filesystem>
#include <functional>

#include "sublimit/implicit/field.h"

namespace sublimit {

/// Evaluates a field at the places of a file, and writes the results.
/// @return  number of rows written
/// @throws FormatError  a row that is not a place, a place where the field is not finite; the message has file
///                      and line
/// @throws IoError      missing, unreadable, unwritable
std::int64_t write_field_samples(const std::filesystem::path& in, const std::filesystem::path& out, const Field& field,
                                 const std::function<void(std::int64_t)>& progress = {});

}  // namespace sublimit
