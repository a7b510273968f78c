// SPDX-License-Identifier: Apache-2.0
#pragma once
// Knots for other control nets of the same curve over the same domain; `refinement_rows` and `elevation_rows`
// compute the nets.
#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "sublimit/patches/knots.h"

namespace sublimit {

/// Returns open knots with a given domain, cut out of a longer list: those in the domain and `degree` on either
/// side.
/// @param all  ascending; contains both ends of the domain and at least `degree` knots beyond each
template <class T>
Knots<T> cut_to_domain(int degree, const std::vector<T>& all, const T& begin, const T& end) {
  // One of several equal knots at an end belongs to the domain; the others would leave control points without
  // influence.
  const auto first = std::upper_bound(all.begin(), all.end(), begin) - 1,
             last = std::lower_bound(first, all.end(), end);
  const Index points = static_cast<Index>(last - first) + degree;
  return Knots<T>::open(degree, points, {first - degree, last + degree + 1});
}

/// Returns knots with the middle of every span that is not empty inserted once: the natural next level. Those beyond an
/// open end are halved too, so that uniform knots stay uniform.
/// @throws InvalidParameter  a span that has no number in its middle
template <class T>
Knots<T> halved_knots(const Knots<T>& knots) {
  const std::span<const T> coarse = knots.is_closed() ? knots.in_domain() : knots.all();
  std::vector<T> fine;
  for (size_t i = 0; i < coarse.size(); ++i) {
    if (i > 0 && coarse[i - 1] < coarse[i]) {
      const T middle = coarse[i - 1] + (coarse[i] - coarse[i - 1]) / T(2);
      if (!(coarse[i - 1] < middle && middle < coarse[i]))
        refuse_knot(KnotFault::too_near, static_cast<Index>(i), static_cast<double>(coarse[i]),
                    static_cast<double>(coarse[i - 1]));
      fine.push_back(middle);
    }
    fine.push_back(coarse[i]);
  }
  if (knots.is_closed()) return Knots<T>::closed(knots.degree(), fine);
  return cut_to_domain(knots.degree(), fine, knots.begin(), knots.end());
}

/// Returns knots with the knot `t` inserted `times` times.
/// @throws InvalidParameter  t is not inside the domain (the start of a closed spline is), or becomes too
///                           frequent
template <class T>
Knots<T> with_knot(const Knots<T>& knots, const T& t, int times = 1) {
  const bool inside = knots.begin() < t && t < knots.end();
  if (!inside && !(knots.is_closed() && t == knots.begin()))
    refuse_parameter(static_cast<double>(t), static_cast<double>(knots.begin()), static_cast<double>(knots.end()));
  const std::span<const T> coarse = knots.is_closed() ? knots.in_domain() : knots.all();
  std::vector<T> fine(coarse.begin(), coarse.end());
  fine.insert(std::upper_bound(fine.begin(), fine.end(), t), static_cast<size_t>(times), t);
  if (knots.is_closed()) return Knots<T>::closed(knots.degree(), fine);
  return cut_to_domain(knots.degree(), fine, knots.begin(), knots.end());
}

/// Returns knots with the same domain and other knots outside of it; a closed spline is opened. Weights over
/// the old control points can be negative and large if the new knots are not among the old ones.
/// @param before, after  knots outside on each side, ascending, `degree` many
template <class T>
Knots<T> with_end_knots(const Knots<T>& knots, std::vector<T> before, const std::vector<T>& after) {
  const auto first = std::upper_bound(knots.all().begin(), knots.all().end(), knots.begin()) - 1;
  const auto last = std::lower_bound(first, knots.all().end(), knots.end()) + 1;
  std::vector<T> all = std::move(before);
  all.insert(all.end(), first, last);
  all.insert(all.end(), after.begin(), after.end());
  return cut_to_domain(knots.degree(), all, knots.begin(), knots.end());
}

/// Returns knots of the same spline with interpolated ends; a closed spline is opened.
template <class T>
Knots<T> clamped_knots(const Knots<T>& knots) {
  const auto p = static_cast<size_t>(knots.degree());
  return with_end_knots(knots, std::vector<T>(p, knots.begin()), std::vector<T>(p, knots.end()));
}

/// Returns the knots of the net of all Bezier pieces: ends are interpolated and inner knots have at least
/// multiplicity `degree`, so that neighbours share control points. A closed spline is opened.
template <class T>
Knots<T> bezier_pieces(const Knots<T>& knots) {
  const Knots<T> open = clamped_knots(knots);
  const int p = open.degree();
  std::vector<T> all;
  auto next = open.all().begin();
  for (Index face = 1; face < open.num_faces(); ++face) {
    const Index k = open.span(face);  // the last of its equals
    const auto end = open.all().begin() + k + 1;
    all.insert(all.end(), next, end);
    const int more = *open.continuity(face, KnotSide::left);  // C^(p-r) lacks p - r knots
    if (more > 0) all.insert(all.end(), static_cast<size_t>(more), open.all()[k]);
    next = end;
  }
  all.insert(all.end(), next, open.all().end());
  return cut_to_domain(p, all, open.begin(), open.end());
}

/// Returns the knots of the spline written in one degree more: the multiplicity of every knot increases by one.
/// @throws InvalidParameter  the new degree exceeds `max_degree`
template <class T>
Knots<T> elevated_knots(const Knots<T>& knots) {
  const std::span<const T> coarse = knots.is_closed() ? knots.in_domain() : knots.all();
  std::vector<T> fine;
  for (size_t i = 0; i < coarse.size(); ++i) {
    if (i == 0 || coarse[i - 1] < coarse[i]) fine.push_back(coarse[i]);
    fine.push_back(coarse[i]);
  }
  if (knots.is_closed()) {
    fine.pop_back();  // its end is its start
    return Knots<T>::closed(knots.degree() + 1, fine);
  }
  return cut_to_domain(knots.degree() + 1, fine, knots.begin(), knots.end());
}

}  // namespace sublimit
