// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/detail/patch_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

/// Slots of a patch's faces: (p + 1) (q + 1), or those of a triangle.
double width_of(const Patch& patch) { return patch.faces().size > 0 ? double(patch.slots(0).size()) : 0; }

}  // namespace

PatchLevelSize level_size(const PatchSet& patches, int level) {
  PatchLevelSize size;
  for (const PatchSet::Member& member : patches.members()) {
    const Patch& patch = *member.patch;
    const double points = patch.num_points(), faces = patch.faces().size, width = width_of(patch);
    if (patch.faces().triangles) {
      const double fine = std::ldexp(points, 2 * level);
      size.points += fine;
      size.nonzeros += fine * width;
      continue;
    }
    // A direction of m points and f spans gets f (2^k - 1) more. Products of both directions are no less than the
    // squares of their geometric means; so it is with rows, of (p + 2) / 2 nonzeros on average.
    const double side = std::sqrt(points) + std::sqrt(faces) * (std::ldexp(1.0, level) - 1);
    const double row = (std::sqrt(width) + 1) / 2;
    size.points += side * side;
    size.nonzeros += side * side * row * row;
  }
  return size;
}

void check_levels(const PatchSet& patches, int levels, bool product) {
  if (levels < 0) throw InvalidParameter("levels is " + std::to_string(levels) + "; it must be 0 or more");
  double width = 0;
  for (const PatchSet::Member& member : patches.members()) width = std::max(width, width_of(*member.patch));
  const auto bytes_of = [&](int level) {
    // S of each patch, their rows one after the other, and the S made of them; columns, places in the set and the file.
    constexpr double bytes_of_nonzero = 3 * 12, bytes_of_point = 3 * 8 + 2 * 4 * 8 + 2 * 4;
    const PatchLevelSize size = level_size(patches, level);
    return size.nonzeros * bytes_of_nonzero + size.points * (bytes_of_point + (product ? 12 * width : 0));
  };
  constexpr double most_items = std::numeric_limits<Index>::max();
  const auto fits = [&](int level) {
    const PatchLevelSize size = level_size(patches, level);
    return size.points <= most_items && size.nonzeros <= most_items && bytes_of(level) <= memory_limit();
  };
  if (levels == 0 || fits(levels)) return;
  int most = 0;
  while (most + 1 < levels && fits(most + 1)) ++most;
  const std::string amount = std::to_string(levels) + " levels of " + std::to_string(patches.faces().size) + " faces";
  const std::string advice = most > 0 ? "use at most " + std::to_string(most) : "use fewer patches";
  check_memory(amount, bytes_of(levels), advice);
  throw ResourceError(amount + " have more points or weights than 32-bit indices count; " + advice);
}

}  // namespace sublimit
