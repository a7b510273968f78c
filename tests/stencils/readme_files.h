// SPDX-License-Identifier: Apache-2.0
#pragma once
// Files that command lines in the documents expect.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "meshes/face_varying_meshes.h"
#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "stencils/readme_commands.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/scheme/detail/prepare.h"
#include "sublimit/stencils/formats/npy.h"
#include "sublimit/stencils/patterns/demo_mesh.h"
#include "support/tolerance.h"

namespace sublimit::testing {

/// Makes "sublimit-demo/" by the program.
inline void run_demo(const std::filesystem::path& folder) {
  expect_done(sublimit({"demo", (folder / "sublimit-demo").string()}));
}

inline void write_text(const std::filesystem::path& path, const std::string& text) { std::ofstream(path) << text; }

/// Writes polygon.csv, the corners of a square.
inline void write_polygon(const std::filesystem::path& folder) {
  write_text(folder / "polygon.csv", "0,0\n1,0\n1,1\n0,1\n");
}

/// Returns the jobs of a manifest that a document shows.
inline std::vector<nlohmann::ordered_json> shown_jobs() {
  std::vector<nlohmann::ordered_json> jobs;
  for (const auto& [document, page] : pages())
    for (const CodeBlock& block : page.blocks)
      if (block.lines.front().starts_with("{\"mesh\""))
        for (const std::string& line : block.lines) jobs.push_back(nlohmann::ordered_json::parse(line));
  return jobs;
}

/// Writes cage.obj, the demo's mesh in triangles for every scheme, with texture coordinates; animation.npy,
/// frames of it; the manifest that the text shows, and its meshes.
inline void write_cages(const std::filesystem::path& folder) {
  const Mesh cage = with_channel(triangulated(demo_mesh()), {});
  write_obj(folder / "cage.obj", cage);
  Mesh prim = demo_mesh();
  prim.scheme = "catmull-clark";
  for (const char* const scene : {"scene.usda", "asset.usdz"}) write_mesh(folder / scene, prim);
  const std::int64_t frames = 3;
  NpyWriter animation(folder / "animation.npy", DType::F32, {frames, cage.num_vertices(), 3});
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    std::vector<float> points;
    for (Index v = 0; v < cage.num_vertices(); ++v)
      for (const double x : cage.positions.row(v)) points.push_back(float(x * double(frame + 1)));
    animation.write(std::span<const float>(points));
  }
  animation.commit();
  std::string manifest;
  for (const auto& job : shown_jobs()) {
    write_obj(folder / job["mesh"].get<std::string>(), demo_mesh());
    manifest += job.dump() + "\n";
  }
  write_text(folder / "jobs.jsonl", manifest);
}

/// Writes a cube, and targets with the position and a normal at each corner, as in the picture beside the
/// commands.
inline void write_cube_with_normals(const std::filesystem::path& folder) {
  const Mesh mesh = cube();
  write_obj(folder / "cage.obj", mesh);
  std::ostringstream targets;
  targets << "vertex,x,y,z,nx,ny,nz\n";
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    const Eigen::RowVector3d x = mesh.positions.row(v);
    targets << v << "," << x[0] << "," << x[1] << "," << x[2] << "," << x[0] << "," << x[1] << "," << x[2] << "\n";
  }
  write_text(folder / "normals.csv", targets.str());
}

/// The job array that a script requests from SLURM: `#SBATCH --array=1-8 --cpus-per-task=4`. Without an array:
/// 0 to 0.
struct JobArray {
  int first = 0, last = 0, cpus = 1;

  /// Returns the variables that SLURM sets for a task.
  std::string variables(int task) const {
    return "SLURM_ARRAY_TASK_ID=" + std::to_string(task) +
           " SLURM_ARRAY_TASK_COUNT=" + std::to_string(last - first + 1) +
           " SLURM_CPUS_PER_TASK=" + std::to_string(cpus);
  }
};

inline JobArray job_array(const std::string& script) {
  JobArray array;
  std::smatch found;
  if (std::regex_search(script, found, std::regex(R"(#SBATCH.*--array=(\d+)-(\d+))")))
    array.first = std::stoi(found[1]), array.last = std::stoi(found[2]);
  if (std::regex_search(script, found, std::regex(R"(#SBATCH.*--cpus-per-task=(\d+))")))
    array.cpus = std::stoi(found[1]);
  return array;
}

}  // namespace sublimit::testing
