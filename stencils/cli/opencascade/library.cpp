// SPDX-License-Identifier: Apache-2.0
#include <type_traits>

#include "../support/part_version.h"
#include "entry.h"

extern "C" void sublimit_cad_file(const sublimit::BoundaryModel& model, const std::string& name, bool step,
                                  sublimit::CadFile& file) {
  file = sublimit::cad_file(model, name, step);
}

static_assert(std::is_same_v<decltype(sublimit_cad_file), sublimit::cli::CadFileEntry>);
