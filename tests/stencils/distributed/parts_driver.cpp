// SPDX-License-Identifier: Apache-2.0
// Under mpirun: parts that ranks gather are those that one process cuts out of the whole mesh.
#include "sublimit/base/error.h"
#include "sublimit/distributed/mesh/gather_part.h"
#include "sublimit/distributed/mesh/partition.h"
#include "sublimit/io/detail/obj.h"

namespace {

using namespace sublimit;

void require(bool condition, const char* what) {
  if (!condition) throw AnalysisError(std::string("other ") + what + " than those of the whole mesh");
}

/// Values of all corners.
Points at_corners(const Mesh& mesh) {
  const Mesh::FaceVarying& channel = mesh.face_varying.at(0);
  return channel.values(channel.indices, Eigen::all);
}

void compare(const MeshPart& part, const MeshPart& right, const Mesh& whole) {
  const Mesh &a = part.mesh, &b = right.mesh;
  require(part.vertices == right.vertices && part.faces == right.faces && part.is_owned == right.is_owned, "numbers");
  require(a.positions == b.positions, "positions");
  require(a.face_sizes == b.face_sizes && a.face_vertices == b.face_vertices, "faces");
  require(a.holes == b.holes && a.corners.size() == b.corners.size(), "holes or corners");
  // Of an edge with several tags the last one counts, whatever order those of other edges have.
  const auto creases = [](const Mesh& mesh) {
    std::vector<std::pair<std::pair<Index, Index>, float>> all;
    for (const auto& c : mesh.creases) all.emplace_back(std::minmax(c.tail, c.head), c.sharpness);
    std::ranges::stable_sort(all, {}, [](const auto& tag) { return tag.first; });
    return all;
  };
  require(creases(a) == creases(b), "creases");
  if (whole.face_varying.empty()) {
    require(a.face_varying.empty(), "texture coordinates");
    return;
  }
  const Points all = at_corners(whole);
  std::vector<Eigen::Index> first{0}, corners;
  for (const Index size : whole.face_sizes) first.push_back(first.back() + size);
  for (const std::int64_t f : part.faces)
    for (Eigen::Index c = first[size_t(f)]; c < first[size_t(f) + 1]; ++c) corners.push_back(c);
  require(at_corners(a) == all(corners, Eigen::all), "texture coordinates");
}

void check_parts(const Ranks& ranks, const std::filesystem::path& path) {
  const SpreadMesh mesh = read_spread_mesh(ranks, path);
  const Incidence around = incidence(ranks, mesh, path.string());
  const Mesh whole = read_obj(path);
  const Topology topology(view(whole));
  for (const bool runs : {false, true}) {
    const std::vector<int> part =
        runs ? equal_runs(ranks, mesh, ranks.size()) : partition(ranks, mesh, around, ranks.size());
    const auto owned = owned_faces(ranks, mesh, part, ranks.size());
    std::vector<int> owner;
    std::vector<std::vector<int>> all(size_t(ranks.size()), part);
    for (const std::vector<int>& from : exchange(ranks, std::move(all)))
      owner.insert(owner.end(), from.begin(), from.end());
    for (const int rings : {0, 1, 3}) {
      const MeshPart gathered = gather_part(ranks, mesh, around, owned.at(0), rings, ranks.is_first());
      ranks.together([&] { compare(gathered, mesh_part(whole, topology, owner, ranks.rank(), rings), whole); });
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Ranks ranks(argc, argv);
  return ranks.run([&] { check_parts(ranks, argv[1]); });
}
