// SPDX-License-Identifier: Apache-2.0
// Continuity reports, as the text that the program writes; the package makes dictionaries of it.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calls.h"
#include "module.h"
#include "own_schemes.h"
#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/report/analysis/claims_json.h"
#include "sublimit/report/analysis/scheme_report.h"
#include "sublimit/report/asset/asset_json.h"
#include "sublimit/report/page/page.h"
#include "sublimit/stencils/jobs/detail/mesh_job.h"

namespace sublimit::python {
namespace {

std::string scheme_report(const std::string& name, const SchemeOptions& options, const std::vector<int>& valences,
                          const std::vector<std::string>& claims, bool curve, const OwnScheme* own, int threads) {
  const Threads held(threads);
  report::ReportOptions wanted{.valences = valences};
  std::vector<report::ReportedScheme> surfaces;
  if (curve) {
    wanted.curves.push_back({name, options});
  } else {
    if (own)
      surfaces.push_back({*own->scheme, *own->exact});
    else
      surfaces.push_back(report::reported_scheme(name, options));
    for (const std::string& claim : claims) report::set_claim(surfaces[0].scheme.claims, claim);
  }
  return report::report_text(report::schemes_report(surfaces, wanted));
}

std::string mesh_report(const Mesh& mesh, const MeshRequest& request, const std::vector<std::string>& tolerances,
                        const std::string& name, int threads) {
  const Threads held(threads);
  AssetOptions wanted;
  for (const std::string& tolerance : tolerances) read_tolerance(tolerance, wanted.tolerance);
  const MeshJob job = mesh_job(request, mesh, name);
  nlohmann::ordered_json report = report::report_head("mesh");
  report["mesh"] = to_json(asset_report(*job.scheme, job.mesh, job.rules, wanted), name);
  return report::report_text(report);
}

std::string page(const std::string& report) { return report_page(nlohmann::ordered_json::parse(report)); }
std::string picture(const std::string& report) { return report_picture(nlohmann::ordered_json::parse(report)); }

/// The file appears whole or not at all.
void write_text(const std::filesystem::path& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace

void add_reports(pybind11::module_& m) {
  namespace py = pybind11;
  const py::call_guard<LongCall> long_call;
  m.def("scheme_report", &scheme_report, py::arg("scheme"), py::arg("options"), py::arg("valences"), py::arg("claims"),
        py::arg("curve"), py::arg("own"), py::arg("threads"), long_call);
  m.def("mesh_report", &mesh_report, py::arg("mesh"), py::arg("request"), py::arg("tolerances"), py::arg("name"),
        py::arg("threads"), long_call);
  m.def("report_page", &page, py::arg("report"), long_call);
  m.def("report_picture", &picture, py::arg("report"), long_call);
  m.def("write_text", &write_text, py::arg("path"), py::arg("text"), long_call);
}

}  // namespace sublimit::python
