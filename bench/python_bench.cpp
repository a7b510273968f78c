// SPDX-License-Identifier: Apache-2.0
// What calls from Python cost: the module's functions, called by Python in this process, beside the same calls in C++
// and SciPy's product of the same matrix.
//   call apply      a table of 500 faces, level 2: microseconds a call, arrays given
//   call evaluate   one place
//   apply           a table of 100k faces, level 3
//   evaluate        a million places of a torus, points; and with first derivatives
//   import          of the package, beyond Python's own start, and of NumPy
// C++ is the peer: peer : ours is what is left of its speed.
#include <pybind11/embed.h>
#include <pybind11/numpy.h>

#include <cstdlib>
#include <random>
#include <string>

#include "bench_report.h"
#include "measuring.h"
#include "meshes/meshes.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit::bench {
namespace {

namespace py = pybind11;

/// Names of Python that jobs use.
class Interpreter {
 public:
  Interpreter() { py::exec("import sys; sys.path.insert(0, '" SUBLIMIT_PYTHON_PACKAGE "')", names_); }

  void set(const char* name, const py::object& value) { names_[name] = value; }
  void run(const std::string& code) { py::exec(code, names_); }
  /// The code `count` times in a loop of Python's.
  std::function<void()> loop(const std::string& code, int count) {
    run("def work():\n  for _ in range(" + std::to_string(count) + "): " + code);
    const py::object work = names_["work"];
    return [work] { work(); };
  }

 private:
  py::dict names_ = py::globals();
};

/// The module's mesh of ours.
void give(Interpreter& python, const Mesh& mesh) {
  python.set("points", py::array_t<double>({mesh.positions.rows(), mesh.positions.cols()}, mesh.positions.data()));
  python.set("sizes", py::array_t<int>(py::ssize_t(mesh.face_sizes.size()), mesh.face_sizes.data()));
  python.set("corners", py::array_t<int>(py::ssize_t(mesh.face_vertices.size()), mesh.face_vertices.data()));
  python.run("import numpy, sublimit\nmesh = sublimit.Mesh(points, (sizes, corners))");
}

std::function<double()> turn(int threads, int count, const std::function<void()>& work) {
  return [=] { return timed(threads, work) / count; };
}

void measure_tables(Report& report, Interpreter& python, const std::string& work, const Mesh& mesh,
                    const std::string& name, int level, int count, const std::string& unit, double scale) {
  if (!report.wants(work, name)) return;
  Patterns patterns(find_scheme("catmull-clark").value());
  const PatternTable<float> table =
      in_float(bake(patterns, mesh, {.rows = TableRows::level, .level = level}).table).table;
  const PatternEvaluator<float> evaluator(table);
  const std::vector<float> points{mesh.positions.data(), mesh.positions.data() + mesh.positions.size()};
  std::vector<float> made(size_t(table.num_points()) * 3);
  give(python, mesh);
  python.run("table = sublimit.bake(mesh, 'catmull-clark', levels=" + std::to_string(level) +
             ")\nx = points.astype('float32')\nout = table.apply(x)\nmatrix = table.matrix()\n"
             "assert abs(matrix @ x - out).max() < 1e-5");
  for (const int threads : report.threads()) {
    const Threads scope(threads);
    const auto ours = python.loop("table.apply(x, out)", count);
    const auto theirs = python.loop("matrix @ x", count);
    std::vector<Contender> contenders{{"ours", Role::ours, turn(threads, count, ours)},
                                      {"C++", Role::peer,
                                       turn(threads, count,
                                            [&] {
                                              for (int i = 0; i < count; ++i) evaluator.apply(points, 3, made);
                                            })},
                                      {"SciPy", Role::shown, turn(threads, count, theirs)}};
    report.measure({work, name, "level " + std::to_string(level), threads, unit, scale}, contenders);
  }
}

void measure_places(Report& report, Interpreter& python, const std::string& work, const Mesh& mesh,
                    const std::string& name, int places, int count, int order, const std::string& unit, double scale) {
  const std::string detail = order == 0 ? "points" : "with D1";
  if (!report.wants(work, name, detail)) return;
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh, {});
  const LimitSurface bound(surface, mesh.positions);
  std::mt19937 random(1);
  std::uniform_int_distribution<Index> face(0, surface.faces().size - 1);
  std::uniform_real_distribution<double> parameter(0, 1);
  std::vector<Place> at(static_cast<size_t>(places));
  for (Place& sample : at) sample = {face(random), parameter(random), parameter(random)};
  py::array_t<int> faces(places);
  py::array_t<double> u(places), v(places);
  for (int i = 0; i < places; ++i) {
    faces.mutable_at(i) = at[size_t(i)].face;
    u.mutable_at(i) = at[size_t(i)].u;
    v.mutable_at(i) = at[size_t(i)].v;
  }
  give(python, mesh);
  python.set("face", faces);
  python.set("u", u);
  python.set("v", v);
  python.run("surface = sublimit.LimitMap(mesh, 'catmull-clark')");
  for (const int threads : report.threads()) {
    const Threads scope(threads);
    const auto ours = python.loop("surface.evaluate(face, u, v, " + std::to_string(order) + ")", count);
    report.measure({work, name, detail, threads, unit, scale},
                   {{"ours", Role::ours, turn(threads, count, ours)}, {"C++", Role::peer, turn(threads, count, [&] {
                                                                         for (int i = 0; i < count; ++i)
                                                                           benchmark::DoNotOptimize(
                                                                               bound.evaluate(at, order, true));
                                                                       })}});
  }
}

void measure_import(Report& report) {
  if (!report.wants("import", "package")) return;
  const auto start = [](const std::string& code) {
    const std::string command = "PYTHONPATH=" SUBLIMIT_PYTHON_PACKAGE " " SUBLIMIT_PYTHON " -c '" + code + "'";
    return [command] {
      return seconds([&] {
        if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
      });
    };
  };
  report.measure({"import", "package", "", 1, "ms", 1e3},
                 {{"ours", Role::ours, start("import sublimit")},
                  {"Python alone", Role::shown, start("pass")},
                  {"NumPy", Role::shown, start("import numpy")},
                  {"all of ours", Role::shown, start("from sublimit import *")}});
}

int run(int argc, char** argv) {
  Report report("python_bench", argc, argv);
  report.take_turns(5);
  PyConfig config;
  PyConfig_InitPythonConfig(&config);
  PyConfig_SetBytesString(&config, &config.program_name, SUBLIMIT_PYTHON);  // not another one that is first in the path
  const py::scoped_interpreter alive(&config);
  Interpreter python;
  using testing::torus;
  const Mesh small = torus(25, 20), large = report.quick() ? torus(40, 25) : torus(400, 250);
  measure_tables(report, python, "call apply", small, "500 faces", 2, 1000, "us", 1e6);
  measure_places(report, python, "call evaluate", small, "one place", 1, 1000, 1, "us", 1e6);
  measure_tables(report, python, "apply", large, "torus", 3, 3, "ms", 1e3);
  const int places = report.quick() ? 10'000 : 1'000'000;
  for (const int order : {0, 1})
    measure_places(report, python, "evaluate", large, "torus", places, 1, order, "ms", 1e3);
  measure_import(report);
  return report.finish();
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) { return sublimit::bench::run(argc, argv); }
