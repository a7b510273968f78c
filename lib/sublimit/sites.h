// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sites: where a mask is applied, as the mask sees it. A site numbers the points of its neighbourhood (slots, in the order
// in which `visit_site` of mask_table.h visits their vertices); the neighbourhood is unfolded, so points that coincide on a
// small mesh are different slots here. A mask therefore depends on the type of the neighbourhood alone.
#include <functional>
#include <span>
#include <vector>

#include "sublimit/number.h"
#include "sublimit/stencil.h"

namespace sublimit {

template <class T>
struct Masks;

/// What every site knows: the level of the parent (0 for the control mesh), constants in the number type, and the masks of
/// the step, for child points that are already made.
template <class T>
class Site {
 public:
  Site(const Masks<T>& masks, int level) : masks_(&masks), level_(level) {}
  int level() const { return level_; }
  static T ratio(int p, int q) { return Number<T>::ratio(p, q); }
  static T cos_2pi(int k, int n) { return Number<T>::cos_2pi(k, n); }

 protected:
  const Masks<T>* masks_;
  int level_;
};

/// A face, seen from a given corner on.
template <class T>
class FaceSite : public Site<T> {
 public:
  FaceSite(const Masks<T>& masks, int level, std::vector<Index> slots)
      : Site<T>(masks, level), slots_(std::move(slots)) {}
  int size() const { return static_cast<int>(slots_.size()); }
  Stencil<T> corner(int i) const { return Stencil<T>(slots_[i]); }
  Stencil<T> centroid() const {
    Stencil<T> sum;
    for (const Index slot : slots_) sum += Stencil<T>(slot);
    return std::move(sum) / T(size());
  }
  /// The child point that the step makes for this face.
  Stencil<T> point() const { return this->masks_->face(*this); }

 private:
  std::vector<Index> slots_;
};

/// An interior edge with its two faces. The left one starts with (tail, head), the right one with (head, tail).
/// Slots: 0 tail, 1 head, the other corners of the left face, those of the right face.
template <class T>
class EdgeSite : public Site<T> {
 public:
  EdgeSite(const Masks<T>& masks, int level, int left_size, int right_size) : Site<T>(masks, level) {
    left_ = {0, 1};
    right_ = {1, 0};
    Index slot = 2;
    while (static_cast<int>(left_.size()) < left_size) left_.push_back(slot++);
    while (static_cast<int>(right_.size()) < right_size) right_.push_back(slot++);
  }
  Stencil<T> tail() const { return Stencil<T>(0); }
  Stencil<T> head() const { return Stencil<T>(1); }
  FaceSite<T> left_face() const { return {*this->masks_, this->level_, left_}; }
  FaceSite<T> right_face() const { return {*this->masks_, this->level_, right_}; }

 private:
  std::vector<Index> left_, right_;
};

/// An interior vertex with its faces, counter-clockwise.
/// Slots: 0 the vertex, then for each face its corners from the far end of its first edge on, up to the next face's.
template <class T>
class Ring : public Site<T> {
 public:
  Ring(const Masks<T>& masks, int level, std::span<const Index> face_sizes) : Site<T>(masks, level) {
    Index slot = 1;
    for (const Index size : face_sizes) {
      faces_.push_back({0});
      for (Index i = 2; i < size; ++i) faces_.back().push_back(slot++);
    }
    for (size_t i = 0; i < faces_.size(); ++i) faces_[i].push_back(faces_[(i + 1) % faces_.size()][1]);
  }
  int valence() const { return static_cast<int>(faces_.size()); }
  Stencil<T> center() const { return Stencil<T>(0); }
  /// The vertex at the other end of edge i; face i lies between edges i and i+1.
  Stencil<T> neighbor(int i) const { return Stencil<T>(faces_[i][1]); }
  FaceSite<T> face(int i) const { return {*this->masks_, this->level_, faces_[i]}; }

  Stencil<T> neighbor_mean() const {
    return mean([&](int i) { return neighbor(i); });
  }
  Stencil<T> face_centroid_mean() const {
    return mean([&](int i) { return face(i).centroid(); });
  }
  Stencil<T> face_point_mean() const {
    return mean([&](int i) { return face(i).point(); });
  }

 private:
  template <class Point>
  Stencil<T> mean(const Point& point) const {
    Stencil<T> sum;
    for (int i = 0; i < valence(); ++i) sum += point(i);
    return std::move(sum) / T(valence());
  }
  std::vector<std::vector<Index>> faces_;
};

/// A vertex on a crease or boundary and its two neighbours along it. Slots: 0 the vertex, 1 and 2 the neighbours.
template <class T>
class CreaseSite : public Site<T> {
 public:
  using Site<T>::Site;
  Stencil<T> center() const { return Stencil<T>(0); }
  Stencil<T> before() const { return Stencil<T>(1); }
  Stencil<T> after() const { return Stencil<T>(2); }
};

/// A sharp or boundary edge. Slots: 0 tail, 1 head.
template <class T>
class CreaseEdgeSite : public Site<T> {
 public:
  using Site<T>::Site;
  Stencil<T> tail() const { return Stencil<T>(0); }
  Stencil<T> head() const { return Stencil<T>(1); }
};

/// The masks of one step; a group that the step's split does not make stays empty.
template <class T>
struct Masks {
  std::function<Stencil<T>(const Ring<T>&)> vertex = {};
  std::function<Stencil<T>(const EdgeSite<T>&)> edge = {};
  std::function<Stencil<T>(const FaceSite<T>&)> face = {};
};

/// The masks along sharp edges and boundaries. A corner stays where it is.
template <class T>
struct CreaseMasks {
  std::function<Stencil<T>(const CreaseSite<T>&)> vertex;
  std::function<Stencil<T>(const CreaseEdgeSite<T>&)> edge;
};

}  // namespace sublimit
