// SPDX-License-Identifier: Apache-2.0
#include "peers/opensubdiv_limit_reference.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/stencilTableFactory.h>

#include <stdexcept>

#include "peers/opensubdiv_refiner.h"

namespace sublimit::testing {
namespace {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;

struct Point {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  void Clear() { x.setZero(); }
  void AddWithWeight(const Point& p, double weight) { x += weight * p.x; }
};

std::vector<Point> control_points(const Mesh& mesh) {
  std::vector<Point> result(static_cast<size_t>(mesh.num_vertices()));
  for (Index v = 0; v < mesh.num_vertices(); ++v) result[v].x = mesh.positions.row(v).transpose();
  return result;
}

}  // namespace

struct FarLimit::Parts {
  std::unique_ptr<Far::TopologyRefiner> refiner;
  std::unique_ptr<const Far::PatchTable> table;
  std::optional<Far::PatchMap> map;
  std::vector<Point> points;  // of all levels, then those of end caps
  Index num_control = 0;
};

FarLimit::FarLimit(const Mesh& mesh, const ReferenceOptions& scheme, const Options& given)
    : parts_(std::make_unique<Parts>()) {
  Far::PatchTableFactory::Options options(static_cast<unsigned>(given.level));
  options.useInfSharpPatch = given.inf_sharp_patches;
  options.generateLegacySharpCornerPatches = !given.inf_sharp_patches;  // sharp patches at smooth corners, by default
  options.SetPatchPrecision<double>();
  options.SetEndCapType(Far::PatchTableFactory::Options::ENDCAP_GREGORY_BASIS);
  Parts& p = *parts_;
  p.num_control = mesh.num_vertices();
  p.refiner = reference_refiner(mesh, scheme);
  p.refiner->RefineAdaptive(options.GetRefineAdaptiveOptions());
  p.table.reset(Far::PatchTableFactory::Create(*p.refiner, options));
  p.map.emplace(*p.table);

  p.points = control_points(mesh);
  p.points.resize(static_cast<size_t>(p.refiner->GetNumVerticesTotal() + p.table->GetNumLocalPoints()));
  const Far::PrimvarRefinerReal<double> primvars(*p.refiner);
  Point* source = p.points.data();
  for (int k = 1; k <= p.refiner->GetMaxLevel(); ++k) {
    Point* target = source + p.refiner->GetLevel(k - 1).GetNumVertices();
    primvars.Interpolate(k, source, target);
    source = target;
  }
  if (p.table->GetNumLocalPoints() > 0)
    p.table->GetLocalPointStencilTable<double>()->UpdateValues(p.points.data(),
                                                               p.points.data() + p.refiner->GetNumVerticesTotal());
}

FarLimit::~FarLimit() = default;
FarLimit::FarLimit(FarLimit&&) noexcept = default;

std::optional<ReferencePoint> FarLimit::at(const Place& place) const {
  const Far::PatchMap::Handle* patch = parts_->map->FindPatch(place.face, place.u, place.v);
  if (!patch) return {};
  double w[6][20];
  parts_->table->EvaluateBasis(*patch, place.u, place.v, w[0], w[1], w[2], w[3], w[4], w[5]);
  const Far::ConstIndexArray vertices = parts_->table->GetPatchVertices(*patch);
  Point sum[6];
  for (int k = 0; k < vertices.size(); ++k)
    for (int row = 0; row < 6; ++row) sum[row].AddWithWeight(parts_->points[vertices[k]], w[row][k]);
  const Far::PatchParam parameter = parts_->table->GetPatchParam(*patch);
  // In triangles that lie upside down u and v run backwards, which second derivatives do not mind; Far 3.5 turns their
  // sign all the same.
  const bool upside_down =
      parts_->refiner->GetSchemeType() == OpenSubdiv::Sdc::SCHEME_LOOP && parameter.IsTriangleRotated();
  const double sign = upside_down ? -1 : 1;
  return ReferencePoint{sum[0].x,
                        sum[1].x,
                        sum[2].x,
                        sign * sum[3].x,
                        sign * sum[4].x,
                        sign * sum[5].x,
                        parameter.IsRegular(),
                        parameter.GetDepth()};
}

Points FarLimit::by_stencils(const std::vector<Place>& places) const {
  using Factory = Far::LimitStencilTableFactoryReal<double>;
  Factory::LocationArrayVec locations;
  for (const Place& s : places) {
    Factory::LocationArray location;
    location.ptexIdx = s.face;
    location.numLocations = 1;
    location.s = &s.u;
    location.t = &s.v;
    locations.push_back(location);
  }
  const std::unique_ptr<const Far::LimitStencilTableReal<double>> table(
      Factory::Create(*parts_->refiner, locations, nullptr, parts_->table.get()));
  if (!table || table->GetNumStencils() != static_cast<int>(places.size()))
    throw std::runtime_error("OpenSubdiv has no limit stencil for some place");
  std::vector<Point> result(places.size());
  table->UpdateValues(parts_->points.data(), result.data());
  Points rows(static_cast<Index>(places.size()), 3);
  for (size_t i = 0; i < places.size(); ++i) rows.row(static_cast<Index>(i)) = result[i].x.transpose();
  return rows;
}

struct BfrLimit::Parts {
  std::unique_ptr<Far::TopologyRefiner> refiner;
  Addresses addresses;
  std::vector<Index> face_sizes;
  std::vector<Bfr::Surface<double>> surfaces;
  std::vector<std::vector<double>> points;  // of each surface's patches
};

BfrLimit::BfrLimit(const Mesh& mesh, const ReferenceOptions& scheme, const Options& given)
    : parts_(new Parts{reference_refiner(mesh, scheme),
                       Addresses(Topology({.num_vertices = mesh.num_vertices(),
                                           .face_vertices = mesh.face_vertices,
                                           .face_sizes = mesh.face_sizes}),
                                 scheme.scheme == "loop"),
                       mesh.face_sizes, std::vector<Bfr::Surface<double>>(mesh.face_sizes.size()),
                       std::vector<std::vector<double>>(mesh.face_sizes.size())}) {
  Bfr::SurfaceFactory::Options options;
  options.SetApproxLevelSmooth(given.smooth_level);
  options.SetApproxLevelSharp(given.sharp_level);
  const Bfr::RefinerSurfaceFactory<> factory(*parts_->refiner, options);
  for (Index f = 0; f < mesh.num_faces(); ++f) {
    Bfr::Surface<double>& surface = parts_->surfaces[f];
    if (!factory.InitVertexSurface(f, &surface)) continue;
    parts_->points[f].resize(3 * static_cast<size_t>(surface.GetNumPatchPoints()));
    surface.PreparePatchPoints(mesh.positions.data(), 3, parts_->points[f].data(), 3);
  }
}

BfrLimit::~BfrLimit() = default;
BfrLimit::BfrLimit(BfrLimit&&) noexcept = default;

std::optional<ReferencePoint> BfrLimit::at(Index face, const BfrParameter& parameter) const {
  const Bfr::Surface<double>& surface = parts_->surfaces[face];
  if (!surface.IsValid()) return {};
  const double uv[2] = {parameter.u, parameter.v};
  ReferencePoint p;
  surface.Evaluate(uv, parts_->points[face].data(), 3, p.position.data(), p.du.data(), p.dv.data(), p.duu.data(),
                   p.duv.data(), p.dvv.data());
  p.regular = surface.IsRegular();
  return p;
}

std::optional<ReferencePoint> BfrLimit::at(const Place& place) const {
  const auto [face, corner] = parts_->addresses.place(place.face);
  return at(index(face), corner < 0 ? BfrParameter{place.u, place.v}
                                    : to_bfr(parts_->face_sizes[index(face)], corner, place.u, place.v));
}

}  // namespace sublimit::testing
