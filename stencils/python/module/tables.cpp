// SPDX-License-Identifier: Apache-2.0
// Tables: baked once for a topology, applied to points of every frame where these lie.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "arrays.h"
#include "calls.h"
#include "gpus.h"
#include "module.h"
#include "sources.h"
#include "sublimit/source/address.h"
#include "sublimit/stencils/jobs/detail/mesh_job.h"
#include "sublimit/sublimit.h"

namespace sublimit::python {
namespace {

/// A table in its precision, with what applies it on GPUs.
template <class Real>
class TableOf {
 public:
  /// @param all  whose weights are of this precision
  explicit TableOf(Table all) : all_(std::move(all)), gpus_(table()) {}
  TableOf(const TableOf&) = delete;

  const Table& all() const { return all_; }
  const TableInfo& info() const { return all_.info(); }
  const BakedTable<Real>& baked() const { return std::get<BakedTable<Real>>(all_.baked()); }
  const PatternTable<Real>& table() const { return baked().table; }

  /// @param gpu  its number; without one the CPU
  void apply(const Evaluation<Real>& evaluation, std::optional<int> gpu) const {
    gpu ? gpus_.apply(evaluation, *gpu) : all_.evaluator<Real>().apply(evaluation);
  }
  void apply_transpose(std::span<const Real> values, int channels, std::span<Real> result,
                       std::optional<int> gpu) const {
    gpu ? gpus_.apply_transpose(values, channels, result, *gpu)
        : all_.evaluator<Real>().apply_transpose(values, channels, result);
  }

