// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/shards/spread_frames.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "sublimit/base/error.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit {

SpreadFrames::SpreadFrames(const Ranks& ranks, const std::filesystem::path& path)
    : ranks_(ranks), name_(path.string()) {
  if (!all_formats().reads(path, contents::arrays)) {
    mesh_ = read_spread_mesh(ranks, path);
    runs_ = mesh_->vertices;
    return;
  }
  ranks.together([&] {
    array_.emplace(path);
    const std::vector<std::int64_t>& shape = array_->shape();
    if (shape.size() != 2 && shape.size() != 3)
      throw FormatError(name_ + ": an array of vertices x channels, or of frames x vertices x channels, is needed");
    has_frames_ = shape.size() == 3;
    if (has_frames_) num_frames_ = shape[0];
    const std::int64_t channels = shape.back();
    if (channels < 1 || channels > 64)
      throw FormatError(fmt::format("{}: {} channels; 1 to 64 can be", name_, channels));
    channels_ = static_cast<int>(channels);
    runs_ = Runs::equal(shape[shape.size() - 2], ranks.size());
  });
}

std::vector<double> SpreadFrames::next() {
  std::vector<double> points(size_t(runs_.size(ranks_.rank()) * channels_));
  if (mesh_) {
    std::copy_n(mesh_->positions.data(), points.size(), points.data());
    return points;
  }
  ranks_.together([&] {
    array_->read<double>((next_ * runs_.size() + runs_.begin(ranks_.rank())) * channels_, points);
    const auto bad = std::ranges::find_if(points, [](double x) { return !std::isfinite(x); });
    if (bad != points.end())
      throw InvalidMesh(fmt::format("{}: frame {}, point {}, channel {} is not a finite number", name_, next_,
                                    runs_.begin(ranks_.rank()) + (bad - points.begin()) / channels_,
                                    (bad - points.begin()) % channels_));
  });
  ++next_;
  return points;
}

}  // namespace sublimit
