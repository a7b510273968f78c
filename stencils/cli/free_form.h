// SPDX-License-Identifier: Apache-2.0
#pragma once
// Files of free-form curves and surfaces on the command line: they take no scheme.
#include "common.h"
#include "sublimit/io/free_form.h"

namespace sublimit::cli {

/// Whether the file is to be taken as free-form surfaces: no scheme is named.
/// @throws InvalidOption  a file that has none, which needs a scheme
bool is_free_form_job(const Common& common);

/// @throws InvalidOption  options that are of meshes
void refuse_mesh_options(const Common& common);

/// The shapes of the file; its warnings are printed.
FreeForm load_free_form(const Common& common);

}  // namespace sublimit::cli
