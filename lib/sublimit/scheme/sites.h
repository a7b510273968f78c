// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sites: the arguments of masks. A site is a vertex, edge or face with the points around it, and a mask is a function
// from a site to the stencil of the new point:
//
//   const Mask<double, EdgeSite<double>> edge = [](const EdgeSite<double>& e) {
//     return (3 * (e.tail() + e.head()) + e.left_face().corner(2) + e.right_face().corner(2)) / 8;  // Loop's
//   };
//
// A site numbers the points of its neighbourhood (slots). The neighbourhood is unfolded: points that coincide on a
// small mesh are different slots. A mask therefore depends on the type of the neighbourhood alone.
#include <algorithm>
#include <compare>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/core/number.h"
#include "sublimit/core/stencil.h"

namespace sublimit {

template <class T>
struct Masks;

/// Knots along an edge, seen from one of its ends, for schemes with knot intervals: intervals and the new knot of the
/// step. If intervals belong to points (`PointKnots`), `length` and `split` are those of the near end, `after` and
/// `before` those of the far one.
template <class T>
struct EdgeKnots {
  T length = T(1);                   ///< interval of the edge
  T split = Number<T>::ratio(1, 2);  ///< distance of the new knot from this end
  T before = T(1), after = T(1);  ///< intervals beyond this end and beyond the other: means if several edges continue
  /// Returns the distance of the new knot from this end.
  const T& near() const { return split; }
  /// Returns the distance of the new knot from the other end.
  T far() const { return length - split; }
  /// Returns the knots seen from the other end.
  EdgeKnots reversed() const { return {length, far(), after, before}; }
};

/// Knots of a point along one of its edges, in degree 2, where the knot between two points is on the edge.
template <class T>
struct PointKnots {
  T length = T(1);                   ///< interval of the point
  T split = Number<T>::ratio(1, 2);  ///< distance of the new knot from the knot on the edge
  PointKnots() = default;
  PointKnots(T own_length, T own_split) : length(std::move(own_length)), split(std::move(own_split)) {}
  /// Returns the distance of the new knot from the knot on the edge, as a fraction of the interval.
  T part() const { return split / length; }
};

/// Returns the position of element `i` of `count`; negative numbers count from the end, -1 is the last one.
/// @param element, owner  words of the message, as in "corner 3 of a face"
/// @throws InvalidParameter  an element that does not exist
inline int site_position(int i, int count, const char* element, const char* owner) {
  if (i >= -count && i < count) return i < 0 ? i + count : i;
  throw InvalidParameter("a mask asks for " + std::string(element) + " " + std::to_string(i) + " of " + owner + " of " +
                         std::to_string(count) + "; 0 to " + std::to_string(count - 1) +
                         " exist, -1 is the last one and -" + std::to_string(count) + " the first");
}

/// Common part of all sites: the level of the parent (0 for the control mesh), constants in the number type, and the
/// masks of the step, for new points that a mask uses. Sites are read by one thread at a time, or by several.
template <class T>
class Site {
 public:
  Site(const Masks<T>& masks, int level) : masks_(&masks), level_(level) {}
  /// Returns the level of the parent, 0 for the control mesh.
  int level() const { return level_; }
  static T ratio(int p, int q) { return Number<T>::ratio(p, q); }
  static T cos_2pi(int k, int n) { return Number<T>::cos_2pi(k, n); }

