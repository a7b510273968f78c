// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reading the points that a table is applied to from a file, frame by frame:
//
//   .obj, .ply, .off, .stl   the vertices of a mesh, x y z
//   .csv               a point in each line, a channel in each column; the first line may name the channels
//   .npy               float or double, vertices x channels, or frames x vertices x channels, read frame by frame
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

class FrameReader {
 public:
  /// @throws FormatError  another extension, a file that cannot be parsed, an array of another shape
  /// @throws InvalidMesh  numbers that are not finite;  IoError  missing, unreadable
  explicit FrameReader(const std::filesystem::path& path);
  /// Makes one frame of points in memory: points x channels.
  FrameReader(const std::filesystem::path& path, Points points, std::vector<std::string> columns);

  std::int64_t num_frames() const { return num_frames_; }
  std::int64_t num_points() const { return num_points_; }
  int num_channels() const { return static_cast<int>(columns_.size()); }
  /// Returns true if the file has a dimension of frames, even of length one.
  bool has_frames() const { return has_frames_; }
  /// Returns the names of channels: those of the file, else x, y, z, else c0, c1, ...
  const std::vector<std::string>& columns() const { return columns_; }
  /// Returns the mesh of a frame, absent if its file is not a mesh.
  const std::optional<Mesh>& mesh() const { return mesh_; }

  /// Reads the next frame, num_points x num_channels, interleaved.
  /// @throws InvalidMesh  a number that is not finite, naming frame, point and channel;  IoError;  FormatError
  void next(std::span<double> points);

 private:
  std::filesystem::path path_;
  std::int64_t num_frames_ = 1, num_points_ = 0, next_ = 0;
  bool has_frames_ = false;
  std::vector<std::string> columns_;
  std::optional<Mesh> mesh_;
  Points points_;        // points of files that are read at once
  std::ifstream array_;  // an .npy, positioned after its header
  bool is_float_ = false;
  std::vector<float> floats_;
};

}  // namespace sublimit
