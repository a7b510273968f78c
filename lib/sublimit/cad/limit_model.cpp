// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/limit_model.h"

#include <algorithm>

#include "sublimit/cad/limit_quads.h"
#include "sublimit/cad/packing.h"

namespace sublimit {

LimitModel limit_model(const LimitSurface& surface, const Points& points, const LimitModelOptions& options) {
  const auto tell = [&](const std::string& what) {
    if (options.progress) options.progress(what);
  };
  LimitQuadOptions wanted;
  wanted.tolerance = options.tolerance;
  wanted.join_smoothly = options.join_smoothly;
  wanted.progress = [&](int round) { tell("fitting caps, ring " + std::to_string(round + 1)); };
  LimitQuads made = limit_quads(surface, points, wanted);
  tell("joining patches");
  QuadEdges edges = quad_edges(surface, made.quads);
  LimitModel model;
  model.quads = std::ssize(made.quads);
  model.caps = made.caps;
  model.deviation = made.deviation;
  model.met = made.met;
  model.measures = measure(made.quads, edges);
  tell("packing patches");
  model.boundary = boundary_model(made.quads, edges, quad_rectangles(made.quads, edges, options.pack));
  return model;
}

}  // namespace sublimit
