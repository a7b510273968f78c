// SPDX-License-Identifier: Apache-2.0
#pragma once
// Definitions that clang has for CUDA but not for the host, and replacements of the GPU instructions in
// kernels/cuda.inc, to run kernels on the host.
#include <cmath>
#include <cstdint>
#include <cstring>

/// Position of the running lane. One workgroup runs at a time; its lanes run in turns, from barrier to barrier.
struct StandInPlace {
  unsigned lane, workgroup[3], num_workgroups[3];
};
extern StandInPlace stand_in_place;
void stand_in_barrier();

inline unsigned __nvvm_read_ptx_sreg_tid_x() { return stand_in_place.lane; }
inline unsigned __nvvm_read_ptx_sreg_ctaid_x() { return stand_in_place.workgroup[0]; }
inline unsigned __nvvm_read_ptx_sreg_ctaid_y() { return stand_in_place.workgroup[1]; }
inline unsigned __nvvm_read_ptx_sreg_ctaid_z() { return stand_in_place.workgroup[2]; }
inline unsigned __nvvm_read_ptx_sreg_nctaid_x() { return stand_in_place.num_workgroups[0]; }
inline void __syncthreads() { stand_in_barrier(); }
inline float __nvvm_rsqrt_approx_f(float x) { return 1 / std::sqrt(x); }

/// Returns the bits of the nearest half float, ties to even.
inline unsigned short HALF_OF(float x) {
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  const std::uint32_t sign = bits >> 16 & 0x8000, magnitude = bits & 0x7fffffff;
  if (magnitude > 0x7f800000) return static_cast<unsigned short>(sign | 0x7e00);
  if (magnitude >= 0x47800000) return static_cast<unsigned short>(sign | 0x7c00);
  // Numbers below 2^-14 have a fixed last place.
  const int shift = magnitude < 0x38800000 ? 126 - int(magnitude >> 23) : 13;
  if (shift > 24) return static_cast<unsigned short>(sign);
  const std::uint32_t whole = magnitude < 0x38800000 ? (magnitude & 0x7fffff) | 0x800000 : magnitude - 0x38000000;
  const std::uint32_t kept = whole >> shift, left = whole & ((1u << shift) - 1), half = 1u << (shift - 1);
  return static_cast<unsigned short>(sign | (kept + (left > half || (left == half && (kept & 1)))));
}
