// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/files/frames.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/polygon_files.h"
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

}  // namespace

FrameReader::FrameReader(const std::filesystem::path& path) : path_(path) {
  if (all_formats().reads(path, contents::meshes)) {
    mesh_ = read_mesh(path);
    points_ = mesh_->positions;
    columns_ = names_of_channels(3);
  } else if (all_formats().reads(path, contents::polygons)) {
    ControlPolygon read = read_polygon(path);
    points_ = std::move(read.points);
    columns_ = read.columns.empty() ? names_of_channels(points_.cols()) : std::move(read.columns);
  } else if (all_formats().reads(path, contents::arrays)) {
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
    array_.open(path, std::ios::binary);
    array_.seekg(static_cast<std::streamoff>(std::filesystem::file_size(path) - bytes));
    return;
  } else {
    throw FormatError(path.string() + ": points come from " +
                      all_formats().readers_in_words({contents::meshes, contents::tangents, contents::arrays}, "or") +
                      " files");
  }
  num_points_ = points_.rows();
}

FrameReader::FrameReader(const std::filesystem::path& path, Points points, std::vector<std::string> columns)
    : path_(path), num_points_(points.rows()), columns_(std::move(columns)), points_(std::move(points)) {}

void FrameReader::next(std::span<double> points) {
  if (!array_.is_open()) {
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
