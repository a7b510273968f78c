// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/files/sidecar.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/mesh/detail/edge_lookup.h"

namespace sublimit {
namespace {

using nlohmann::json;

class Sidecar {
 public:
  Sidecar(std::string_view text, std::string_view name) : name_(name), root_(parse(text)) {
    if (!root_.is_object()) fail("holds " + show(root_) + "; a sidecar is an object such as {\"holeIndices\": [3]}");
  }

  void apply(Mesh& mesh, const std::optional<MeshCounts>& elsewhere) {
    counts_ = elsewhere.value_or(MeshCounts{mesh.num_vertices(), mesh.num_faces()});
    knows_edges_ = !elsewhere;
    // All of it is read and checked before any of it is applied.
    std::vector<Mesh::Crease> creases = read_creases(mesh);
    std::vector<Mesh::Corner> corners = read_corners();
    std::vector<Mesh::KnotInterval> intervals = read_intervals(mesh);
    std::vector<Index> holes = read_ids("holeIndices", counts_.faces, "face");
    const auto boundary = choice<Boundary>(
        "interpolateBoundary",
        {{"none", Boundary::none}, {"edgeOnly", Boundary::edge_only}, {"edgeAndCorner", Boundary::edge_and_corner}});
    const auto creasing =
        choice<Creasing>("creaseMethod", {{"uniform", Creasing::uniform}, {"chaikin", Creasing::chaikin}});
    const auto triangles = choice<Triangles>("triangleSubdivisionRule",
                                             {{"catmullClark", Triangles::catmark}, {"smooth", Triangles::smooth}});
    using enum FaceVaryingInterpolation;
    const auto face_varying =
        choice<FaceVaryingInterpolation>("faceVaryingLinearInterpolation", {{"none", none},
                                                                            {"cornersOnly", corners_only},
                                                                            {"cornersPlus1", corners_plus1},
                                                                            {"cornersPlus2", corners_plus2},
                                                                            {"boundaries", boundaries},
                                                                            {"all", all}});
    if (find("creaseIndices")) mesh.creases = std::move(creases);
    if (find("cornerIndices")) mesh.corners = std::move(corners);
    if (find("knotIntervals")) mesh.knot_intervals = std::move(intervals);
    if (find("holeIndices")) mesh.holes = std::move(holes);
    if (boundary) mesh.boundary = boundary;
    if (creasing) mesh.creasing = creasing;
    if (triangles) mesh.triangles = triangles;
    if (face_varying) mesh.face_varying_interpolation = face_varying;
    warn_unknown(mesh);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw FormatError(name_ + ": " + what); }

  // A value as messages show it: "an array", "2.5", "\"smooth\"".
  static std::string show(const json& value) {
    if (value.is_structured()) return std::string("an ") + value.type_name();
    return value.dump(-1, ' ', true).substr(0, 40);
  }

  // "key[3]"
  static std::string entry(const std::string& key, std::size_t i) { return key + "[" + format_number(i) + "]"; }

  json parse(std::string_view text) const {
    // Sidecars are lists in an object. A limit on depth keeps other files from growing a tree; keys that come twice
    // would silently lose one of them.
    std::unordered_set<std::string> keys;
    const auto watch = [&](int depth, json::parse_event_t event, json& value) {
      if (depth > 8) fail("nests deeper than any sidecar does");
      if (event == json::parse_event_t::key && depth == 1 && !keys.insert(value.get<std::string>()).second) {
        fail("has the key '" + value.get<std::string>() + "' twice");
      }
      return true;
    };
    try {
      return json::parse(text.begin(), text.end(), watch);
    } catch (const json::parse_error& error) {
      const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
      throw FormatError(name_ + ":" + format_number(1 + std::count(text.begin(), end, '\n')) +
                        ": not JSON: " + reason(error));
    } catch (const json::exception& error) {
      fail("not JSON: " + reason(error));
    }
  }

  // What the parser says, without the name of its exception in brackets.
  static std::string reason(const json::exception& error) {
    const std::string text = error.what();
    const std::size_t end = text.find("] ");
    return end == std::string::npos ? text : text.substr(end + 2);
  }

  const json* find(const std::string& key) {
    known_.insert(key);
    const auto found = root_.find(key);
    return found == root_.end() ? nullptr : &*found;
  }

