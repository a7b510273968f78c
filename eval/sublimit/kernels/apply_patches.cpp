// SPDX-License-Identifier: Apache-2.0
#include "sublimit/kernels/apply_patches.h"

#include <algorithm>

// Compiled once for each kind of registers.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sublimit/kernels/apply_patches.cpp"
#include <hwy/foreach_target.h>  // NOLINT: must come first
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sublimit::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <bool Contract, class V>
HWY_INLINE V mul_add(V a, V b, V sum) {
  if constexpr (Contract) return hn::MulAdd(a, b, sum);
  return hn::Add(hn::Mul(a, b), sum);
}

/// `Vectors` registers of rows from `first` on, of one patch: x, y, z.
template <int Vectors, bool Contract, class D, class Real = hn::TFromD<D>>
HWY_INLINE void rows_of_three(D d, const Patches<Real>& p, const std::int32_t* own, std::int32_t first, Real* out) {
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  using V = hn::Vec<D>;
  V x[Vectors], y[Vectors], z[Vectors];
  for (int v = 0; v < Vectors; ++v) x[v] = y[v] = z[v] = hn::Zero(d);
  const Real* weights = p.weights + first;
  for (std::int32_t k = 0; k < p.columns; ++k, weights += p.stride) {
    const Real* point = p.points + std::int64_t{own[k]} * 3;
    const V px = hn::Set(d, point[0]), py = hn::Set(d, point[1]), pz = hn::Set(d, point[2]);
    for (int v = 0; v < Vectors; ++v) {
      const V w = hn::LoadU(d, weights + v * lanes);
      x[v] = mul_add<Contract>(w, px, x[v]);
      y[v] = mul_add<Contract>(w, py, y[v]);
      z[v] = mul_add<Contract>(w, pz, z[v]);
    }
  }
  for (int v = 0; v < Vectors; ++v) {
    const std::int32_t row = first + v * lanes;
    if (row + lanes <= p.rows) {
      hn::StoreInterleaved3(x[v], y[v], z[v], d, out + std::int64_t{row} * 3);
    } else {
      HWY_ALIGN Real rest[3 * hn::MaxLanes(d)];
      hn::StoreInterleaved3(x[v], y[v], z[v], d, rest);
      std::copy_n(rest, 3 * std::clamp(p.rows - row, 0, lanes), out + std::int64_t{row} * 3);
    }
  }
}

template <int Vectors, bool Contract, class D, class Real = hn::TFromD<D>>
HWY_INLINE void rows_of_any(D d, const Patches<Real>& p, const std::int32_t* own, std::int32_t first, Real* out) {
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  using V = hn::Vec<D>;
  for (int channel = 0; channel < p.channels; ++channel) {
    V x[Vectors];
    for (int v = 0; v < Vectors; ++v) x[v] = hn::Zero(d);
    const Real* weights = p.weights + first;
    for (std::int32_t k = 0; k < p.columns; ++k, weights += p.stride) {
      const V value = hn::Set(d, p.points[std::int64_t{own[k]} * p.channels + channel]);
      for (int v = 0; v < Vectors; ++v) x[v] = mul_add<Contract>(hn::LoadU(d, weights + v * lanes), value, x[v]);
    }
    HWY_ALIGN Real made[Vectors * hn::MaxLanes(d)];
    for (int v = 0; v < Vectors; ++v) hn::StoreU(x[v], d, made + v * lanes);
    const std::int32_t count = std::min(Vectors * lanes, p.rows - first);
    Real* to = out + std::int64_t{first} * p.channels + channel;
    for (std::int32_t i = 0; i < count; ++i, to += p.channels) *to = made[i];
  }
}

template <bool Contract, class Real>
void apply(const Patches<Real>& p) {
  const hn::ScalableTag<Real> d;
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  const std::int32_t* own = p.control_points;
  for (std::int64_t i = 0; i < p.count; ++i, own += p.columns) {
    Real* const out = p.result + (p.patch_points ? p.patch_points[i] : i * p.rows) * p.channels;
    // Four registers of each of x, y, z: with the points and the weights they fill what there is.
    const auto chunk = [&]<int Vectors>(std::int32_t first) {
      if (p.channels == 3)
        rows_of_three<Vectors, Contract>(d, p, own, first, out);
      else
        rows_of_any<Vectors, Contract>(d, p, own, first, out);
    };
    std::int32_t first = 0;
    for (; p.rows - first > 3 * lanes; first += 4 * lanes) chunk.template operator()<4>(first);
    if (p.rows - first > 2 * lanes)
      chunk.template operator()<3>(first);
    else if (p.rows - first > lanes)
      chunk.template operator()<2>(first);
    else if (p.rows > first)
      chunk.template operator()<1>(first);
  }
}

void apply_float(const Patches<float>& p, bool contract) { contract ? apply<true>(p) : apply<false>(p); }
void apply_double(const Patches<double>& p, bool contract) { contract ? apply<true>(p) : apply<false>(p); }

}  // namespace sublimit::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sublimit::kernels {

HWY_EXPORT(apply_float);
HWY_EXPORT(apply_double);

void apply_patches(const Patches<float>& patches, bool contract) {
  HWY_DYNAMIC_DISPATCH(apply_float)(patches, contract);
}
void apply_patches(const Patches<double>& patches, bool contract) {
  HWY_DYNAMIC_DISPATCH(apply_double)(patches, contract);
}

std::vector<std::int64_t> targets() { return hwy::SupportedAndGeneratedTargets(); }
void use_target(std::int64_t target) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace sublimit::kernels
#endif
