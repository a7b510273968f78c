// SPDX-License-Identifier: Apache-2.0
#pragma once
// The parts of the compiled module, each in the file of its name. They take what the package has checked and give
// arrays; signatures are in sublimit/_sublimit.pyi.
#include <pybind11/pybind11.h>

namespace sublimit::python {

void add_errors(pybind11::module_& m);
void add_meshes(pybind11::module_& m);
void add_schemes(pybind11::module_& m);
void add_own_sites(pybind11::module_& m);
void add_own_schemes(pybind11::module_& m);
void add_levels(pybind11::module_& m);
void add_surfaces(pybind11::module_& m);
void add_gpus(pybind11::module_& m);
void add_tables(pybind11::module_& m);
void add_constructions(pybind11::module_& m);
void add_curves(pybind11::module_& m);
void add_reports(pybind11::module_& m);
void add_fits(pybind11::module_& m);
void add_parts(pybind11::module_& m);
void add_scenes(pybind11::module_& m);

}  // namespace sublimit::python