 protected:
  const Masks<T>* masks_;
  int level_;
};

/// A face, starting at a given corner. Corners and edges count from 0; -1 is the last one.
template <class T>
class FaceSite : public Site<T> {
 public:
  FaceSite(const Masks<T>& masks, int level, std::vector<Index> slots, std::vector<EdgeKnots<T>> knots = {})
      : Site<T>(masks, level), slots_(std::move(slots)), knots_(std::move(knots)) {}
  /// Returns the number of corners.
  int size() const { return static_cast<int>(slots_.size()); }
  /// Returns the knots of the edge from corner i to the next one, seen from corner i.
  EdgeKnots<T> knots(int i) const {
    const int at = position(i);
    return knots_.empty() ? EdgeKnots<T>{} : knots_[at];
  }
  /// Returns the knots of corner i along the edge to the next corner, in degree 2.
  PointKnots<T> knots_to_next(int i) const {
    const int at = position(i);
    if (knots_.empty()) return {};
    const EdgeKnots<T>& k = knots_[at];
    return {k.length, k.split};
  }
  /// Returns the knots of corner i along the edge to the corner before, in degree 2.
  PointKnots<T> knots_to_previous(int i) const {
    const int at = position(i);
    if (knots_.empty()) return {};
    const EdgeKnots<T>& k = knots_[at == 0 ? size() - 1 : at - 1];
    return {k.after, k.before};
  }
  Stencil<T> corner(int i) const { return Stencil<T>(slots_[position(i)]); }
  /// Returns the mean of the corners.
  Stencil<T> centroid() const {
    Stencil<T> sum;
    for (const Index slot : slots_) sum += Stencil<T>(slot);
    return std::move(sum) / T(size());
  }
  /// Returns the new point that the step makes for this face.
  /// @throws InvalidParameter  the step has no mask of faces
  Stencil<T> point() const {
    if (!this->masks_->face)
      throw InvalidParameter(
          "a mask asks for the new point of a face, but its step has no mask `face`; centroids of faces are known");
    return this->masks_->face(*this);
  }

 private:
  int position(int i) const { return site_position(i, size(), "corner", "a face"); }
  std::vector<Index> slots_;
  std::vector<EdgeKnots<T>> knots_;  // none: all are equal
};

/// An interior edge with its two faces. The left one starts at the tail, the right one at the head.
/// Slots: 0 tail, 1 head, the other corners of the left face, those of the right face.
template <class T>
class EdgeSite : public Site<T> {
 public:
  EdgeSite(const Masks<T>& masks, int level, int left_size, int right_size, std::vector<EdgeKnots<T>> left_knots = {},
           std::vector<EdgeKnots<T>> right_knots = {})
      : Site<T>(masks, level), left_knots_(std::move(left_knots)), right_knots_(std::move(right_knots)) {
    left_ = {0, 1};
    right_ = {1, 0};
    Index slot = 2;
    while (static_cast<int>(left_.size()) < left_size) left_.push_back(slot++);
    while (static_cast<int>(right_.size()) < right_size) right_.push_back(slot++);
  }
  Stencil<T> tail() const { return Stencil<T>(0); }
  Stencil<T> head() const { return Stencil<T>(1); }
  FaceSite<T> left_face() const { return {*this->masks_, this->level_, left_, left_knots_}; }
  FaceSite<T> right_face() const { return {*this->masks_, this->level_, right_, right_knots_}; }
  /// Returns the knots of the edge, seen from the tail.
  EdgeKnots<T> knots() const { return left_face().knots(0); }

 private:
  std::vector<Index> left_, right_;
  std::vector<EdgeKnots<T>> left_knots_, right_knots_;
};

/// A vertex with its faces, counter-clockwise; the ring is closed around an interior vertex, and open where a boundary
/// or a sharp edge cuts it. Slots of the site of a vertex: 0 the vertex, then for each face its corners from the far
/// end of its first edge on, up to the next face's. Rings of wide sites number edges and faces from the site's own edge
/// on: neighbor(0) is its other end, neighbor(-1) the one before. Edges and faces of a closed ring count modulo the
/// valence; in an open one those beyond its ends do not exist.
template <class T>
class Ring : public Site<T> {
 public:
  /// Makes a closed ring.
  /// @param knots  for each face, from the vertex on; empty: all are equal
  Ring(const Masks<T>& masks, int level, std::span<const Index> face_sizes,
       std::vector<std::vector<EdgeKnots<T>>> knots = {})
      : Site<T>(masks, level), knots_(std::move(knots)) {
    Index slot = 1;
    for (const Index size : face_sizes) {
      faces_.push_back({0});
      for (Index i = 2; i < size; ++i) faces_.back().push_back(slot++);
    }
    for (size_t i = 0; i < faces_.size(); ++i) faces_[i].push_back(faces_[(i + 1) % faces_.size()][1]);
  }
  /// Makes the ring of a wide site.
  /// @param faces  slots of the corners of each face, from the vertex on
  /// @param start  position of the site's own edge
  Ring(const Masks<T>& masks, int level, std::vector<std::vector<Index>> faces, bool closed, int start)
      : Site<T>(masks, level), faces_(std::move(faces)), closed_(closed), start_(start) {}

