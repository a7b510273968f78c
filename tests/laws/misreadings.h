// SPDX-License-Identifier: Apache-2.0
#pragma once
// Known misprints and misreadings of the rules of well-known schemes, each as a scheme of its own. Tests
// (lib/errata_test.cpp) show their consequences. The rules in the registry are those of the papers.
#include "sublimit/schemes/schemes.h"

namespace sublimit::testing::misread {

/// "sqrt(3): centroids and flipped edges", and nothing else.
template <class T>
Scheme<T> sqrt3_without_relaxation() {
  Scheme<T> scheme = *find_scheme<T>("sqrt3");
  scheme.steps[0].masks.vertex = [](const Ring<T>& v) { return v.center(); };
  return scheme;
}

/// "The midpoint of vertex and centroid": (5, 1, 1, 1)/8 on quads.
template <class T>
Scheme<T> doo_sabin_halfway() {
  return doo_sabin_with<T>("halfway", "", [](const FaceSite<T>& f, int j) {
    return f.ratio(1, 2 * f.size()) + (j == 0 ? f.ratio(1, 2) : T(0));
  });
}

/// Doo-Sabin's weights with a sum over i = 0 ... n, in which corner 0 occurs twice.
template <class T>
Scheme<T> doo_sabin_with_one_term_more() {
  return doo_sabin_with<T>("one-term-more", "", [](const FaceSite<T>& f, int j) {
    const int n = f.size();
    return j == 0 ? f.ratio(n + 5, 4 * n) * 2 : (T(3) + 2 * f.cos_2pi(j, n)) / (4 * n);
  });
}

/// "The mean of centroid, vertex and the midpoints of its two edges."
template <class T>
Scheme<T> doo_sabin_mean_of_four() {
  Scheme<T> scheme = *find_scheme<T>("doo-sabin");
  scheme.steps[0].masks.corner = [](const FaceSite<T>& f) {
    const Stencil<T> v = f.corner(0), next = (v + f.corner(1)) / 2, last = (v + f.corner(f.size() - 1)) / 2;
    return (f.centroid() + v + next + last) / 4;
  };
  return scheme;
}

/// Two mid-edge steps as one step, from a corner and its neighbours in the face.
template <class T>
Scheme<T> doo_sabin_of_three_corners() {
  return doo_sabin_with<T>("three-corners", "", [](const FaceSite<T>& f, int j) {
    return j == 0 ? f.ratio(1, 2) : j == 1 || j == f.size() - 1 ? f.ratio(1, 4) : T(0);
  });
}

/// "Points of edges at extraordinary places are joined with the centroids of the faces", misread as a rule for
/// edges of faces that are not quads: the point halfway from the midpoint to the centroid.
template <class T>
Scheme<T> mid_edge_with_centroids() {
  return mid_edge_with<T>("mid-edge-with-centroids", "", [](const EdgeSite<T>& e) {
    const Stencil<T> middle = (e.tail() + e.head()) / 2;
    Stencil<T> point = middle;
    for (const FaceSite<T>& f : {e.left_face(), e.right_face()})
      if (f.size() != 4) point += (f.centroid() - middle) / 2;
    return point;
  });
}

/// Catmull-Clark's new vertex (F + 2 R + (n - 3) v)/n, where R is the mean of `edge(ring, i)` over its edges.
template <class T, class Edge>
Scheme<T> catmull_clark_with(const Edge& edge) {
  Scheme<T> scheme = *find_scheme<T>("catmull-clark");
  scheme.steps[0].masks.vertex = [=](const Ring<T>& v) {
    const int n = v.valence();
    Stencil<T> points;
    for (int i = 0; i < n; ++i) points += edge(v, i);
    return (v.face_point_mean() + 2 * points / T(n) + (n - 3) * v.center()) / n;
  };
  return scheme;
}
template <class T>
Scheme<T> catmull_clark_with_new_edge_points() {
  return catmull_clark_with<T>([](const Ring<T>& v, int i) {
    return (v.center() + v.neighbor(i) + v.face(i - 1).centroid() + v.face(i).centroid()) / 4;
  });
}
template <class T>
Scheme<T> catmull_clark_with_old_midpoints() {
  return catmull_clark_with<T>([](const Ring<T>& v, int i) { return (v.center() + v.neighbor(i)) / 2; });
}

/// Loop's weight of one neighbour taken as that of the whole ring, so that it is divided by the valence twice.
template <class T>
Scheme<T> loop_divided_twice() {
  return loop_with<T>("loop-divided-twice", "", [](const Ring<T>& v) {
    const T a = v.ratio(3, 8) + v.cos_2pi(1, v.valence()) / 4;
    return (v.ratio(5, 8) - a * a) / v.valence();
  });
}

/// The modified butterfly's rule for valences from 5 on, used also at vertices of valence 6.
template <class T>
Scheme<T> modified_butterfly_with_one_formula() {
  Scheme<T> scheme = *find_scheme<T>("modified-butterfly");
  scheme.steps[0].masks.wide_edge = [](const WideEdgeSite<T>& e) {
    Stencil<T> sum;
    for (const Ring<T>* v : {&e.tail_ring(), &e.head_ring()}) {
      if (!v->is_closed()) {  // on borders anything: for neighbourhoods without
        sum += v->center();
        continue;
      }
      const int k = v->valence();
      sum += v->ratio(3, 4) * v->center();
      for (int i = 0; i < k; ++i)
        sum += (v->ratio(1, 4) + v->cos_2pi(i, k) + v->cos_2pi(2 * i, k) / 2) / k * v->neighbor(i);
    }
    return sum / T(2);
  };
  return scheme;
}

/// Kobbelt's scheme with tension 1 and face points computed in one direction only (0 or 1); `r` is the weight
/// of diagonals in the virtual point. Only for neighbourhoods without borders, where its rules have no meaning.
template <class T>
Scheme<T> kobbelt_one_way(int way, Ratio r) {
  Scheme<T> scheme = *find_scheme<T>("kobbelt");
  scheme.steps[0].masks.wide_edge = [=](const WideEdgeSite<T>& e) {
    const auto beyond = [=](const Ring<T>& v) {
      if (!v.is_closed()) return v.center();
      Stencil<T> sum;
      const int n = v.valence();
      const T weight = v.ratio(r.p, r.q);
      for (int j = 0; j < n; ++j) sum += T(4) / n * (v.neighbor(j) - weight * v.diagonal(j));
      for (const int j : {-1, 0, 1}) sum += T(-1) * v.neighbor(j);
      for (const int j : {-2, -1, 0, 1}) sum += weight * v.diagonal(j);
      return sum;
    };
    return e.ratio(9, 16) * (e.tail() + e.head()) - e.ratio(1, 16) * (beyond(e.tail_ring()) + beyond(e.head_ring()));
  };
  scheme.steps[0].masks.wide_face = [=](const WideFaceSite<T>& f) {
    const auto next = [&](int i) { return f.has_across(i) ? f.edge_point_beyond(i) : f.edge_point(i); };
    return f.ratio(9, 16) * (f.edge_point(way) + f.edge_point(way + 2)) - f.ratio(1, 16) * (next(way) + next(way + 2));
  };
  return scheme;
}

}  // namespace sublimit::testing::misread
