// SPDX-License-Identifier: Apache-2.0
#include "peers/opensubdiv_reference.h"

#include <opensubdiv/far/error.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "peers/opensubdiv_refiner.h"

namespace sublimit::testing {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

// OpenSubdiv reports through process-wide callbacks and carries on, so errors are noted here and thrown after the call.
thread_local std::string far_errors;

void listen_to_far() {
  static const bool once = [] {
    Far::SetErrorCallback([](Far::ErrorType, const char* message) { far_errors += message; });
    Far::SetWarningCallback([](const char*) {});
    return true;
  }();
  static_cast<void>(once);
  far_errors.clear();
}

void throw_far_errors() {
  if (!far_errors.empty()) throw std::runtime_error("OpenSubdiv: " + far_errors);
}

Sdc::SchemeType scheme_type(const std::string& name) {
  if (name == "catmull-clark") return Sdc::SCHEME_CATMARK;
  if (name == "loop") return Sdc::SCHEME_LOOP;
  if (name == "bilinear") return Sdc::SCHEME_BILINEAR;
  throw std::runtime_error("OpenSubdiv has no scheme '" + name + "'; it has catmull-clark, loop, bilinear");
}

Sdc::Options scheme_options(const ReferenceOptions& options) {
  Sdc::Options sdc;
  switch (options.boundary) {
    case Boundary::none:
      sdc.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_NONE);
      break;
    case Boundary::edge_only:
      sdc.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
      break;
    case Boundary::edge_and_corner:
      sdc.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
      break;
  }
  sdc.SetCreasingMethod(options.creasing == Creasing::chaikin ? Sdc::Options::CREASE_CHAIKIN
                                                              : Sdc::Options::CREASE_UNIFORM);
  sdc.SetTriangleSubdivision(options.triangles == Triangles::smooth ? Sdc::Options::TRI_SUB_SMOOTH
                                                                    : Sdc::Options::TRI_SUB_CATMARK);
  if (options.face_varying)
    sdc.SetFVarLinearInterpolation(static_cast<Sdc::Options::FVarLinearInterpolation>(*options.face_varying));
  return sdc;
}

// The factory trusts every index and needs a face: what it does not look at is looked at here.
void require_indices_in_range(const Mesh& mesh) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::runtime_error(std::string("no mesh for OpenSubdiv: ") + what);
  };
  const auto is_vertex = [&](Index v) { return v >= 0 && v < mesh.num_vertices(); };
  require(mesh.num_faces() > 0, "it has no faces");
  require(mesh.positions.cols() == 3, "positions need three coordinates");
  std::size_t corners = 0;
  for (const Index size : mesh.face_sizes) {
    require(size >= 3, "a face has fewer than 3 corners");
    corners += static_cast<std::size_t>(size);
  }
  require(corners == mesh.face_vertices.size(), "face sizes do not add up");
  require(std::ranges::all_of(mesh.face_vertices, is_vertex), "a face vertex is out of range");
  for (const Mesh::Crease& crease : mesh.creases) {
    require(is_vertex(crease.tail) && is_vertex(crease.head), "a crease vertex is out of range");
  }
  for (const Mesh::Corner& corner : mesh.corners) require(is_vertex(corner.vertex), "a corner is out of range");
  for (const Index f : mesh.holes) require(f >= 0 && f < mesh.num_faces(), "a hole is out of range");
}

// A mesh, refined in place.
std::unique_ptr<Far::TopologyRefiner> refiner(const Mesh& mesh, const ReferenceOptions& options) {
  if (options.levels < 0 || options.levels > 15) throw std::runtime_error("OpenSubdiv refines 0 to 15 levels");
  std::unique_ptr<Far::TopologyRefiner> made = reference_refiner(mesh, options);
  Far::TopologyRefiner::UniformOptions uniform(options.levels);
  uniform.fullTopologyInLastLevel = true;  // sharpness and limit masks need the edges
  made->RefineUniform(uniform);
  throw_far_errors();
  return made;
}

