// SPDX-License-Identifier: Apache-2.0
#include "support/loaded_library.h"

#include <dlfcn.h>
#include <fmt/core.h>

#include <exception>
#include <new>
#include <string_view>

#include "sublimit/base/detail/terminate_as_bad_alloc.h"
#include "sublimit/base/error.h"
#include "sublimit/base/version.h"

namespace sublimit::cli {
namespace {

/// The version that the library of a part says that it has; they share types, so that another one must not be used.
void check_version(void* loaded, const char* library) {
  const auto* const version = static_cast<const char*>(::dlsym(loaded, "sublimit_part_version"));
  if (version && std::string_view(version) == SUBLIMIT_VERSION) return;
  Dl_info place{};
  const bool is_known = version && ::dladdr(version, &place) != 0;
  throw IoError(fmt::format("{} is of {}, and this program is of sublimit {}: both must be of one version; {}",
                            is_known ? place.dli_fname : library,
                            version ? fmt::format("sublimit {}", version) : "an unknown version", SUBLIMIT_VERSION,
                            "look whether LD_LIBRARY_PATH names the folder of another one"));
}

/// Whether the exception that is handled is none of the standard library's: OpenCASCADE's, for a lack of memory.
bool is_foreign() {
  try {
    throw;
  } catch (const std::exception&) {
    return false;
  } catch (...) {
    return true;
  }
}

/// A library as dlopen finds it; null if it does not. Its initialisers run in there, and what OpenCASCADE's throw for a
/// lack of memory ends the process, for no exception leaves dlopen.
void* loaded_library(const char* name) {
  const TerminateAsBadAlloc<is_foreign> named;
  try {
    return ::dlopen(name, RTLD_NOW);
  } catch (const std::exception&) {
    throw;
  } catch (...) {
    throw std::bad_alloc();
  }
}

}  // namespace

void* loaded_function(const OptionalPart& part, const char* library, const char* function, const char* makes) {
  void* const loaded = loaded_library(library);
  if (loaded) check_version(loaded, library);
  void* const entry = loaded ? ::dlsym(loaded, function) : nullptr;
  if (entry) return entry;
  const std::string_view why = ::dlerror();
  // A library that is there, or one that it needs, is named first with its whole path or its own name.
  if (!loaded && why.substr(0, std::string_view(library).size()) == library)
    throw InvalidOption(fmt::format(
        "{} need a part that is not here: {} is neither beside the program nor where it was installed; where sublimit "
        "came as Debian packages, install {}; where it was built, {}",
        makes, library, part.package, how_to_build(part)));
  throw IoError(fmt::format("cannot load {}, which makes {}: {}", library, makes, why));
}

}  // namespace sublimit::cli
