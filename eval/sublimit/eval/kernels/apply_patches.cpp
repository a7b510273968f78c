// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/kernels/apply_patches.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "sublimit/eval/kernels/first_lanes.h"

// Compiled once for each kind of registers.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sublimit/eval/kernels/apply_patches.cpp"
#include <hwy/foreach_target.h>  // NOLINT: must come first
#include <hwy/highway.h>

#include "sublimit/eval/kernels/channels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sublimit::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// sums[i][v] = rows[v] of the weights * control points of patch i, of channels from `points` on. Several patches share
/// what is read of the weights, and keep the multipliers busy where there are few rows.
template <int Count, int Vectors, int Channels, bool Contract, class D, class Real = hn::TFromD<D>,
          class V = hn::Vec<D>>
HWY_INLINE void sum(D d, const Patches<Real>& p, const Real* weights, const Real* points, const std::int32_t* own,
                    const PackedRows* rows, Values<Channels, V> (*sums)[Vectors]) {
  const Real* at[Vectors];
  const std::int32_t* control_points[Count];
  for (int v = 0; v < Vectors; ++v) at[v] = weights + rows[v].first;
  for (int i = 0; i < Count; ++i) {
    control_points[i] = own + i * p.columns;
    for (int v = 0; v < Vectors; ++v)
      for (int c = 0; c < Channels; ++c) sums[i][v].of[c] = hn::Zero(d);
  }
  std::int64_t offset = 0;
  for (std::int32_t k = 0; k < p.columns; ++k, offset += p.stride) {
    V w[Vectors];
    for (int v = 0; v < Vectors; ++v) w[v] = hn::LoadU(d, at[v] + offset);
    for (int i = 0; i < Count; ++i) {
      const Real* const point = points + control_points[i][k] * p.in.point;
      for (int c = 0; c < Channels; ++c) {
        const V value = hn::Set(d, point[c * p.in.channel]);
        for (int v = 0; v < Vectors; ++v) sums[i][v].of[c] = mul_add<Contract>(w[v], value, sums[i][v].of[c]);
      }
    }
  }
}

/// Channels of the rows that are taken, one behind the other. Highway's own copies its table where the machine has no
/// instruction for it.
template <int Channels, class D, class V = hn::Vec<D>>
HWY_INLINE void compress(D d, Values<Channels, V>& x, std::uint32_t taken) {
#if HWY_TARGET == HWY_AVX2
  const hn::RebindToSigned<D> integers;
  const auto& all = first_lanes<hn::TFromD<decltype(integers)>, hn::MaxLanes(D())>;
  const auto lanes = hn::IndicesFromVec(d, hn::LoadU(integers, all[taken].data()));
  for (int c = 0; c < Channels; ++c) x.of[c] = hn::TableLookupLanes(x.of[c], lanes);
#else
  std::uint8_t bits[8] = {};
  std::memcpy(bits, &taken, sizeof taken);
  const auto mask = hn::LoadMaskBits(d, bits);
  for (int c = 0; c < Channels; ++c) x.of[c] = hn::Compress(x.of[c], mask);
#endif
}

/// The first ones, at most 32: by halves that overlap, for a loop becomes a call or an instruction that is slow to
/// start.
template <class Real>
HWY_INLINE void copy_first(const Real* from, Real* to, std::int32_t count) {
  const auto ends = [&](auto size) {
    constexpr std::int32_t n = decltype(size)::value;
    Real first[n], last[n];
    std::memcpy(first, from, sizeof first);
    std::memcpy(last, from + count - n, sizeof last);
    std::memcpy(to, first, sizeof first);
    std::memcpy(to + count - n, last, sizeof last);
  };
  if (count >= 16) return ends(std::integral_constant<std::int32_t, 16>());
  if (count >= 8) return ends(std::integral_constant<std::int32_t, 8>());
  if (count >= 4) return ends(std::integral_constant<std::int32_t, 4>());
  if (count >= 2) return ends(std::integral_constant<std::int32_t, 2>());
  if (count == 1) *to = *from;
}

