// SPDX-License-Identifier: Apache-2.0
#include "sublimit/source/address.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/source/detail/why_outside.h"

namespace sublimit {

Addresses::Addresses(const Topology& t, bool triangles) : triangles_(triangles) {
  const Index whole = triangles ? 3 : 4;
  if (t.uniform_face_size() == whole) {
    size_ = t.num_faces();
    return;
  }
  first_.reserve(t.num_faces() + 1);
  for (Index f = 0; f < t.num_faces(); ++f) {
    first_.push_back(size_);
    size_ += t.size(Face{f}) == whole ? 1 : t.size(Face{f});
  }
  first_.push_back(size_);
}

Addresses::FaceCorner Addresses::place(Index address) const {
  if (first_.empty()) return {Face{address}, -1};
  const Index f = static_cast<Index>(std::upper_bound(first_.begin(), first_.end(), address) - first_.begin()) - 1;
  return {Face{f}, first_[f + 1] - first_[f] == 1 ? -1 : address - first_[f]};
}

std::string faces_in_words(const FaceCount& faces) {
  if (faces.size == 0) return "there are no faces";
  return "faces are 0 to " + std::to_string(faces.size - 1) +
         (faces.triangles ? ", the triangles of the mesh" : ", a quad each or a corner of another polygon");
}

std::string why_outside(const FaceCount& faces, std::int64_t face, double u, double v) {
  if (face < 0 || face >= faces.size)
    return "face " + std::to_string(face) + " does not exist; " + faces_in_words(faces);
  if (is_inside(faces, {static_cast<Index>(face), u, v})) return {};
  return "(u, v) = (" + format_number(u) + ", " + format_number(v) + ") is outside the " +
         (faces.triangles ? "triangle u >= 0, v >= 0, u + v <= 1" : "square 0 <= u, v <= 1");
}

void check_inside(const FaceCount& faces, const Place& s) {
  if (!is_inside(faces, s)) throw InvalidParameter(why_outside(faces, s.face, s.u, s.v));
}

namespace {

Index squares_in_a_row(Index corners) { return static_cast<Index>(std::sqrt(double(corners - 1))) + 1; }

}  // namespace

BfrParameter to_bfr(Index corners, Index corner, double u, double v) {
  const Index w = squares_in_a_row(corners), column = corner % w, row = corner / w;
  return {double(column) + u / 2, double(row) + v / 2};
}

Place from_bfr(Index corners, const BfrParameter& p) {
  const Index w = squares_in_a_row(corners);
  const double column = std::floor(p.u), row = std::floor(p.v);
  const double u = 2 * (p.u - column), v = 2 * (p.v - row);
  if (!(column >= 0 && column < w && row >= 0 && row * w + column < corners && u <= 1 && v <= 1))
    throw InvalidParameter("(" + format_number(p.u) + ", " + format_number(p.v) + ") is in no square of a polygon of " +
                           std::to_string(corners) + " corners; squares are half a unit wide, " + std::to_string(w) +
                           " in a row");
  return {static_cast<Index>(row * w + column), u, v};
}

}  // namespace sublimit
