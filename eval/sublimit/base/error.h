// SPDX-License-Identifier: Apache-2.0
#pragma once
// Errors. Broken input throws once, at the door, with a message that says what is wrong, where, and what would be
// right. Every error carries a code; the program maps a code to its exit status, the C interface to its return value.
#include <stdexcept>
#include <string>
#include <string_view>

namespace sublimit {

enum class ErrorCode {
  invalid_mesh,
  unsupported_topology,
  invalid_option,
  invalid_parameter,
  format_error,
  analysis_error,
  io_error,
  resource_error,
};

/// Base of everything that sublimit throws on purpose.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

/// Connectivity or positions that no scheme could take: an index out of range, a face with two corners.
struct InvalidMesh : Error {
  explicit InvalidMesh(const std::string& message) : Error(ErrorCode::invalid_mesh, message) {}
};
/// A valid mesh that this scheme cannot take: a quad given to Loop.
struct UnsupportedTopology : Error {
  explicit UnsupportedTopology(const std::string& message) : Error(ErrorCode::unsupported_topology, message) {}
};
/// An unknown scheme, an unknown option or a value outside its range.
struct InvalidOption : Error {
  explicit InvalidOption(const std::string& message) : Error(ErrorCode::invalid_option, message) {}
};
/// An argument outside its range: a negative level, an array of the wrong length.
struct InvalidParameter : Error {
  explicit InvalidParameter(const std::string& message) : Error(ErrorCode::invalid_parameter, message) {}
};
/// A file that cannot be understood; the message starts with file:line where there is one.
struct FormatError : Error {
  explicit FormatError(const std::string& message) : Error(ErrorCode::format_error, message) {}
};
/// A local matrix whose spectrum has no limit: eigenvalue 1 not simple and dominant, a neighbourhood that is not
/// closed.
struct AnalysisError : Error {
  explicit AnalysisError(const std::string& message) : Error(ErrorCode::analysis_error, message) {}
};
/// A file that cannot be opened, read or written.
struct IoError : Error {
  explicit IoError(const std::string& message) : Error(ErrorCode::io_error, message) {}
};
/// More memory, disk or 32-bit indices than there are, predicted or met.
struct ResourceError : Error {
  explicit ResourceError(const std::string& message) : Error(ErrorCode::resource_error, message) {}
};

/// Exit status of the program for an error of this code (stencils/README.md, "Exit codes").
constexpr int exit_status(ErrorCode code) {
  switch (code) {
    case ErrorCode::invalid_option:
    case ErrorCode::invalid_parameter:
      return 2;
    case ErrorCode::resource_error:
      return 4;
    case ErrorCode::analysis_error:
      return 70;
    default:
      return 3;
  }
}

}  // namespace sublimit
