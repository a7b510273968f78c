// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/opencascade/shape.h"

#include <BRepCheck_Analyzer.hxx>
#include <BRep_Builder.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "sublimit/cad/signed_classes.h"

namespace sublimit {
namespace {

/// Knots that differ, and how often each is there.
struct KnotCounts {
  std::vector<double> knots;
  std::vector<int> counts;
  explicit KnotCounts(const std::vector<double>& all) {
    for (const double t : all) {
      if (knots.empty() || knots.back() != t) knots.push_back(t), counts.push_back(0);
      ++counts.back();
    }
  }
  TColStd_Array1OfReal values() const {
    TColStd_Array1OfReal array(1, int(knots.size()));
    for (size_t k = 0; k < knots.size(); ++k) array(int(k) + 1) = knots[k];
    return array;
  }
  TColStd_Array1OfInteger multiplicities() const {
    TColStd_Array1OfInteger array(1, int(counts.size()));
    for (size_t k = 0; k < counts.size(); ++k) array(int(k) + 1) = counts[k];
    return array;
  }
};

gp_Pnt point(const Points& points, Eigen::Index row) { return {points(row, 0), points(row, 1), points(row, 2)}; }

Handle(Geom_BSplineCurve) curve_of(const SplineEdge& edge) {
  const int n = int(edge.poles.rows());
  TColgp_Array1OfPnt poles(1, n);
  TColStd_Array1OfReal weights(1, n);
  for (int i = 0; i < n; ++i) {
    poles(i + 1) = point(edge.poles, i);
    weights(i + 1) = edge.weights.size() > 0 ? edge.weights[i] : 1;
  }
  const KnotCounts knots(edge.knots);
  return new Geom_BSplineCurve(poles, weights, knots.values(), knots.multiplicities(), edge.degree);
}

Handle(Geom_BSplineSurface) surface_of(const SplineFace& face) {
  const KnotCounts u(face.u_knots), v(face.v_knots);
  const int nu = int(face.u_knots.size()) - face.u_degree - 1, nv = int(face.v_knots.size()) - face.v_degree - 1;
  TColgp_Array2OfPnt poles(1, nu, 1, nv);
  TColStd_Array2OfReal weights(1, nu, 1, nv);
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const Eigen::Index row = Eigen::Index(i) * nv + j;
      poles(i + 1, j + 1) = point(face.poles, row);
      weights(i + 1, j + 1) = face.weights.size() > 0 ? face.weights[row] : 1;
    }
  return new Geom_BSplineSurface(poles, weights, u.values(), v.values(), u.multiplicities(), v.multiplicities(),
                                 face.u_degree, face.v_degree);
}

/// An edge in the parameters of a face: straight, linear in the edge's own parameter.
Handle(Geom2d_Curve) segment_of(const EdgeUse& use, const SplineEdge& edge) {
  const Eigen::Vector2d from = use.reversed ? use.to : use.from, to = use.reversed ? use.from : use.to;
  const double first = edge.knots.front(), last = edge.knots.back(), length = (to - from).norm();
  constexpr double rounding = 1e-12;
  if (first == 0 && std::abs(length - last) <= rounding * last) {
    const Eigen::Vector2d along = (to - from) / length;
    return new Geom2d_Line(gp_Pnt2d(from[0], from[1]), gp_Dir2d(along[0], along[1]));
  }
  TColgp_Array1OfPnt2d ends(1, 2);
  ends(1) = gp_Pnt2d(from[0], from[1]), ends(2) = gp_Pnt2d(to[0], to[1]);
  const KnotCounts knots({first, first, last, last});
  return new Geom2d_BSplineCurve(ends, knots.values(), knots.multiplicities(), 1);
}

double tolerance_of(const SplineEdge& edge) { return std::max(Precision::Confusion(), 1.5 * edge.gap); }

class ShapeMaker {
 public:
  explicit ShapeMaker(const BoundaryModel& model) : model_(model) {}

  ModelShape make() {
    make_edges();
    for (const SplineFace& face : model_.faces) faces_.push_back(face_of(face));
    return gather();
  }

 private:
  void make_edges() {
    std::vector<TopoDS_Vertex> vertices(size_t(model_.vertices.rows()));
    std::vector<double> tolerance(vertices.size(), Precision::Confusion());
    for (const SplineEdge& e : model_.edges)
      for (const Index v : {e.start, e.end}) tolerance[size_t(v)] = std::max(tolerance[size_t(v)], 2 * e.gap);
    for (size_t v = 0; v < vertices.size(); ++v)
      builder_.MakeVertex(vertices[v], point(model_.vertices, Eigen::Index(v)), tolerance[v]);
    for (const SplineEdge& e : model_.edges) {
      TopoDS_Edge edge;
      if (e.is_point) {
        builder_.MakeEdge(edge);
        builder_.UpdateEdge(edge, tolerance_of(e));
        builder_.Degenerated(edge, true);
      } else {
        builder_.MakeEdge(edge, curve_of(e), tolerance_of(e));
      }
      builder_.Range(edge, e.knots.front(), e.knots.back());
      builder_.Add(edge, vertices[size_t(e.start)].Oriented(TopAbs_FORWARD));
      builder_.Add(edge, vertices[size_t(e.end)].Oriented(TopAbs_REVERSED));
      edges_.push_back(edge);
    }
  }

