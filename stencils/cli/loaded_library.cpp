// SPDX-License-Identifier: Apache-2.0
#include "loaded_library.h"

#include <dlfcn.h>
#include <fmt/core.h>

#include "sublimit/base/error.h"

namespace sublimit::cli {

void* loaded_function(const char* library, const char* function, const char* makes) {
  void* const loaded = ::dlopen(library, RTLD_NOW);
  void* const entry = loaded ? ::dlsym(loaded, function) : nullptr;
  if (!entry)
    throw IoError(
        fmt::format("cannot load {}, which makes {}: {}; it should lie where the program was installed with it",
                    library, makes, ::dlerror()));
  return entry;
}

}  // namespace sublimit::cli
