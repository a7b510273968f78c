// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control points that ranks have in runs, to where they are needed, and sums back: by PETSc's star forests.
// Source: Zhang et al. 2022, "The PetscSF scalable communication layer".
#include "sublimit/distributed/mesh/petsc.h"
#include "sublimit/distributed/ranks.h"

namespace sublimit {

class Halo {
 public:
  /// @param runs    of the control points
  /// @param inputs  of this rank: numbers of the whole, in any order
  Halo(const Ranks& ranks, const Runs& runs, std::span<const std::int64_t> inputs);

  std::int64_t num_own() const { return num_own_; }        ///< control points of this rank's run
  std::int64_t num_inputs() const { return num_inputs_; }  ///< of this rank
  bool is_own(std::int64_t input) const { return own_of_[size_t(input)] >= 0; }

  /// Inputs from control points, interleaved channels. Between `begin` and `end` inputs that are this rank's own are
  /// there already, the others on their way.
  void begin(std::span<const double> own, int channels, std::span<double> inputs) const;
  void end(std::span<const double> own, int channels, std::span<double> inputs) const;
  void fetch(std::span<const double> own, int channels, std::span<double> inputs) const {
    begin(own, channels, inputs);
    end(own, channels, inputs);
  }
  /// own = sums of the inputs that each is, of all ranks.
  void add(std::span<const double> inputs, int channels, std::span<double> own) const;

  /// Numbers that come from other ranks, each time, a channel.
  std::int64_t num_remote() const { return num_remote_; }

 private:
  std::int64_t num_own_ = 0, num_inputs_ = 0, num_remote_ = 0;
  std::vector<std::int64_t> own_of_;  // of each input: which of the own ones, or -1
  PetscObjectOf<PetscSF> remote_;
};

}  // namespace sublimit