struct Point {
  Eigen::Vector3d x;
  void Clear() { x.setZero(); }
  void AddWithWeight(const Point& p, double weight) { x += weight * p.x; }
};

std::vector<Point> points(const Points& positions) {
  std::vector<Point> result(static_cast<std::size_t>(positions.rows()));
  for (Index v = 0; v < positions.rows(); ++v) result[v].x = positions.row(v).transpose();
  return result;
}

Points positions(const std::vector<Point>& points) {
  Points result(static_cast<Index>(points.size()), 3);
  for (Index v = 0; v < result.rows(); ++v) result.row(v) = points[v].x.transpose();
  return result;
}

// Values of any number of columns.
struct Value {
  Eigen::VectorXd x;
  void Clear() { x.setZero(); }
  void AddWithWeight(const Value& v, double weight) { x += weight * v.x; }
};

void add_values(const Far::TopologyLevel& level, const std::vector<Value>& values, ReferenceLevel& result) {
  for (Index f = 0; f < level.GetNumFaces(); ++f) {
    const Far::ConstIndexArray of_face = level.GetFaceFVarValues(f, 0);
    for (int i = 0; i < of_face.size(); ++i) result.corner_value.push_back(of_face[i]);
  }
  result.values.resize(static_cast<Index>(values.size()), values[0].x.size());
  for (Index i = 0; i < result.values.rows(); ++i) result.values.row(i) = values[i].x.transpose();
}

ReferenceLevel topology(const Far::TopologyLevel& level, bool first) {
  ReferenceLevel result;
  for (Index f = 0; f < level.GetNumFaces(); ++f) {
    const Far::ConstIndexArray vertices = level.GetFaceVertices(f), edges = level.GetFaceEdges(f);
    result.face_sizes.push_back(vertices.size());
    for (int i = 0; i < vertices.size(); ++i) {
      result.face_vertices.push_back(vertices[i]);
      result.corner_edge_sharpness.push_back(level.GetEdgeSharpness(edges[i]));
    }
    result.face_hole.push_back(level.IsFaceHole(f));
    if (!first) result.face_parent.push_back(level.GetFaceParentFace(f));
  }
  for (Index v = 0; v < level.GetNumVertices(); ++v) result.vertex_sharpness.push_back(level.GetVertexSharpness(v));
  return result;
}

void add_children(const Far::TopologyLevel& level, Sdc::SchemeType scheme, ReferenceLevel& result) {
  result.child_face_offsets.push_back(0);
  for (Index f = 0; f < level.GetNumFaces(); ++f) {
    const Far::ConstIndexArray edges = level.GetFaceEdges(f), children = level.GetFaceChildFaces(f);
    for (int i = 0; i < edges.size(); ++i) result.corner_edge_child.push_back(level.GetEdgeChildVertex(edges[i]));
    for (int i = 0; i < children.size(); ++i) result.child_faces.push_back(children[i]);
    result.child_face_offsets.push_back(static_cast<Index>(result.child_faces.size()));
    if (scheme != Sdc::SCHEME_LOOP) result.face_child.push_back(level.GetFaceChildVertex(f));
  }
  for (Index v = 0; v < level.GetNumVertices(); ++v) result.vertex_child.push_back(level.GetVertexChildVertex(v));
}

ReferenceVertex::Rule rule(Sdc::Crease::Rule rule) {
  switch (rule) {
    case Sdc::Crease::RULE_SMOOTH:
      return ReferenceVertex::Rule::smooth;
    case Sdc::Crease::RULE_DART:
      return ReferenceVertex::Rule::dart;
    case Sdc::Crease::RULE_CREASE:
      return ReferenceVertex::Rule::crease;
    default:
      return ReferenceVertex::Rule::corner;
  }
}

// First corner of each face, to number corners as ReferenceLevel does.
std::vector<Index> first_corners(const Far::TopologyLevel& level) {
  std::vector<Index> first{0};
  for (Index f = 0; f < level.GetNumFaces(); ++f) first.push_back(first.back() + level.GetFaceVertices(f).size());
  return first;
}

