// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/table/table_channels.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/rule_words.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

[[noreturn]] void fail(const std::string& what) { throw InvalidParameter(what); }

void check_word(const char* name, const std::string& word, std::span<const char* const> right) {
  std::string all;
  for (const char* known : right) {
    if (word == known) return;
    all += (all.empty() ? "" : ", ") + std::string(known);
  }
  fail(std::string(name) + " is '" + word + "'; one of " + all + " is right");
}

void check_indices(const std::string& name, const SharedArray<std::int32_t>& indices, std::int64_t count,
                   const char* what) {
  for (size_t i = 0; i < indices.size(); ++i)
    if (indices[i] < 0 || indices[i] >= count)
      fail(name + ": entry " + std::to_string(i) + " names " + what + " " + std::to_string(indices[i]) + " of " +
           std::to_string(count));
}

void check_sharpness(const char* name, const SharedArray<float>& sharpness, size_t count) {
  if (sharpness.size() != count)
    fail(std::string(name) + " has " + std::to_string(sharpness.size()) + " entries for " + std::to_string(count) +
         " tags");
  for (const float s : sharpness)
    if (!std::isfinite(s) || s < 0)
      fail(std::string(name) + " has " + format_number(s) + "; it should be 0 or more, where 10 is infinitely sharp");
}

}  // namespace

void check_channels(const TableChannels& channels, std::int64_t num_corners) {
  if (channels.list.empty()) return;
  check_word("face_varying", channels.interpolation, face_varying_words);
  for (size_t c = 0; c < channels.list.size(); ++c) {
    const FaceVaryingValues& channel = channels.list[c];
    const std::string name = "face_varying." + std::to_string(c);
    // Arrays without entries are no arrays of a file.
    if (channel.channels < 1 || channel.values.empty() || channel.values.size() % size_t(channel.channels) != 0)
      fail(name + ".values has " + std::to_string(channel.values.size()) + " numbers, " +
           std::to_string(channel.channels) + " a value");
    for (const double x : channel.values)
      if (!std::isfinite(x)) fail(name + ".values has a number that is not finite");
    if (std::int64_t(channel.indices.size()) != num_corners || num_corners == 0)
      fail(name + ".indices has " + std::to_string(channel.indices.size()) + " entries, not one for each of " +
           std::to_string(num_corners) + " corners of faces");
    check_indices(name + ".indices", channel.indices, std::int64_t(channel.values.size()) / channel.channels, "value");
  }
}

void check_tags(const TableTags& tags, std::int64_t num_points) {
  check_word("tags.boundary", tags.boundary, std::span(boundary_words).last(2));  // `none` has been made holes
  check_word("tags.creasing", tags.creasing, creasing_words);
  if (tags.creases.size() % 2 != 0) fail("tags.creases has a point without another one");
  check_indices("tags.creases", tags.creases, num_points, "point");
  check_indices("tags.corners", tags.corners, num_points, "point");
  for (size_t i = 0; i < tags.creases.size(); i += 2)
    if (tags.creases[i] == tags.creases[i + 1])
      fail("tags.creases: an edge from point " + std::to_string(tags.creases[i]) + " to itself");
  check_sharpness("tags.crease_sharpness", tags.crease_sharpness, tags.creases.size() / 2);
  check_sharpness("tags.corner_sharpness", tags.corner_sharpness, tags.corners.size());
}

}  // namespace sublimit