/// Rows that are taken go to `out`, the first point of their patch.
template <int Channels, class D, class Real = hn::TFromD<D>, class V = hn::Vec<D>>
HWY_INLINE void store(D d, Values<Channels, V> x, const PackedRows& rows, const Patches<Real>& p, Real* out) {
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  const std::int32_t count = std::popcount(rows.taken);
  if (rows.taken & (rows.taken + 1)) compress<Channels>(d, x, rows.taken);  // else they are the first ones
  out += rows.to * p.out.point;
  if (p.out.channel == 1 && p.out.point == Channels) {
    // What is too much is overwritten by the rows that follow, unless it is another patch's.
    if (rows.to + lanes <= p.num_rows) return store_interleaved(d, x, out);
    HWY_ALIGN Real made[Channels * hn::MaxLanes(d)];
    store_interleaved(d, x, made);
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
    for (int c = 0; c < Channels; ++c) {
      const std::int32_t left = std::clamp(count * Channels - c * lanes, 0, lanes);
      hn::BlendedStore(hn::Load(d, made + c * lanes), hn::FirstN(d, size_t(left)), d, out + c * lanes);
    }
#else
    if constexpr (Channels * hn::MaxLanes(d) <= 32)
      copy_first(made, out, Channels * count);
    else
      std::copy_n(made, Channels * count, out);
#endif
    return;
  }
  HWY_ALIGN Real made[hn::MaxLanes(d)];
  for (int c = 0; c < Channels; ++c) {
    Real* to = out + c * p.out.channel;
    if (p.out.point == 1 && rows.to + lanes <= p.num_rows) {
      hn::StoreU(x.of[c], d, to);
      continue;
    }
    hn::Store(x.of[c], d, made);
    for (std::int32_t i = 0; i < count; ++i, to += p.out.point) *to = made[i];
  }
}

/// Where the points of a patch begin, counted from the result.
template <class Real>
HWY_INLINE std::int64_t first_number(const Patches<Real>& p, std::int64_t patch) {
  return (p.patch_points ? p.patch_points[patch] : patch * p.num_rows) * p.out.point;
}

/// `Count` patches from `first` on, `Vectors` registers of rows.
template <int Count, int Vectors, int Channels, bool Contract, class D, class Real = hn::TFromD<D>>
HWY_INLINE void patches(D d, const Patches<Real>& p, int channel, std::int64_t first, const PackedRows* rows) {
  Values<Channels, hn::Vec<D>> sums[Count][Vectors];
  sum<Count, Vectors, Channels, Contract>(d, p, p.weights, p.points + channel * p.in.channel,
                                          p.control_points + first * p.columns, rows, sums);
  for (int i = 0; i < Count; ++i) {
    Real* const out = p.result + channel * p.out.channel + first_number(p, first + i);
    for (int v = 0; v < Vectors; ++v) store<Channels>(d, sums[i][v], rows[v], p, out);
  }
}

/// Calls body(rows) with all rows, by registers of this width.
template <class D, class Real, class Body>
HWY_INLINE void for_each_part(D d, const Patches<Real>& p, const Body& body) {
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  if (lanes == row_multiple) return body(p.rows);
  // Some at a time, so that there is nothing to allocate.
  constexpr size_t some = 16;
  PackedRows part[some * row_multiple];
  for (size_t begin = 0; begin < p.rows.size(); begin += some) {
    size_t count = 0;
    for (const PackedRows& rows : p.rows.subspan(begin, std::min(some, p.rows.size() - begin))) {
      std::int32_t to = rows.to;
      for (std::int32_t lane = 0; lane < row_multiple; lane += lanes) {
        const std::uint32_t taken = rows.taken >> lane & ((1u << lanes) - 1);
        if (taken) part[count++] = {rows.first + lane, to, taken};
        to += std::popcount(taken);
      }
    }
    body(std::span<const PackedRows>(part, count));
  }
}

/// Channels from `channel` on; as many registers as there are for them, the points and the weights.
template <int Channels, bool Contract, class D, class Real = hn::TFromD<D>>
HWY_NOINLINE void apply_channels(D d, const Patches<Real>& p, int channel) {
  constexpr int Most = Channels == 4 ? 3 : 4;
  for_each_part(d, p, [&](std::span<const PackedRows> rows) {
    std::int64_t i = 0;
    if constexpr (Channels == 3) {
      if (rows.size() == 1)
        for (; i + 4 <= p.count; i += 4) patches<4, 1, Channels, Contract>(d, p, channel, i, rows.data());
      if (rows.size() == 2)
        for (; i + 2 <= p.count; i += 2) patches<2, 2, Channels, Contract>(d, p, channel, i, rows.data());
    }
    for (; i < p.count; ++i) {
      const PackedRows* at = rows.data();
      size_t left = rows.size();
      for (; left >= Most; left -= Most, at += Most) patches<1, Most, Channels, Contract>(d, p, channel, i, at);
      if (Channels == 3 && left == 3) {
        patches<1, 3, Channels, Contract>(d, p, channel, i, at);
      } else if (Channels == 3 && left == 2) {
        patches<1, 2, Channels, Contract>(d, p, channel, i, at);
      } else {
        for (; left > 0; --left, ++at) patches<1, 1, Channels, Contract>(d, p, channel, i, at);
      }
    }
  });
}

