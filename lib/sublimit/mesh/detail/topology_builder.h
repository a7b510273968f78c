// SPDX-License-Identifier: Apache-2.0
#pragma once
// Construction of a Topology by a split, which computes twins and fans of children from those of parents and
// passes the arrays; edges are numbered here.
#include "sublimit/core/uninitialized.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {

class TopologyBuilder {
 public:
  struct Fans {
    Index vertex;
    std::vector<Index> starts;  ///< first half-edge of each fan
  };

  Index uniform_face_size = 0;      ///< size of all faces; 0: given by face_offsets
  std::vector<Index> face_offsets;  ///< #F + 1, mixed sizes only
  UninitializedVector<Index> tail;  ///< per half-edge
  UninitializedVector<Index> twin;  ///< per half-edge, -1 without one
  /// Half-edges of each non-manifold edge, ascending. Every other half-edge without twin is a separate edge.
  std::vector<std::vector<Index>> nonmanifold_edges;
  UninitializedVector<Index> outgoing;  ///< per vertex: a half-edge (the one without twin, if any), -1 if isolated
  UninitializedVector<Index> degree;    ///< per vertex: number of corners
  std::vector<Fans> nonmanifold_vertices;
  std::vector<Topology::Fault> faults;

  /// Sets outgoing, degree and nonmanifold_vertices from the other arrays (face_offsets among them).
  void find_fans(Index num_vertices);

  /// Returns the topology. Consumes the arrays.
  Topology build() &&;

  /// Drops edges and vertices and keeps faces, half-edges, twins and tails: half of the memory. Edge and
  /// vertex queries on the result are invalid.
  static Topology corners_only(Topology&& all);

 private:
  static void number_edges(Topology& t, const std::vector<std::vector<Index>>& nonmanifold_edges);
};

}  // namespace sublimit