ReferenceVertex vertex(const Far::TopologyLevel& level, Index v, int regular_face, const std::vector<Index>& first) {
  const Far::ConstIndexArray edges = level.GetVertexEdges(v), faces = level.GetVertexFaces(v);
  ReferenceVertex result{.rule = rule(level.GetVertexRule(v)),
                         .boundary = level.IsVertexBoundary(v),
                         .nonmanifold = level.IsVertexNonManifold(v),
                         .semisharp = level.IsVertexSemiSharp(v),
                         .faces = faces.size(),
                         .edges = edges.size()};
  std::vector<int> sharp;  // manifold: counter-clockwise, edge i and then face i
  for (int i = 0; i < edges.size(); ++i) {
    result.semisharp |= level.IsEdgeSemiSharp(edges[i]);
    if (level.GetEdgeSharpness(edges[i]) > 0) sharp.push_back(i);
  }
  for (int i = 0; i < faces.size(); ++i) {
    result.irregular_face |= level.GetFaceVertices(faces[i]).size() != regular_face;
  }
  if (result.rule == ReferenceVertex::Rule::crease && !result.nonmanifold) {
    result.side_faces = sharp[1] - sharp[0];
    result.side_corner = first[faces[sharp[0]]] + level.GetVertexFaceLocalIndices(v)[sharp[0]];
  }
  return result;
}

// PrimvarRefiner::Limit writes its masks into buffers of Level::getMaxValence() entries. On refined levels that number
// forgets the faces at the middle of a crowded edge (n faces give 2n there, but n + 2 edges), and the tangent masks of
// these vertices would be written out of bounds, as on catmark_nonman_edge100. A larger number only enlarges the
// buffers.
void make_room_for_limit_masks(Far::TopologyRefiner& refiner) {
  auto& level = refiner.getLevel(refiner.GetMaxLevel());
  int most = level.getMaxValence();
  for (Index v = 0; v < level.getNumVertices(); ++v) most = std::max(most, level.getVertexFaces(v).size());
  level.setMaxValence(most);
}

}  // namespace

// Vertices at more than one sheet, isolated ones (non-manifold to OpenSubdiv: corners
// that stay where they are), repeated vertices and degenerate edges are all accepted by the factory. Of a repeated edge
// in one face it makes a second, separate edge, as it does of every edge (v,v).
std::unique_ptr<Far::TopologyRefiner> reference_refiner(const Mesh& mesh, const ReferenceOptions& options) {
  require_indices_in_range(mesh);

  std::vector<Index> crease_vertices, corner_vertices;
  std::vector<float> crease_sharpness, corner_sharpness;
  for (const Mesh::Crease& crease : mesh.creases) {
    crease_vertices.insert(crease_vertices.end(), {crease.tail, crease.head});
    crease_sharpness.push_back(crease.sharpness);
  }
  for (const Mesh::Corner& corner : mesh.corners) {
    corner_vertices.push_back(corner.vertex);
    corner_sharpness.push_back(corner.sharpness);
  }
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = mesh.num_vertices();
  descriptor.numFaces = mesh.num_faces();
  descriptor.numVertsPerFace = mesh.face_sizes.data();
  descriptor.vertIndicesPerFace = mesh.face_vertices.data();
  descriptor.numCreases = static_cast<int>(crease_sharpness.size());
  descriptor.creaseVertexIndexPairs = crease_vertices.data();
  descriptor.creaseWeights = crease_sharpness.data();
  descriptor.numCorners = static_cast<int>(corner_sharpness.size());
  descriptor.cornerVertexIndices = corner_vertices.data();
  descriptor.cornerWeights = corner_sharpness.data();
  descriptor.numHoles = static_cast<int>(mesh.holes.size());
  descriptor.holeIndices = mesh.holes.data();

  Far::TopologyDescriptor::FVarChannel channel;
  if (options.face_varying) {
    channel.numValues = static_cast<int>(mesh.face_varying.at(0).values.rows());
    channel.valueIndices = mesh.face_varying[0].indices.data();
    descriptor.numFVarChannels = 1;
    descriptor.fvarChannels = &channel;
  }

  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  listen_to_far();
  std::unique_ptr<Far::TopologyRefiner> made(
      Factory::Create(descriptor, Factory::Options(scheme_type(options.scheme), scheme_options(options))));
  throw_far_errors();
  if (!made) throw std::runtime_error("OpenSubdiv refuses the mesh and does not say why");
  return made;
}

