// SPDX-License-Identifier: Apache-2.0
#include "limit_peers.h"

#include <embree3/rtcore.h>
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <tbb/global_control.h>

#include <cmath>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <stdexcept>

#include "opensubdiv_point.h"
#include "opensubdiv_refiner.h"
#include "sublimit/base/detail/parallel_for.h"

namespace sublimit::bench {
namespace {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;

constexpr int numbers_per_place(int order) { return 3 * (order + 1) * (order + 2) / 2; }

bool one_thread() { return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism) == 1; }

Addresses addresses_of(const Mesh& mesh) {
  return {
      Topology(
          {.num_vertices = mesh.num_vertices(), .face_vertices = mesh.face_vertices, .face_sizes = mesh.face_sizes}),
      false};
}

/// Position and derivatives of all places, one after the other.
template <class Real>
class Results {
 public:
  void resize(size_t places) { numbers_.resize(places * numbers_per_place(2)); }
  Real* at(std::int64_t place, int order) { return &numbers_[size_t(place) * numbers_per_place(order)]; }
  void made(int order) { order_ = order; }
  Eigen::Vector3d position(size_t place) const {
    const Real* p = &numbers_[place * numbers_per_place(order_)];
    return {double(p[0]), double(p[1]), double(p[2])};
  }

 private:
  std::vector<Real> numbers_;
  int order_ = 0;
};

template <class Real>
std::vector<Real> coordinates(const Mesh& mesh) {
  return {mesh.positions.data(), mesh.positions.data() + mesh.positions.size()};
}

template <class Real>
class BfrEvaluator : public LimitEvaluator {
 public:
  explicit BfrEvaluator(const Case& c)
      : mesh_(c.mesh), peer_(c), addresses_(addresses_of(c.mesh)), points_(coordinates<Real>(c.mesh)) {
    refiner_ = topology_refiner(peer_.mesh);
  }

  void forget() override {
    surfaces_ = {};
    patch_points_ = {};
    first_point_ = {};
  }

  void start() override {
    using Threaded = Bfr::SurfaceFactoryCacheThreaded<std::shared_mutex, std::shared_lock<std::shared_mutex>,
                                                      std::unique_lock<std::shared_mutex>>;
    if (one_thread()) {
      start_with(Bfr::RefinerSurfaceFactory<>(*refiner_));
    } else {
      start_with(Bfr::RefinerSurfaceFactory<Threaded>(*refiner_));
    }
  }

  void set_places(std::span<const Place> places) override {
    places_.clear();
    for (const Place& s : places) {
      const auto [face, corner] = addresses_.place(s.face);
      BfrParameter p{s.u, s.v};
      if (corner >= 0) p = to_bfr(mesh_.face_sizes[index(face)], corner, s.u, s.v);
      places_.push_back({index(face), {Real(p.u), Real(p.v)}});
    }
    results_.resize(places.size());
  }

  void evaluate(int order) override {
    parallel_for_blocks(std::int64_t(places_.size()), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) {
        const PeerPlace& place = places_[i];
        const Bfr::Surface<Real>& surface = surfaces_[place.face];
        const Real* points = &patch_points_[first_point_[place.face]];
        Real* x = results_.at(i, order);
        if (order == 0) {
          surface.Evaluate(place.uv, points, 3, x);
        } else if (order == 1) {
          surface.Evaluate(place.uv, points, 3, x, x + 3, x + 6);
        } else {
          surface.Evaluate(place.uv, points, 3, x, x + 3, x + 6, x + 9, x + 12, x + 15);
        }
      }
    });
    results_.made(order);
  }

  Eigen::Vector3d position(size_t place) const override { return results_.position(place); }

 private:
  struct PeerPlace {
    Index face;
    Real uv[2];
  };

  void start_with(const Bfr::SurfaceFactory& factory) {
    const Index faces = mesh_.num_faces();
    surfaces_.resize(faces);
    const auto parallel = [&](const auto& body) {
      parallel_for_blocks(
          faces,
          [&](std::int64_t, std::int64_t begin, std::int64_t end) {
            for (std::int64_t f = begin; f < end; ++f) body(Index(f));
          },
          64);
    };
    parallel([&](Index f) { factory.InitVertexSurface(f, &surfaces_[f]); });
    first_point_.assign(faces + 1, 0);
    for (Index f = 0; f < faces; ++f) {
      if (!surfaces_[f].IsValid()) throw std::runtime_error("Bfr has no surface for face " + std::to_string(f));
      first_point_[f + 1] = first_point_[f] + 3 * size_t(surfaces_[f].GetNumPatchPoints());
    }
    patch_points_.resize(first_point_[faces]);
    parallel([&](Index f) { surfaces_[f].PreparePatchPoints(points_.data(), 3, &patch_points_[first_point_[f]], 3); });
  }

  const Mesh& mesh_;
  PeerCase peer_;
  Addresses addresses_;
  std::vector<Real> points_;
  std::unique_ptr<Far::TopologyRefiner> refiner_;
  std::vector<Bfr::Surface<Real>> surfaces_;
  std::vector<size_t> first_point_;  // times 3
  std::vector<Real> patch_points_;
  std::vector<PeerPlace> places_;
  Results<Real> results_;
};

