// SPDX-License-Identifier: Apache-2.0
#include "peers/openmesh_reference.h"

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/MidpointT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/ModifiedButterFlyT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/Sqrt3InterpolatingSubdividerLabsikGreinerT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/Sqrt3T.hh>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace sublimit::testing {
namespace {

namespace Uniform = OpenMesh::Subdivider::Uniform;

struct DoublePointsOnly : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;  // the type of normals stays Vec3f
};
using Polygons = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;
using Triangles = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;
using TrianglesSingle = OpenMesh::TriMesh_ArrayKernelT<DoublePointsOnly>;

template <class PeerKernel>
PeerKernel built(const Mesh& control) {
  PeerKernel mesh;
  std::vector<OpenMesh::VertexHandle> corners;
  for (Index v = 0; v < control.num_vertices(); ++v)
    mesh.add_vertex({control.positions(v, 0), control.positions(v, 1), control.positions(v, 2)});
  size_t at = 0;
  for (const Index size : control.face_sizes) {
    corners.clear();
    for (Index i = 0; i < size; ++i) corners.emplace_back(control.face_vertices[at++]);
    // A triangle mesh would cut other faces into triangles without a word.
    if ((PeerKernel::is_trimesh() && size != 3) || !mesh.add_face(corners).is_valid())
      throw std::runtime_error("OpenMesh does not take the mesh");
  }
  return mesh;
}

template <class PeerKernel>
PeerMesh copied(const PeerKernel& mesh) {
  PeerMesh result;
  result.positions.resize(Index(mesh.n_vertices()), 3);
  for (const auto v : mesh.vertices())
    for (int c = 0; c < 3; ++c) result.positions(v.idx(), c) = mesh.point(v)[c];
  for (const auto f : mesh.faces()) {
    Index size = 0;
    for (const auto v : mesh.fv_range(f)) result.face_vertices.push_back(v.idx()), ++size;
    result.face_sizes.push_back(size);
  }
  result.num_edges = Index(mesh.n_edges());
  return result;
}

/// A mesh and its subdivider, ready to run.
template <class PeerKernel, template <class, class> class Subdivider>
struct Refinable {
  explicit Refinable(const Mesh& control) : mesh(built<PeerKernel>(control)) {
    if constexpr (requires { subdivide.init_weights(size_t{}); }) {
      // Tables of weights reach to a fixed valence, and most subdividers read on beyond.
      unsigned most = 0;
      for (const auto v : mesh.vertices()) most = std::max(most, mesh.valence(v));
      if (most >= 30) subdivide.init_weights(most + 1);
    }
  }
  /// In place.
  const PeerKernel& refine(int levels) {
    if (!subdivide(mesh, size_t(levels))) throw std::runtime_error("OpenMesh does not refine the mesh");
    return mesh;
  }
  PeerKernel mesh;
  Subdivider<PeerKernel, double> subdivide;
};

/// Calls `use` with a pointer to the Refinable.
template <class Use>
auto with_refinable(const Mesh& control, OpenMeshScheme scheme, const Use& use) {
  switch (scheme) {
    case OpenMeshScheme::loop:
      return use(std::make_shared<Refinable<Triangles, Uniform::LoopT>>(control));
    case OpenMeshScheme::sqrt3:
      return use(std::make_shared<Refinable<Triangles, Uniform::Sqrt3T>>(control));
    case OpenMeshScheme::modified_butterfly:
      return use(std::make_shared<Refinable<Triangles, Uniform::ModifiedButterflyT>>(control));
    case OpenMeshScheme::interpolatory_sqrt3:
      return use(std::make_shared<Refinable<Triangles, Uniform::InterpolatingSqrt3LGT>>(control));
    case OpenMeshScheme::catmull_clark:
      return use(std::make_shared<Refinable<Polygons, Uniform::CatmullClarkT>>(control));
    case OpenMeshScheme::midpoint:
      return use(std::make_shared<Refinable<Polygons, Uniform::MidpointT>>(control));
  }
  throw std::runtime_error("no such scheme");
}

}  // namespace

std::optional<OpenMeshScheme> openmesh_scheme(const std::string& name) {
  if (name == "loop") return OpenMeshScheme::loop;
  if (name == "sqrt3") return OpenMeshScheme::sqrt3;
  if (name == "modified-butterfly") return OpenMeshScheme::modified_butterfly;
  if (name == "interpolatory-sqrt3") return OpenMeshScheme::interpolatory_sqrt3;
  if (name == "catmull-clark") return OpenMeshScheme::catmull_clark;
  if (name == "mid-edge") return OpenMeshScheme::midpoint;
  return std::nullopt;
}

PeerMesh openmesh_refine(const Mesh& mesh, OpenMeshScheme scheme, int levels, OpenMeshNormals normals) {
  if (normals == OpenMeshNormals::twice)
    return with_refinable(mesh, scheme, [&](const auto& refinable) { return copied(refinable->refine(levels)); });
  if (scheme != OpenMeshScheme::loop) throw std::runtime_error("single normals are for Loop's scheme only");
  return copied(Refinable<TrianglesSingle, Uniform::LoopT>(mesh).refine(levels));
}

std::function<std::size_t()> openmesh_run(const Mesh& mesh, OpenMeshScheme scheme, int levels) {
  return with_refinable(mesh, scheme, [&](const auto& refinable) -> std::function<std::size_t()> {
    return [refinable, levels] { return refinable->refine(levels).n_vertices(); };
  });
}

}  // namespace sublimit::testing
