// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/files/frames.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/usd_flat.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/formats/npy.h"

namespace sublimit {
namespace {

std::vector<std::string> names_of_channels(std::int64_t count) {
  if (count == 3) return {"x", "y", "z"};
  std::vector<std::string> names;
  for (std::int64_t c = 0; c < count; ++c) names.push_back("c" + format_number(c));
  return names;
}

/// The next numbers of a file.
template <class T>
bool read_numbers(std::ifstream& file, std::span<T> out) {
  file.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size_bytes()));
  return static_cast<bool>(file);
}

/// The points of a file with one frame.
PointFile point_file(const std::filesystem::path& path) {
  if (all_formats().reads(path, contents::meshes)) {
    Mesh mesh = read_mesh(path);
    Points points = mesh.positions;
    return {std::move(points), names_of_channels(3), std::move(mesh)};
  }
  if (const FileFormat* const format = all_formats().reader(path, contents::polygons)) {
    ControlPolygon read = format->parse_polygon(read_inflated(path), path.string(), false);
    std::vector<std::string> names =
        read.columns.empty() ? names_of_channels(read.points.cols()) : std::move(read.columns);
    return {std::move(read.points), std::move(names), {}};
  }
  if (all_formats().reads(path, contents::arrays)) {
    FrameReader array(path);
    if (array.has_frames()) throw FormatError(path.string() + ": it holds many frames; files of a sequence hold one");
    PointFile file{Points(array.num_points(), array.num_channels()), array.columns(), {}};
    array.next({file.points.data(), std::size_t(file.points.size())});
    return file;
  }
  throw FormatError(path.string() + ": points come from " +
                    all_formats().readers_in_words({contents::meshes, contents::tangents, contents::arrays}, "or") +
                    " files");
}

}  // namespace

FrameReader::FrameReader(const std::filesystem::path& path) : path_(path) {
  if (!all_formats().reads(path, contents::arrays)) {
    take(point_file(path));
    if (!all_formats().reads(path, contents::scenes)) return;
    UsdFrames frames = read_usd_frames(opened_path(path));
    if (frames.count < 2) return;
    has_frames_ = true;
    num_frames_ = frames.count;
    positions_ = std::move(frames.positions);
  } else {
    // Its header alone: of a long animation that is mapped, memory would hold all frames that were read.
    const NpyArray array(path);
    const std::vector<std::int64_t>& shape = array.shape();
    if (shape.size() != 2 && shape.size() != 3)
      throw FormatError(path.string() + ": an array of " + format_number(shape.size()) +
                        " dimensions; vertices x channels or frames x vertices x channels are right");
    has_frames_ = shape.size() == 3;
    if (has_frames_) num_frames_ = shape[0];
    num_points_ = shape[shape.size() - 2];
    if (shape.back() < 1 || shape.back() > 4096)
      throw FormatError(path.string() + ": " + format_number(shape.back()) + " channels; 1 to 4096 are right");
    columns_ = names_of_channels(shape.back());
    is_float_ = array.dtype() == DType::F32;
    const auto bytes = static_cast<std::uintmax_t>(array.size()) * (is_float_ ? sizeof(float) : sizeof(double));
    array_.open(opened_path(path), std::ios::binary);
    array_.seekg(static_cast<std::streamoff>(std::filesystem::file_size(opened_path(path)) - bytes));
  }
}

FrameReader::FrameReader(std::vector<std::filesystem::path> files,
                         std::function<PointFile(const std::filesystem::path&)> read)
    : path_(files.front()),
      files_(std::move(files)),
      read_(read ? std::move(read) : point_file),
      num_frames_(std::ssize(files_)),
      has_frames_(true) {
  take(read_(path_));
}

void FrameReader::take(PointFile file) {
  points_ = std::move(file.points);
  columns_ = std::move(file.columns);
  mesh_ = std::move(file.mesh);
  num_points_ = points_.rows();
}

void FrameReader::choose(std::int64_t first, std::int64_t last) {
  if (!has_frames_) throw InvalidOption("--frames: " + path_.string() + " holds one frame, without a number");
  if (last >= num_frames_)
    throw InvalidOption("--frames: " + path_.string() + " holds " + format_number(num_frames_) + " frames, from 0 to " +
                        format_number(num_frames_ - 1) + "; there is no frame " + format_number(last));
  next_ = first;
  num_frames_ = last - first + 1;
  if (positions_) return;
  const std::int64_t bytes = num_points_ * num_channels() * std::int64_t(is_float_ ? sizeof(float) : sizeof(double));
  array_.seekg(first * bytes, std::ios::cur);
}

FrameReader::FrameReader(const std::filesystem::path& path, Points points, std::vector<std::string> columns)
    : path_(path), num_points_(points.rows()), columns_(std::move(columns)), points_(std::move(points)) {}

void FrameReader::next(std::span<double> points) {
  if (!files_.empty() && next_ > 0) {
    const std::filesystem::path& file = files_[std::size_t(next_)];
    PointFile read = read_(file);
    if (read.points.rows() != num_points_ || std::ssize(read.columns) != num_channels())
      throw InvalidMesh(file.string() + ": " + format_number(read.points.rows()) + " points of " +
                        format_number(std::ssize(read.columns)) + " channels, and " + path_.string() + " has " +
                        format_number(num_points_) + " of " + format_number(num_channels()) +
                        "; all frames should have the same points");
    path_ = file;
    take(std::move(read));
  }
  if (positions_) points_ = positions_(next_);
  if (!array_.is_open()) {
    ++next_;
    std::copy_n(points_.data(), points.size(), points.data());
    return;
  }
  const std::int64_t frame = next_++;
  floats_.resize(is_float_ ? points.size() : 0);
  if (!(is_float_ ? read_numbers<float>(array_, floats_) : read_numbers(array_, points)))
    throw IoError(path_.string() + ": cannot read frame " + format_number(frame) + "; the file has become shorter");
  std::copy(floats_.begin(), floats_.end(), points.begin());
  const auto bad = std::find_if(points.begin(), points.end(), [](double x) { return !std::isfinite(x); });
  if (bad == points.end()) return;
  const std::int64_t at = bad - points.begin(), channels = num_channels();
  throw InvalidMesh(path_.string() + ": " + (has_frames_ ? "frame " + format_number(frame) + ", " : "") + "point " +
                    format_number(at / channels) + ", channel " + format_number(at % channels) + " is " +
                    format_number(*bad) + "; it should be a finite number");
}

}  // namespace sublimit