template <bool Contract, class Real>
void apply(const Patches<Real>& p) {
  const hn::ScalableTag<Real> d;
  int channel = 0;
  for (; p.channels - channel > 4; channel += 4) apply_channels<4, Contract>(d, p, channel);
  const int left = p.channels - channel;
  if (left == 4) apply_channels<4, Contract>(d, p, channel);
  if (left == 3) apply_channels<3, Contract>(d, p, channel);
  if (left == 2) apply_channels<2, Contract>(d, p, channel);
  if (left == 1) apply_channels<1, Contract>(d, p, channel);
}

void apply_float(const Patches<float>& p, bool contract) { contract ? apply<true>(p) : apply<false>(p); }
void apply_double(const Patches<double>& p, bool contract) { contract ? apply<true>(p) : apply<false>(p); }

template <bool Contract, class Real>
void frames(const Patches<Real>& p, const Patches<Real>& q, const TangentFrames<Real>& f) {
  const hn::ScalableTag<Real> d;
  using V = hn::Vec<decltype(d)>;
  const auto apply_rows = [&](const PackedRows& rows, std::int64_t patch) {
    const std::int64_t begin = first_number(p, patch);
    const std::int32_t* const own = p.control_points + patch * p.columns;
    Values<3, V> sums[2][1];
    sum<1, 1, 3, Contract>(d, p, p.weights, p.points, own, &rows, sums);
    sum<1, 1, 3, Contract>(d, p, q.weights, p.points, own, &rows, sums + 1);
    const Values<3, V>&u = sums[0][0], &v = sums[1][0];
    if (p.result) store<3>(d, u, rows, p, p.result + begin);
    if (q.result) store<3>(d, v, rows, p, q.result + begin);
    const Frame<V> frame = tangent_frame<Contract>(d, u, v);
    if (f.tangents) store<3>(d, frame.t, rows, p, f.tangents + begin);
    if (f.bitangents) store<3>(d, cross(frame.n, frame.t), rows, p, f.bitangents + begin);
    if (f.normals) store<3>(d, frame.n, rows, p, f.normals + begin);
  };
  for_each_part(d, p, [&](std::span<const PackedRows> all) {
    for (std::int64_t i = 0; i < p.count; ++i)
      for (const PackedRows& rows : all) apply_rows(rows, i);
  });
}

void frames_float(const Patches<float>& u, const Patches<float>& v, const TangentFrames<float>& f, bool contract) {
  contract ? frames<true>(u, v, f) : frames<false>(u, v, f);
}
void frames_double(const Patches<double>& u, const Patches<double>& v, const TangentFrames<double>& f, bool contract) {
  contract ? frames<true>(u, v, f) : frames<false>(u, v, f);
}

}  // namespace sublimit::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sublimit::kernels {

HWY_EXPORT(apply_float);
HWY_EXPORT(apply_double);
HWY_EXPORT(frames_float);
HWY_EXPORT(frames_double);

void apply_patches(const Patches<float>& patches, bool contract) {
  HWY_DYNAMIC_DISPATCH(apply_float)(patches, contract);
}
void apply_patches(const Patches<double>& patches, bool contract) {
  HWY_DYNAMIC_DISPATCH(apply_double)(patches, contract);
}
void apply_frames(const Patches<float>& along_u, const Patches<float>& along_v, const TangentFrames<float>& frames,
                  bool contract) {
  HWY_DYNAMIC_DISPATCH(frames_float)(along_u, along_v, frames, contract);
}
void apply_frames(const Patches<double>& along_u, const Patches<double>& along_v, const TangentFrames<double>& frames,
                  bool contract) {
  HWY_DYNAMIC_DISPATCH(frames_double)(along_u, along_v, frames, contract);
}

std::vector<std::int64_t> targets() { return hwy::SupportedAndGeneratedTargets(); }
void use_target(std::int64_t target) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace sublimit::kernels
#endif