  const json* find_list(const std::string& key) {
    const json* const list = find(key);
    if (list && !list->is_array()) fail(key + " is " + show(*list) + "; it should be a list");
    return list;
  }

  // A key that another one cannot do without.
  const json& list_beside(const std::string& key, const std::string& beside) {
    const json* const list = find_list(key);
    if (!list) fail(beside + " comes without " + key);
    return *list;
  }

  std::vector<Index> read_ids(const std::string& key, Index count, const std::string& what) {
    std::vector<Index> ids;
    const json* const list = find_list(key);
    if (!list) return ids;
    for (std::size_t i = 0; i < list->size(); ++i) {
      const json& value = (*list)[i];
      if (!value.is_number_integer()) fail(entry(key, i) + " is " + show(value) + "; it should be an integer");
      // The parser makes every integer from 0 up an unsigned one.
      if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= static_cast<std::uint64_t>(count)) {
        fail(entry(key, i) + ": " + what + " " + show(value) + " is out of range; it should be 0 to " +
             format_number(count - 1));
      }
      ids.push_back(value.get<Index>());
    }
    return ids;
  }

  std::vector<float> read_sharpnesses(const std::string& key, const std::string& beside) {
    std::vector<float> values;
    const json& list = list_beside(key, beside);
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (!list[i].is_number()) fail(entry(key, i) + " is " + show(list[i]) + "; it should be a number");
      const double value = list[i].get<double>();
      if (value < 0) fail(entry(key, i) + " is " + format_number(value) + "; a sharpness should be 0 or more");
      values.push_back(value < double{std::numeric_limits<float>::max()} ? static_cast<float>(value)
                                                                         : std::numeric_limits<float>::infinity());
    }
    return values;
  }

  std::vector<Mesh::Crease> read_creases(const Mesh& mesh) {
    const std::vector<Index> ids = read_ids("creaseIndices", counts_.vertices, "vertex");
    if (!find("creaseIndices")) {
      for (const char* const key : {"creaseLengths", "creaseSharpnesses"}) {
        if (find(key)) fail(std::string(key) + " comes without creaseIndices");
      }
      return {};
    }
    const json& lengths = list_beside("creaseLengths", "creaseIndices");
    const std::vector<float> sharpnesses = read_sharpnesses("creaseSharpnesses", "creaseIndices");

    std::size_t used = 0;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      const json& length = lengths[i];
      if (!length.is_number_unsigned() || length.get<std::uint64_t>() < 2) {
        fail(entry("creaseLengths", i) + " is " + show(length) + "; a chain should have 2 or more vertices");
      }
      if (length.get<std::uint64_t>() > ids.size() - used) {
        fail(entry("creaseLengths", i) + ": the chains need more vertices than the " + format_number(ids.size()) +
             " of creaseIndices");
      }
      used += length.get<std::size_t>();
    }
    if (used < ids.size()) {
      fail("creaseLengths add up to " + format_number(used) + "; creaseIndices has " + format_number(ids.size()));
    }
    const std::size_t edges = used - lengths.size();
    const bool per_chain = sharpnesses.size() == lengths.size();
    if (!per_chain && sharpnesses.size() != edges) {
      fail("creaseSharpnesses has " + format_number(sharpnesses.size()) + " values; it should have " +
           format_number(lengths.size()) + ", one for each chain, or " + format_number(edges) + ", one for each edge");
    }