template <class Real>
class FarEvaluator : public LimitEvaluator {
 public:
  explicit FarEvaluator(const Case& c) : peer_(c), points_(coordinates<Real>(c.mesh)) { forget(); }

  void forget() override {
    map_.reset();
    table_.reset();
    refined_ = {};
    refiner_ = topology_refiner(peer_.mesh);
  }

  void start() override {
    Far::PatchTableFactory::Options options(4);
    options.useInfSharpPatch = true;
    options.generateVaryingTables = false;
    options.SetPatchPrecision<Real>();
    options.SetEndCapType(Far::PatchTableFactory::Options::ENDCAP_GREGORY_BASIS);
    refiner_->RefineAdaptive(options.GetRefineAdaptiveOptions());
    table_.reset(Far::PatchTableFactory::Create(*refiner_, options));
    map_.emplace(*table_);

    refined_.resize(size_t(refiner_->GetNumVerticesTotal()) + table_->GetNumLocalPoints());
    const auto* control = reinterpret_cast<const Point*>(points_.data());
    std::copy(control, control + points_.size() / 3, refined_.begin());
    const Far::PrimvarRefinerReal<Real> primvars(*refiner_);
    Point* source = refined_.data();
    for (int k = 1; k <= refiner_->GetMaxLevel(); ++k) {
      Point* target = source + refiner_->GetLevel(k - 1).GetNumVertices();
      primvars.Interpolate(k, source, target);
      source = target;
    }
    if (table_->GetNumLocalPoints() > 0)
      table_->template GetLocalPointStencilTable<Real>()->UpdateValues(
          refined_.data(), refined_.data() + refiner_->GetNumVerticesTotal());
  }

  void set_places(std::span<const Place> places) override {
    places_.assign(places.begin(), places.end());
    results_.resize(places.size());
  }

  void evaluate(int order) override {
    order == 0 ? evaluate<0>() : order == 1 ? evaluate<1>() : evaluate<2>();
    results_.made(order);
  }

  Eigen::Vector3d position(size_t place) const override { return results_.position(place); }

 private:
  using Point = OpenSubdivPoint<Real>;

  template <int order>
  void evaluate() {
    parallel_for_blocks(std::int64_t(places_.size()), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      constexpr int rows = numbers_per_place(order) / 3;
      Real w[rows][20];
      for (std::int64_t i = begin; i < end; ++i) {
        const Place& s = places_[i];
        const Far::PatchMap::Handle* patch = map_->FindPatch(s.face, s.u, s.v);
        if constexpr (order == 0) {
          table_->EvaluateBasis(*patch, Real(s.u), Real(s.v), w[0]);
        } else if constexpr (order == 1) {
          table_->EvaluateBasis(*patch, Real(s.u), Real(s.v), w[0], w[1], w[2]);
        } else {
          table_->EvaluateBasis(*patch, Real(s.u), Real(s.v), w[0], w[1], w[2], w[3], w[4], w[5]);
        }
        const Far::ConstIndexArray vertices = table_->GetPatchVertices(*patch);
        Point sum[rows] = {};
        for (int k = 0; k < vertices.size(); ++k) {
          const Point& p = refined_[vertices[k]];
          for (int row = 0; row < rows; ++row) sum[row].AddWithWeight(p, w[row][k]);
        }
        std::copy(sum, sum + rows, reinterpret_cast<Point*>(results_.at(i, order)));
      }
    });
  }

  PeerCase peer_;
  std::vector<Real> points_;
  std::unique_ptr<Far::TopologyRefiner> refiner_;
  std::unique_ptr<const Far::PatchTable> table_;
  std::optional<Far::PatchMap> map_;
  std::vector<Point> refined_;
  std::vector<Place> places_;
  Results<Real> results_;
};

class EmbreeEvaluator : public LimitEvaluator {
 public:
  explicit EmbreeEvaluator(const Case& c)
      : mesh_(c.mesh), peer_(c), addresses_(addresses_of(c.mesh)), points_(coordinates<float>(c.mesh)) {
    points_.push_back(0);  // the last vertex is read as four floats
    device_ = rtcNewDevice(nullptr);
    if (!device_) throw std::runtime_error("Embree makes no device");
  }
  ~EmbreeEvaluator() override {
    forget();
    rtcReleaseDevice(device_);
  }
  EmbreeEvaluator(const EmbreeEvaluator&) = delete;
  EmbreeEvaluator& operator=(const EmbreeEvaluator&) = delete;

  void forget() override {
    if (geometry_) rtcReleaseGeometry(geometry_);
    if (scene_) rtcReleaseScene(scene_);
    geometry_ = nullptr;
    scene_ = nullptr;
  }