  TopoDS_Face face_of(const SplineFace& f) {
    TopoDS_Face face;
    builder_.MakeFace(face, surface_of(f), Precision::Confusion());
    TopoDS_Wire wire;
    builder_.MakeWire(wire);
    for (const EdgeUse& use : f.border) {
      add_segment(f, use, face);
      const TopoDS_Edge& edge = edges_[size_t(use.edge)];
      builder_.Add(wire, edge.Oriented(use.reversed ? TopAbs_REVERSED : TopAbs_FORWARD));
    }
    wire.Closed(true);
    builder_.Add(face, wire);
    if (f.reversed) face.Reverse();
    return face;
  }

  void add_segment(const SplineFace& f, const EdgeUse& use, const TopoDS_Face& face) {
    const TopoDS_Edge& edge = edges_[size_t(use.edge)];
    const SplineEdge& e = model_.edges[size_t(use.edge)];
    const auto other =
        std::ranges::find_if(f.border, [&](const EdgeUse& u) { return u.edge == use.edge && &u != &use; });
    const bool is_seam = other != f.border.end();
    if (is_seam && use.reversed) return;  // told with the other one, which the edge runs along
    if (is_seam)
      builder_.UpdateEdge(edge, segment_of(use, e), segment_of(*other, e), face, tolerance_of(e));
    else
      builder_.UpdateEdge(edge, segment_of(use, e), face, tolerance_of(e));
    builder_.Range(edge, face, e.knots.front(), e.knots.back());
    builder_.SameParameter(edge, true);
    builder_.SameRange(edge, true);
  }

  /// Faces by the edges that they share.
  std::vector<std::vector<size_t>> components() const {
    SignedClasses groups(model_.faces.size());
    std::vector<size_t> first(model_.edges.size(), model_.faces.size());
    for (size_t f = 0; f < model_.faces.size(); ++f)
      for (const EdgeUse& use : model_.faces[f].border) {
        if (model_.edges[size_t(use.edge)].is_point) continue;
        size_t& at = first[size_t(use.edge)];
        if (at == model_.faces.size()) at = f;
        groups.join(at, f);
      }
    std::map<size_t, std::vector<size_t>> found;
    for (size_t f = 0; f < groups.size(); ++f) found[groups.find(f).first].push_back(f);
    std::vector<std::vector<size_t>> all;
    for (auto& [least, faces] : found) all.push_back(std::move(faces));
    return all;
  }

  /// Whether each edge has one face on either side, and fronts go on across it.
  bool is_closed(const std::vector<size_t>& component) const {
    std::map<Index, std::pair<int, int>> uses;  // and their sum with signs
    for (const size_t f : component)
      for (const EdgeUse& use : model_.faces[f].border) {
        if (model_.edges[size_t(use.edge)].is_point) continue;
        auto& [count, sum] = uses[use.edge];
        ++count, sum += use.reversed != model_.faces[f].reversed ? -1 : 1;
      }
    return std::ranges::all_of(uses, [](const auto& use) { return use.second == std::pair(2, 0); });
  }

  ModelShape gather() {
    ModelShape made;
    for (const std::vector<size_t>& component : components()) {
      TopoDS_Shell shell;
      builder_.MakeShell(shell);
      double volume = 0;
      for (const size_t f : component) builder_.Add(shell, faces_[f]), volume += model_.faces[f].volume;
      const bool closed = is_closed(component);
      shell.Closed(closed);
      made.parts.push_back({shell, common_name(component)});
      if (!closed || is_flat(component, volume)) {
        ++made.shells;
        continue;
      }
      TopoDS_Solid solid;
      builder_.MakeSolid(solid);
      builder_.Add(solid, volume < 0 ? shell.Reversed() : TopoDS_Shape(shell));
      made.parts.back().shape = solid;
      ++made.solids;
      made.volume += std::abs(volume);
    }
    made.shape = made.parts.size() == 1 ? made.parts[0].shape : TopoDS_Shape(compound(made.parts));
    made.is_valid = BRepCheck_Analyzer(made.shape).IsValid();
    made.faces.assign(faces_.begin(), faces_.end());
    return made;
  }

  /// Two faces on each other bound nothing.
  bool is_flat(const std::vector<size_t>& component, double volume) const {
    constexpr double rounding = 1e-12;
    Eigen::AlignedBox3d box;
    for (const size_t f : component)
      for (const auto& pole : model_.faces[f].poles.rowwise()) box.extend(Eigen::Vector3d(pole.transpose()));
    return !(std::abs(volume) > rounding * std::pow(box.diagonal().norm(), 3));
  }

  std::string common_name(const std::vector<size_t>& component) const {
    const std::string& name = model_.faces[component[0]].name;
    const bool all = std::ranges::all_of(component, [&](size_t f) { return model_.faces[f].name == name; });
    return all ? name : std::string();
  }

  TopoDS_Compound compound(const std::vector<ModelShape::Part>& parts) {
    TopoDS_Compound all;
    builder_.MakeCompound(all);
    for (const ModelShape::Part& part : parts) builder_.Add(all, part.shape);
    return all;
  }

  const BoundaryModel& model_;
  BRep_Builder builder_;
  std::vector<TopoDS_Edge> edges_;
  std::vector<TopoDS_Face> faces_;
};

}  // namespace

ModelShape shape_of(const BoundaryModel& model) { return ShapeMaker(model).make(); }

}  // namespace sublimit