  /// True if faces go all around the vertex; false at a boundary or sharp edge.
  bool is_closed() const { return closed_; }
  /// Returns the number of faces; in a closed ring that of edges too.
  int valence() const { return static_cast<int>(faces_.size()); }
  /// Returns the vertex itself.
  Stencil<T> center() const { return Stencil<T>(faces_[0][0]); }
  /// Returns the vertex at the other end of edge i; face i lies between edges i and i + 1.
  /// @throws InvalidParameter  an edge that an open ring does not have
  Stencil<T> neighbor(int i) const {
    if (!has_neighbor(i)) refuse("edge", i, valence());
    const int n = valence(), at = closed_ ? position(i) : start_ + i;
    return Stencil<T>(at == n ? faces_[n - 1].back() : faces_[at][1]);
  }
  /// True if edge i exists.
  bool has_neighbor(int i) const { return closed_ || (start_ + i >= 0 && start_ + i <= valence()); }
  /// Returns face i, starting at the vertex.
  /// @throws InvalidParameter  a face that an open ring does not have
  FaceSite<T> face(int i) const {
    const int at = position(i);
    return {*this->masks_, this->level_, faces_[at], knots_.empty() ? std::vector<EdgeKnots<T>>{} : knots_[at]};
  }
  /// Returns the knots of edge i of a closed ring, seen from the vertex.
  EdgeKnots<T> knots(int i) const { return knots_.empty() ? EdgeKnots<T>{} : knots_[position(i)][0]; }
  /// Returns the corner of the quadrilateral face i that is opposite to the vertex.
  /// @throws InvalidParameter  a face that is not a quadrilateral
  Stencil<T> diagonal(int i) const {
    const std::vector<Index>& corners = faces_[position(i)];
    if (corners.size() != 4)
      throw InvalidParameter("a mask asks for the diagonal of face " + std::to_string(i) + " of a ring, which has " +
                             std::to_string(corners.size()) +
                             " corners; only in a quadrilateral one is opposite (face(i).corner(j) has all)");
    return Stencil<T>(corners[2]);
  }

  /// Returns neighbor(i) of a ring of triangles that is closed by two virtual points, one beyond each border edge, so
  /// that the triangle there is half of a parallelogram; the regular border vertex then has valence 6.
  /// @throws InvalidParameter  faces that are not triangles
  Stencil<T> continued(int i) const {
    if (faces_[0].size() != 3)
      throw InvalidParameter("a mask asks for a ring of faces of " + std::to_string(faces_[0].size()) +
                             " corners to be continued beyond the border; only rings of triangles are");
    if (closed_) return neighbor(i);
    const int n = valence(), edges = n + 3, at = ((start_ + i) % edges + edges) % edges;
    const auto end = [&](int k) { return Stencil<T>(k == n ? faces_[n - 1].back() : faces_[k][1]); };
    if (at <= n) return end(at);
    return at == n + 1 ? center() + end(n) - end(n - 1) : center() + end(0) - end(1);
  }

  /// Returns the mean of the neighbours in a closed ring.
  /// @throws InvalidParameter  an open ring
  Stencil<T> neighbor_mean() const {
    return mean([&](int i) { return neighbor(i); });
  }
  /// Returns the mean of the centroids of the faces in a closed ring.
  /// @throws InvalidParameter  an open ring
  Stencil<T> face_centroid_mean() const {
    return mean([&](int i) { return face(i).centroid(); });
  }
  /// Returns the mean of the new points of the faces in a closed ring.
  /// @throws InvalidParameter  an open ring, or a step without a mask of faces
  Stencil<T> face_point_mean() const {
    return mean([&](int i) { return face(i).point(); });
  }

