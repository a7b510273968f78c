// SPDX-License-Identifier: Apache-2.0
#pragma once
// The part of the program that needs OpenCASCADE, as a library that is loaded when it is wanted.
#include <string>

#include "sublimit/cad/boundary_model.h"
#include "sublimit/cad/opencascade/write_cad.h"

namespace sublimit::cli {

constexpr const char* opencascade_library = "libsublimit_opencascade.so";
constexpr const char* cad_file_entry = "sublimit_cad_file";
/// `cad_file`, by a function that has a C name.
using CadFileEntry = void(const BoundaryModel& model, const std::string& name, bool step, CadFile& file);

}  // namespace sublimit::cli
