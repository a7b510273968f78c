// SPDX-License-Identifier: Apache-2.0
// Errors of the library as those of the package, which sublimit/_errors.py defines by their codes.
#include "sublimit/base/error.h"

#include "module.h"

namespace sublimit::python {
namespace {

void raise(ErrorCode code, const char* message) {
  namespace py = pybind11;
  const py::object type = py::module_::import("sublimit._errors").attr("by_code")(int(code));
  PyErr_SetString(type.ptr(), message);
}

}  // namespace

void add_errors(pybind11::module_& m) {
  // In the order of ErrorCode.
  m.attr("error_codes") =
      pybind11::make_tuple("invalid_mesh", "unsupported_topology", "invalid_option", "invalid_parameter",
                           "format_error", "analysis_error", "io_error", "resource_error");
  pybind11::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      raise(error.code(), error.what());
    }
  });
}

}  // namespace sublimit::python
