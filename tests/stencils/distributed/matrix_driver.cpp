// SPDX-License-Identifier: Apache-2.0
// A table in shards as PETSc's matrix, under mpirun: adjoint to its transpose, and good for a user's own KSP.
#include <petscksp.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <type_traits>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/distributed/jobs/place_routes.h"
#include "sublimit/distributed/jobs/spread_targets.h"
#include "sublimit/distributed/mesh/partition.h"
#include "sublimit/distributed/mesh/shared_file.h"
#include "sublimit/distributed/shards/spread_frames.h"
#include "sublimit/distributed/shards/spread_rows.h"
#include "sublimit/distributed/shards/spread_table.h"

namespace {

using namespace sublimit;

// What refers to an argument takes no temporary one.
using Path = const std::filesystem::path&;
using Parts = const std::vector<int>;
static_assert(std::is_constructible_v<SpreadFrames, Ranks&, Path> &&
              !std::is_constructible_v<SpreadFrames, Ranks, Path>);
static_assert(std::is_constructible_v<SpreadTargets, Ranks&, Path> &&
              !std::is_constructible_v<SpreadTargets, Ranks, Path>);
static_assert(std::is_constructible_v<SharedFile, Ranks&, Path, int> &&
              !std::is_constructible_v<SharedFile, Ranks, Path, int>);
static_assert(std::is_constructible_v<SpreadRows, SparseMatrix, Halo&> &&
              !std::is_constructible_v<SpreadRows, SparseMatrix, Halo>);
static_assert(std::is_constructible_v<PlaceRoutes, Ranks&, SpreadJob&, Parts&, MeshPart&> &&
              !std::is_constructible_v<PlaceRoutes, Ranks, SpreadJob&, Parts&, MeshPart&> &&
              !std::is_constructible_v<PlaceRoutes, Ranks&, SpreadJob, Parts&, MeshPart&> &&
              !std::is_constructible_v<PlaceRoutes, Ranks&, SpreadJob&, Parts, MeshPart&> &&
              !std::is_constructible_v<PlaceRoutes, Ranks&, SpreadJob&, Parts&, MeshPart>);
template <class Applied>
constexpr bool has_matrix = requires(Applied&& applied) {
  matrix(std::forward<Applied>(applied));
};
static_assert(has_matrix<SpreadTable&> && !has_matrix<SpreadTable> && has_matrix<SpreadRows&> &&
              !has_matrix<SpreadRows>);

double noise(std::int64_t number, int seed) {
  const double x = std::sin(double(number + 1) * 12.9898 + seed) * 43758.5453;
  return x - std::floor(x) - 0.5;
}

PetscObjectOf<Vec> noise_like(Vec like, int seed) {
  PetscObjectOf<Vec> x;
  check_petsc(VecDuplicate(like, &x.value));
  PetscInt begin = 0, end = 0;
  check_petsc(VecGetOwnershipRange(x, &begin, &end));
  for (PetscInt i = begin; i < end; ++i) check_petsc(VecSetValue(x, i, noise(i, seed), INSERT_VALUES));
  check_petsc(VecAssemblyBegin(x));
  check_petsc(VecAssemblyEnd(x));
  return x;
}

void require(bool condition, const char* what, double value) {
  if (!condition) throw AnalysisError(std::string(what) + ": " + std::to_string(value));
}

void check_matrix(const Ranks& ranks, const std::filesystem::path& directory, const std::filesystem::path& mesh) {
  const ShardManifest manifest = load_manifest(directory);
  SpreadFrames frames(ranks, mesh);
  std::vector<LoadedShard> shards;
  for (int number = 0; number < manifest.all.count; ++number)
    if (rank_of_part(ranks, number, manifest.all.count) == ranks.rank())
      shards.push_back(load_shard(directory, manifest, number));
  const SpreadTable table(ranks, std::move(shards), frames.runs());
  const PetscObjectOf<Mat> A = matrix(table);
  PetscObjectOf<Vec> left, right;
  check_petsc(MatCreateVecs(A, &right.value, &left.value));
  const PetscObjectOf<Vec> x = noise_like(right, 1), y = noise_like(left, 2);
  check_petsc(MatMult(A, x, left));
  check_petsc(MatMultTranspose(A, y, right));
  PetscScalar one = 0, other = 0;
  check_petsc(VecDot(y, left, &one));
  check_petsc(VecDot(right, x, &other));
  require(std::abs(one - other) < 1e-13 * std::abs(one) + 1e-12, "y . A x and A^T y . x differ by", one - other);

  // The same in three channels at once.
  std::vector<double> own(size_t(3 * table.halo().num_own())), points(size_t(3 * table.num_points())), back(own.size());
  const PetscScalar* values = nullptr;
  check_petsc(VecGetArrayRead(x, &values));
  for (size_t i = 0; i < own.size(); ++i) own[i] = values[i / 3] * double(i % 3 + 1);
  check_petsc(VecRestoreArrayRead(x, &values));
  table.apply(own, 3, points);
  const PetscScalar* made = nullptr;
  check_petsc(VecGetArrayRead(left, &made));
  for (size_t i = 0; i < points.size(); ++i)
    require(std::abs(points[i] - made[i / 3] * double(i % 3 + 1)) < 1e-14, "apply and MatMult differ at", double(i));
  check_petsc(VecRestoreArrayRead(left, &made));
  table.apply_transpose(points, 3, back);
  double dot = 0, norm = 0;
  for (size_t i = 0; i < own.size(); ++i) dot += own[i] * back[i];
  for (const double p : points) norm += p * p;
  require(std::abs(ranks.sum(dot) - ranks.sum(norm)) < 1e-12 * ranks.sum(norm), "x . A^T A x is not |A x|^2", dot);

  // Least squares: of what A makes of x.
  PetscObjectOf<KSP> solver;
  check_petsc(KSPCreate(PETSC_COMM_WORLD, &solver.value));
  check_petsc(KSPSetType(solver, KSPLSQR));
  check_petsc(KSPSetOperators(solver, A, A));
  PC none = nullptr;
  check_petsc(KSPGetPC(solver, &none));
  check_petsc(PCSetType(none, PCNONE));
  check_petsc(KSPSetTolerances(solver, 1e-14, 1e-14, PETSC_DEFAULT, 2000));
  check_petsc(KSPSolve(solver, left, right));
  check_petsc(VecAXPY(right, -1, x));
  check_petsc(MatMult(A, right, left));  // where vertices of valence 3 alternate A makes nothing of x
  PetscReal error = 0;
  check_petsc(VecNorm(left, NORM_INFINITY, &error));
  require(error < 1e-10, "KSPLSQR is off by", error);
}

}  // namespace

int main(int argc, char** argv) {
  const Ranks ranks(argc, argv);
  return ranks.run([&] { check_matrix(ranks, argv[1], argv[2]); });
}
