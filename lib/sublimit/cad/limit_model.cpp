// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/limit_model.h"

#include <algorithm>

#include "sublimit/base/error.h"
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
  const std::vector<QuadRectangle> rectangles = quad_rectangles(made.quads, edges, options.pack);
  if (std::ssize(rectangles) > options.max_faces)
    throw ResourceError(std::to_string(rectangles.size()) + " faces are needed, more than " +
                        std::to_string(options.max_faces) + "; allow a larger tolerance, or lower semi-sharp creases");
  model.boundary = boundary_model(made.quads, edges, rectangles);
  return model;
}

}  // namespace sublimit
