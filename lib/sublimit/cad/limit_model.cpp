// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/limit_model.h"

#include <algorithm>

#include "sublimit/base/error.h"
#include "sublimit/cad/limit_quads.h"
#include "sublimit/cad/packing.h"

namespace sublimit {
namespace {

/// Names of quads: those of the faces of the mesh that they are in.
std::vector<Index> names_of(const std::vector<LimitQuad>& quads, const LimitMap& surface,
                            const Mesh::FaceNames& names) {
  std::vector<Index> numbers;
  if (names.of_face.empty()) return numbers;
  numbers.reserve(quads.size());
  for (const LimitQuad& quad : quads)
    numbers.push_back(names.of_face[size_t(index(surface.addresses().place(quad.address).face))]);
  return numbers;
}

void check_names(const Mesh::FaceNames& names, Index faces) {
  if (names.of_face.empty()) return;
  if (std::ssize(names.of_face) != faces)
    throw InvalidParameter(std::to_string(names.of_face.size()) + " faces have names; the mesh has " +
                           std::to_string(faces));
  for (const Index name : names.of_face)
    if (name < -1 || name >= std::ssize(names.names))
      throw InvalidParameter("name " + std::to_string(name) + " of a face; there are " +
                             std::to_string(names.names.size()) + ", from 0, and -1 is none");
}

}  // namespace

LimitModel limit_model(const LimitMap& surface, const Points& points, const LimitModelOptions& options) {
  const auto tell = [&](const std::string& what) {
    if (options.progress) options.progress(what);
  };
  check_names(options.face_names, surface.level().topology().num_faces());
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
  const std::vector<Index> names = names_of(made.quads, surface, options.face_names);
  const std::vector<QuadRectangle> rectangles = quad_rectangles(made.quads, edges, options.pack, names);
  if (std::ssize(rectangles) > options.max_faces)
    throw ResourceError(std::to_string(rectangles.size()) + " faces are needed, more than " +
                        std::to_string(options.max_faces) + "; allow a larger tolerance, or lower semi-sharp creases");
  model.boundary = boundary_model(made.quads, edges, rectangles);
  for (size_t f = 0; f < rectangles.size() && !names.empty(); ++f)
    if (const Index name = names[size_t(rectangles[f][0][0].quad)]; name >= 0)
      model.boundary.faces[f].name = options.face_names.names[size_t(name)];
  return model;
}

}  // namespace sublimit
