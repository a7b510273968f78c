// SPDX-License-Identifier: Apache-2.0
// Kernels for CUDA: the variants of one of them, or of one of them that makes so many quantities, so that those that
// are wanted are compiled for the device in little time.
#include "language.inc"

#if defined(STAND_IN_FOR_CUDA) && defined(HALF)
#define NAME_OF(kernel, Q, C, R, P) half_##kernel##_q##Q##c##C##r##R##p##P  // all in one library
#else
#define NAME_OF(kernel, Q, C, R, P) kernel##_q##Q##c##C##r##R##p##P
#endif
// Three quantities are to leave registers for 16 workgroups: with fewer, the memory is waited for.
#define WORKGROUPS (PATCHES_OF == 3 ? 16 : 1)
#define VARIANT(kernel, q, c, r, p)                                                                   \
  extern "C" __attribute__((global)) __attribute__((launch_bounds(THREADS, WORKGROUPS))) void NAME_OF( \
      kernel, q, c, r, p)(const Arguments arguments) {                                                \
    kernel<q, c, r, p>(arguments);                                                                    \
  }
#define CHANNELS_OF(kernel, q, r, p) \
  VARIANT(kernel, q, 1, r, p) VARIANT(kernel, q, 2, r, p) VARIANT(kernel, q, 3, r, p) VARIANT(kernel, q, 4, r, p)

#ifndef PATCHES_OF
#define PATCHES_OF 0
#endif
#if PATCHES_OF == 1
#include "apply_patches.comp"
CHANNELS_OF(apply_patches, 1, 4, 2) CHANNELS_OF(apply_patches, 1, 1, 1)
#elif PATCHES_OF == 3
#include "apply_patches.comp"
CHANNELS_OF(apply_patches, 3, 4, 1) CHANNELS_OF(apply_patches, 3, 1, 1)
#elif PATCHES_OF == 6
#include "apply_patches.comp"
CHANNELS_OF(apply_patches, 6, 4, 1) CHANNELS_OF(apply_patches, 6, 1, 1)
#elif ROWS_OF == 1
#include "apply_rows.comp"
CHANNELS_OF(apply_rows, 1, 1, 1)
#elif ROWS_OF == 3
#include "apply_rows.comp"
CHANNELS_OF(apply_rows, 3, 1, 1)
#elif ROWS_OF == 6
#include "apply_rows.comp"
CHANNELS_OF(apply_rows, 6, 1, 1)
#elif defined(COPIES)
#include "copy_points.comp"
VARIANT(copy_points, 1, 1, 1, 1)
#else
#include "transpose_patches.comp"
#include "gather_parts.comp"
#include "fold_copies.comp"
CHANNELS_OF(transpose_patches, 1, 1, 1)
CHANNELS_OF(gather_parts, 1, 1, 1)
VARIANT(fold_copies, 1, 1, 1, 1)
#endif
