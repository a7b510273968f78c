// SPDX-License-Identifier: Apache-2.0
#pragma once
// Exchange of control points: from the ranks that have them in their runs to the ranks that need them (inputs),
// and sums of inputs back, by PETSc's star forests. Source: Zhang et al. 2022, "The PetscSF scalable
// communication layer".
#include "sublimit/distributed/mesh/petsc.h"
#include "sublimit/distributed/ranks.h"

namespace sublimit {

class Halo {
 public:
  /// Collective: all ranks call, as for all functions that take points.
  /// @param runs    runs of the control points
  /// @param inputs  control points that this rank needs, by their numbers in the whole mesh, in any order
  Halo(const Ranks& ranks, const Runs& runs, std::span<const std::int64_t> inputs);

  std::int64_t num_own() const { return num_own_; }        ///< control points of this rank's run
  std::int64_t num_inputs() const { return num_inputs_; }  ///< inputs of this rank
  bool is_own(std::int64_t input) const { return own_of_[size_t(input)] >= 0; }

  /// Starts to set `inputs` from the control points `own` of this rank's run, both interleaved; `end` completes
  /// it. After `begin`, inputs of this rank's run are valid, those of other ranks are not yet.
  void begin(std::span<const double> own, int channels, std::span<double> inputs) const;
  void end(std::span<const double> own, int channels, std::span<double> inputs) const;
  void fetch(std::span<const double> own, int channels, std::span<double> inputs) const {
    begin(own, channels, inputs);
    end(own, channels, inputs);
  }
  /// Sets each control point of `own` to the sum of all ranks' inputs with its number. The order of sums is not
  /// fixed.
  void add(std::span<const double> inputs, int channels, std::span<double> own) const;

  /// Returns the number of control points that this rank receives from other ranks in each exchange.
  std::int64_t num_remote() const { return num_remote_; }

 private:
  std::int64_t num_own_ = 0, num_inputs_ = 0, num_remote_ = 0;
  std::vector<std::int64_t> own_of_;  // for each input: its position in the own run, or -1
  PetscObjectOf<PetscSF> remote_;
};

}  // namespace sublimit