  void start() override {
    geometry_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SUBDIVISION);
    const auto share = [&](RTCBufferType type, RTCFormat format, const void* data, size_t stride, size_t count) {
      if (count > 0) rtcSetSharedGeometryBuffer(geometry_, type, 0, format, data, 0, stride, count);
    };
    const PeerMesh& m = peer_.mesh;
    share(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, points_.data(), 12, size_t(mesh_.num_vertices()));
    share(RTC_BUFFER_TYPE_FACE, RTC_FORMAT_UINT, m.face_sizes.data(), 4, m.face_sizes.size());
    share(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, m.face_vertices.data(), 4, m.face_vertices.size());
    share(RTC_BUFFER_TYPE_EDGE_CREASE_INDEX, RTC_FORMAT_UINT2, m.crease_vertices.data(), 8, m.crease_sharpness.size());
    share(RTC_BUFFER_TYPE_EDGE_CREASE_WEIGHT, RTC_FORMAT_FLOAT, m.crease_sharpness.data(), 4,
          m.crease_sharpness.size());
    share(RTC_BUFFER_TYPE_VERTEX_CREASE_INDEX, RTC_FORMAT_UINT, m.corner_vertices.data(), 4, m.corner_sharpness.size());
    share(RTC_BUFFER_TYPE_VERTEX_CREASE_WEIGHT, RTC_FORMAT_FLOAT, m.corner_sharpness.data(), 4,
          m.corner_sharpness.size());
    rtcSetGeometrySubdivisionMode(geometry_, 0, RTC_SUBDIVISION_MODE_PIN_CORNERS);
    rtcSetGeometryTessellationRate(geometry_, 1);
    rtcCommitGeometry(geometry_);
    scene_ = rtcNewScene(device_);  // half-edges are found with the scene
    rtcAttachGeometry(scene_, geometry_);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree refuses the mesh");
  }

  void set_places(std::span<const Place> places) override {
    faces_.clear();
    u_.clear();
    v_.clear();
    for (const Place& s : places) {
      const auto [face, corner] = addresses_.place(s.face);
      faces_.push_back(unsigned(index(face)));
      // Square i of a polygon lies at [2 (i mod 4) + 1/2, ...+ 1] x [2 (i div 4) + 1/2, ... + 1].
      u_.push_back(float(corner < 0 ? s.u : 2 * (corner % 4) + 0.5 + s.u));
      v_.push_back(float(corner < 0 ? s.v : 2 * (corner / 4) + 0.5 + s.v));
    }
    while (faces_.size() % 4 != 0) {
      faces_.push_back(faces_.back());
      u_.push_back(u_.back());
      v_.push_back(v_.back());
    }
    results_.resize(faces_.size() * numbers_per_place(2));
  }

  void evaluate(int order) override {
    order_ = order;
    const auto blocks = [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      const size_t n = size_t(end - begin);
      float* x = &results_[size_t(begin) * numbers_per_place(order)];
      RTCInterpolateNArguments arguments = {};
      arguments.geometry = geometry_;
      arguments.primIDs = &faces_[begin];
      arguments.u = &u_[begin];
      arguments.v = &v_[begin];
      arguments.N = unsigned(n);
      arguments.bufferType = RTC_BUFFER_TYPE_VERTEX;
      arguments.P = x;
      if (order >= 1) arguments.dPdu = x + 3 * n, arguments.dPdv = x + 6 * n;
      if (order == 2) arguments.ddPdudu = x + 9 * n, arguments.ddPdvdv = x + 12 * n, arguments.ddPdudv = x + 15 * n;
      arguments.valueCount = 3;
      rtcInterpolateN(&arguments);
    };
    parallel_for_blocks(std::int64_t(faces_.size()), blocks, places_per_call);
  }

  Eigen::Vector3d position(size_t place) const override {
    const size_t begin = place / places_per_call * places_per_call;
    const size_t n = std::min(faces_.size() - begin, size_t(places_per_call));
    const float* x = &results_[begin * numbers_per_place(order_)] + (place - begin);
    return {x[0], x[n], x[2 * n]};
  }

 private:
  static constexpr std::int64_t places_per_call = 1024;

  const Mesh& mesh_;
  PeerCase peer_;
  Addresses addresses_;
  std::vector<float> points_;
  RTCDevice device_ = nullptr;
  RTCGeometry geometry_ = nullptr;
  RTCScene scene_ = nullptr;
  std::vector<unsigned> faces_;
  std::vector<float> u_, v_, results_;
  int order_ = 0;
};

}  // namespace

std::unique_ptr<LimitEvaluator> bfr_float(const Case& mesh) { return std::make_unique<BfrEvaluator<float>>(mesh); }
std::unique_ptr<LimitEvaluator> bfr_double(const Case& mesh) { return std::make_unique<BfrEvaluator<double>>(mesh); }
std::unique_ptr<LimitEvaluator> far_float(const Case& mesh) { return std::make_unique<FarEvaluator<float>>(mesh); }
std::unique_ptr<LimitEvaluator> far_double(const Case& mesh) { return std::make_unique<FarEvaluator<double>>(mesh); }
std::unique_ptr<LimitEvaluator> embree(const Case& mesh) { return std::make_unique<EmbreeEvaluator>(mesh); }

}  // namespace sublimit::bench