 private:
  /// Returns the position in `faces_` of face i, between edges i and i + 1.
  int position(int i) const {
    const int n = valence();
    if (closed_) return ((start_ + i) % n + n) % n;
    if (start_ + i < 0 || start_ + i >= n) refuse("face", i, n - 1);
    return start_ + i;
  }
  /// Reports an element that an open ring does not have.
  /// @param last  position of the last one that exists
  [[noreturn]] void refuse(const char* element, int i, int last) const {
    throw InvalidParameter("a mask asks for " + std::string(element) + " " + std::to_string(i) +
                           " of an open ring, which ends before: " + std::to_string(-start_) + " to " +
                           std::to_string(last - start_) + " exist (has_neighbor)");
  }
  template <class Point>
  Stencil<T> mean(const Point& point) const {
    if (!closed_)
      throw InvalidParameter(
          "a mask asks for the mean around an open ring; a mean is known of closed rings (is_closed), neighbors and "
          "faces of open ones are known one by one");
    Stencil<T> sum;
    for (int i = 0; i < valence(); ++i) sum += point(i);
    return std::move(sum) / T(valence());
  }
  std::vector<std::vector<Index>> faces_;
  std::vector<std::vector<EdgeKnots<T>>> knots_;
  bool closed_ = true;
  int start_ = 0;
};

/// Arrangement of the faces around a vertex, seen from one of its edges: all around, or in an open row in which the
/// edge is at position `start`.
struct FanShape {
  Index faces = 0;   ///< number of faces
  Index start = -1;  ///< -1: closed
  bool is_closed() const { return start < 0; }
  /// Returns the number of faces from the edge on, counter-clockwise; all of a closed ring.
  Index left() const { return is_closed() ? faces : faces - start; }
  /// Returns the number of faces from the edge on, clockwise; 0 in a closed ring.
  Index right() const { return is_closed() ? 0 : start; }
  auto operator<=>(const FanShape&) const = default;
};

/// An edge with the rings of both its ends; all faces have the same size.
/// Slots: 0 tail, 1 head, other corners of the left face, then of the right one (from the head, from the tail), then
/// the rest of the tail's ring, counter-clockwise from the left face and clockwise from the right one, then the rest of
/// the head's.
template <class T>
class WideEdgeSite : public Site<T> {
 public:
  WideEdgeSite(const Masks<T>& masks, int level, Index face_size, FanShape tail, FanShape head)
      : Site<T>(masks, level),
        left_(tail.left() > 0),
        right_(tail.is_closed() || tail.right() > 0),
        slots_(2 + (Index(left_) + Index(right_)) * (face_size - 2)),
        tail_(ring(face_size, tail, 0, 1, 2, 2 + Index(left_) * (face_size - 2), left_, right_)),
        head_(ring(face_size, head, 1, 0, 2 + Index(left_) * (face_size - 2), 2, right_, left_)) {}

  Index num_slots() const { return slots_; }
  Stencil<T> tail() const { return Stencil<T>(0); }
  Stencil<T> head() const { return Stencil<T>(1); }
  /// True if there is no face on one side of the edge.
  bool is_border() const { return !left_ || !right_; }
  const Ring<T>& tail_ring() const { return tail_; }
  const Ring<T>& head_ring() const { return head_; }

 private:
  Ring<T> ring(Index size, FanShape shape, Index center, Index end, Index left, Index right, bool has_left,
               bool has_right) {
    // The face on the left is (center, end, left...), that on the right (end, center, right...).
    std::vector<Index> left_face{center, end}, right_face{center};
    for (Index i = 0; i < size - 2; ++i) left_face.push_back(left + i), right_face.push_back(right + i);
    right_face.push_back(end);
    std::vector<std::vector<Index>> faces;
    const auto next_face = [&](Index from, Index to) {  // counter-clockwise, `to` < 0: new
      std::vector<Index> face{center, from};
      for (Index i = 0; i < size - 3; ++i) face.push_back(slots_++);
      face.push_back(to < 0 ? slots_++ : to);
      return face;
    };
    if (shape.is_closed()) {
      faces.push_back(left_face);
      for (Index k = 2; k < shape.faces; ++k)
        faces.push_back(next_face(faces.back().back(), k + 1 == shape.faces ? right_face[1] : -1));
      faces.push_back(right_face);
      return {*this->masks_, this->level_, std::move(faces), true, 0};
    }
    if (has_left) faces.push_back(left_face);
    for (Index k = 1; k < shape.left(); ++k) faces.push_back(next_face(faces.back().back(), -1));
    std::vector<std::vector<Index>> before;  // clockwise
    if (has_right) before.push_back(right_face);
    for (Index k = 1; k < shape.right(); ++k) {
      std::vector<Index> face{center};
      for (Index i = 0; i < size - 2; ++i) face.push_back(slots_++);
      face.push_back(before.back()[1]);
      before.push_back(face);
    }
    faces.insert(faces.begin(), before.rbegin(), before.rend());
    return {*this->masks_, this->level_, std::move(faces), false, static_cast<int>(shape.start)};
  }