    std::vector<Mesh::Crease> creases;
    std::vector<std::size_t> positions;  // of each crease's tail in creaseIndices
    std::size_t position = 0;
    for (std::size_t chain = 0; chain < lengths.size(); ++chain, ++position) {
      for (std::size_t left = lengths[chain].get<std::size_t>(); left > 1; --left, ++position) {
        creases.push_back({.tail = ids[position],
                           .head = ids[position + 1],
                           .sharpness = sharpnesses[per_chain ? chain : creases.size()]});
        positions.push_back(position);
      }
    }
    if (!knows_edges_) return creases;
    const std::vector<bool> found = along_edges(mesh, creases);
    for (std::size_t i = 0; i < creases.size(); ++i) {
      if (found[i]) continue;
      fail(entry("creaseIndices", positions[i]) + ": no face has an edge between vertices " +
           format_number(creases[i].tail) + " and " + format_number(creases[i].head) + "; a crease runs along edges");
    }
    return creases;
  }

  std::vector<Mesh::Corner> read_corners() {
    const std::vector<Index> ids = read_ids("cornerIndices", counts_.vertices, "vertex");
    if (!find("cornerIndices")) {
      if (find("cornerSharpnesses")) fail("cornerSharpnesses comes without cornerIndices");
      return {};
    }
    const std::vector<float> sharpnesses = read_sharpnesses("cornerSharpnesses", "cornerIndices");
    if (sharpnesses.size() != ids.size()) {
      fail("cornerSharpnesses has " + format_number(sharpnesses.size()) + " values; it should have " +
           format_number(ids.size()) + ", one for each of cornerIndices");
    }
    std::vector<Mesh::Corner> corners;
    for (std::size_t i = 0; i < ids.size(); ++i) corners.push_back({.vertex = ids[i], .sharpness = sharpnesses[i]});
    return corners;
  }

  /// `knotIntervals` as numbers, `knotIntervalEdges` as two vertices for each.
  std::vector<Mesh::KnotInterval> read_intervals(const Mesh& mesh) {
    const std::vector<Index> ids = read_ids("knotIntervalEdges", counts_.vertices, "vertex");
    if (!find("knotIntervals")) {
      if (find("knotIntervalEdges")) fail("knotIntervalEdges comes without knotIntervals");
      return {};
    }
    list_beside("knotIntervalEdges", "knotIntervals");
    const json& lengths = *find_list("knotIntervals");
    if (ids.size() != 2 * lengths.size())
      fail("knotIntervalEdges has " + format_number(ids.size()) + " vertices; it should have " +
           format_number(2 * lengths.size()) + ", two for each of knotIntervals");
    std::vector<Mesh::KnotInterval> intervals;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      if (!lengths[i].is_number())
        fail(entry("knotIntervals", i) + " is " + show(lengths[i]) + "; it should be a number");
      const double length = lengths[i].get<double>();
      if (!std::isfinite(length) || length < 0)
        fail(entry("knotIntervals", i) + " is " + format_number(length) + "; an interval should be a positive number");
      intervals.push_back({.tail = ids[2 * i], .head = ids[2 * i + 1], .length = length});
    }
    if (!knows_edges_) return intervals;
    const std::vector<bool> found = along_edges(mesh, edges_of(intervals));
    for (std::size_t i = 0; i < intervals.size(); ++i)
      if (!found[i])
        fail(entry("knotIntervalEdges", 2 * i) + ": no face has an edge between vertices " +
             format_number(intervals[i].tail) + " and " + format_number(intervals[i].head) +
             "; an interval is of an edge");
    return intervals;
  }

  template <class T>
  std::optional<T> choice(const std::string& key, std::initializer_list<std::pair<const char*, T>> values) {
    const json* const value = find(key);
    if (!value) return std::nullopt;
    std::string names;
    for (const auto& [value_name, meaning] : values) {
      if (value->is_string() && value->get_ref<const std::string&>() == value_name) return meaning;
      names += (names.empty() ? "" : ", ") + std::string(value_name);
    }
    fail(key + " is " + show(*value) + "; it should be one of " + names);
  }

  void warn_unknown(Mesh& mesh) const {
    constexpr std::size_t most = 20;
    std::size_t count = 0;
    for (const auto& item : root_.items()) {
      if (known_.contains(item.key())) continue;
      if (++count > most) continue;
      mesh.warnings.push_back(name_ + ": unknown key " + show(json(item.key())) + " ignored");
    }
    if (count > most)
      mesh.warnings.push_back(name_ + ": " + format_number(count - most) + " more unknown keys ignored");
  }

  std::string name_;
  json root_;
  std::unordered_set<std::string> known_;
  MeshCounts counts_;
  bool knows_edges_ = true;
};

}  // namespace

namespace {

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
  std::filesystem::path path = mesh;
  path.replace_extension(".json");
  std::error_code error;
  if (path == mesh || !std::filesystem::exists(path, error) || is_report(path)) return std::nullopt;
  return path;
}

void apply_sidecar(Mesh& mesh, const std::filesystem::path& path) {
  apply_sidecar_text(mesh, read_file(path), path.string());
}

void apply_sidecar_text(Mesh& mesh, std::string_view text, std::string_view name,
                        const std::optional<MeshCounts>& elsewhere) {
  Sidecar(text, name).apply(mesh, elsewhere);
}

}  // namespace sublimit
