// SPDX-License-Identifier: Apache-2.0
#include "eval/interop/opensubdiv_stencils_reference.h"

#include <opensubdiv/far/stencilTable.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/osd/cpuEvaluator.h>
#include <opensubdiv/osd/cpuVertexBuffer.h>

#include <memory>
#include <stdexcept>

#include "peers/opensubdiv_refiner.h"

namespace sublimit::testing {
namespace {

using namespace OpenSubdiv;

/// Three numbers, as Far adds them up.
template <class Real>
struct Xyz {
  Real x[3];
  void Clear() { x[0] = x[1] = x[2] = 0; }
  void AddWithWeight(const Xyz& other, Real weight) {
    for (int c = 0; c < 3; ++c) x[c] += weight * other.x[c];
  }
};

template <class Real, class Table>
std::vector<Real> updated(const Table& table, const std::vector<Real>& points) {
  std::vector<Real> made(size_t(table.GetNumStencils()) * 3);
  auto* out = reinterpret_cast<Xyz<Real>*>(made.data());
  table.UpdateValues(reinterpret_cast<const Xyz<Real>*>(points.data()), out);
  return made;
}

}  // namespace

std::array<std::vector<float>, 3> osd_points(const OpenSubdivStencils<float>& stencils,
                                             const std::vector<float>& points) {
  const int count = stencils.GetNumStencils();
  const auto buffer = [](int size) {
    return std::unique_ptr<Osd::CpuVertexBuffer>(Osd::CpuVertexBuffer::Create(3, size));
  };
  const auto source = buffer(stencils.GetNumControlVertices());
  source->UpdateData(points.data(), 0, stencils.GetNumControlVertices());
  const std::unique_ptr<Osd::CpuVertexBuffer> made[3] = {buffer(count), buffer(count), buffer(count)};
  const Osd::BufferDescriptor xyz(0, 3, 3);
  const bool derivatives = !stencils.GetDuWeights().empty();
  const bool done = derivatives ? Osd::CpuEvaluator::EvalStencils(source.get(), xyz, made[0].get(), xyz, made[1].get(),
                                                                  xyz, made[2].get(), xyz, &stencils)
                                : Osd::CpuEvaluator::EvalStencils(source.get(), xyz, made[0].get(), xyz, &stencils);
  if (!done) throw std::runtime_error("EvalStencils");
  std::array<std::vector<float>, 3> out;
  for (size_t q = 0; q < (derivatives ? 3u : 1u); ++q)
    out[q].assign(made[q]->BindCpuBuffer(), made[q]->BindCpuBuffer() + 3 * count);
  return out;
}

template <>
std::vector<float> far_points(const OpenSubdivStencils<float>& stencils, const std::vector<float>& points) {
  return updated<float>(FarStencilTable<Far::StencilTable>(stencils), points);
}
template <>
std::vector<double> far_points(const OpenSubdivStencils<double>& stencils, const std::vector<double>& points) {
  return updated<double>(FarStencilTable<Far::StencilTableReal<double>>(stencils), points);
}

FarRows far_rows(const Mesh& mesh, int level, const std::vector<double>& points) {
  const auto refiner = reference_refiner(mesh, ReferenceOptions{});  // catmull-clark
  refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(level));
  using Factory = Far::StencilTableFactoryReal<double>;
  Factory::Options options;
  options.generateIntermediateLevels = false;
  options.generateOffsets = false;
  const std::unique_ptr<const Far::StencilTableReal<double>> table(Factory::Create(*refiner, options));
  return {rows_of_opensubdiv<double>(*table), updated<double>(*table, points)};
}

}  // namespace sublimit::testing