ReferenceOptions reference_options(const Mesh& mesh, const std::string& scheme, int levels) {
  ReferenceOptions options;
  options.scheme = scheme;
  options.levels = levels;
  if (mesh.boundary) options.boundary = *mesh.boundary;
  if (mesh.creasing) options.creasing = *mesh.creasing;
  if (mesh.triangles) options.triangles = *mesh.triangles;
  return options;
}

std::vector<ReferenceLevel> reference_refine(const Mesh& mesh, const ReferenceOptions& options) {
  const std::unique_ptr<Far::TopologyRefiner> refined = refiner(mesh, options);
  const Far::PrimvarRefinerReal<double> primvars(*refined);
  std::vector<ReferenceLevel> levels;
  std::vector<Point> parent = points(mesh.positions);
  std::vector<Value> values;
  if (options.face_varying)
    for (Index i = 0; i < mesh.face_varying[0].values.rows(); ++i)
      values.push_back({mesh.face_varying[0].values.row(i)});
  for (int k = 0; k <= options.levels; ++k) {
    const Far::TopologyLevel& level = refined->GetLevel(k);
    if (k > 0 && options.face_varying) {
      std::vector<Value> child(static_cast<std::size_t>(level.GetNumFVarValues(0)),
                               Value{Eigen::VectorXd::Zero(values[0].x.size())});
      primvars.InterpolateFaceVarying(k, values, child);
      values = std::move(child);
    }
    if (k > 0) {
      std::vector<Point> child(static_cast<std::size_t>(level.GetNumVertices()));
      primvars.Interpolate(k, parent, child);
      parent = std::move(child);
    }
    levels.push_back(topology(level, k == 0));
    levels.back().positions = positions(parent);
    if (options.face_varying) add_values(level, values, levels.back());
    if (k < options.levels) add_children(level, refined->GetSchemeType(), levels.back());
  }
  return levels;
}

ReferenceLimit reference_limit(const Mesh& mesh, const ReferenceOptions& options) {
  const std::unique_ptr<Far::TopologyRefiner> refined = refiner(mesh, options);
  const Far::PrimvarRefinerReal<double> primvars(*refined);
  std::vector<Point> parent = points(mesh.positions);
  for (int k = 1; k <= options.levels; ++k) {
    std::vector<Point> child(static_cast<std::size_t>(refined->GetLevel(k).GetNumVertices()));
    primvars.Interpolate(k, parent, child);
    parent = std::move(child);
  }

  ReferenceLimit limit;
  std::vector<Point> position(parent.size());
  if (options.tangents) {
    make_room_for_limit_masks(*refined);
    std::vector<Point> tangent1(parent.size()), tangent2(parent.size());
    primvars.Limit(parent, position, tangent1, tangent2);
    limit.tangent1 = positions(tangent1);
    limit.tangent2 = positions(tangent2);
  } else {
    primvars.Limit(parent, position);
  }
  throw_far_errors();
  limit.position = positions(position);

  const Far::TopologyLevel& level = refined->GetLevel(options.levels);
  const std::vector<Index> first = first_corners(level);
  const int regular_face = refined->GetSchemeType() == Sdc::SCHEME_LOOP ? 3 : 4;
  for (Index v = 0; v < level.GetNumVertices(); ++v) limit.vertex.push_back(vertex(level, v, regular_face, first));
  return limit;
}

}  // namespace sublimit::testing
