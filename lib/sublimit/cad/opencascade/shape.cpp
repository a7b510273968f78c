// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/opencascade/shape.h"

#include <BRepCheck_Analyzer.hxx>
#include <BRep_Builder.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

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
  TColgp_Array1OfPnt poles(1, int(edge.poles.rows()));
  for (Eigen::Index i = 0; i < edge.poles.rows(); ++i) poles(int(i) + 1) = point(edge.poles, i);
  const KnotCounts knots(edge.knots);
  return new Geom_BSplineCurve(poles, knots.values(), knots.multiplicities(), edge.degree);
}

Handle(Geom_BSplineSurface) surface_of(const SplineFace& face) {
  const KnotCounts u(face.u_knots), v(face.v_knots);
  const int nu = int(face.u_knots.size()) - face.degree - 1, nv = int(face.v_knots.size()) - face.degree - 1;
  TColgp_Array2OfPnt poles(1, nu, 1, nv);
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) poles(i + 1, j + 1) = point(face.poles, Eigen::Index(i) * nv + j);
  return new Geom_BSplineSurface(poles, u.values(), v.values(), u.multiplicities(), v.multiplicities(), face.degree,
                                 face.degree);
}

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
      builder_.MakeEdge(edge, curve_of(e), std::max(Precision::Confusion(), 1.5 * e.gap));
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
      const TopoDS_Edge& edge = edges_[size_t(use.edge)];
      const Eigen::Vector2d from = use.reversed ? use.to : use.from, to = use.reversed ? use.from : use.to;
      const Eigen::Vector2d along = (to - from).normalized();
      const Handle(Geom2d_Line) line = new Geom2d_Line(gp_Pnt2d(from[0], from[1]), gp_Dir2d(along[0], along[1]));
      builder_.UpdateEdge(edge, line, face, std::max(Precision::Confusion(), 1.5 * model_.edges[size_t(use.edge)].gap));
      const double first = model_.edges[size_t(use.edge)].knots.front();
      builder_.Range(edge, face, first, first + (to - from).norm());
      builder_.SameParameter(edge, true);
      builder_.SameRange(edge, true);
      builder_.Add(wire, edge.Oriented(use.reversed ? TopAbs_REVERSED : TopAbs_FORWARD));
    }
    wire.Closed(true);
    builder_.Add(face, wire);
    return face;
  }

  /// Faces by the edges that they share.
  std::vector<std::vector<size_t>> components() const {
    std::vector<size_t> group(model_.faces.size());
    std::iota(group.begin(), group.end(), size_t{0});
    const auto find = [&](size_t a) {
      while (group[a] != a) a = group[a] = group[group[a]];
      return a;
    };
    std::vector<size_t> first(model_.edges.size(), model_.faces.size());
    for (size_t f = 0; f < model_.faces.size(); ++f)
      for (const EdgeUse& use : model_.faces[f].border) {
        size_t& at = first[size_t(use.edge)];
        if (at == model_.faces.size()) at = f;
        const size_t a = find(at), b = find(f);
        group[std::max(a, b)] = std::min(a, b);
      }
    std::map<size_t, std::vector<size_t>> found;
    for (size_t f = 0; f < group.size(); ++f) found[find(f)].push_back(f);
    std::vector<std::vector<size_t>> all;
    for (auto& [least, faces] : found) all.push_back(std::move(faces));
    return all;
  }

  ModelShape gather() {
    ModelShape made;
    std::vector<TopoDS_Shape> parts;
    std::vector<int> balance(model_.edges.size(), 0), uses(model_.edges.size(), 0);
    for (const SplineFace& face : model_.faces)
      for (const EdgeUse& use : face.border)
        balance[size_t(use.edge)] += use.reversed ? -1 : 1, ++uses[size_t(use.edge)];
    for (const std::vector<size_t>& component : components()) {
      TopoDS_Shell shell;
      builder_.MakeShell(shell);
      bool closed = true;
      for (const size_t f : component) {
        builder_.Add(shell, faces_[f]);
        for (const EdgeUse& use : model_.faces[f].border)
          closed = closed && uses[size_t(use.edge)] == 2 && balance[size_t(use.edge)] == 0;
      }
      shell.Closed(closed);
      if (!closed) {
        ++made.shells;
        parts.push_back(shell);
        continue;
      }
      TopoDS_Solid solid;
      builder_.MakeSolid(solid);
      builder_.Add(solid, shell);
      double volume = 0;
      for (const size_t f : component) volume += model_.faces[f].volume;
      if (volume < 0) {
        builder_.MakeSolid(solid);
        builder_.Add(solid, shell.Reversed());
      }
      ++made.solids;
      parts.push_back(solid);
    }
    if (parts.size() == 1) {
      made.shape = parts[0];
    } else {
      TopoDS_Compound all;
      builder_.MakeCompound(all);
      for (const TopoDS_Shape& part : parts) builder_.Add(all, part);
      made.shape = all;
    }
    made.is_valid = BRepCheck_Analyzer(made.shape).IsValid();
    return made;
  }

  const BoundaryModel& model_;
  BRep_Builder builder_;
  std::vector<TopoDS_Edge> edges_;
  std::vector<TopoDS_Face> faces_;
};

}  // namespace

ModelShape shape_of(const BoundaryModel& model) { return ShapeMaker(model).make(); }

}  // namespace sublimit
