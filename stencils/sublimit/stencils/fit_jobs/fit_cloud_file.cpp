// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/stencils/fit_jobs/fit_job.h"
#include "sublimit/stencils/formats/csv_rows.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit {
namespace {

Cloud from_csv(const std::string& path) {
  CsvRows rows(path, {{"x", "y", "z"}, {"x", "y", "z", "weight"}}, "x,y,z[,weight]");
  Cloud cloud;
  std::vector<double> values;
  while (rows.next()) {
    for (size_t c = 0; c < 3; ++c) values.push_back(rows.finite(c));
    if (rows.columns().size() == 3) continue;
    cloud.weights.push_back(rows.finite(3));
    if (cloud.weights.back() < 0)
      throw FormatError(rows.place() + "weight " + format_number(cloud.weights.back()) + "; it should be 0 or more");
  }
  if (!cloud.weights.empty() && std::ranges::all_of(cloud.weights, [](double w) { return w == 0; }))
    throw FormatError(path + ": all weights are 0; one at least should count");
  if (values.empty()) throw FormatError(path + ": no points after the header; every other line should be one");
  cloud.points = Eigen::Map<const Points>(values.data(), static_cast<Eigen::Index>(values.size() / 3), 3);
  return cloud;
}

}  // namespace

Cloud read_cloud(const std::string& path, std::optional<Index> samples, unsigned seed) {
  if (all_formats().reads(path, contents::rows) || all_formats().reads(path, contents::arrays)) {
    if (samples)
      throw InvalidOption("--samples is for clouds from meshes; a " + file_extension(path) +
                          " has no faces to take points from");
    return from_csv(path);
  }
  Mesh mesh;
  try {
    mesh = read_mesh(path);
  } catch (const FormatError& error) {
    if (std::string_view(error.what()).find("no faces") == std::string_view::npos) throw;
    throw FormatError(std::string(error.what()) + "; points alone can be a .csv with the header x,y,z");
  }
  if (mesh.num_faces() == 0) throw FormatError(path + ": no faces; points alone can be a .csv with the header x,y,z");
  return samples ? cloud_of_faces(mesh, *samples, seed) : cloud_of_vertices(mesh);
}

}  // namespace sublimit
