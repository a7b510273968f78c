// SPDX-License-Identifier: Apache-2.0
// What is compared with OpenSubdiv where no regression shapes lie beside the checkout: our own tagged meshes reach
// every rule that lib/README.md speaks of, for every scheme that has it.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "meshes/meshes.h"
#include "peers/compare_with_opensubdiv.h"
#include "peers/opensubdiv_reference.h"

namespace sublimit::testing {
namespace {

using Kinds = std::set<std::string>;

const char* word(Rule rule) {
  constexpr const char* words[] = {"smooth", "dart", "crease", "corner"};
  return words[int(rule)];
}

/// What a vertex is, rules of now and of the next level, and among how many faces.
void add_vertex(Kinds& kinds, const Level& level, Vertex v) {
  const Topology& t = level.topology();
  if (t.is_isolated(v)) {
    kinds.insert("isolated vertex");
    return;
  }
  const VertexSharpness sharpness(t, level.sharpness, v);
  const Rule rule = sharpness.rule();
  if (t.is_nonmanifold(v)) {
    kinds.insert(std::string("non-manifold ") + word(rule));
    return;
  }
  const std::string faces = " among " + std::to_string(t.num_faces(v)) + " faces";
  if (t.is_boundary(v)) {
    kinds.insert(std::string("boundary ") + word(rule) + faces);
    return;
  }
  kinds.insert(std::string(word(rule)) + faces);
  if (rule != sharpness.child_rule()) kinds.insert(std::string(word(rule)) + " to " + word(sharpness.child_rule()));
}

Kinds kinds_of(const Mesh& mesh, const Scheme<double>& scheme) {
  const Level level = control_level(scheme, mesh);
  const Topology& t = level.topology();
  Kinds kinds;
  for (Index v = 0; v < t.num_vertices(); ++v) add_vertex(kinds, level, Vertex{v});
  bool open = false, semi_sharp = false;
  for (Index e = 0; e < t.num_edges(); ++e) {
    const float s = level.sharpness.edge[index(Edge{e})];
    open |= t.is_boundary(Edge{e});
    semi_sharp |= is_semi_sharp(s);
    if (t.is_nonmanifold(Edge{e}))
      kinds.insert("non-manifold edge");
    else if (is_semi_sharp(s))
      kinds.insert(s < 1 ? "fractional edge" : "semi-sharp edge");
    else if (is_infinite(s) && !t.is_boundary(Edge{e}))
      kinds.insert("infinitely sharp edge");
  }
  for (const Mesh::Corner& c : mesh.corners)
    if (is_sharp(c.sharpness)) kinds.insert(is_infinite(c.sharpness) ? "infinitely sharp vertex" : "semi-sharp vertex");
  for (Index f = 0; f < t.num_faces(); ++f) kinds.insert("face of " + std::to_string(t.size(Face{f})) + " corners");
  if (!mesh.holes.empty()) kinds.insert("hole");
  if (open)
    kinds.insert(std::string("boundary mode ") +
                 std::to_string(int(mesh.boundary.value_or(Boundary::edge_and_corner))));
  if (semi_sharp) kinds.insert(mesh.creasing == Creasing::chaikin ? "Chaikin creasing" : "uniform creasing");
  if (mesh.triangles == Triangles::smooth) kinds.insert("smooth triangles");
  return kinds;
}

Kinds expected_kinds(const std::string& scheme) {
  Kinds kinds{"fractional edge",
              "semi-sharp edge",
              "infinitely sharp edge",
              "semi-sharp vertex",
              "hole",
              "boundary mode 0",
              "boundary mode 1",
              "boundary mode 2",
              "uniform creasing",
              "Chaikin creasing",
              "non-manifold edge",
              "non-manifold crease",
              "non-manifold corner",
              "isolated vertex",
              "infinitely sharp vertex"};
  const auto among = [&](const std::string& what, int from, int to) {
    for (int n = from; n <= to; ++n) kinds.insert(what + " among " + std::to_string(n) + " faces");
  };
  const bool loop = scheme == "loop";
  among("smooth", 2, 9);
  among("boundary crease", 1, 7);
  among("boundary corner", 1, 2);
  for (const int n : loop ? std::vector<int>{3, 4, 5, 6, 7, 8} : std::vector<int>{3, 4, 5, 6, 7, 8})
    for (const char* rule : {"dart", "crease", "corner"}) among(rule, n, n);
  for (const char* change : {"dart to smooth", "crease to smooth", "crease to dart", "corner to smooth",
                             "corner to dart", "corner to crease"})
    kinds.insert(change);
  for (const int n : loop ? std::vector<int>{3} : std::vector<int>{3, 4, 5, 6, 7})
    kinds.insert("face of " + std::to_string(n) + " corners");
  if (!loop) kinds.insert("smooth triangles");
  return kinds;
}

TEST(TaggedMeshes, ReachEveryRuleOfOpenSubdiv) {
  for (const std::string scheme : {"catmull-clark", "loop"}) {
    Kinds missing = expected_kinds(scheme);
    for (const NamedMesh& named : tagged_meshes())
      if (std::find(named.schemes.begin(), named.schemes.end(), scheme) != named.schemes.end())
        for (const std::string& kind : kinds_of(named.mesh, scheme_for(named.mesh, scheme))) missing.erase(kind);
    for (const std::string& kind : missing) ADD_FAILURE() << scheme << ": no mesh has: " << kind;
  }
}

}  // namespace
}  // namespace sublimit::testing
