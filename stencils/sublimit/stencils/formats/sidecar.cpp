// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/formats/sidecar.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/mesh/detail/edge_lookup.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/json/json_file.h"
#include "sublimit/stencils/json/json_object.h"

namespace sublimit {
namespace {

/// Keys that a sidecar may have. A file with none of them is something else.
namespace keys {
enum Key {
  crease_indices,
  crease_lengths,
  crease_sharpnesses,
  corner_indices,
  corner_sharpnesses,
  knot_intervals,
  knot_interval_edges,
  hole_indices,
  interpolate_boundary,
  crease_method,
  triangle_subdivision_rule,
  face_varying_linear_interpolation,
  count
};
constexpr std::array<const char*, count> names{
    "creaseIndices",       "creaseLengths", "creaseSharpnesses",       "cornerIndices",
    "cornerSharpnesses",   "knotIntervals", "knotIntervalEdges",       "holeIndices",
    "interpolateBoundary", "creaseMethod",  "triangleSubdivisionRule", "faceVaryingLinearInterpolation"};
}  // namespace keys

std::string key_name(keys::Key key) { return keys::names[key]; }

class Sidecar {
 public:
  /// @param root  must outlive this
  Sidecar(const JsonValue& root, const std::string& name) : object_(root, name) {}

  void apply(Mesh& mesh, const std::optional<MeshCounts>& elsewhere) {
    counts_ = elsewhere.value_or(MeshCounts{mesh.num_vertices(), mesh.num_faces()});
    knows_edges_ = !elsewhere;
    // All of it is read and checked before any of it is applied.
    std::vector<Mesh::Crease> creases = read_creases();
    std::vector<Mesh::Corner> corners = read_corners();
    std::vector<Mesh::KnotInterval> intervals = read_intervals(mesh);
    std::vector<Index> holes = read_ids(key_name(keys::hole_indices), counts_.faces, "a face");
    const auto boundary = choice<Boundary>(
        key_name(keys::interpolate_boundary),
        {{"none", Boundary::none}, {"edgeOnly", Boundary::edge_only}, {"edgeAndCorner", Boundary::edge_and_corner}});
    const auto creasing = choice<Creasing>(key_name(keys::crease_method),
                                           {{"uniform", Creasing::uniform}, {"chaikin", Creasing::chaikin}});
    const auto triangles = choice<Triangles>(key_name(keys::triangle_subdivision_rule),
                                             {{"catmullClark", Triangles::catmark}, {"smooth", Triangles::smooth}});
    using enum FaceVaryingInterpolation;
    const auto face_varying = choice<FaceVaryingInterpolation>(key_name(keys::face_varying_linear_interpolation),
                                                               {{"none", none},
                                                                {"cornersOnly", corners_only},
                                                                {"cornersPlus1", corners_plus1},
                                                                {"cornersPlus2", corners_plus2},
                                                                {"boundaries", boundaries},
                                                                {"all", all}});
    if (object_.has(key_name(keys::crease_indices))) {
      mesh.creases = std::move(creases);
      if (knows_edges_)
        drop_loose_creases(mesh, [&](std::size_t i) {
          return object_.place() + ": " + JsonObject::entry(key_name(keys::crease_indices), crease_positions_[i]) +
                 ": ";
        });
    }
    if (object_.has(key_name(keys::corner_indices))) mesh.corners = std::move(corners);
    if (object_.has(key_name(keys::knot_intervals))) mesh.knot_intervals = std::move(intervals);
    if (object_.has(key_name(keys::hole_indices))) mesh.holes = std::move(holes);
    if (boundary) mesh.boundary = boundary;
    if (creasing) mesh.creasing = creasing;
    if (triangles) mesh.triangles = triangles;
    if (face_varying) mesh.face_varying_interpolation = face_varying;
    warn_unknown(mesh);
  }

 private:
  /// Checks that a key is there that another one cannot do without.
  void require_beside(const std::string& key, const std::string& beside) {
    if (!object_.has(key)) object_.fail(beside, "comes without " + key);
  }
  /// Returns true if a key is there. Without it there may be none of those that go with it.
  bool has(const std::string& key, std::initializer_list<std::string> with) {
    if (object_.has(key)) return true;
    for (const std::string& other : with)
      if (object_.has(other)) object_.fail(other, "comes without " + key);
    return false;
  }

