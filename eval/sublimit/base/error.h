// SPDX-License-Identifier: Apache-2.0
#pragma once
// Errors. Broken input throws when it is first checked, with a message that says what is wrong, where, and what would
// be right. Every error has a code; the program maps it to an exit status, the C interface to a return value:
//
//   try {
//     write_mesh("fine.obj", refine(read_mesh("coarse.obj"), "loop", 2));
//   } catch (const Error& error) {
//     std::cerr << error.what() << "\n";
//     return exit_status(error.code());
//   }
#include <stdexcept>
#include <string>
#include <string_view>

namespace sublimit {

/// Kind of an error, one for each class below.
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

/// Base class of all errors of sublimit. Other exceptions, such as `std::bad_alloc`, come from the standard library or
/// from functions of the caller.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ErrorCode code() const noexcept { return code_; }  ///< kind of the error

 private:
  ErrorCode code_;
};

/// Thrown for connectivity or positions that no scheme can take: an index out of range, a face with two corners.
struct InvalidMesh : Error {
  explicit InvalidMesh(const std::string& message) : Error(ErrorCode::invalid_mesh, message) {}
};
/// Thrown for a valid mesh that this scheme cannot take: a quadrilateral given to Loop.
struct UnsupportedTopology : Error {
  explicit UnsupportedTopology(const std::string& message) : Error(ErrorCode::unsupported_topology, message) {}
};
/// Thrown for an unknown scheme, an unknown option, or a value of an option outside its range.
struct InvalidOption : Error {
  explicit InvalidOption(const std::string& message) : Error(ErrorCode::invalid_option, message) {}
};
/// Thrown for an argument outside its range: a negative level, an array of the wrong length.
struct InvalidParameter : Error {
  explicit InvalidParameter(const std::string& message) : Error(ErrorCode::invalid_parameter, message) {}
};
/// Thrown for a file that cannot be parsed. For text files the message starts with file:line.
struct FormatError : Error {
  explicit FormatError(const std::string& message) : Error(ErrorCode::format_error, message) {}
};
/// Thrown for a local matrix whose powers have no limit: eigenvalue 1 is not simple and dominant, or the neighbourhood
/// is not closed.
struct AnalysisError : Error {
  explicit AnalysisError(const std::string& message) : Error(ErrorCode::analysis_error, message) {}

 protected:
  AnalysisError(ErrorCode code, const std::string& message) : Error(code, message) {}
};
/// Thrown for a file that cannot be opened, read or written, and for a GPU that is lost.
struct IoError : Error {
  explicit IoError(const std::string& message) : Error(ErrorCode::io_error, message) {}
};
/// Thrown if memory, disk space or 32-bit indices do not suffice; often predicted before memory is taken.
struct ResourceError : Error {
  explicit ResourceError(const std::string& message) : Error(ErrorCode::resource_error, message) {}
};

/// Returns the exit status of the program for an error of this code (stencils/README.md, "Exit codes").
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
