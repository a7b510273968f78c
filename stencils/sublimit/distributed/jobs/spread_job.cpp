// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/jobs/spread_job.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>

#include "sublimit/base/error.h"

namespace sublimit {

SpreadJob spread_job(const Ranks& ranks, const MeshRequest& request, SpreadMesh mesh, const std::string& name) {
  SpreadJob job;
  ranks.together([&] {
    if (request.strict) throw InvalidOption("faults are looked for in whole meshes; `sublimit info --strict` does");
    MeshRequest of_about = request;  // which has no faces to be cut
    of_about.triangulate = false;
    MeshJob of_rules = mesh_job(of_about, mesh.about, name);
    mesh.about = std::move(of_rules.mesh);
    if (!of_rules.scheme) throw InvalidOption("no scheme; give one");
    job.scheme = *std::move(of_rules.scheme);
    job.options = of_rules.options, job.rules = of_rules.rules;
    job.creasing = job.rules.creasing.value_or(mesh.about.creasing.value_or(Creasing::uniform));
    if (request.no_creases) mesh.creases.clear(), mesh.corners.clear();
  });
  if (request.triangulate) triangulate(ranks, mesh);
  const std::int32_t whole = job.scheme.face_size() == 3 ? 3 : 4;
  job.all_whole = ranks.all(std::ranges::all_of(mesh.face_sizes, [&](std::int32_t size) { return size == whole; }));
  ranks.together([&] {
    if (job.scheme.face_size() == 3 && !job.all_whole)
      throw UnsupportedTopology(
          fmt::format("{}: {} is for triangles, and faces have other sizes", name, job.scheme.name));
  });
  job.name = name;
  job.incidence = incidence(ranks, mesh, name);
  job.mesh = std::move(mesh);
  return job;
}

std::vector<int> divided(const Ranks& ranks, const SpreadJob& job, const Division& division) {
  const int parts = division.parts > 0 ? division.parts : ranks.size();
  return division.runs ? equal_runs(ranks, job.mesh, parts) : partition(ranks, job.mesh, job.incidence, parts);
}

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {  // Steele, Lea, Flood 2014: SplitMix
  hash += 0x9e3779b97f4a7c15 + value;
  hash = (hash ^ hash >> 30) * 0xbf58476d1ce4e5b9;
  hash = (hash ^ hash >> 27) * 0x94d049bb133111eb;
  return hash ^ hash >> 31;
}

std::uint64_t faces_hash(const Ranks& ranks, const SpreadMesh& mesh) {
  std::uint64_t sum = 0;
  size_t corner = 0;
  for (size_t f = 0; f < mesh.face_sizes.size(); ++f) {
    std::uint64_t hash = mixed(1, std::uint64_t(mesh.faces.begin(ranks.rank())) + f);
    for (std::int32_t k = 0; k < mesh.face_sizes[f]; ++k)
      hash = mixed(hash, std::uint64_t(mesh.face_vertices[corner++]));
    sum += hash;
  }
  return std::bit_cast<std::uint64_t>(ranks.sum(std::bit_cast<std::int64_t>(sum)));
}

std::uint64_t mesh_hash(const Ranks& ranks, const SpreadMesh& mesh) {
  std::uint64_t sum = 0;
  for (const auto& c : mesh.creases)
    sum +=
        mixed(mixed(mixed(mixed(2, std::uint64_t(std::min(c.tail, c.head))), std::uint64_t(std::max(c.tail, c.head))),
                    std::bit_cast<std::uint32_t>(c.sharpness)),
              std::uint64_t(c.number));
  for (const auto& c : mesh.corners)
    sum += mixed(mixed(mixed(3, std::uint64_t(c.vertex)), std::bit_cast<std::uint32_t>(c.sharpness)),
                 std::uint64_t(c.number));
  for (const std::int64_t f : mesh.holes) sum += mixed(4, std::uint64_t(f));
  sum = std::bit_cast<std::uint64_t>(ranks.sum(std::bit_cast<std::int64_t>(sum)));
  return mixed(mixed(faces_hash(ranks, mesh), sum), std::uint64_t(mesh.vertices.size()));
}

std::string in_hexadecimal(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

}  // namespace sublimit
