// SPDX-License-Identifier: Apache-2.0
#pragma once
// Zorin, Schroeder, Sweldens 1996, "Interpolating subdivision for meshes with arbitrary topology": the butterfly, with
// rules of their own for edges at interior vertices of valence other than 6. Option t is that of the ten-point mask,
// not a tension. Border: see butterfly.h. Border vertices count as regular, whatever their valence.
#include "sublimit/schemes/butterfly.h"

namespace sublimit {

template <class T>
Scheme<T> modified_butterfly(const SchemeOptions& options) {
  const OptionInfo info{.name = "t",
                        .values = {"0"},
                        .meaning =
                            "weight of the two far points on the line of the edge: 0 is the eight-point mask; a third "
                            "eigenvalue of regular points reaches 1/2, and tangents are lost, at -1/16 and 1/24",
                        .range = OptionRange{{-1, 32}, {1, 32}}};
  const Ratio t = ratio_option(options, info);
  const auto regular = [=](const WideEdgeSite<T>& e) {
    const Ring<T>&a = e.tail_ring(), &b = e.head_ring();
    const T far = e.ratio(t.p, t.q);
    return (e.ratio(1, 2) - far) * (e.tail() + e.head()) +
           (e.ratio(1, 8) + 2 * far) * (a.continued(1) + a.continued(-1)) -
           (e.ratio(1, 16) + far) * (a.continued(2) + a.continued(-2) + b.continued(2) + b.continued(-2)) +
           far / 2 * (a.continued(3) + a.continued(-3) + b.continued(3) + b.continued(-3));
  };
  const auto extraordinary = [](const Ring<T>& v) {
    const int k = v.valence();
    Stencil<T> sum = v.ratio(3, 4) * v.center();
    for (int i = 0; i < k; ++i) {
      T weight(0);
      if (k == 2)
        weight = i == 0 ? v.ratio(1, 4) : T(0);
      else if (k == 3)
        weight = i == 0 ? v.ratio(5, 12) : v.ratio(-1, 12);
      else if (k == 4)
        weight = i == 0 ? v.ratio(3, 8) : i == 2 ? v.ratio(-1, 8) : T(0);
      else
        weight = (v.ratio(1, 4) + v.cos_2pi(i, k) + v.cos_2pi(2 * i, k) / 2) / k;
      sum += weight * v.neighbor(i);
    }
    return sum;
  };
  Scheme<T> scheme =
      butterfly_with<T>("modified-butterfly",
                        "Zorin, Schroeder, Sweldens 1996, Interpolating subdivision for meshes with arbitrary topology",
                        options, {info}, {1, 1}, [=](const WideEdgeSite<T>& e) {
                          const auto special = [](const Ring<T>& v) { return v.is_closed() && v.valence() != 6; };
                          const bool a = special(e.tail_ring()), b = special(e.head_ring());
                          if (a && b) return (extraordinary(e.tail_ring()) + extraordinary(e.head_ring())) / 2;
                          return a ? extraordinary(e.tail_ring()) : b ? extraordinary(e.head_ring()) : regular(e);
                        });
  scheme.claims.extraordinary = 1;
  return scheme;
}

}  // namespace sublimit
