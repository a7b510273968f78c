// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/gpu/detail/compiled_kernels.h"

namespace sublimit::gpu {
namespace {

constexpr std::uint32_t apply_patches[] = {
#include "sublimit_spirv/apply_patches.inc"
};
constexpr std::uint32_t apply_patches_half[] = {
#include "sublimit_spirv/apply_patches_half.inc"
};
constexpr std::uint32_t apply_rows[] = {
#include "sublimit_spirv/apply_rows.inc"
};
constexpr std::uint32_t apply_rows_half[] = {
#include "sublimit_spirv/apply_rows_half.inc"
};
constexpr std::uint32_t copy_points[] = {
#include "sublimit_spirv/copy_points.inc"
};
constexpr std::uint32_t copy_points_half[] = {
#include "sublimit_spirv/copy_points_half.inc"
};
constexpr std::uint32_t transpose_patches[] = {
#include "sublimit_spirv/transpose_patches.inc"
};
constexpr std::uint32_t gather_parts[] = {
#include "sublimit_spirv/gather_parts.inc"
};
constexpr std::uint32_t fold_copies[] = {
#include "sublimit_spirv/fold_copies.inc"
};

}  // namespace

std::span<const std::uint32_t> spirv_of(Kernel kernel, bool half) {
  switch (kernel) {
    case Kernel::apply_patches:
      return half ? std::span<const std::uint32_t>(apply_patches_half) : std::span<const std::uint32_t>(apply_patches);
    case Kernel::apply_rows:
      return half ? std::span<const std::uint32_t>(apply_rows_half) : std::span<const std::uint32_t>(apply_rows);
    case Kernel::copy_points:
      return half ? std::span<const std::uint32_t>(copy_points_half) : std::span<const std::uint32_t>(copy_points);
    case Kernel::transpose_patches:
      return transpose_patches;
    case Kernel::gather_parts:
      return gather_parts;
    case Kernel::fold_copies:
      return fold_copies;
  }
  return {};
}

}  // namespace sublimit::gpu