  std::vector<Index> read_ids(const std::string& key, Index count, const char* what) {
    return object_.has(key) ? object_.integers(key, 0, count - 1, what) : std::vector<Index>();
  }

  std::vector<float> read_sharpnesses(const std::string& key, const std::string& beside) {
    require_beside(key, beside);
    std::vector<float> values;
    for (const double value : object_.numbers(key)) {
      if (value < 0)
        object_.fail(JsonObject::entry(key, values.size()),
                     "is " + format_number(value) + "; a sharpness should be 0 or more");
      values.push_back(value < double{std::numeric_limits<float>::max()} ? static_cast<float>(value)
                                                                         : std::numeric_limits<float>::infinity());
    }
    return values;
  }

  std::vector<Mesh::Crease> read_creases() {
    const std::vector<Index> ids = read_ids(key_name(keys::crease_indices), counts_.vertices, "a vertex");
    if (!has(key_name(keys::crease_indices), {key_name(keys::crease_lengths), key_name(keys::crease_sharpnesses)}))
      return {};
    require_beside(key_name(keys::crease_lengths), key_name(keys::crease_indices));
    const std::vector<int> lengths = object_.integers(
        key_name(keys::crease_lengths), 2, std::numeric_limits<int>::max(), "the number of vertices of a chain,");
    const std::vector<float> sharpnesses =
        read_sharpnesses(key_name(keys::crease_sharpnesses), key_name(keys::crease_indices));

    std::size_t used = 0;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      if (std::size_t(lengths[i]) > ids.size() - used)
        object_.fail(JsonObject::entry(key_name(keys::crease_lengths), i),
                     "the chains need more vertices than the " + format_number(ids.size()) + " of creaseIndices");
      used += std::size_t(lengths[i]);
    }
    if (used < ids.size())
      object_.fail(key_name(keys::crease_lengths),
                   "they add up to " + format_number(used) + "; creaseIndices has " + format_number(ids.size()));
    const std::size_t edges = used - lengths.size();
    const bool per_chain = sharpnesses.size() == lengths.size();
    if (!per_chain && sharpnesses.size() != edges)
      object_.fail(key_name(keys::crease_sharpnesses), "has " + format_number(sharpnesses.size()) +
                                                           " values; it should have " + format_number(lengths.size()) +
                                                           ", one for each chain, or " + format_number(edges) +
                                                           ", one for each edge");

    std::vector<Mesh::Crease> creases;
    std::size_t position = 0;
    for (std::size_t chain = 0; chain < lengths.size(); ++chain, ++position) {
      for (int left = lengths[chain]; left > 1; --left, ++position) {
        creases.push_back({.tail = ids[position],
                           .head = ids[position + 1],
                           .sharpness = sharpnesses[per_chain ? chain : creases.size()]});
        crease_positions_.push_back(position);
      }
    }
    return creases;
  }

  std::vector<Mesh::Corner> read_corners() {
    const std::vector<Index> ids = read_ids(key_name(keys::corner_indices), counts_.vertices, "a vertex");
    if (!has(key_name(keys::corner_indices), {key_name(keys::corner_sharpnesses)})) return {};
    const std::vector<float> sharpnesses =
        read_sharpnesses(key_name(keys::corner_sharpnesses), key_name(keys::corner_indices));
    if (sharpnesses.size() != ids.size())
      object_.fail(key_name(keys::corner_sharpnesses), "has " + format_number(sharpnesses.size()) +
                                                           " values; it should have " + format_number(ids.size()) +
                                                           ", one for each of cornerIndices");
    std::vector<Mesh::Corner> corners;
    for (std::size_t i = 0; i < ids.size(); ++i) corners.push_back({.vertex = ids[i], .sharpness = sharpnesses[i]});
    return corners;
  }