  bool left_, right_;
  Index slots_;
  Ring<T> tail_, head_;
};

/// A face with the rings of its corners, and the points that the step makes on edges; all faces have the same size.
/// Ring i starts with the edge from corner i to corner i + 1, so its face 0 is this face.
/// Slots: the corners; the other corners of the faces across edge 0, 1, ... (if there is one); for each corner the
/// rest of its ring, counter-clockwise from the face across the edge before, clockwise from the face across its own
/// edge; then the points of the face's edges, and of the edges beyond (of quadrilaterals: opposite in the face across).
template <class T>
class WideFaceSite : public Site<T> {
 public:
  WideFaceSite(const Masks<T>& masks, int level, std::span<const FanShape> shapes) : Site<T>(masks, level) {
    const Index size = static_cast<Index>(shapes.size());
    slots_ = size;
    std::vector<std::vector<Index>> across(size);  // from corner i + 1 on: (i + 1, i, ...)
    for (Index i = 0; i < size; ++i)
      if (shapes[i].is_closed() || shapes[i].right() > 0) {
        across[i] = {(i + 1) % size, i};
        for (Index k = 2; k < size; ++k) across[i].push_back(slots_++);
      }
    for (Index i = 0; i < size; ++i) {
      const FanShape& shape = shapes[i];
      const Index prev = (i + size - 1) % size;
      std::vector<std::vector<Index>> faces(1), before;
      for (Index k = 0; k < size; ++k) faces[0].push_back((i + k) % size);
      const auto turned = [&](const std::vector<Index>& face) {  // from corner i on
        std::vector<Index> result = face;
        std::rotate(result.begin(), std::find(result.begin(), result.end(), i), result.end());
        return result;
      };
      const auto on = [&](Index to) {
        std::vector<Index> face{i, faces.back().back()};
        for (Index k = 0; k < size - 3; ++k) face.push_back(slots_++);
        face.push_back(to < 0 ? slots_++ : to);
        faces.push_back(face);
      };
      if (shape.is_closed()) {
        if (shape.faces > 1) faces.push_back(turned(across[prev]));
        for (Index k = 3; k < shape.faces; ++k) on(k + 1 == shape.faces ? turned(across[i])[1] : -1);
        if (shape.faces > 2) faces.push_back(turned(across[i]));
        rings_.emplace_back(masks, level, std::move(faces), true, 0);
        continue;
      }
      if (shape.left() > 1) faces.push_back(turned(across[prev]));
      for (Index k = 2; k < shape.left(); ++k) on(-1);
      if (shape.right() > 0) before.push_back(turned(across[i]));
      for (Index k = 1; k < shape.right(); ++k) {
        std::vector<Index> face{i};
        for (Index m = 0; m < size - 2; ++m) face.push_back(slots_++);
        face.push_back(before.back()[1]);
        before.push_back(face);
      }
      faces.insert(faces.begin(), before.rbegin(), before.rend());
      rings_.emplace_back(masks, level, std::move(faces), false, static_cast<int>(shape.start));
    }
    for (Index i = 0; i < size; ++i) has_across_.push_back(!across[i].empty());
  }

  int size() const { return static_cast<int>(rings_.size()); }
  Index num_slots() const { return slots_; }
  Stencil<T> corner(int i) const { return Stencil<T>(position(i)); }
  const Ring<T>& ring(int i) const { return rings_[position(i)]; }
  /// True if there is a face across edge i.
  bool has_across(int i) const { return has_across_[position(i)]; }
  /// Returns the new point on edge i.
  Stencil<T> edge_point(int i) const { return Stencil<T>(slots_ + position(i)); }
  /// Returns the new point on the edge opposite to edge i in the quadrilateral across it.
  /// @throws InvalidParameter  no face across, or faces that are not quadrilaterals
  Stencil<T> edge_point_beyond(int i) const {
    const int at = position(i);
    if (!has_across_[at])
      throw InvalidParameter("a mask asks for the point beyond edge " + std::to_string(i) +
                             " of a face, where there is no face across (has_across)");
    if (size() != 4)
      throw InvalidParameter("a mask asks for the point opposite to edge " + std::to_string(i) + " in a face of " +
                             std::to_string(size()) + " corners; only quadrilaterals have opposite edges");
    return Stencil<T>(slots_ + size() + at);
  }

