// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/mesh/partition.h"

#include <mpi.h>
#include <stdio.h>  // which the next one needs

#include <ptscotch.h>

#include <algorithm>
#include <array>
#include <type_traits>

#include "sublimit/base/error.h"

namespace sublimit {

namespace {

/// PT-Scotch tells errors by numbers, and what they are on stderr.
void check_scotch(int error) {
  if (error != 0) throw AnalysisError("PT-Scotch cannot divide the mesh; --partition runs takes faces as they stand");
}

struct Graph {
  SCOTCH_Dgraph graph{};
  SCOTCH_Strat strategy{};
  Graph() {
    check_scotch(SCOTCH_dgraphInit(&graph, MPI_COMM_WORLD));
    check_scotch(SCOTCH_stratInit(&strategy));
  }
  ~Graph() {
    SCOTCH_dgraphExit(&graph);
    SCOTCH_stratExit(&strategy);
  }
  Graph(const Graph&) = delete;
  Graph& operator=(const Graph&) = delete;
};

}  // namespace

std::vector<int> partition(const Ranks& ranks, const SpreadMesh& mesh, const Incidence& incidence, int parts) {
  static_assert(std::is_same_v<SCOTCH_Num, std::int64_t>, "PT-Scotch of 64-bit numbers is needed");
  const std::int64_t faces = mesh.faces.size(ranks.rank()), edges = std::ssize(incidence.neighbours.items);
  if (parts == 1) return std::vector<int>(size_t(faces), 0);
  SCOTCH_randomReset();
  Graph of_faces;
  // It reads only, and wants both not to be null.
  std::vector<SCOTCH_Num> begins = incidence.neighbours.begins, items = incidence.neighbours.items,
                          part(size_t(faces) + 1);
  items.push_back(0);
  ranks.together([&] {
    check_scotch(SCOTCH_dgraphBuild(&of_faces.graph, 0, faces, faces, begins.data(), nullptr, nullptr, nullptr, edges,
                                    edges, items.data(), nullptr, nullptr));
  });
  ranks.together([&] {  // not before all have their graph: they divide it together
    check_scotch(SCOTCH_dgraphPart(&of_faces.graph, parts, &of_faces.strategy, part.data()));
  });
  return {part.begin(), part.end() - 1};
}

std::vector<int> equal_runs(const Ranks& ranks, const SpreadMesh& mesh, int parts) {
  const Runs runs = Runs::equal(mesh.faces.size(), parts);
  std::vector<int> part;
  part.reserve(mesh.face_sizes.size());
  for (std::int64_t f = 0; f < mesh.faces.size(ranks.rank()); ++f)
    part.push_back(runs.rank_of(mesh.faces.begin(ranks.rank()) + f));
  return part;
}

std::vector<std::vector<std::int64_t>> owned_faces(const Ranks& ranks, const SpreadMesh& mesh,
                                                   const std::vector<int>& part, int parts) {
  using Owned = std::array<std::int64_t, 2>;  // part, face
  std::vector<std::vector<Owned>> to(size_t(ranks.size()));
  for (size_t f = 0; f < part.size(); ++f)
    to[size_t(rank_of_part(ranks, part[f], parts))].push_back(
        {part[f], mesh.faces.begin(ranks.rank()) + std::int64_t(f)});
  std::vector<int> own;
  for (int p = 0; p < parts; ++p)
    if (rank_of_part(ranks, p, parts) == ranks.rank()) own.push_back(p);
  std::vector<std::vector<std::int64_t>> faces(own.size());
  for (const auto& from : exchange(ranks, std::move(to)))  // of ascending runs
    for (const auto& [p, face] : from) faces[size_t(p - own.front())].push_back(face);
  return faces;
}

}  // namespace sublimit
