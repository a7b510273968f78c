// SPDX-License-Identifier: Apache-2.0
#pragma once
// What is next to a centre, and nothing of what is around that.
#include <compare>

#include "sublimit/mesh/sharpness.h"
#include "sublimit/neighborhood/centre.h"

namespace sublimit {

struct LocalType {
  Centre::Kind kind = Centre::Kind::vertex;
  Index faces = 4;      ///< around the vertex; corners of the face; without meaning for a border edge
  bool open = false;    ///< the vertex is on the border, or on one side of sharp edges
  bool corner = false;  ///< and stays where it is
  int phase = 0;        ///< level modulo the scheme's period
  auto operator<=>(const LocalType&) const = default;
};

/// True if the tail of a half-edge stays where it is: a sharp vertex, or one where more than two sharp edges meet.
bool is_corner(const Topology& topology, const Sharpness& sharpness, Vertex v);

LocalType local_type(const Topology& topology, const Sharpness& sharpness, const Centre& centre, int level, int period);

}  // namespace sublimit