  /// `knotIntervals` as numbers, `knotIntervalEdges` as two vertices for each.
  std::vector<Mesh::KnotInterval> read_intervals(const Mesh& mesh) {
    const std::vector<Index> ids = read_ids(key_name(keys::knot_interval_edges), counts_.vertices, "a vertex");
    if (!has(key_name(keys::knot_intervals), {key_name(keys::knot_interval_edges)})) return {};
    require_beside(key_name(keys::knot_interval_edges), key_name(keys::knot_intervals));
    const std::vector<double> lengths = object_.numbers(key_name(keys::knot_intervals));
    if (ids.size() != 2 * lengths.size())
      object_.fail(key_name(keys::knot_interval_edges),
                   "has " + format_number(ids.size()) + " vertices; it should have " +
                       format_number(2 * lengths.size()) + ", two for each of knotIntervals");
    std::vector<Mesh::KnotInterval> intervals;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      if (lengths[i] < 0)
        object_.fail(JsonObject::entry(key_name(keys::knot_intervals), i),
                     "is " + format_number(lengths[i]) + "; an interval should be a positive number");
      intervals.push_back({.tail = ids[2 * i], .head = ids[2 * i + 1], .length = lengths[i]});
    }
    if (!knows_edges_) return intervals;
    const std::vector<bool> found = along_edges(mesh, edges_of(intervals));
    if (const auto missing = std::ranges::find(found, false); missing != found.end()) {
      const auto i = static_cast<std::size_t>(missing - found.begin());
      object_.fail(JsonObject::entry(key_name(keys::knot_interval_edges), 2 * i),
                   "no face has an edge between vertices " + format_number(intervals[i].tail) + " and " +
                       format_number(intervals[i].head) + "; an interval is of an edge");
    }
    return intervals;
  }

  template <class T>
  std::optional<T> choice(const std::string& key, std::initializer_list<std::pair<const char*, T>> values) {
    if (!object_.has(key)) return std::nullopt;
    std::vector<const char*> words;
    for (const auto& [word, meaning] : values) words.push_back(word);
    return (values.begin() + object_.word(key, words))->second;
  }

  void warn_unknown(Mesh& mesh) const {
    constexpr std::size_t most = 20;
    const std::vector<std::string> keys = object_.unread();
    for (std::size_t i = 0; i < std::min(keys.size(), most); ++i) {
      const std::vector<std::string> near = object_.nearest(keys[i]);
      mesh.warnings.push_back(object_.place() + ": unknown key " + show_text(keys[i]) + " ignored" +
                              (near.empty() ? "" : "; the nearest is " + near[0]));
    }
    if (keys.size() > most)
      mesh.warnings.push_back(object_.place() + ": " + format_number(keys.size() - most) +
                              " more unknown keys ignored");
  }

  JsonObject object_;
  MeshCounts counts_;
  bool knows_edges_ = true;
  std::vector<std::size_t> crease_positions_;  // of the tail of each crease in creaseIndices
};

/// Reports of this program may lie beside a mesh under its name; they say at once what they are.
bool is_report(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string start;
  for (char c; start.size() < 20 && file.get(c);)
    if (!std::isspace(static_cast<unsigned char>(c))) start += c;
  return start == R"({"format":"sublimit-)";
}

}  // namespace

std::optional<std::filesystem::path> find_sidecar(const std::filesystem::path& mesh) {
  std::filesystem::path path = without_gz(mesh);
  path.replace_extension(".json");
  std::error_code error;
  if (path == mesh || !std::filesystem::is_regular_file(path, error) || is_report(path)) return std::nullopt;
  const std::string text = read_json_text(path);
  const bool has_key = std::ranges::any_of(
      keys::names, [&](const char* key) { return text.find('"' + std::string(key) + '"') != std::string::npos; });
  return has_key ? std::optional(path) : std::nullopt;
}

std::string sidecar_text(const std::filesystem::path& path) { return read_json_text(path); }

void apply_sidecar(Mesh& mesh, const std::filesystem::path& path) {
  apply_sidecar_text(mesh, sidecar_text(path), path.string());
}

void apply_sidecar_text(Mesh& mesh, std::string_view text, std::string_view name,
                        const std::optional<MeshCounts>& elsewhere) {
  const std::string file(name);
  const JsonValue root = parse_json(text, file);
  require_object(root, file, "a sidecar is an object such as {\"holeIndices\": [3]}");
  Sidecar(root, file).apply(mesh, elsewhere);
}

}  // namespace sublimit
