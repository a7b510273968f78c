// SPDX-License-Identifier: Apache-2.0
#include "loaded_library.h"

#include <dlfcn.h>
#include <fmt/core.h>

#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "sublimit/base/error.h"

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

/// A library as dlopen finds it. Its initialisers run in there, and no exception leaves dlopen: those of OpenCASCADE,
/// which are no std::exception, are thrown for a lack of memory and end the process. They do as std::bad_alloc does.
class LoadedLibrary {
 public:
  explicit LoadedLibrary(const char* name) : own_(std::set_terminate(end)) {
    before_ = own_;
    try {
      handle_ = ::dlopen(name, RTLD_NOW);
    } catch (const std::exception&) {
      std::set_terminate(own_);
      throw;
    } catch (...) {
      std::set_terminate(own_);
      throw std::bad_alloc();
    }
    std::set_terminate(own_);
  }
  void* handle() const { return handle_; }

 private:
  [[noreturn]] static void end() {
    try {
      if (std::current_exception()) throw;
    } catch (const std::exception&) {
      before_();
    } catch (...) {
      try {
        throw std::bad_alloc();
      } catch (...) {
        before_();
      }
    }
    before_();
    std::abort();
  }
  std::terminate_handler own_;
  void* handle_ = nullptr;
  static inline std::terminate_handler before_ = nullptr;  // the program loads one library at a time
};

}  // namespace

void* loaded_function(const OptionalPart& part, const char* library, const char* function, const char* makes) {
  void* const loaded = LoadedLibrary(library).handle();
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
