// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "common.h"
#include "free_form.h"
#include "normal_surfaces.h"
#include "recipes.h"
#include "sublimit/base/error.h"
#include "sublimit/files/rule_words.h"
#include "sublimit/limit/address.h"

namespace sublimit::cli {
namespace {

using Json = nlohmann::ordered_json;
using Histogram = std::map<Index, Index>;

Json to_json(const Histogram& histogram) {
  Json result = Json::object();
  for (const auto& [key, count] : histogram) result[std::to_string(key)] = count;
  return result;
}
std::string to_text(const Histogram& histogram) {
  std::string text;
  for (const auto& [key, count] : histogram) text += fmt::format("{}{} x {}", text.empty() ? "" : ", ", key, count);
  return text.empty() ? "none" : text;
}

/// Groups of vertices that edges join (isolated ones left out).
Index num_components(const Topology& t) {
  std::vector<Index> root(t.num_vertices());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](Index v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (Index e = 0; e < t.num_edges(); ++e) root[find(index(t.tail(Edge{e})))] = find(index(t.head(Edge{e})));
  Index count = 0;
  for (Index v = 0; v < t.num_vertices(); ++v) count += root[v] == v && !t.is_isolated(Vertex{v});
  return count;
}

/// Closed walks along boundary half-edges.
Index num_boundary_loops(const Topology& t) {
  std::vector<bool> seen(t.num_half_edges(), false);
  Index loops = 0;
  for (Index i = 0; i < t.num_half_edges(); ++i) {
    if (seen[i] || exists(t.twin(HalfEdge{i}))) continue;
    ++loops;
    HalfEdge h{i};
    while (!seen[index(h)]) {
      seen[index(h)] = true;
      h = t.next(h);  // on to the next half-edge without twin around the head
      while (exists(t.twin(h))) h = t.next(t.twin(h));
    }
  }
  return loops;
}

// The rules in force: as asked for, else the file's tag, else the default.
template <class Rule>
const char* in_force(std::optional<Rule> asked, std::optional<Rule> tag, Rule otherwise) {
  return word(asked.value_or(tag.value_or(otherwise)));
}
struct RuleWords {
  const char *boundary, *creasing, *triangles;
  explicit RuleWords(const Loaded& loaded)
      : boundary(in_force(loaded.rules.boundary, loaded.mesh.boundary, Boundary::edge_and_corner)),
        creasing(in_force(loaded.rules.creasing, loaded.mesh.creasing, Creasing::uniform)),
        triangles(in_force({}, loaded.mesh.triangles, Triangles::catmark)) {}
};

int run(const Common& common, bool as_json) {
  if (is_recipe_job(common)) {
    print_recipes(common, read_recipes(common.mesh), as_json);
    return 0;
  }
  if (common.scheme.empty() && has_free_form(common.mesh)) {
    const FreeForm shapes = read_free_form(common.mesh);
    print_free_form(common, shapes, as_json);
    if (shapes.num_faces == 0 || as_json) return 0;
  }
  Common quiet = common;
  quiet.quiet = true;
  Progress progress(common.quiet);
  const bool normals = is_normal_job(common);
  if (normals) {
    check_normal_job(common, false);
    quiet.scheme.clear();
    quiet.options.clear();
  }
  const Loaded loaded = load(quiet, progress);  // warnings and faults are what this subcommand prints
  progress.step("");
  const ControlMesh& mesh = loaded.mesh;
  const RuleWords rules(loaded);
  const Topology t(view(mesh));
  Histogram sizes, interior, boundary;
  for (Index f = 0; f < t.num_faces(); ++f) ++sizes[t.size(Face{f})];
  for (Index v = 0; v < t.num_vertices(); ++v) {
    const HalfEdge h = t.outgoing(Vertex{v});
    if (exists(h)) ++(exists(t.twin(h)) ? interior : boundary)[static_cast<Index>(t.edges(Vertex{v}).size())];
  }
  const Index euler = t.num_vertices() - t.num_edges() + t.num_faces();
  const bool triangles = normals || (loaded.scheme && loaded.scheme->face_size() == 3);
  const Addresses addresses(t, triangles);
  std::string why_not;  // empty: the scheme takes the mesh
  std::vector<double> cost;
  if (loaded.scheme) {
    try {
      control_level(*loaded.scheme, mesh, loaded.rules);  // refuses tags that the scheme has no rule for
      if (loaded.scheme->face_size() == 3) check_triangles(t);
      for (int level = 1; level <= 6; ++level) cost.push_back(predicted_bytes(*loaded.scheme, t, level));
    } catch (const UnsupportedTopology& error) {
      why_not = error.what();
    }
  }
  if (normals) why_not = why_no_normal_surface(common, loaded.mesh);
  if (as_json) {
    Json faults = Json::array();
    for (const auto& fault : t.faults()) faults.push_back(fault.message);
    Json json{{"mesh", common.mesh},
              {"vertices", t.num_vertices()},
              {"edges", t.num_edges()},
              {"faces", t.num_faces()},
              {"euler_characteristic", euler},
              {"components", num_components(t)},
              {"boundary_loops", num_boundary_loops(t)},
              {"face_sizes", to_json(sizes)},
              {"addresses", why_not.empty() ? Json(addresses.size()) : Json()},
              {"interior_valences", to_json(interior)},
              {"boundary_valences", to_json(boundary)},
              {"creases", mesh.creases.size()},
              {"corners", mesh.corners.size()},
              {"holes", mesh.holes.size()},
              {"boundary", rules.boundary},
              {"creasing", rules.creasing},
              {"triangles", rules.triangles},
              {"face_varying_channels", mesh.face_varying.size()},
              {"face_varying", word(loaded.face_varying)},
              {"warnings", mesh.warnings},
              {"faults", faults}};
    if (loaded.scheme || normals) {
      json["scheme"] = {{"name", common.scheme},
                        {"takes_mesh", why_not.empty() ? "yes" : "no: " + why_not},
                        {"predicted_bytes_by_level", cost}};
    }
    fmt::print("{}\n", json.dump(2));
    return 0;
  }
  fmt::print("{}\n", common.mesh);
  fmt::print("  {} vertices, {} edges, {} faces; Euler characteristic {}, {} component(s)\n", t.num_vertices(),
             t.num_edges(), t.num_faces(), euler, num_components(t));
  fmt::print("  face sizes         {}\n", to_text(sizes));
  if (why_not.empty())
    fmt::print("  addresses          faces 0 to {} of `sublimit sample`: {}\n", addresses.size() - 1,
               triangles ? "the triangles" : "a quad is one, another polygon one a corner");
  fmt::print("  interior valences  {}\n", to_text(interior));
  fmt::print("  boundary valences  {}\n", to_text(boundary));
  fmt::print("  boundary loops     {}\n", num_boundary_loops(t));
  fmt::print("  tags               {} creases, {} corners, {} holes\n", mesh.creases.size(), mesh.corners.size(),
             mesh.holes.size());
  fmt::print("  rules              boundary {}, creasing {}, triangles {}\n", rules.boundary, rules.creasing,
             rules.triangles);
  for (const ControlMesh::FaceVarying& channel : mesh.face_varying)
    fmt::print("  face-varying       {}: {} values of {} numbers, interpolation {}\n", channel.name,
               channel.values.rows(), channel.values.cols(), word(loaded.face_varying));
  if (loaded.scheme || normals) {
    fmt::print("  {:<18} {}\n", common.scheme + ":", why_not.empty() ? "takes this mesh" : "no: " + why_not);
    for (size_t k = 0; k < cost.size(); ++k)
      fmt::print("    to level {}         about {:.1f} MB\n", k + 1, cost[k] / 1e6);
  }
  for (const std::string& warning : mesh.warnings) fmt::print("  warning: {}\n", warning);
  constexpr size_t most = 20;
  for (size_t i = 0; i < std::min(t.faults().size(), most); ++i) fmt::print("  fault: {}\n", t.faults()[i].message);
  if (t.faults().size() > most) fmt::print("  and {} faults more (--json lists all)\n", t.faults().size() - most);
  if (t.faults().empty()) fmt::print("  no faults: a consistently wound manifold\n");
  return 0;
}

}  // namespace

Command add_info(CLI::App& app) {
  auto* command = app.add_subcommand("info", "Counts, valences, boundaries, tags and every fault of a mesh");
  auto common = std::make_shared<Common>();
  auto as_json = std::make_shared<bool>(false);
  add_mesh(*command, *common, false);
  command->add_flag("--json", *as_json, "As JSON");
  command->footer(
      "Examples:\n  sublimit info cage.obj\n  sublimit info cage.obj -s loop --json\n"
      "Of an .obj with free-form curves and surfaces: bases, degrees, knots, continuity, weights, collapsed sides, trims.\n"
      "Of recipes (.json): kinds, faces or segments, control points, whether there is an exact net.");
  return [=] { return run(*common, *as_json); };
}

}  // namespace sublimit::cli
