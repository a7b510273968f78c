// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/asset/warnings.h"

#include <cmath>
#include <map>

#include "sublimit/base/detail/format_number.h"

namespace sublimit::asset {
namespace {

using What = VertexKind::What;
using Severity = AssetWarning::Severity;

/// A ratio mu/lambda^2 as people read it.
std::string rounded(double ratio) {
  const std::string text = format_number(std::round(ratio * 1000) / 1000);
  return text;
}

std::string curvature_words(const PointVerdict& v) {
  switch (v.curvature) {
    case CurvatureVerdict::divergent:
      return "curvature diverges (mu/lambda^2 = " + rounded(*v.ratio) + ")";
    case CurvatureVerdict::logarithmic:
      return "curvature grows without bound, like a logarithm";
    case CurvatureVerdict::flat:
      return "curvature tends to zero (mu/lambda^2 = " + rounded(*v.ratio) + "): a flat spot";
    default:
      return "";
  }
}

struct Finding {
  Severity severity;
  std::string says, advice;
};

/// What is wrong with the tangent plane of a point.
std::optional<Finding> plane_finding(const VertexKind& kind, const PointVerdict& verdict) {
  if (verdict.plane != PlaneVerdict::no && verdict.plane != PlaneVerdict::slow) return std::nullopt;
  const std::string what =
      kind.what == What::corner   ? "corner with " + std::to_string(kind.sides[0]) + " faces on a side"
      : kind.what == What::border ? "border vertex with " + std::to_string(kind.n) + " faces"
      : kind.what == What::crease ? "crease vertex with " + std::to_string(kind.sides[0]) + " faces on a side"
      : kind.what == What::dart   ? "end of a crease among " + std::to_string(kind.n) + " faces"
                                  : "vertex of valence " + std::to_string(kind.n);
  const bool cut = !kind.sides.empty();
  const std::string fewer = cut ? "use fewer faces on this side: the scheme's plain rules are too weak for so many"
                            : kind.n <= 2 ? "remove the vertex by joining its faces, or add an edge to it"
                                          : "change the valence, by turning an edge or moving it to a neighbour";
  if (verdict.plane == PlaneVerdict::no)
    return Finding{kind.what == What::corner ? Severity::warning : Severity::error,
                   what + " has no tangent plane: normals around it keep differing", fewer};
  return Finding{Severity::warning,
                 what + ": the tangent plane is reached slowly (a Jordan block), shading near it suffers", fewer};
}

std::optional<Finding> valence_finding(const Scheme<double>& scheme, const VertexKind& kind,
                                       const PointVerdict& verdict) {
  if (kind.what != What::extraordinary || verdict.plane == PlaneVerdict::no) return std::nullopt;
  const Index regular = scheme.regular_valence();
  const std::string words = curvature_words(verdict), and_words = words.empty() ? "" : ": " + words;
  const std::string what = "vertex of valence " + std::to_string(kind.n);
  if (kind.n <= 2)
    return Finding{Severity::warning, what + and_words, "remove the vertex by joining its faces, or add an edge to it"};
  if (kind.n >= regular + 3)
    return Finding{Severity::warning, "high valence, " + std::to_string(kind.n) + and_words,
                   "spread its edges over several vertices; valences " + std::to_string(regular - 1) + " and " +
                       std::to_string(regular + 1) + " do the least harm"};
  if (words.empty()) return std::nullopt;
  return Finding{Severity::hint, what + and_words, "keep it where the surface is flat or hidden"};
}

bool ends_crease_at_border(const Level& level, const VertexKind& kind, Vertex v) {
  if (!kind.at_border || (kind.what != What::corner && kind.what != What::dart)) return false;
  const Topology& t = level.topology();
  for (const Edge e : t.edges(v))
    if (exists(t.twin(t.half_edge(e))) && is_infinite(level.sharpness.edge[index(e)])) return true;
  return false;
}

}  // namespace

std::vector<AssetWarning> warnings(const Scheme<double>& scheme, const Level& level, const Points& points,
                                   const Inventory& inventory, PointVerdicts& verdicts, const AssetOptions& options) {
  const Topology& t = level.topology();
  // One group for each sentence, in the order of the first vertex that it is said of.
  std::map<std::pair<Severity, std::string>, WarningGroup> groups;
  const auto say = [&](const Finding& f, Index v) {
    groups.try_emplace({f.severity, f.says}, f.severity, f.says, f.advice)
        .first->second.add_vertex(v, points, options.listed);
  };
  const auto is_extraordinary = [&](Vertex v) { return inventory.vertices[index(v)].what == What::extraordinary; };
  for (Index i = 0; i < t.num_vertices(); ++i) {
    const VertexKind& kind = inventory.vertices[i];
    if (kind.what == What::regular || kind.what == What::in_hole) continue;
    if (kind.what == What::isolated) {
      say({Severity::warning, "vertex that no face uses", "take it out"}, i);
      continue;
    }
    if (kind.what == What::non_manifold) {
      say({Severity::warning, "non-manifold vertex: its faces are no single fan, the surface stays sharp there",
           "split the vertex, one copy for each fan of faces"},
          i);
      continue;
    }
    const PointVerdict verdict = verdict_of(kind, verdicts);
    if (const auto finding = plane_finding(kind, verdict)) say(*finding, i);
    if (const auto finding = valence_finding(scheme, kind, verdict)) say(*finding, i);
    if (ends_crease_at_border(level, kind, Vertex{i}))
      say({Severity::hint, "crease that ends at the border: a corner, which stays where it is",
           "lead the crease along the border, or let its sharpness run out before it"},
          i);
    else if (kind.what == What::dart)
      say({Severity::hint, "crease that ends in the smooth surface (a dart)",
           "let the sharpness of its last edges run out, for a softer end"},
          i);
  }
  for (Index e = 0; e < t.num_edges(); ++e) {
    if (is_extraordinary(t.tail(Edge{e})) && is_extraordinary(t.head(Edge{e})))
      say({Severity::hint, "extraordinary vertices next to each other: no regular patch lies between them",
           "refine the control mesh there, or move one of them away"},
          index(t.tail(Edge{e})));
    if (t.is_nonmanifold(Edge{e}))
      say({Severity::warning,
           "non-manifold edge: more or fewer than two faces that agree in their winding; it stays sharp",
           "turn or split the faces at it"},
          index(t.tail(Edge{e})));
    const float s = level.sharpness.edge[e];
    if (is_semi_sharp(s) && s > float(options.levels))
      say({Severity::hint,
           "sharpness beyond the " + std::to_string(options.levels) +
               " levels that are shown: the edge looks like a crease, but its limit is smooth",
           "use less, or 10 and more for a crease that stays"},
          index(t.tail(Edge{e})));
  }
  std::vector<AssetWarning> result = face_warnings(level, points, options.listed);
  for (const auto& [key, group] : groups) group.put_into(result);
  std::map<Index, WarningGroup> polygons;
  for (Index f = 0; f < t.num_faces(); ++f) {
    const Index n = t.size(Face{f});
    if (level.holes[f] || n == regular_size(scheme)) continue;
    const PointVerdict& verdict = scheme.is_dual() ? verdicts.face(n) : verdicts.inside(n);
    const std::string words = curvature_words(verdict);
    if (verdict.plane == PlaneVerdict::yes && (words.empty() || n <= regular_size(scheme) + 2)) continue;
    const bool bad = verdict.plane == PlaneVerdict::no || verdict.plane == PlaneVerdict::slow;
    const std::string says = "face of " + std::to_string(n) +
                             " corners: " + (bad ? "its middle has no tangent plane, or reaches it slowly" : words);
    polygons.try_emplace(n, bad ? Severity::warning : Severity::hint, says, "cut it into faces with fewer corners")
        .first->second.add_face(f, Eigen::Vector3d(points.row(t.vertices(Face{f})[0])), options.listed);
  }
  for (const auto& [n, group] : polygons) group.put_into(result);
  return result;
}

}  // namespace sublimit::asset
