// SPDX-License-Identifier: Apache-2.0
// Classical curves and surfaces by recipes.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <string>

#include "calls.h"
#include "module.h"
#include "sources.h"
#include "sublimit/stencils/recipes/construct.h"

namespace sublimit::python {

void add_constructions(pybind11::module_& m) {
  namespace py = pybind11;
  const py::call_guard<LongCall> long_call;
  py::class_<Construction, std::shared_ptr<Construction>>(m, "Construction")
      .def(py::init([](const std::string& recipe) { return construct(recipe); }), py::arg("recipe"), long_call)
      .def_property_readonly("names", &Construction::names)
      .def_property_readonly("notes", &Construction::notes)
      .def(
          "surfaces", [](const Construction& c) { return std::make_shared<PatchSurfaces>(c.surfaces()); }, long_call)
      .def(
          "curves", [](const Construction& c) { return std::make_shared<Curves>(c.curves()); }, long_call)
      .def("write", &Construction::write, py::arg("path"), long_call);
}

}  // namespace sublimit::python
