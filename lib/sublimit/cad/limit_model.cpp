// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/limit_model.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/cad/limit_quads.h"
#include "sublimit/cad/packing.h"
#include "sublimit/mesh/detail/attributes.h"

namespace sublimit {
namespace {

using Colour = std::optional<std::array<double, 3>>;

/// Faces of a mesh by their names and colours.
class FaceLabels {
 public:
  FaceLabels(const Mesh::FaceNames& names, const std::vector<Mesh::Values>& values, Index faces) : names_(names) {
    const auto channels = find_colours(values);
    if (!channels && names.of_face.empty()) return;
    std::map<std::pair<Index, Colour>, Index> numbers;
    for (Index f = 0; f < faces; ++f) {
      std::pair<Index, Colour> label(names.of_face.empty() ? -1 : names.of_face[size_t(f)], std::nullopt);
      if (channels) label.second = colour(values, *channels, f);
      const auto [found, is_new] = numbers.emplace(label, static_cast<Index>(labels_.size()));
      if (is_new) labels_.push_back(label);
      of_face_.push_back(found->second);
    }
  }

  /// Returns a number for each quad, the same where name and colour are; empty: faces have neither.
  std::vector<Index> of(const std::vector<LimitQuad>& quads, const LimitMap& surface) const {
    std::vector<Index> numbers;
    if (of_face_.empty()) return numbers;
    numbers.reserve(quads.size());
    for (const LimitQuad& quad : quads)
      numbers.push_back(of_face_[size_t(index(surface.addresses().place(quad.address).face))]);
    return numbers;
  }

  void put_on(SplineFace& face, Index number) const {
    const auto& [name, colour] = labels_[size_t(number)];
    if (name >= 0) face.name = names_.names[size_t(name)];
    face.colour = colour;
  }

 private:
  static Colour colour(const std::vector<Mesh::Values>& values, const std::array<Index, 4>& channels, Index face) {
    std::array<double, 3> all{};
    for (size_t k = 0; k < 3; ++k) {
      const Mesh::Values& channel = values[size_t(channels[k])];
      if (size_t(face) >= channel.values.size())
        throw InvalidParameter(std::to_string(channel.values.size()) + " faces have a colour '" + channel.name +
                               "'; all should have one");
      const double number = colour_in_unit(channel, size_t(face));
      if (!(number >= 0 && number <= 1))
        throw InvalidParameter("a colour of face " + std::to_string(face) + " is " + format_number(number) +
                               "; it should be 0 to 1, or 0 to 255 if its type is uint8");
      all[k] = number;
    }
    return all;
  }

  const Mesh::FaceNames& names_;
  std::vector<std::pair<Index, Colour>> labels_;
  std::vector<Index> of_face_;
};

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
  const Index num_faces = surface.level().topology().num_faces();
  check_names(options.face_names, num_faces);
  const FaceLabels labels(options.face_names, options.face_values, num_faces);
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
  const std::vector<Index> numbers = labels.of(made.quads, surface);
  const std::vector<QuadRectangle> rectangles = quad_rectangles(made.quads, edges, options.pack, numbers);
  if (std::ssize(rectangles) > options.max_faces)
    throw ResourceError(std::to_string(rectangles.size()) + " faces are needed, more than " +
                        std::to_string(options.max_faces) + "; allow a larger tolerance, or lower semi-sharp creases");
  model.boundary = boundary_model(made.quads, edges, rectangles);
  for (size_t f = 0; f < rectangles.size() && !numbers.empty(); ++f)
    labels.put_on(model.boundary.faces[f], numbers[size_t(rectangles[f][0][0].quad)]);
  return model;
}

}  // namespace sublimit
