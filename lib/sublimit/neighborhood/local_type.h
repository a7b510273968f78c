// SPDX-License-Identifier: Apache-2.0
#pragma once
// Types of centres by what is incident to them, without the faces beyond.
#include <compare>

#include "sublimit/mesh/sharpness.h"
#include "sublimit/neighborhood/centre.h"

namespace sublimit {

/// Type of an isolated centre.
struct LocalType {
  Centre::Kind kind = Centre::Kind::vertex;
  Index faces = 4;      ///< faces around the vertex, or corners of the face; unused for a border edge
  bool open = false;    ///< the vertex is on the border, or on one side of sharp edges
  bool corner = false;  ///< the vertex is interpolated: a corner
  int phase = 0;        ///< level modulo the scheme's period
  auto operator<=>(const LocalType&) const = default;
};

/// True if a vertex is interpolated: a sharp vertex, or one where more than two sharp edges meet.
bool is_corner(const Topology& topology, const Sharpness& sharpness, Vertex v);

/// Returns the type of a centre.
/// @param level   number of the level
/// @param period  period of the scheme
LocalType local_type(const Topology& topology, const Sharpness& sharpness, const Centre& centre, int level, int period);

}  // namespace sublimit
