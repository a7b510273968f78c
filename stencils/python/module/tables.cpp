// SPDX-License-Identifier: Apache-2.0
// Tables: baked once for a topology, applied to points of every frame where these lie.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <string>
#include <variant>

#include "arrays.h"
#include "calls.h"
#include "gpus.h"
#include "module.h"
#include "sources.h"
#include "sublimit/bake/bake.h"
#include "sublimit/base/error.h"
#include "sublimit/jobs/mesh_job.h"
#include "sublimit/pattern_evaluator.h"
#include "sublimit/table_file.h"

namespace sublimit::python {
namespace {

template <class Real>
class Table {
 public:
  explicit Table(BakedTable<Real> table) : table_(std::move(table)), evaluator_(table_.table), gpus_(table_.table) {}
  Table(const Table&) = delete;

  const BakedTable<Real>& baked() const { return table_; }
  const PatternTable<Real>& table() const { return table_.table; }

  /// @param gpu  its number; without one the CPU
  void apply(const Evaluation<Real>& evaluation, std::optional<int> gpu) const {
    gpu ? gpus_.apply(evaluation, *gpu) : evaluator_.apply(evaluation);
  }
  void apply_transpose(std::span<const Real> values, int channels, std::span<Real> result,
                       std::optional<int> gpu) const {
    gpu ? gpus_.apply_transpose(values, channels, result, *gpu) : evaluator_.apply_transpose(values, channels, result);
  }

