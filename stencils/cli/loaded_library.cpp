// SPDX-License-Identifier: Apache-2.0
#include "loaded_library.h"

#include <dlfcn.h>
#include <fmt/core.h>

#include <string_view>

#include "sublimit/base/error.h"

namespace sublimit::cli {

void* loaded_function(const OptionalPart& part, const char* library, const char* function, const char* makes) {
  void* const loaded = ::dlopen(library, RTLD_NOW);
  void* const entry = loaded ? ::dlsym(loaded, function) : nullptr;
  if (entry) return entry;
  const std::string_view why = ::dlerror();
  // A library that is there, or one that it needs, is named first with its whole path or its own name.
  if (!loaded && why.substr(0, std::string_view(library).size()) == library)
    throw InvalidOption(
        fmt::format("{} need a part that is not here: {} is neither beside the program nor where it was installed; {}",
                    makes, library, how_to_build(part)));
  throw IoError(fmt::format("cannot load {}, which makes {}: {}", library, makes, why));
}

}  // namespace sublimit::cli