 private:
  int position(int i) const { return site_position(i, size(), "corner or edge", "a face"); }
  Index slots_ = 0;
  std::vector<Ring<T>> rings_;
  std::vector<bool> has_across_;
};

/// A vertex on a crease or boundary and its two neighbours along it. Slots: 0 the vertex, 1 and 2 the neighbours.
template <class T>
class CreaseSite : public Site<T> {
 public:
  CreaseSite(const Masks<T>& masks, int level, EdgeKnots<T> knots_before = {}, EdgeKnots<T> knots_after = {})
      : Site<T>(masks, level), knots_before_(std::move(knots_before)), knots_after_(std::move(knots_after)) {}
  Stencil<T> center() const { return Stencil<T>(0); }
  Stencil<T> before() const { return Stencil<T>(1); }
  Stencil<T> after() const { return Stencil<T>(2); }
  /// Returns the knots of the edge to the neighbour before or after, seen from the vertex.
  const EdgeKnots<T>& knots_before() const { return knots_before_; }
  const EdgeKnots<T>& knots_after() const { return knots_after_; }

 private:
  EdgeKnots<T> knots_before_, knots_after_;
};

/// A sharp or boundary edge, and the curve that it is part of. If a step makes several points on it, the tail is the
/// end that is nearer to the point. Slots: 0 tail, 1 head, 2 and 3 the points before and after them on the curve.
template <class T>
class CreaseEdgeSite : public Site<T> {
 public:
  CreaseEdgeSite(const Masks<T>& masks, int level, bool has_before = true, bool has_after = true,
                 EdgeKnots<T> knots = {})
      : Site<T>(masks, level), has_before_(has_before), has_after_(has_after), knots_(std::move(knots)) {}
  Stencil<T> tail() const { return Stencil<T>(0); }
  Stencil<T> head() const { return Stencil<T>(1); }
  /// Returns the point before or after the edge; if the curve ends in a corner there, a virtual point that has the
  /// corner in the middle.
  Stencil<T> before() const { return has_before_ ? Stencil<T>(2) : T(2) * tail() - head(); }
  Stencil<T> after() const { return has_after_ ? Stencil<T>(3) : T(2) * head() - tail(); }
  /// Returns the knots of the edge, seen from the tail.
  const EdgeKnots<T>& knots() const { return knots_; }

 private:
  bool has_before_, has_after_;
  EdgeKnots<T> knots_;
};

/// A mask: a function from a site to the stencil of the new point. It may be called by several threads.
template <class T, class Site>
using Mask = std::function<Stencil<T>(const Site&)>;

/// The masks of one step. Masks of points that the step's split does not make stay empty.
template <class T>
struct Masks {
  Mask<T, Ring<T>> vertex{};    ///< new position of a vertex
  Mask<T, EdgeSite<T>> edge{};  ///< point of an interior edge
  Mask<T, FaceSite<T>> face{};  ///< point of a face
  /// Point at corner 0 of a face, in a dual split.
  Mask<T, FaceSite<T>> corner{};
  /// Point of an edge, instead of `edge`, if it depends on more of the mesh.
  Mask<T, WideEdgeSite<T>> wide_edge{};
  Mask<T, WideFaceSite<T>> wide_face{};  ///< point of a face, instead of `face`, if it depends on more of the mesh
  bool wide_borders = false;             ///< border points by `wide_edge`; else by the crease masks
};

/// The masks along sharp edges and boundaries. A corner stays where it is.
template <class T>
struct CreaseMasks {
  Mask<T, CreaseSite<T>> vertex{};    ///< new position of a vertex on a crease
  Mask<T, CreaseEdgeSite<T>> edge{};  ///< point of a crease edge
};

}  // namespace sublimit
