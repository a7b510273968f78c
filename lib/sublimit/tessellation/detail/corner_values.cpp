// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/detail/corner_values.h"

#include "sublimit/surface/detail/limit_map_parts.h"
#include "sublimit/tessellation/detail/cell_vertices.h"

namespace sublimit {

CornerValues corner_values(const Tessellation& made, const LimitMap& channel) {
  CellVertices values(channel.parts());
  CornerValues found;
  found.indices.reserve(3 * made.triangles.size());
  // Corners are whole numbers of steps, and so divided without rounding.
  const auto steps = [](double u) { return static_cast<std::int32_t>(u * cell_steps); };
  for (const Tessellation::Triangle& t : made.triangles)
    for (const auto& [u, v] : t.uv) found.indices.push_back(values.add(t.face, {steps(u), steps(v)}));
  found.places = values.places();
  return found;
}

}  // namespace sublimit
