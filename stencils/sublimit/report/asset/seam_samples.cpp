// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/asset/seam_samples.h"

namespace sublimit::asset {
namespace {

/// Next to a seam: the polynomial of one side, and a position that differs from the seam's by rounding.
constexpr double beside = 0x1p-50;

/// Between the corner squares of a dual scheme's faces polynomials end, and there the curvature of one side is asked
/// for; elsewhere sides of pieces are seen from both of them, exactly.
double end_of_square(bool dual) { return dual ? 1 - beside : 1; }

}  // namespace

SeamPlaces::SeamPlaces(const Scheme<double>& scheme, const LimitMap& surface, const Inventory& inventory,
                       bool polynomial)
    : surface_(surface),
      inventory_(inventory),
      polynomial_(polynomial),
      dual_(scheme.is_dual()),
      mid_edge_(scheme.steps[0].split == Split::mid_edge) {
  const Topology& t = surface.level().topology();
  for (Index e = 0; e < t.num_edges(); ++e) {
    const HalfEdge h = t.half_edge(Edge{e});
    if (!exists(t.twin(h)) && !t.is_nonmanifold(Edge{e}))
      ++borders_;
    else if (is_crease(Edge{e}))
      ++creases_;
    else
      ++smooth_;
  }
  // Without polynomials derivatives are known at points of some level only: halves, or thirds.
  if (scheme.steps[0].split == Split::sqrt3)
    along_ = {1. / 9, 1. / 3, 2. / 3, 8. / 9};
  else if (!polynomial)
    along_ = {1. / 16, .25, .5, .75, 15. / 16};
  else
    along_ = {5. / 4096, 9. / 128, 5. / 16, 11. / 16, 119. / 128, 4091. / 4096};
}

std::int64_t SeamPlaces::size() const {
  const Topology& t = surface_.level().topology();
  return std::int64_t(t.num_edges()) + t.num_faces() + t.num_vertices();
}

void SeamPlaces::add(std::int64_t number, SeamSamples& out) const {
  const Topology& t = surface_.level().topology();
  const std::int64_t first = std::int64_t(out.samples.size());
  if (number < t.num_edges())
    add_edge(Edge{Index(number)}, out);
  else if (number < std::int64_t(t.num_edges()) + t.num_faces())
    add_patches(Face{Index(number - t.num_edges())}, out);
  else
    add_point(Vertex{Index(number - t.num_edges() - t.num_faces())}, out);
  const std::int64_t count = std::int64_t(out.samples.size()) - first;
  if (count == 0 && !out.groups.empty() && out.groups.back().count < 0) out.groups.pop_back();
  if (count > 0) out.groups.back().count = count;
}

void SeamPlaces::add_edge(Edge e, SeamSamples& out) const {
  const Topology& t = surface_.level().topology();
  const std::vector<HalfEdge> halves = t.half_edges(e);
  if (halves.size() < 2 || t.tail(e) == t.head(e)) return;
  if (dual_ && t.is_nonmanifold(e)) return;  // a border on each of its sides
  // Two faces around a vertex are glued by mid-edge, each with parameters of its own: the same curve, at other places.
  if (mid_edge_)
    for (const Vertex v : {t.tail(e), t.head(e)})
      if (inventory_.vertices[index(v)].n == 2 && !inventory_.vertices[index(v)].at_border) return;
  const bool crease = is_crease(e);
  out.groups.push_back(
      {{crease ? Seam::What::crease : Seam::What::inside, halves[0]}, std::int64_t(out.samples.size()), -1});
  for (size_t k = 1; k < halves.size(); ++k) {
    if (is_hole(halves[0]) || is_hole(halves[k])) continue;
    for (const double along : along_)
      for (const HalfEdge h : {halves[0], halves[k]})
        out.samples.push_back(place_on(surface_.addresses(), t, h, t.tail(h) == t.tail(halves[0]) ? along : 1 - along));
  }
}

void SeamPlaces::add_patches(Face f, SeamSamples& out) const {
  const Topology& t = surface_.level().topology();
  const Addresses& addresses = surface_.addresses();
  if (!polynomial_ || surface_.level().holes[index(f)]) return;
  out.groups.push_back({{Seam::What::patch, t.first(f)}, std::int64_t(out.samples.size()), -1});
  const bool triangle = addresses.triangles();
  bool plain = !is_cut(addresses, t, f);
  bool border = false;  // parameters have roots there: two places side by side may be apart
  for (const Index v : t.vertices(f)) {
    const VertexKind& kind = inventory_.vertices[v];
    if (kind.n > most_faces) return;  // each sample there costs as much as a small mesh
    plain = plain && kind.what == VertexKind::What::regular;
    border = border || (kind.at_border && dual_);
  }
  const auto pair = [&](HalfEdge h, double a, double b, double da, double db) {
    for (const double side : {-1., 1.})
      out.samples.push_back(place_at(addresses, t, h, a + side * da * beside, b + side * db * beside));
  };
  for (Index i = 0; i < t.size(f); ++i) {
    const HalfEdge h = t.corner(f, i);
    if (is_cut(addresses, t, f)) {  // the way from the middle of h to that of the face
      const double end = end_of_square(dual_);
      for (const double s : {3. / 32, 5. / 16, 11. / 16}) {
        out.samples.push_back(place_at(addresses, t, h, end, s));
        out.samples.push_back(place_at(addresses, t, t.next(h), s, end));
      }
    } else if (dual_) {
      for (const double s : {5. / 64, 11. / 32}) pair(h, .5, s, 1, 0);
    }
    if (border) continue;
    if (plain) {  // one polynomial, or two of a box spline
      if (dual_) pair(h, .3125, .3125, 1, -1);
      continue;
    }
    for (const double x : {.5, .25, .125}) {
      if (triangle) {
        for (const double s : {3. / 16, 11. / 16}) pair(h, x * s, x * (1 - s), 1, 1);
        continue;
      }
      for (const double s : {5. / 64, 11. / 32, 13. / 16}) {
        pair(h, x, x * s, 1, 0);
        pair(h, x * s, x, 0, 1);
      }
      if (dual_) pair(h, x * .6875, x * .6875, 1, -1);  // where box splines are cut
    }
  }
}

void SeamPlaces::add_point(Vertex v, SeamSamples& out) const {
  using What = VertexKind::What;
  const Topology& t = surface_.level().topology();
  const VertexKind& kind = inventory_.vertices[index(v)];
  const bool has_plane = kind.plane != PlaneVerdict::no;
  if (kind.what != What::extraordinary && (has_plane || kind.sides.size() != 1)) return;
  const HalfEdge start = t.outgoing(v);
  if (!exists(start)) return;
  out.groups.push_back({{Seam::What::point, start, has_plane}, std::int64_t(out.samples.size()), -1});
  HalfEdge h = start;
  do {
    if (!is_hole(h)) out.samples.push_back(place_at(surface_.addresses(), t, h, near_point, near_point));
    h = t.ccw(h);
  } while (exists(h) && h != start);
}

}  // namespace sublimit::asset
