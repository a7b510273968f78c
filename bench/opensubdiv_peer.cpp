// SPDX-License-Identifier: Apache-2.0
#include "opensubdiv_peer.h"

#include <opensubdiv/far/error.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/stencilTable.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "opensubdiv_point.h"
#include "opensubdiv_refiner.h"

namespace sublimit::bench {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

Sdc::SchemeType scheme_type(PeerScheme scheme) {
  switch (scheme) {
    case PeerScheme::bilinear:
      return Sdc::SCHEME_BILINEAR;
    case PeerScheme::loop:
      return Sdc::SCHEME_LOOP;
    default:
      return Sdc::SCHEME_CATMARK;
  }
}

template <class Real>
PeerPositions interpolate(const Far::TopologyRefiner& refiner, std::span<const Real> positions) {
  const int levels = refiner.GetMaxLevel();
  const auto control = static_cast<std::size_t>(refiner.GetLevel(0).GetNumVertices());
  if (positions.size() != 3 * control) throw std::runtime_error("three coordinates per control vertex are needed");
  const std::size_t refined = static_cast<std::size_t>(refiner.GetNumVerticesTotal()) - control;
  using Point = OpenSubdivPoint<Real>;
  const auto points = std::make_unique_for_overwrite<Point[]>(refined);

  const auto* source = reinterpret_cast<const Point*>(positions.data());
  Point* target = points.get();
  const Far::PrimvarRefinerReal<Real> primvars(refiner);
  for (int k = 1; k <= levels; ++k) {
    primvars.Interpolate(k, source, target);
    source = target;
    target += refiner.GetLevel(k).GetNumVertices();
  }
  PeerPositions result{.vertices = refined};
  for (int v = 0; v < refiner.GetLevel(levels).GetNumVertices(); v += 1000) {
    for (const Real x : {source[v].x, source[v].y, source[v].z}) result.checksum += std::abs(static_cast<double>(x));
  }
  return result;
}

template <class Real>
PeerStencils stencils(const Far::TopologyRefiner& refiner) {
  using Factory = Far::StencilTableFactoryReal<Real>;
  typename Factory::Options options;
  options.generateOffsets = true;
  options.generateIntermediateLevels = false;
  options.maxLevel = static_cast<unsigned>(refiner.GetMaxLevel()) & 0xf;
  const std::unique_ptr<const Far::StencilTableReal<Real>> table(Factory::Create(refiner, options));
  // GetWeights() may be longer than what the stencils use; the indices are not.
  return {static_cast<std::size_t>(table->GetNumStencils()), table->GetControlIndices().size()};
}

}  // namespace

std::unique_ptr<Far::TopologyRefiner> topology_refiner(const PeerMesh& mesh) {
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = mesh.num_vertices;
  descriptor.numFaces = static_cast<int>(mesh.face_sizes.size());
  descriptor.numVertsPerFace = mesh.face_sizes.data();
  descriptor.vertIndicesPerFace = mesh.face_vertices.data();
  descriptor.numCreases = static_cast<int>(mesh.crease_sharpness.size());
  descriptor.creaseVertexIndexPairs = mesh.crease_vertices.data();
  descriptor.creaseWeights = mesh.crease_sharpness.data();
  descriptor.numCorners = static_cast<int>(mesh.corner_sharpness.size());
  descriptor.cornerVertexIndices = mesh.corner_vertices.data();
  descriptor.cornerWeights = mesh.corner_sharpness.data();

  Sdc::Options sdc;
  sdc.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  std::unique_ptr<Far::TopologyRefiner> refiner(
      Factory::Create(descriptor, Factory::Options(scheme_type(mesh.scheme), sdc)));
  if (!refiner) throw std::runtime_error("OpenSubdiv refuses the mesh");
  return refiner;
}

struct PeerRefiner::Implementation {
  std::unique_ptr<Far::TopologyRefiner> refiner;
};

PeerRefiner::PeerRefiner(const PeerMesh& mesh, int levels, bool whole_last_level)
    : implementation_(std::make_unique<Implementation>()) {
  if (levels < 0 || levels > 10) throw std::runtime_error("OpenSubdiv's stencil factory stops at level 10");
  implementation_->refiner = topology_refiner(mesh);
  Far::TopologyRefiner::UniformOptions uniform(levels);
  uniform.fullTopologyInLastLevel = whole_last_level;
  implementation_->refiner->RefineUniform(uniform);
}

PeerRefiner::~PeerRefiner() = default;
PeerRefiner::PeerRefiner(PeerRefiner&&) noexcept = default;
PeerRefiner& PeerRefiner::operator=(PeerRefiner&&) noexcept = default;

int PeerRefiner::levels() const { return implementation_->refiner->GetMaxLevel(); }
std::size_t PeerRefiner::num_vertices(int level) const {
  return static_cast<std::size_t>(implementation_->refiner->GetLevel(level).GetNumVertices());
}
std::size_t PeerRefiner::num_faces(int level) const {
  return static_cast<std::size_t>(implementation_->refiner->GetLevel(level).GetNumFaces());
}

PeerPositions PeerRefiner::refine(std::span<const double> positions) const {
  return interpolate(*implementation_->refiner, positions);
}
PeerPositions PeerRefiner::refine(std::span<const float> positions) const {
  return interpolate(*implementation_->refiner, positions);
}
PeerStencils PeerRefiner::stencils_double() const { return stencils<double>(*implementation_->refiner); }
PeerStencils PeerRefiner::stencils_float() const { return stencils<float>(*implementation_->refiner); }

}  // namespace sublimit::bench
