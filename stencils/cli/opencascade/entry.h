// SPDX-License-Identifier: Apache-2.0
#pragma once
// The part of the program that needs OpenCASCADE: a library that is loaded on first use.
#include <string>

#include "sublimit/cad/boundary_model.h"
#include "sublimit/cad/opencascade/write_cad.h"

namespace sublimit::cli {

constexpr const char* opencascade_library = "libsublimit_opencascade.so";
constexpr const char* cad_file_entry = "sublimit_cad_file";
/// Type of the function `cad_file_entry`, which sets `file` to the result of `cad_file`.
using CadFileEntry = void(const BoundaryModel& model, const std::string& name, bool step, CadFile& file);

}  // namespace sublimit::cli
