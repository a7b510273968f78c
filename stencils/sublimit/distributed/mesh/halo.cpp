// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/mesh/halo.h"

#include <algorithm>

#include "sublimit/base/detail/found_once.h"

namespace sublimit {
namespace {

/// A point of so many channels, as MPI counts. Never freed: PETSc remembers types that it has seen.
MPI_Datatype point_type(int channels) {
  static const FoundByKey<int, MPI_Datatype> types;
  if (channels == 1) return MPI_DOUBLE;
  return types.get(channels, [&] {
    MPI_Datatype type = MPI_DATATYPE_NULL;
    MPI_Type_contiguous(channels, MPI_DOUBLE, &type);
    MPI_Type_commit(&type);
    return type;
  });
}

}  // namespace

Halo::Halo(const Ranks& ranks, const Runs& runs, std::span<const std::int64_t> inputs)
    : num_own_(runs.size(ranks.rank())), num_inputs_(std::ssize(inputs)) {
  std::vector<PetscInt> leaves;
  std::vector<PetscSFNode> roots;
  own_of_.reserve(inputs.size());
  for (size_t i = 0; i < inputs.size(); ++i) {
    const int rank = runs.rank_of(inputs[i]);
    const std::int64_t number = inputs[i] - runs.begin(rank);
    own_of_.push_back(rank == ranks.rank() ? number : -1);
    if (rank == ranks.rank()) continue;
    leaves.push_back(PetscInt(i));
    roots.push_back({rank, number});
  }
  num_remote_ = std::ssize(leaves);
  check_petsc(PetscSFCreate(PETSC_COMM_WORLD, &remote_.value));
  check_petsc(PetscSFSetGraph(remote_, num_own_, num_remote_, leaves.data(), PETSC_COPY_VALUES, roots.data(),
                              PETSC_COPY_VALUES));
  check_petsc(PetscSFSetUp(remote_));
}

void Halo::begin(std::span<const double> own, int channels, std::span<double> inputs) const {
  check_petsc(PetscSFBcastBegin(remote_, point_type(channels), own.data(), inputs.data(), MPI_REPLACE));
  for (size_t i = 0; i < own_of_.size(); ++i)
    if (own_of_[i] >= 0)
      std::copy_n(own.data() + own_of_[i] * channels, channels, inputs.data() + std::int64_t(i) * channels);
}

void Halo::end(std::span<const double> own, int channels, std::span<double> inputs) const {
  check_petsc(PetscSFBcastEnd(remote_, point_type(channels), own.data(), inputs.data(), MPI_REPLACE));
}

void Halo::add(std::span<const double> inputs, int channels, std::span<double> own) const {
  std::ranges::fill(own, 0.0);
  for (size_t i = 0; i < own_of_.size(); ++i)
    for (int c = 0; own_of_[i] >= 0 && c < channels; ++c)
      own[size_t(own_of_[i] * channels + c)] += inputs[i * size_t(channels) + size_t(c)];
  check_petsc(PetscSFReduceBegin(remote_, point_type(channels), inputs.data(), own.data(), MPI_SUM));
  check_petsc(PetscSFReduceEnd(remote_, point_type(channels), inputs.data(), own.data(), MPI_SUM));
}

}  // namespace sublimit
