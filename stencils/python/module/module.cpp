// SPDX-License-Identifier: Apache-2.0
#include "module.h"

#include "sublimit/base/version.h"

PYBIND11_MODULE(_sublimit, m) {
  using namespace sublimit::python;
  m.doc() = "The compiled part of sublimit. Use the package.";
  m.attr("__version__") = sublimit::version();
  m.def("version", &sublimit::version,
        "The version of the library as text, ``major.minor.patch``; also `__version__`.");
  add_errors(m);
  add_meshes(m);
  add_own_sites(m);
  add_own_schemes(m);
  add_schemes(m);
  add_levels(m);
  add_surfaces(m);
  add_gpus(m);
  add_tables(m);
  add_curves(m);
  add_constructions(m);
  add_reports(m);
  add_fits(m);
  add_parts(m);
  add_scenes(m);
}
