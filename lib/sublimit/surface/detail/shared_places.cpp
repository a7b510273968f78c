// SPDX-License-Identifier: Apache-2.0
#include "sublimit/surface/detail/shared_places.h"

namespace sublimit {

std::int64_t SharedPlaces::size() const {
  const bool has_spokes = t_.uniform_face_size() != (addresses_.triangles() ? 3 : 4);
  return first_inside() +
         std::int64_t(t_.num_half_edges()) * ((has_spokes || dual_ ? steps_ + 1 : 0) + (dual_ ? 2 : 0));
}

std::int64_t SharedPlaces::at_tail(HalfEdge h) const {
  if (!dual_ || !t_.is_nonmanifold(t_.tail(h))) return index(t_.tail(h));
  HalfEdge least = h;  // of the fan: its first one if it is open
  for (HalfEdge g = h; exists(t_.twin(g));) {
    g = t_.next(t_.twin(g));
    if (g == h) break;
    if (!exists(t_.twin(g)) || index(g) < index(least)) least = g;
  }
  return first_apart() + index(least);
}

std::int64_t SharedPlaces::on_edge(HalfEdge h, std::int64_t from_tail) const {
  if (from_tail == 0) return at_tail(h);
  if (from_tail == 2 * steps_) return at_tail(t_.next(h));
  if (dual_ && !exists(t_.twin(h)))  // two squares of one polygon share its middle
    return from_tail == steps_ ? first_apart() + t_.num_half_edges() + index(h) : not_shared;
  return t_.num_vertices() + index(t_.edge(h)) * (2 * steps_ - 1) +
         (t_.forward(h) ? from_tail : 2 * steps_ - from_tail) - 1;
}

std::int64_t SharedPlaces::on_spoke(HalfEdge h, std::int64_t k) const {
  if (k == 0) return on_edge(h, steps_);
  if (k == steps_) h = t_.first(t_.face(h));  // the middle is one
  return first_inside() + index(h) * (steps_ + 1) + k;
}

std::int64_t SharedPlaces::number(Index address, std::int64_t i, std::int64_t j) const {
  const bool triangle = addresses_.triangles();
  if (i > 0 && j > 0 && (triangle ? i + j < steps_ : i < steps_ && j < steps_)) return not_shared;
  const Addresses::FaceCorner at = addresses_.place(address);
  if (at.corner >= 0) {
    const HalfEdge h = t_.corner(at.face, at.corner), before = t_.prev(h);
    if (j == 0) return on_edge(h, i);
    if (i == 0) return on_edge(before, 2 * steps_ - j);
    if (i == steps_) return on_spoke(h, j);
    if (j == steps_) return on_spoke(before, i);
    return not_shared;
  }
  const HalfEdge h = t_.first(at.face);
  if (j == 0) return on_edge(h, 2 * i);
  if (triangle ? i + j == steps_ : i == steps_) return on_edge(t_.next(h), 2 * j);
  if (!triangle && j == steps_) return on_edge(t_.next(t_.next(h)), 2 * (steps_ - i));
  if (i == 0) return on_edge(t_.prev(h), 2 * (steps_ - j));
  return not_shared;
}

}  // namespace sublimit
