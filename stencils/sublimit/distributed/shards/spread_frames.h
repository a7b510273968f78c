// SPDX-License-Identifier: Apache-2.0
#pragma once
// Poses of a mesh that no process has whole: each rank reads the points of its run, frame by frame.
#include <filesystem>

#include "sublimit/distributed/mesh/spread_mesh.h"
#include "sublimit/stencils/formats/npy.h"

namespace sublimit {

class SpreadFrames {
 public:
  /// Opens a mesh as `read_spread_mesh` does, or an .npy: vertices x channels, or frames x vertices x channels.
  /// Collective: all ranks call.
  /// @param ranks  must outlive this
  /// @throws FormatError, InvalidMesh, IoError  on all ranks
  SpreadFrames(const Ranks& ranks, const std::filesystem::path& path);
  SpreadFrames(const Ranks&&, const std::filesystem::path&) = delete;

  const Runs& runs() const { return runs_; }
  std::int64_t num_frames() const { return num_frames_; }
  int num_channels() const { return channels_; }
  bool has_frames() const { return has_frames_; }
  const std::optional<SpreadMesh>& mesh() const { return mesh_; }

  /// Returns the points of this rank's run in the next frame, interleaved. Collective: all ranks call.
  /// @throws InvalidMesh  on all ranks: a number that is not finite
  std::vector<double> next();

 private:
  const Ranks& ranks_;
  std::string name_;
  Runs runs_;
  std::int64_t num_frames_ = 1, next_ = 0;
  int channels_ = 3;
  bool has_frames_ = false;
  std::optional<SpreadMesh> mesh_;
  std::optional<NpyArray> array_;
};

}  // namespace sublimit
