// SPDX-License-Identifier: Apache-2.0
#pragma once
// Errors of the system on files, as `ResourceError` (a full disk, no memory) or `IoError` (all others).
#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "sublimit/base/error.h"

namespace sublimit {

/// Throws an error with the message "PATH: cannot ACTION: MESSAGE OF THE SYSTEM; REMEDY".
/// @param number  errno of the failed call
/// @throws ResourceError  no space, quota, file size or memory left;  IoError  anything else
[[noreturn]] inline void throw_file_error(const std::filesystem::path& path, std::string_view action, int number,
                                          std::string_view remedy = {}) {
  std::string message =
      path.string() + ": cannot " + std::string(action) + ": " + std::generic_category().message(number);
  if (number == ENOSPC || number == EFBIG || number == EDQUOT) {
    throw ResourceError(message + "; free some space or write elsewhere");
  }
  if (number == ENOMEM) throw ResourceError(message);
  if (!remedy.empty()) message += "; " + std::string(remedy);
  throw IoError(message);
}

}  // namespace sublimit
