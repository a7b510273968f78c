// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reading the points that a table is applied to from a file, frame by frame:
//
//   .obj, .ply, .off, .stl   the vertices of a mesh, x y z; .glb, .gltf, .usda, .usdz too,
//                      and of a scene that moves each time of its samples
//   .csv               a point in each line, a channel in each column; the first line may name the channels
//   .npy               float or double, vertices x channels, or frames x vertices x channels, read frame by frame
//
// or from a sequence of such files, a frame each.
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sublimit/mesh/mesh.h"
#include "sublimit/stencils/files/frame_files.h"

namespace sublimit {

/// The points of a file with one frame.
struct PointFile {
  Points points;
  std::vector<std::string> columns;  ///< names of channels
  std::optional<Mesh> mesh;          ///< whose points they are, if the file is one
};

class FrameReader {
 public:
  /// Reads one file.
  /// @throws FormatError  another extension, a file that cannot be parsed, an array of another shape
  /// @throws InvalidMesh  numbers that are not finite;  IoError  missing, unreadable
  explicit FrameReader(const std::filesystem::path& path);
  /// Reads a frame from each of some files, one or more, when it is asked for.
  /// @param read  reads a file; if empty, as the constructor above does
  /// @throws FormatError  a file that holds many frames; else as above
  explicit FrameReader(std::vector<std::filesystem::path> files,
                       std::function<PointFile(const std::filesystem::path&)> read = {});
  /// Makes one frame of points in memory: points x channels.
  FrameReader(const std::filesystem::path& path, Points points, std::vector<std::string> columns);

  /// Leaves out frames of a file, numbered from 0, before `first` and behind `last`.
  /// @throws InvalidOption  there are no such frames, or no frames at all
  void choose(std::int64_t first, std::int64_t last);

  /// Returns the file of the last frame that was read, and of the first one before that.
  const std::filesystem::path& path() const { return path_; }
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
  /// @throws InvalidMesh  a number that is not finite, naming frame, point and channel; another number of points than
  ///                      files before have, naming the file;  IoError;  FormatError
  void next(std::span<double> points);

 private:
  void take(PointFile file);

  std::filesystem::path path_;
  std::vector<std::filesystem::path> files_;  // of a sequence
  std::function<PointFile(const std::filesystem::path&)> read_;
  std::int64_t num_frames_ = 1, num_points_ = 0, next_ = 0;
  bool has_frames_ = false;
  std::vector<std::string> columns_;
  std::optional<Mesh> mesh_;
  std::function<Points(std::int64_t)> positions_;  // of the frames of a scene
  Points points_;                                  // points of files that are read at once
  std::ifstream array_;                            // an .npy, positioned after its header
  bool is_float_ = false;
  std::vector<float> floats_;
};

}  // namespace sublimit
