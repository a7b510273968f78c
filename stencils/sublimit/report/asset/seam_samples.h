// SPDX-License-Identifier: Apache-2.0
#pragma once
// Seams between patches, and pairs of places on both sides of a seam that are compared.
#include "sublimit/report/asset/inventory.h"
#include "sublimit/report/asset/surface_places.h"

namespace sublimit::asset {

struct Seam {
  enum class What : std::uint8_t { inside, crease, patch, point } what = What::inside;
  HalfEdge half = no_half_edge;  ///< the edge, the face, or the vertex at its tail
  bool has_plane = true;         ///< true if the point has a tangent plane
};
/// Seams with their samples: pairs of places on both sides of a seam, or around a point one place in each face.
struct SeamSamples {
  struct Group {
    Seam seam;
    std::int64_t first = 0, count = 0;
  };
  std::vector<Group> groups;
  std::vector<Place> samples;
  void clear() { groups.clear(), samples.clear(); }
};

class SeamPlaces {
 public:
  /// @param surface, inventory  must outlive this
  /// @param polynomial  true if pieces are polynomials; otherwise places are at repeated halves or thirds,
  ///                    where derivatives are known, and seams inside faces are left out
  SeamPlaces(const Scheme<double>& scheme, const LimitMap& surface, const Inventory& inventory, bool polynomial);
  SeamPlaces(const Scheme<double>&, const LimitMap&&, const Inventory&, bool) = delete;
  SeamPlaces(const Scheme<double>&, const LimitMap&, const Inventory&&, bool) = delete;
  /// Returns the number of elements that may have seams: edges, then faces, then vertices.
  std::int64_t size() const;
  void add(std::int64_t number, SeamSamples& out) const;

  std::int64_t num_creases() const { return creases_; }
  std::int64_t num_borders() const { return borders_; }
  std::int64_t num_smooth() const { return smooth_; }
  bool is_crease(Edge e) const { return is_infinite(surface_.level().sharpness.edge[index(e)]); }

 private:
  void add_edge(Edge e, SeamSamples& out) const;
  void add_patches(Face f, SeamSamples& out) const;
  void add_point(Vertex v, SeamSamples& out) const;
  bool is_hole(HalfEdge h) const { return surface_.level().holes[index(surface_.level().topology().face(h))]; }

  const LimitMap& surface_;
  const Inventory& inventory_;
  bool polynomial_, dual_, mid_edge_;
  std::vector<double> along_;  // parameters of samples on an edge
  std::int64_t creases_ = 0, borders_ = 0, smooth_ = 0;
};

/// Distance from extraordinary points at which their faces are compared.
inline constexpr double near_point = 0x1p-10;

}  // namespace sublimit::asset