 private:
  BakedTable<Real> table_;
  PatternEvaluator<Real> evaluator_;
  TableOnGpus<Real> gpus_;
};

/// Points of some frames, (frames, points, channels) numbers, to (frames, quantities, points, channels).
/// @param divided  by the weight, the last channel, if the table is rational
template <class Real>
void apply(const Table<Real>& table, const Array<Real>& points, Array<Real>& result, int threads,
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
  asked.rational = divided && table.baked().info.rational;
  const std::int64_t made = table.table().num_points() * asked.result_channels(), q = table.table().quantities();
  asked.result_layout.frame = q * made;
  for (std::int64_t k = 0; k < q && frames > 0; ++k)
    asked.quantities[size_t(k)] = out.subspan(size_t(k * made), size_t((frames - 1) * q * made + made));
  if (asked.rational) asked.least_weight = noise_of_weights(asked, table.table().num_control_points());
  table.apply(asked, gpu);
}

template <class Real>
void apply_transpose(const Table<Real>& table, const Array<Real>& values, Array<Real>& result, int threads,
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
py::tuple matrix(const Table<Real>& table) {
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
py::tuple faces(const Table<Real>& table) {
  const FaceList found = without_gil([&] { return faces_of(table.baked()); });
  return py::make_tuple(array(std::vector<Index>(found.sizes.begin(), found.sizes.end())),
                        array(std::vector<Index>(found.corners.begin(), found.corners.end())));
}

/// (face, (u, v)) of each point of a list of places or a grid.
template <class Real>
py::object addresses(const Table<Real>& table) {
  const TableInfo& info = table.baked().info;
  const SampleAddresses& known = table.baked().addresses;
  std::vector<Index> faces(known.faces.begin(), known.faces.end());
  std::vector<double> parameters(known.parameters.begin(), known.parameters.end());
  if (info.rows == TableRows::grid) {
    const std::int64_t n = info.grid, of_a_face = info.triangles ? n * (n + 1) / 2 : n * n;
    for (const Sample& place :
         grid_places({Index(table.table().num_points() / of_a_face), info.triangles}, info.grid)) {
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
  py::class_<Table<Real>, std::shared_ptr<Table<Real>>>(m, name)
      .def_property_readonly("num_points", [](const Table<Real>& t) { return t.table().num_points(); })
      .def_property_readonly("num_control_points", [](const Table<Real>& t) { return t.table().num_control_points(); })
      .def_property_readonly("quantities", [](const Table<Real>& t) { return t.table().quantities(); })
      .def_property_readonly("num_bytes", [](const Table<Real>& t) { return t.table().num_bytes(); })
      .def_property_readonly("info", [](const Table<Real>& t) { return info(t.baked().info); })
      .def_property_readonly("statuses", [](const Table<Real>& t) { return array(statuses_of(t.baked())); })
      .def_property_readonly("status_words", [](const Table<Real>& t) { return t.baked().info.statuses; })
      .def("faces", &faces<Real>)
      .def("addresses", &addresses<Real>)
      .def("apply", &apply<Real>, py::arg("points"), py::arg("result"), py::arg("threads"), py::arg("gpu"),
           py::arg("divided"))
      .def("apply_transpose", &apply_transpose<Real>, py::arg("values"), py::arg("result"), py::arg("threads"),
           py::arg("gpu"))
      .def("matrix", &matrix<Real>)
      .def(
          "save", [](const Table<Real>& t, const std::filesystem::path& path) { save_table(path, t.baked()); },
          py::arg("path"), py::call_guard<LongCall>());
}

using AnyOfThem = std::variant<std::shared_ptr<Table<float>>, std::shared_ptr<Table<double>>>;

struct Asked {
  std::string rows = "level";
  int level = 0, grid = 0, derivatives = 0;
  bool in_float = true;
};

using Places = std::optional<std::tuple<Array<Index>, Array<double>, Array<double>>>;

BakeRequest request_of(const Asked& asked, const Places& at) {
  BakeRequest wanted;
  wanted.rows = table_rows(asked.rows).value();
  wanted.level = asked.level;
  wanted.grid = asked.grid;
  wanted.derivatives = asked.derivatives;
  if (at) {
    const auto& [face, u, v] = *at;
    wanted.samples.resize(size_t(face.size()));
    for (size_t i = 0; i < wanted.samples.size(); ++i) wanted.samples[i] = {face.data()[i], u.data()[i], v.data()[i]};
  }
  return wanted;
}

AnyOfThem table_of(Baked&& baked, const Asked& asked) {
  if (asked.in_float) return std::make_shared<Table<float>>(in_float(baked.table));
  return std::make_shared<Table<double>>(std::move(baked.table));
}

/// @param triangles  between places, three corners each
AnyOfThem bake_mesh(const ControlMesh& mesh, const MeshRequest& request, const Asked& asked, const Places& at,
                    const std::optional<Array<Index>>& triangles, int threads) {
  BakeRequest wanted = request_of(asked, at);
  if (triangles) {
    wanted.face_vertices = vector(*triangles);
    wanted.face_sizes.assign(wanted.face_vertices.size() / 3, 3);
  }
  const LongCall scope;
  const Threads held(threads);
  const MeshJob job = mesh_job(request, mesh, "mesh");
  Patterns patterns(*job.scheme);
  return table_of(bake(patterns, job.mesh, wanted, job.rules), asked);
}

AnyOfThem bake_patches(const Patches& patches, const Asked& asked, const Places& at, int threads) {
  const BakeRequest wanted = request_of(asked, at);
  const LongCall scope;
  const Threads held(threads);
  return table_of(bake(patches.surface(), wanted), asked);
}

AnyOfThem load(const std::filesystem::path& path, bool checksums) {
  const LongCall scope;
  return std::visit(
      [](auto&& table) -> AnyOfThem {
        using Real = std::decay_t<decltype(table.table.arrays().weights[0])>;
        return std::make_shared<Table<Real>>(std::move(table));
      },
      load_table(path, {.checksums = checksums}));
}

}  // namespace

void add_tables(py::module_& m) {
  add_table<float>(m, "FloatTable");
  add_table<double>(m, "DoubleTable");
  py::class_<Asked>(m, "TableRequest")
      .def(py::init<>())
      .def_readwrite("rows", &Asked::rows)
      .def_readwrite("level", &Asked::level)
      .def_readwrite("grid", &Asked::grid)
      .def_readwrite("derivatives", &Asked::derivatives)
      .def_readwrite("in_float", &Asked::in_float);
  m.def("bake", &bake_mesh, py::arg("mesh"), py::arg("request"), py::arg("table"), py::arg("at"), py::arg("triangles"),
        py::arg("threads"));
  m.def("bake_patches", &bake_patches, py::arg("patches"), py::arg("table"), py::arg("at"), py::arg("threads"));
  m.def("load", &load, py::arg("path"), py::arg("checksums"));
}

}  // namespace sublimit::python
