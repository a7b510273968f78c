// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fields at places, from and to CSV files of any length:
//
//   in    x,y,z
//   out   x,y,z,value,gx,gy,gz,hxx,hxy,hxz,hyy,hyz,hzz,nx,ny,nz,gauss,mean
//
// What does not exist is an empty field: derivatives where two arguments of a minimum tie, normals where the gradient
// is zero. The mean curvature of a sphere with outward normals is -1/r.
#include <cstdint>
#include <filesystem>
#include <functional>

#include "sublimit/implicit/field.h"

namespace sublimit {

/// @return  rows that were written
/// @throws FormatError  rows that are no places, with file:line; a place where the field is not finite;  IoError
std::int64_t write_field_samples(const std::filesystem::path& in, const std::filesystem::path& out, const Field& field,
                                 const std::function<void(std::int64_t)>& progress = {});

}  // namespace sublimit
