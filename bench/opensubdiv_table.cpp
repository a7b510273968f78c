// SPDX-License-Identifier: Apache-2.0
#include "opensubdiv_table.h"

#include <opensubdiv/far/stencilTable.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/osd/bufferDescriptor.h>
#include <opensubdiv/osd/cpuEvaluator.h>
#include <tbb/parallel_for.h>

#include <Eigen/SparseCore>

#include "opensubdiv_point.h"
#include "opensubdiv_refiner.h"

namespace sublimit::bench {
namespace {

namespace Far = OpenSubdiv::Far;
using Point = OpenSubdivPoint<float>;
using Matrix = Eigen::SparseMatrix<float, Eigen::RowMajor>;
using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Calls body(begin, end) for parts of [0, count).
template <class Body>
void in_ranges(int count, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<int>(0, count, 4096),
                    [&](const tbb::blocked_range<int>& r) { body(r.begin(), r.end()); });
}

}  // namespace

struct PeerTable::Implementation {
  std::unique_ptr<const Far::StencilTable> table;
  std::unique_ptr<const Eigen::Map<const Matrix>> matrix;
  std::vector<int> outer;
};

PeerTable::PeerTable(const PeerMesh& mesh, int levels) : implementation_(std::make_unique<Implementation>()) {
  const auto refiner = topology_refiner(mesh);
  refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(levels));
  Far::StencilTableFactory::Options options;
  options.generateOffsets = true;
  options.generateIntermediateLevels = false;
  options.maxLevel = static_cast<unsigned>(levels) & 0xf;
  implementation_->table.reset(Far::StencilTableFactory::Create(*refiner, options));
  const Far::StencilTable& t = *implementation_->table;
  implementation_->outer = t.GetOffsets();
  implementation_->outer.push_back(static_cast<int>(t.GetControlIndices().size()));
  implementation_->matrix = std::make_unique<const Eigen::Map<const Matrix>>(
      t.GetNumStencils(), t.GetNumControlVertices(), implementation_->outer.back(), implementation_->outer.data(),
      t.GetControlIndices().data(), t.GetWeights().data());
}
PeerTable::~PeerTable() = default;

std::size_t PeerTable::num_points() const { return std::size_t(implementation_->table->GetNumStencils()); }
std::size_t PeerTable::num_bytes() const {
  const Far::StencilTable& t = *implementation_->table;
  return 4 * (t.GetSizes().size() + t.GetOffsets().size() + t.GetControlIndices().size() + t.GetWeights().size());
}

void PeerTable::apply_osd(std::span<const float> points, std::span<float> result) const {
  const Far::StencilTable& t = *implementation_->table;
  const OpenSubdiv::Osd::BufferDescriptor xyz(0, 3, 3);
  in_ranges(t.GetNumStencils(), [&](int begin, int end) {
    // It writes where its pointer stands, whatever stencil comes first.
    OpenSubdiv::Osd::CpuEvaluator::EvalStencils(points.data(), xyz, result.data() + 3 * std::size_t(begin), xyz,
                                                t.GetSizes().data(), t.GetOffsets().data(),
                                                t.GetControlIndices().data(), t.GetWeights().data(), begin, end);
  });
}

void PeerTable::apply_far(std::span<const float> points, std::span<float> result) const {
  const Far::StencilTable& t = *implementation_->table;
  const auto* from = reinterpret_cast<const Point*>(points.data());
  auto* to = reinterpret_cast<Point*>(result.data());
  in_ranges(t.GetNumStencils(), [&](int begin, int end) { t.UpdateValues(from, to, begin, end); });
}

void PeerTable::apply_eigen(std::span<const float> points, std::span<float> result) const {
  const auto& M = *implementation_->matrix;
  const Eigen::Map<const Rows> from(points.data(), M.cols(), 3);
  Eigen::Map<Rows> to(result.data(), M.rows(), 3);
  in_ranges(static_cast<int>(M.rows()), [&](int begin, int end) {
    to.middleRows(begin, end - begin).noalias() = M.middleRows(begin, end - begin) * from;
  });
}

struct PeerLimitTable::Implementation {
  std::unique_ptr<const Far::LimitStencilTable> table;
};

PeerLimitTable::PeerLimitTable(const PeerMesh& mesh, int N) : implementation_(std::make_unique<Implementation>()) {
  const auto refiner = topology_refiner(mesh);
  Far::TopologyRefiner::AdaptiveOptions adaptive(4);
  adaptive.useInfSharpPatch = true;
  refiner->RefineAdaptive(adaptive);
  std::vector<float> u, v;
  for (int j = 0; j < N; ++j)
    for (int i = 0; i < N; ++i) {
      u.push_back(float(i) / float(N - 1));
      v.push_back(float(j) / float(N - 1));
    }
  const Far::TopologyLevel& level = refiner->GetLevel(0);
  int faces = 0;
  for (int f = 0; f < level.GetNumFaces(); ++f) {
    const int corners = level.GetFaceVertices(f).size();
    faces += corners == 4 ? 1 : corners;
  }
  Far::LimitStencilTableFactory::LocationArrayVec places(static_cast<std::size_t>(faces));
  for (int f = 0; f < faces; ++f) {
    places[std::size_t(f)].ptexIdx = f;
    places[std::size_t(f)].numLocations = N * N;
    places[std::size_t(f)].s = u.data();
    places[std::size_t(f)].t = v.data();
  }
  Far::LimitStencilTableFactory::Options options;
  options.generate1stDerivatives = true;
  options.generate2ndDerivatives = false;
  implementation_->table.reset(Far::LimitStencilTableFactory::Create(*refiner, places, nullptr, nullptr, options));
}
PeerLimitTable::~PeerLimitTable() = default;

std::size_t PeerLimitTable::num_points() const { return std::size_t(implementation_->table->GetNumStencils()); }
std::size_t PeerLimitTable::num_bytes() const {
  const Far::LimitStencilTable& t = *implementation_->table;
  return 4 * (t.GetSizes().size() + t.GetOffsets().size() + t.GetControlIndices().size() + t.GetWeights().size() +
              t.GetDuWeights().size() + t.GetDvWeights().size());
}

void PeerLimitTable::apply_osd(std::span<const float> points, std::span<float> result) const {
  const Far::LimitStencilTable& t = *implementation_->table;
  const OpenSubdiv::Osd::BufferDescriptor xyz(0, 3, 3);
  const std::size_t n = 3 * num_points();
  in_ranges(t.GetNumStencils(), [&](int begin, int end) {
    float* const to = result.data() + 3 * std::size_t(begin);
    OpenSubdiv::Osd::CpuEvaluator::EvalStencils(points.data(), xyz, to, xyz, to + n, xyz, to + 2 * n, xyz,
                                                t.GetSizes().data(), t.GetOffsets().data(),
                                                t.GetControlIndices().data(), t.GetWeights().data(),
                                                t.GetDuWeights().data(), t.GetDvWeights().data(), begin, end);
  });
}

void PeerLimitTable::apply_far(std::span<const float> points, std::span<float> result) const {
  const Far::LimitStencilTable& t = *implementation_->table;
  const auto* from = reinterpret_cast<const Point*>(points.data());
  auto* to = reinterpret_cast<Point*>(result.data());
  const std::size_t n = num_points();
  in_ranges(t.GetNumStencils(), [&](int begin, int end) {
    t.UpdateValues(from, to, begin, end);
    t.UpdateDerivs(from, to + n, to + 2 * n, begin, end);
  });
}

}  // namespace sublimit::bench