 private:
  Table all_;
  TableOnGpus<Real> gpus_;
};

/// Points of some frames, (frames, points, channels) numbers, to (frames, quantities, points, channels).
/// @param divided  by the weight, the last channel, if the table is rational
template <class Real>
void apply(const TableOf<Real>& table, const Array<Real>& points, Array<Real>& result, int threads,
           std::optional<int> gpu, bool divided) {
  const std::int64_t channels = points.shape(2), frames = points.shape(0);
  const std::span<const Real> in = span(points);
  const std::span<Real> out{result.mutable_data(), size_t(result.size())};
  const LongCall scope;
  const Threads held(threads);
  Evaluation<Real> asked;
  asked.channels = static_cast<int>(channels);
  asked.frames = static_cast<int>(frames);
  asked.points = in;
  asked.rational = divided && table.info().rational;
  const std::int64_t made = table.table().num_points() * asked.result_channels(), q = table.table().quantities();
  asked.result_layout.frame = q * made;
  for (std::int64_t k = 0; k < q && frames > 0; ++k)
    asked.quantities[size_t(k)] = out.subspan(size_t(k * made), size_t((frames - 1) * q * made + made));
  if (asked.rational) asked.least_weight = noise_of_weights(asked, table.table().num_control_points());
  table.apply(asked, gpu);
}

template <class Real>
void apply_transpose(const TableOf<Real>& table, const Array<Real>& values, Array<Real>& result, int threads,
                     std::optional<int> gpu) {
  const auto channels = static_cast<int>(values.shape(2));
  const std::span<const Real> in = span(values);
  const std::span<Real> out{result.mutable_data(), size_t(result.size())};
  const LongCall scope;
  const Threads held(threads);
  table.apply_transpose(in, channels, out, gpu);
}

/// (weights, columns, starts of rows, (rows, columns)); offsets of 64 bits.
template <class Real>
py::tuple matrix(const TableOf<Real>& table) {
  auto rows = std::make_unique<StencilTable<Real>>(without_gil([&] { return table.table().expanded(); }));
  const StencilTable<Real>& all = *rows;
  const py::capsule owner(rows.release(), [](void* memory) { delete static_cast<StencilTable<Real>*>(memory); });
  const py::ssize_t entries = py::ssize_t(all.weights().size());
  return py::make_tuple(py::array_t<Real>({entries}, all.weights().data(), owner),
                        py::array_t<std::int32_t>({entries}, all.columns().data(), owner),
                        py::array_t<std::int64_t>({py::ssize_t(all.num_rows()) + 1}, all.offsets().data(), owner),
                        py::make_tuple(all.num_rows(), all.num_control_points()));
}

template <class Real>
py::tuple faces(const TableOf<Real>& table) {
  const FaceList found = without_gil([&] { return table.all().faces(); });
  return py::make_tuple(array(std::vector<Index>(found.sizes.begin(), found.sizes.end())),
                        array(std::vector<Index>(found.corners.begin(), found.corners.end())));
}

/// The point of each vertex of the refined mesh; None if the table was baked without.
template <class Real>
py::object refined_points(const TableOf<Real>& table) {
  const std::span<const std::int64_t> points = table.all().refined_points();
  if (points.empty()) return py::none();
  return array(std::vector<std::int64_t>(points.begin(), points.end()));
}

/// (face, (u, v)) of each point of a list of places or a grid.
template <class Real>
py::object addresses(const TableOf<Real>& table) {
  const TableInfo& info = table.info();
  const SampleAddresses& known = table.baked().addresses;
  std::vector<Index> faces(known.faces.begin(), known.faces.end());
  std::vector<double> parameters(known.parameters.begin(), known.parameters.end());
  if (info.rows == TableRows::grid) {
    const std::int64_t n = info.grid, of_a_face = info.triangles ? n * (n + 1) / 2 : n * n;
    for (const Place& place : grid_places({Index(table.table().num_points() / of_a_face), info.triangles}, info.grid)) {
      faces.push_back(place.face);
      parameters.insert(parameters.end(), {place.u, place.v});
    }
  }
  if (faces.empty()) return py::none();
  const auto count = py::ssize_t(faces.size());
  return py::make_tuple(array(std::move(faces)), array(std::move(parameters)).reshape({count, py::ssize_t(2)}));
}

py::dict info(const TableInfo& info) {
  py::dict all;
  all["scheme"] = info.scheme;
  all["options"] = info.options;
  all["rows"] = name(info.rows);
  all["level"] = info.level;
  all["grid"] = info.grid;
  all["triangles"] = info.triangles;
  all["topology_hash"] = info.topology_hash;
  all["tool"] = info.tool;
  all["rational"] = info.rational;
  return all;
}

template <class Real>
void add_table(py::module_& m, const char* name) {
  using Of = TableOf<Real>;
  py::class_<Of, std::shared_ptr<Of>>(m, name)
      .def_property_readonly("num_points", [](const Of& t) { return t.all().num_points(); })
      .def_property_readonly("num_control_points", [](const Of& t) { return t.all().num_control_points(); })
      .def_property_readonly("quantities", [](const Of& t) { return t.all().quantities(); })
      .def_property_readonly("num_bytes", [](const Of& t) { return t.table().num_bytes(); })
      .def_property_readonly("info", [](const Of& t) { return info(t.info()); })
      .def_property_readonly("statuses", [](const Of& t) { return array(statuses_of(t.baked())); })
      .def_property_readonly("status_words", [](const Of& t) { return t.info().statuses; })
      .def("faces", &faces<Real>)
      .def("refined_points", &refined_points<Real>)
      .def("addresses", &addresses<Real>)
      .def("apply", &apply<Real>, py::arg("points"), py::arg("result"), py::arg("threads"), py::arg("gpu"),
           py::arg("divided"))
      .def("apply_transpose", &apply_transpose<Real>, py::arg("values"), py::arg("result"), py::arg("threads"),
           py::arg("gpu"))
      .def("matrix", &matrix<Real>)
      .def(
          "save", [](const Of& t, const std::filesystem::path& path) { t.all().save(path); }, py::arg("path"),
          py::call_guard<LongCall>());
}

/// In the precision of its weights.
using AnyOfThem = std::variant<std::shared_ptr<TableOf<float>>, std::shared_ptr<TableOf<double>>>;
AnyOfThem any_of_them(Table table) {
  if (table.is_double()) return std::make_shared<TableOf<double>>(std::move(table));
  return std::make_shared<TableOf<float>>(std::move(table));
}

using Places = std::tuple<Array<Index>, Array<double>, Array<double>>;

void set_places(BakeOptions& options, const Places& at) {
  const auto& [face, u, v] = at;
  options.at.resize(size_t(face.size()));
  for (size_t i = 0; i < options.at.size(); ++i) options.at[i] = {face.data()[i], u.data()[i], v.data()[i]};
}

/// @param corners  of triangles between the places, three each
void set_triangles(BakeOptions& options, const Array<Index>& corners) {
  options.face_vertices = vector(corners);
  options.face_sizes.assign(options.face_vertices.size() / 3, 3);
}

AnyOfThem bake_mesh(const Mesh& mesh, const MeshRequest& request, const BakeOptions& options, int threads) {
  const LongCall scope;
  const Threads held(threads);
  const MeshJob job = mesh_job(request, mesh, "mesh");
  return any_of_them(bake(job.mesh, *job.scheme, options));
}

AnyOfThem bake_patches(const PatchSurfaces& patches, const BakeOptions& options, int threads) {
  const LongCall scope;
  const Threads held(threads);
  return any_of_them(bake(patches.patches(), options));
}

AnyOfThem load_table_of(const std::filesystem::path& path, bool checksums) {
  const LongCall scope;
  return any_of_them(load(path, {.checksums = checksums}));
}

}  // namespace

void add_tables(py::module_& m) {
  add_table<float>(m, "FloatTable");
  add_table<double>(m, "DoubleTable");
  py::class_<BakeOptions>(m, "BakeOptions")
      .def(py::init<>())
      .def_readwrite("levels", &BakeOptions::levels)
      .def_readwrite("limit", &BakeOptions::limit)
      .def_readwrite("grid", &BakeOptions::grid)
      .def_readwrite("derivatives", &BakeOptions::derivatives)
      .def_readwrite("in_double", &BakeOptions::in_double)
      .def_readwrite("order", &BakeOptions::order)
      .def("set_places", &set_places, py::arg("at"))
      .def("set_triangles", &set_triangles, py::arg("corners"));
  m.def("bake", &bake_mesh, py::arg("mesh"), py::arg("request"), py::arg("options"), py::arg("threads"));
  m.def("bake_patches", &bake_patches, py::arg("patches"), py::arg("options"), py::arg("threads"));
  m.def("load", &load_table_of, py::arg("path"), py::arg("checksums"));
}

}  // namespace sublimit::python
