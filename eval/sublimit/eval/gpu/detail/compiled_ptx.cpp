// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/gpu/detail/compiled_kernels.h"

namespace sublimit::gpu {

#ifdef SUBLIMIT_GPU_CUDA
namespace {

constexpr char patches1[] =
#include "sublimit_ptx/patches1.inc"
    ;
constexpr char patches3[] =
#include "sublimit_ptx/patches3.inc"
    ;
constexpr char patches6[] =
#include "sublimit_ptx/patches6.inc"
    ;
constexpr char rows1[] =
#include "sublimit_ptx/rows1.inc"
    ;
constexpr char rows3[] =
#include "sublimit_ptx/rows3.inc"
    ;
constexpr char rows6[] =
#include "sublimit_ptx/rows6.inc"
    ;
constexpr char copies[] =
#include "sublimit_ptx/copies.inc"
    ;
constexpr char patches1_half[] =
#include "sublimit_ptx/patches1_half.inc"
    ;
constexpr char patches3_half[] =
#include "sublimit_ptx/patches3_half.inc"
    ;
constexpr char patches6_half[] =
#include "sublimit_ptx/patches6_half.inc"
    ;
constexpr char rows1_half[] =
#include "sublimit_ptx/rows1_half.inc"
    ;
constexpr char rows3_half[] =
#include "sublimit_ptx/rows3_half.inc"
    ;
constexpr char rows6_half[] =
#include "sublimit_ptx/rows6_half.inc"
    ;
constexpr char copies_half[] =
#include "sublimit_ptx/copies_half.inc"
    ;
constexpr char transpose[] =
#include "sublimit_ptx/transpose.inc"
    ;

const char* of_quantities(int quantities, const char* one, const char* three, const char* six) {
  return quantities == 1 ? one : quantities == 3 ? three : six;
}

}  // namespace

const char* ptx_of(const Variant& variant) {
  const int q = variant.quantities;
  switch (variant.kernel) {
    case Kernel::apply_patches:
      return variant.half ? of_quantities(q, patches1_half, patches3_half, patches6_half)
                          : of_quantities(q, patches1, patches3, patches6);
    case Kernel::apply_rows:
      return variant.half ? of_quantities(q, rows1_half, rows3_half, rows6_half)
                          : of_quantities(q, rows1, rows3, rows6);
    case Kernel::copy_points:
      return variant.half ? copies_half : copies;
    default:
      return transpose;
  }
}
#else
const char* ptx_of(const Variant&) { return nullptr; }
#endif

std::string name_in_ptx(const Variant& variant) {
  constexpr const char* names[num_kernels] = {"apply_patches",     "apply_rows",   "copy_points",
                                              "transpose_patches", "gather_parts", "fold_copies"};
  return names[static_cast<size_t>(variant.kernel)] + std::string("_q") + std::to_string(variant.quantities) + "c" +
         std::to_string(variant.channels) + "r" + std::to_string(variant.rows) + "p" + std::to_string(variant.patches);
}

}  // namespace sublimit::gpu
