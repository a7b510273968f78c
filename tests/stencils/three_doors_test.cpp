// SPDX-License-Identifier: Apache-2.0
// Bad input at the three doors: functions of sublimit.h, the program and the Python package refuse it with the same
// code and the same words. A row of the tables below is one mistake as each door is given it; where a door cannot be
// given it, or says something else, the row says why.
#include "sublimit/sublimit.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit::testing {
namespace {

using Words = std::vector<std::string>;
using enum ErrorCode;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

enum class Door { cpp, program, python };

/// What one door does instead of saying the words of a row with its code, and why.
struct Otherwise {
  Door door;
  std::string why;
  bool is_asked = true;                ///< it can make the mistake
  std::string words = {};              ///< a part of its own message; empty: the same words
  std::optional<ErrorCode> code = {};  ///< its own code
  std::string exception = {};          ///< Python's own, which has no code: "ValueError"
};

Otherwise not_asked(Door door, const std::string& why) { return {.door = door, .why = why, .is_asked = false}; }
Otherwise says(Door door, const std::string& why, const std::string& words, std::optional<ErrorCode> code = {}) {
  return {.door = door, .why = why, .words = words, .code = code};
}
Otherwise raises(const std::string& exception, const std::string& why, const std::string& words) {
  return {.door = Door::python, .why = why, .words = words, .exception = exception};
}

// Reasons of several rows.

/// A file that no mesh can be made of: its reader names the line, and counts as the file does.
Otherwise by_reader(const std::string& words, ErrorCode code = invalid_mesh) {
  return says(Door::program, "a reader names the line and counts as the file does", words, code);
}
/// Numbers of a file are wrong by themselves, whatever they are for.
Otherwise in_a_file(const std::string& words = {}) {
  return says(Door::program, "what a file has is the fault of the file, whose line is named", words, format_error);
}
Otherwise on_the_line(const std::string& words) {
  return says(Door::program, "it looks at its command line before it reads a file, and names the option", words);
}
/// The names of files that meshes are written to, as the program lists them.
std::string words_of_writers() {
  std::string words;
  for (const std::string& extension : all_formats().writers({contents::meshes}))
    words += (words.empty() ? "" : " or ") + extension;
  return words;
}

Otherwise before_it_begins(const std::string& words) {
  return says(Door::program, "it looks at its files before it begins", words);
}
Otherwise of_arrays(const std::string& words) {
  return says(Door::python, "arrays are looked at as such, by name and shape, before anything is made of them", words);
}

struct Row {
  std::string what;
  ErrorCode code;
  std::function<void()> cpp;  ///< in the folder of the test
  Words program;              ///< its arguments
  std::string python;         ///< statements, with the names of `python_rows`
  std::vector<Otherwise> otherwise = {};

  const Otherwise* at(Door door) const {
    for (const Otherwise& other : otherwise)
      if (other.door == door) return &other;
    return nullptr;
  }
};

/// What a door said of a mistake.
struct Answer {
  std::string code;  ///< "invalid_mesh"; of the program an exit status, of Python's own errors their class
  std::string message;
};

/// In the order of `ErrorCode`: its name, and the class of the Python package.
constexpr std::array<std::pair<const char*, const char*>, 8> codes{{{"invalid_mesh", "InvalidMesh"},
                                                                    {"unsupported_topology", "UnsupportedTopology"},
                                                                    {"invalid_option", "InvalidOption"},
                                                                    {"invalid_parameter", "InvalidParameter"},
                                                                    {"format_error", "FormatError"},
                                                                    {"analysis_error", "AnalysisError"},
                                                                    {"io_error", "IoError"},
                                                                    {"resource_error", "ResourceError"}}};

const char* const python_rows = R"(
import json, warnings
import numpy as np
import sublimit
warnings.simplefilter("ignore")
answers = []
for statements in json.load(open("rows.json")):
    points = [[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
    faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    names = {"np": np, "sublimit": sublimit, "points": points, "faces": faces,
             "make": lambda **tags: sublimit.Mesh(points, faces, **tags)}
    names["cube"] = names["make"]()
    names["surface"] = sublimit.LimitSurface(names["cube"], "catmull-clark")
    try:
        exec(statements, names)
        answers.append(["", "", "nothing was raised"])
    except Exception as error:
        answers.append([type(error).__name__, getattr(error, "code", ""), str(error)])
json.dump(answers, open("answers.json", "w"))
)";

/// The folder of a test, in which all doors run: messages name files without it.
class ThreeDoors : public ::testing::Test {
 protected:
  void SetUp() override {
    before_ = std::filesystem::current_path();
    std::filesystem::current_path(directory_.path());
    write_mesh("cube.obj", cube());
  }
  void TearDown() override { std::filesystem::current_path(before_); }

  const TemporaryDirectory& folder() const { return directory_; }

  /// Gives the mistake of each row to each door.
  void expect_refused(const std::vector<Row>& rows) {
    const std::vector<Answer> python = answers_of_python(rows);
    for (size_t i = 0; i < rows.size(); ++i) {
      SCOPED_TRACE(rows[i].what);
      std::map<Door, Answer> answers;
      if (rows[i].cpp) answers[Door::cpp] = answer_of_cpp(rows[i]);
      if (!rows[i].program.empty()) answers[Door::program] = answer_of_program(rows[i]);
      if (!rows[i].python.empty() && !python.empty()) answers[Door::python] = python[i];
      compare(rows[i], answers, !python.empty());
    }
  }

 private:
  static Answer answer_of_cpp(const Row& row) {
    try {
      row.cpp();
      return {"", "nothing was thrown"};
    } catch (const Error& error) {
      return {codes[size_t(error.code())].first, error.what()};
    } catch (const std::exception& error) {
      return {"", error.what()};
    }
  }

  Answer answer_of_program(const Row& row) const {
    const Outcome outcome = sublimit(row.program);
    EXPECT_EQ(outcome.out, "");
    return {std::to_string(outcome.status), outcome.err};
  }

  /// One interpreter for all rows; none if the module was not built.
  std::vector<Answer> answers_of_python(const std::vector<Row>& rows) const {
    if (!has_python) {
      std::puts("NO PYTHON MODULE: this door is not tried; SUBLIMIT_BUILD_PYTHON=ON builds it, without a sanitizer");
      return {};
    }
    nlohmann::json statements = nlohmann::json::array();
    for (const Row& row : rows) statements.push_back(row.python);
    directory_.write("rows.json", statements.dump());
    directory_.write("rows.py", python_rows);
    const std::string command = std::string("PYTHONPATH='") + python_path + "' PYTHONDONTWRITEBYTECODE=1 '" +
                                python_interpreter + "' rows.py 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::vector<Answer> answers;
    for (const nlohmann::json& one : nlohmann::json::parse(read_file("answers.json"))) {
      const std::string type = one[0], code = one[1];
      for (const auto& [name, its_class] : codes)
        if (code == name) {
          EXPECT_EQ(type, its_class);
        }
      answers.push_back({code.empty() ? type : code, one[2]});
    }
    return answers;
  }

#ifdef SUBLIMIT_PYTHON_MODULE
  static constexpr bool has_python = true;
  static constexpr const char *python_path = SUBLIMIT_PYTHON_PATH, *python_interpreter = SUBLIMIT_PYTHON;
#else
  static constexpr bool has_python = false;
  static constexpr const char *python_path = "", *python_interpreter = "";
#endif

  static std::string name_of(Door door) {
    return door == Door::cpp ? "C++" : door == Door::program ? "the program" : "Python";
  }

  /// The code as a door has it.
  static std::string code_at(Door door, ErrorCode code) {
    return door == Door::program ? std::to_string(exit_status(code)) : codes[size_t(code)].first;
  }

  static void compare(const Row& row, const std::map<Door, Answer>& answers, bool with_python) {
    std::optional<std::string> words;  // of the first door that has none of its own
    for (const Door door : {Door::cpp, Door::program, Door::python}) {
      const Otherwise* const other = row.at(door);
      const auto answer = answers.find(door);
      if (door == Door::python && !with_python) continue;
      EXPECT_EQ(answer != answers.end(), !other || other->is_asked) << name_of(door);
      if (answer == answers.end()) continue;
      const std::string message = bare(answer->second.message);
      const std::string code = other && !other->exception.empty()
                                   ? other->exception
                                   : code_at(door, other && other->code ? *other->code : row.code);
      EXPECT_EQ(answer->second.code, code) << name_of(door) << ": " << answer->second.message;
      if (!other || other->words.empty()) {
        if (!words) words = message;
        EXPECT_EQ(message, *words) << name_of(door);
        EXPECT_TRUE(!other || code != code_at(door, row.code)) << name_of(door) << " is as the others: " << other->why;
      } else {
        EXPECT_NE(message.find(other->words), std::string::npos)
            << name_of(door) << ": no '" << other->words << "' in: " << answer->second.message;
        EXPECT_TRUE(!words || message != *words) << name_of(door) << " says what the others do: " << other->why;
      }
    }
  }

  /// A message without what only its door says: the name of the program, also before its verbs, the place in a file,
  /// the mesh and the scheme before what is wrong with them, the options that would help.
  static std::string bare(std::string message) {
    static const std::string names = [] {
      std::string all = "mesh";  // as Python calls the mesh of a call
      for (const SchemeInfo& scheme : schemes()) all += "|" + scheme.name;
      return all;
    }();
    static const std::vector<std::pair<std::regex, const char*>> parts{
        {std::regex("\n$"), ""},
        {std::regex("^sublimit( [a-z]+)?: "), ""},
        {std::regex("; `sublimit help [a-z]+` shows options and examples$"), ""},
        {std::regex(R"(^[a-z_0-9]+\.(obj|ply|off|csv|json|npy|safetensors)(:\d+)?: )"), ""},
        {std::regex("^(" + names + "): "), ""},
        {std::regex("^target [0-9]+: "), ""},
        {std::regex("; --clamp moves such places to its rim$"), ""},
        {std::regex(R"( \(--[a-z][^)]*\))"), ""},
        {std::regex("`sublimit (schemes|info|analyze)`"), "`$1`"}};
    for (const auto& [part, with] : parts) message = std::regex_replace(message, part, with);
    return message;
  }

  TemporaryDirectory directory_;
  std::filesystem::path before_;
};

/// What every function does that takes a mesh as it is, in the order of the program's list.
std::vector<std::pair<const char*, std::function<void(const Mesh&)>>> verbs() {
  const auto catmark = "catmull-clark";
  return {{"info", [=](const Mesh& mesh) { (void)info(mesh, catmark); }},
          {"refine", [=](const Mesh& mesh) { (void)refine(mesh, catmark, 1); }},
          {"levels", [=](const Mesh& mesh) { (void)levels(mesh, catmark, 1); }},
          {"subdivision_matrix", [=](const Mesh& mesh) { (void)subdivision_matrix(mesh, catmark, 1); }},
          {"limit", [=](const Mesh& mesh) { (void)limit(mesh, catmark); }},
          {"LimitSurface", [=](const Mesh& mesh) { (void)LimitSurface(mesh, catmark); }},
          {"tessellate", [=](const Mesh& mesh) { (void)tessellate(mesh, catmark, {.chord = 0.1}); }},
          {"bake", [=](const Mesh& mesh) { (void)bake(mesh, catmark, {.levels = 1}); }},
          {"fit", [=](const Mesh& mesh) { (void)fit(mesh, catmark, {{.vertex = 0}}); }},
          {"analyze", [=](const Mesh& mesh) { (void)analyze(mesh, catmark); }},
          {"write_mesh", [=](const Mesh& mesh) { write_mesh("mesh.obj", mesh); }}};
}

/// Gives a mesh to all functions, which are to say the same of it, and throws that.
/// @param without  functions that take such a mesh
void by_all(const Mesh& mesh, const std::set<std::string>& without = {}) {
  std::optional<std::pair<ErrorCode, std::string>> first;
  for (const auto& [name, verb] : verbs()) {
    if (without.contains(name)) continue;
    try {
      verb(mesh);
      ADD_FAILURE() << name << " takes it";
    } catch (const Error& error) {
      const std::string message =
          std::string(error.what()).starts_with("mesh.obj: ") ? error.what() + 10 : error.what();
      if (!first) first.emplace(error.code(), message);
      EXPECT_EQ(message, first->second) << name;
      EXPECT_EQ(error.code(), first->first) << name;
    }
  }
  if (first) throw Error(first->first, first->second);
}

Mesh with_face_vertex(Index corner, Index vertex) {
  Mesh mesh = cube();
  mesh.face_vertices[size_t(corner)] = vertex;
  return mesh;
}

Mesh with_crease(Index tail, Index head, float sharpness) {
  Mesh mesh = cube();
  mesh.creases.push_back({.tail = tail, .head = head, .sharpness = sharpness});
  return mesh;
}

TEST_F(ThreeDoors, RefuseBrokenMeshes) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  folder().write("past_the_end.obj", vertices + "f 1 2 3 9\n");
  folder().write("negative.obj", vertices + "f 1 2 3 -9\n");
  folder().write("two_corners.obj", vertices + "f 1 2\n");
  folder().write("nan.obj", "v 0 nan 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  folder().write("plane.obj", "v 0 0\nv 1 0\nv 1 1\nf 1 2 3\n");
  folder().write("negative_crease.obj", vertices + "f 1 2 3 4\nt crease 2/1/0 0 1 -1\n");
  folder().write("no_head.obj", vertices + "f 1 2 3 4\nt crease 2/1/0 0 8 1\n");
  folder().write("no_vertex.obj", vertices + "f 1 2 3 4\nt corner 1/1/0 8 1\n");
  folder().write("no_face.obj", vertices + "f 1 2 3 4\nt hole 1/0/0 6\n");
  const auto refined = [](const std::string& file) -> Words {
    return {"refine", file, "-s", "catmull-clark", "-l", "1", "-o", "out.obj"};
  };
  Mesh two_corners = cube(), sizes = cube(), plane = cube(), no_vertex = cube(), no_face = cube(), nan = cube();
  two_corners.face_sizes[1] = 2, two_corners.face_sizes[2] = 6;
  sizes.face_sizes[1] = 5;
  plane.positions.conservativeResize(8, 2);
  no_vertex.corners.push_back({.vertex = 8, .sharpness = 1});
  no_face.holes = {6};
  nan.positions(3, 1) = not_a_number;
  Mesh named = cube();
  named.groups = {.names = {"front", "back"}, .of_face = {0, 1}};
  const std::set<std::string> of_connectivity{"info", "levels", "subdivision_matrix", "bake"};
  std::set<std::string> of_points_elsewhere = of_connectivity;
  of_points_elsewhere.insert("write_mesh");  // which counts vertices, as files do
  expect_refused({
      {"an index past the end",
       invalid_mesh,
       [&] { by_all(with_face_vertex(5, 8)); },
       refined("past_the_end.obj"),
       "faces[1][1] = 8; make()",
       {by_reader("index 9 is out of range")}},
      {"a negative index",
       invalid_mesh,
       [&] { by_all(with_face_vertex(5, -1)); },
       refined("negative.obj"),
       "faces[1][1] = -1; make()",
       {by_reader("index -9 counts back")}},
      {"a face of two corners",
       invalid_mesh,
       [&] { by_all(two_corners); },
       refined("two_corners.obj"),
       "faces[1:3] = [[4, 5], [7, 6, 0, 1, 5, 4]]; make()",
       {by_reader("has 2 corners; it should have at least 3")}},
      {"sizes that do not add up",
       invalid_mesh,
       [&] { by_all(sizes); },
       {},
       "sublimit.Mesh(points, (np.array([4, 5, 4, 4, 4, 4]), np.array(sum(faces, []))))",
       {not_asked(Door::program, "each face of a file is a line")}},
      {"a coordinate that is not a number",
       invalid_mesh,
       [&] { by_all(nan, of_points_elsewhere); },
       refined("nan.obj"),
       "points[3][1] = float('nan'); make()",
       {by_reader("coordinate y is 'nan'", format_error), of_arrays("points[3, 1] is nan")}},
      {"two coordinates",
       invalid_mesh,
       [&] { by_all(plane, of_points_elsewhere); },
       refined("plane.obj"),
       "sublimit.Mesh(np.array(points)[:, :2], faces)",
       {by_reader("where coordinate z should be", format_error), of_arrays("points has shape (8, 2)")}},
      {"a negative sharpness",
       invalid_mesh,
       [&] { by_all(with_crease(0, 1, -1)); },
       refined("negative_crease.obj"),
       "make(creases={(0, 1): -1})",
       {by_reader("sharpness is '-1'", format_error)}},
      {"a sharpness that is not a number",
       invalid_mesh,
       [&] { by_all(with_crease(0, 1, float(not_a_number))); },
       {},
       "make(creases={(0, 1): float('nan')})",
       {not_asked(Door::program, "a reader takes numbers alone"), of_arrays("sharpness nan")}},
      {"a crease that is no edge",
       invalid_mesh,
       [&] { by_all(with_crease(0, 3, 1), {"write_mesh"}); },
       {},
       "make(creases={(0, 3): 1})",
       {not_asked(Door::program, "a reader warns of it, and --strict refuses it")}},
      {"a crease past the end",
       invalid_mesh,
       [&] { by_all(with_crease(0, 8, 1)); },
       refined("no_head.obj"),
       "make(creases={(0, 8): 1})",
       {by_reader("vertex 8 is out of range")}},
      {"a corner past the end",
       invalid_mesh,
       [&] { by_all(no_vertex); },
       refined("no_vertex.obj"),
       "make(corners={8: 1})",
       {by_reader("vertex 8 is out of range")}},
      {"a hole past the end",
       invalid_mesh,
       [&] { by_all(no_face); },
       refined("no_face.obj"),
       "make(holes=[6])",
       {by_reader("face 6 is out of range")}},
      {"names of some faces",
       invalid_mesh,
       [&] {
         by_all(named,
                {"levels", "subdivision_matrix", "limit", "LimitSurface", "tessellate", "bake", "fit", "analyze"});
       },
       {},
       "make(face_names=['front', 'back'])",
       {not_asked(Door::program, "each face of a file is in a group or in none"),
        of_arrays("face_names has 2 names; 6 are right")}},
  });
  // Each verb of the program that reads a mesh.
  for (const Words& verb : std::vector<Words>{{"info"},
                                              {"refine", "-l", "1", "-o", "out.obj"},
                                              {"limit", "-o", "out.obj"},
                                              {"sample", "--grid", "2", "-o", "out.csv"},
                                              {"tessellate", "--chord", "1", "-o", "out.obj"},
                                              {"bake", "-l", "1", "-o", "out.safetensors"},
                                              {"analyze", "-o", "out.html"}}) {
    Words arguments{verb[0], "past_the_end.obj", "-s", "catmull-clark"};
    arguments.insert(arguments.end(), verb.begin() + 1, verb.end());
    expect_failure(sublimit(arguments), exit_status(invalid_mesh), {"past_the_end.obj:5: ", "index 9"});
  }
}

TEST_F(ThreeDoors, SayWhatASchemeCannotTake) {
  const Mesh creased = with_crease(0, 1, 2);
  const std::vector<std::array<int, 3>> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, corners{{0, 1, 1}};
  const Mesh thin = sublimit::make_mesh(points, corners);
  write_mesh("creased.obj", creased);
  write_mesh("thin.obj", thin);
  expect_refused({
      {"quads under loop",
       unsupported_topology,
       [&] { (void)refine(cube(), "loop", 1); },
       {"refine", "cube.obj", "-s", "loop", "-l", "1", "-o", "out.obj"},
       "sublimit.refine(cube, 'loop', 1)"},
      {"a semi-sharp crease under doo-sabin",
       unsupported_topology,
       [&] { (void)limit(creased, "doo-sabin"); },
       {"limit", "creased.obj", "-s", "doo-sabin", "-o", "out.obj"},
       "sublimit.limit(make(creases={(0, 1): 2}), 'doo-sabin')"},
      {"a face that visits a vertex twice, strictly",
       invalid_mesh,
       {},
       {"refine", "thin.obj", "-s", "catmull-clark", "-l", "1", "--strict", "-o", "out.obj"},
       "sublimit.refine(sublimit.read('thin.obj'), 'catmull-clark', 1, strict=True)",
       {not_asked(Door::cpp, "faults are a field of `info` and warnings of what `refine` makes")}},
  });
  // Otherwise it is taken, with a warning.
  const Mesh refined = refine(thin, "catmull-clark", 1);
  ASSERT_FALSE(refined.warnings.empty());
  EXPECT_EQ(refined.warnings, info(thin).faults);
  const Words arguments{"refine", "thin.obj", "-s", "catmull-clark", "-l", "1", "-o", "out.obj"};
  const Outcome outcome = expect_done(sublimit(arguments), true);
  for (const std::string& warning : refined.warnings)
    expect_parts(outcome.err, {"sublimit: warning: thin.obj: " + warning + "\n"});
}

TEST_F(ThreeDoors, OfferTheNearestSchemes) {
  const auto refined = [](const Words& scheme) {
    Words all{"refine", "cube.obj", "-l", "1", "-o", "out.obj", "-s"};
    all.insert(all.end(), scheme.begin(), scheme.end());
    return all;
  };
  expect_refused({
      {"a misspelt name", invalid_option, [&] { (void)refine(cube(), "catmul-clark", 1); }, refined({"catmul-clark"}),
       "sublimit.refine(cube, 'catmul-clark', 1)"},
      {"a misspelt short name", invalid_option, [&] { (void)limit(cube(), "lop"); }, refined({"lop"}),
       "sublimit.scheme('lop')"},
      {"a name like no other", invalid_option, [&] { (void)LimitSurface(cube(), "xyz"); }, refined({"xyz"}),
       "sublimit.LimitSurface(cube, 'xyz')"},
      {"a misspelt name, to be analyzed",
       invalid_option,
       [&] { (void)analyze("catmul-clark"); },
       {"analyze", "-s", "catmul-clark"},
       "sublimit.analyze('catmul-clark')"},
      {"a scheme of curves, for a mesh",
       invalid_option,
       [&] { (void)bake(cube(), "chaikin", {.levels = 1}); },
       {"bake", "cube.obj", "-s", "chaikin", "-l", "1", "-o", "out.safetensors"},
       "sublimit.bake(cube, 'chaikin', levels=1)",
       {says(Door::program, "it says what the subcommand takes",
             "chaikin refines curves; `sublimit bake` takes meshes under a scheme with masks")}},
      {"a scheme of points with more than positions", invalid_option, [&] { (void)limit(cube(), "torus-pieces"); },
       refined({"torus-pieces"}), "sublimit.limit(cube, 'torus-pieces')"},
      {"an unknown option", invalid_option,
       [&] {
         (void)AnyScheme("kobbelt", {{"tenson", "1"}});
       },
       refined({"kobbelt", "--option", "tenson=1"}), "sublimit.scheme('kobbelt', tenson=1)"},
      {"an option of a scheme without any", invalid_option,
       [&] {
         (void)AnyScheme("loop", {{"degree", "3"}});
       },
       refined({"loop", "--option", "degree=3"}), "sublimit.refine(cube, 'loop', 1, option={'degree': 3})"},
      {"a number out of its range", invalid_option,
       [&] {
         (void)AnyScheme("averaging", {{"degree", "99"}});
       },
       refined({"averaging", "--option", "degree=99"}), "sublimit.scheme('averaging', degree=99)"},
      {"a word that there is not", invalid_option,
       [&] {
         (void)AnyScheme("catmull-clark", {{"triangles", "round"}});
       },
       refined({"catmull-clark", "--option", "triangles=round"}),
       "sublimit.scheme('catmull-clark', triangles='round')"},
      {"a rule that there is not",
       invalid_option,
       {},
       refined({"catmull-clark", "--boundary", "edges"}),
       "sublimit.refine(cube, 'catmull-clark', 1, boundary='edges')",
       {not_asked(Door::cpp, "rules are enumerators"), on_the_line("--boundary: edges not in")}},
  });
}

TEST_F(ThreeDoors, RefuseNumbersOutOfTheirRange) {
  const LimitSurface surface(cube(), "catmull-clark");
  folder().write("points.csv", "x,y,z\n2,0,0\n");
  folder().write("rays.csv", "ox,oy,oz,dx,dy,dz\n0,0,9,0,0,-1\n");
  const Points point{{2, 0, 0}};
  const std::vector<Ray> ray{{.origin = {0, 0, 9}, .direction = {0, 0, -1}}};
  const auto by_program = [](Words arguments) {
    arguments.insert(arguments.begin() + 1, "cube.obj");
    arguments.insert(arguments.end(), {"-s", "catmull-clark"});
    return arguments;
  };
  expect_refused({
      {"negative levels", invalid_parameter, [&] { (void)refine(cube(), "catmull-clark", -1); },
       by_program({"refine", "-l", "-1", "-o", "out.obj"}), "sublimit.refine(cube, 'catmull-clark', -1)"},
      {"negative levels of a matrix", invalid_parameter, [&] { (void)subdivision_matrix(cube(), "catmull-clark", -1); },
       by_program({"refine", "-l", "-1", "--matrix", "out.mtx", "-o", "out.obj"}),
       "sublimit.subdivision_matrix(cube, 'catmull-clark', -1)"},
      {"negative levels of limits", invalid_parameter, [&] { (void)limit(cube(), "catmull-clark", {.levels = -1}); },
       by_program({"limit", "-l", "-1", "-o", "out.obj"}), "sublimit.limit(cube, 'catmull-clark', -1)"},
      {"more levels than memory holds", resource_error, [&] { (void)refine(cube(), "catmull-clark", 30); },
       by_program({"refine", "-l", "30", "-o", "out.obj"}), "sublimit.refine(cube, 'catmull-clark', 30)"},
      {"no nearest faces",
       invalid_parameter,
       [&] { (void)closest(surface, point, {.nearest = 0}); },
       by_program({"closest", "--points", "points.csv", "--nearest", "0", "-o", "out.csv"}),
       "surface.closest([[2, 0, 0]], nearest=0)",
       {on_the_line("--nearest 0: it should be a whole number of faces, 1 or more")}},
      {"a negative radius",
       invalid_parameter,
       [&] { (void)closest(surface, point, {.radius = -1}); },
       by_program({"closest", "--points", "points.csv", "--radius", "-1", "-o", "out.csv"}),
       "surface.closest([[2, 0, 0]], radius=-1)",
       {on_the_line("--radius -1: it should be a distance, 0 or more")}},
      {"no parts to look at",
       invalid_parameter,
       [&] { (void)intersect(surface, ray, {.most_parts = 0}); },
       by_program({"intersect", "--rays", "rays.csv", "--most-parts", "0", "-o", "out.csv"}),
       "surface.intersect([0, 0, 9], [0, 0, -1], most_parts=0)",
       {on_the_line("--most-parts 0: it should be a whole number of parts, 1 or more")}},
      {"no chord",
       invalid_parameter,
       [&] { (void)tessellate(surface, {.chord = 0}); },
       by_program({"tessellate", "--chord", "0", "-o", "out.obj"}),
       "surface.tessellate(0)",
       {on_the_line("--chord 0: it should be a distance above 0")}},
      {"a negative angle",
       invalid_parameter,
       [&] { (void)tessellate(surface, {.chord = 1, .angle = -1}); },
       by_program({"tessellate", "--chord", "1", "--angle", "-1", "-o", "out.obj"}),
       "surface.tessellate(1, angle=-1)",
       {on_the_line("--angle -1: it should be degrees, above 0")}},
      {"no triangles",
       invalid_parameter,
       [&] { (void)tessellate(surface, {.chord = 1, .max_triangles = 0}); },
       by_program({"tessellate", "--chord", "1", "--max-triangles", "0", "-o", "out.obj"}),
       "surface.tessellate(1, max_triangles=0)",
       {on_the_line("--max-triangles 0: it should be a whole number from 1")}},
      {"too few triangles", resource_error, [&] { (void)tessellate(surface, {.chord = 1e-3, .max_triangles = 9}); },
       by_program({"tessellate", "--chord", "1e-3", "--max-triangles", "9", "-o", "out.obj"}),
       "surface.tessellate(1e-3, max_triangles=9)"},
      {"third derivatives",
       invalid_parameter,
       [&] { (void)surface.evaluate(surface.grid(2), 3); },
       by_program({"sample", "--grid", "2", "--derivatives", "3", "-o", "out.csv"}),
       "surface.evaluate(0, 0, 0, 3)",
       {on_the_line("--derivatives: Value 3 not in range 0 to 2"), of_arrays("derivatives is 3; 0, 1 or 2 are right")}},
      {"a grid of one place",
       invalid_parameter,
       [&] { (void)surface.grid(1); },
       by_program({"sample", "--grid", "1", "-o", "out.csv"}),
       "",
       {on_the_line("--grid 1: it should be"), not_asked(Door::python, "grids are made by NumPy")}},
  });
}

TEST_F(ThreeDoors, RefusePlacesOutside) {
  const LimitSurface surface(cube(), "catmull-clark");
  folder().write("face.csv", "face,u,v\n6,0,0\n");
  folder().write("square.csv", "face,u,v\n0,1.5,0.25\n");
  folder().write("nan.csv", "face,u,v\n0,nan,0\n");
  write_mesh("octahedron.obj", octahedron());
  folder().write("triangle.csv", "face,u,v\n7,0.5,0.75\n");
  const auto sampled = [](const std::string& places) -> Words {
    return {"sample", "cube.obj", "-s", "catmull-clark", "--at", places, "-o", "out.csv"};
  };
  const auto baked = [](const std::string& places) -> Words {
    return {"bake", "cube.obj", "-s", "catmull-clark", "--at", places, "-o", "out.safetensors"};
  };
  expect_refused({
      {"a face that there is not",
       invalid_parameter,
       [&] { (void)surface.stencils({{.face = 6, .u = 0, .v = 0}}); },
       sampled("face.csv"),
       "surface.evaluate(6, 0, 0)",
       {in_a_file()}},
      {"outside of the square",
       invalid_parameter,
       [&] { (void)surface.stencils({{.face = 0, .u = 1.5, .v = 0.25}}); },
       sampled("square.csv"),
       "surface.stencils(0, 1.5, 0.25)",
       {in_a_file()}},
      {"outside of the triangle",
       invalid_parameter,
       [&] { (void)LimitSurface(octahedron(), "loop").stencils({{.face = 7, .u = 0.5, .v = 0.75}}); },
       {"sample", "octahedron.obj", "-s", "loop", "--at", "triangle.csv", "-o", "out.csv"},
       "sublimit.LimitSurface(sublimit.read('octahedron.obj'), 'loop').evaluate(7, 0.5, 0.75)",
       {in_a_file()}},
      {"not a number",
       invalid_parameter,
       [&] { (void)surface.stencils({{.face = 0, .u = not_a_number, .v = 0}}); },
       sampled("nan.csv"),
       "surface.evaluate(0, float('nan'), 0)",
       {in_a_file("u is 'nan'; it should be a finite number")}},
      {"a face that there is not, to bake",
       invalid_parameter,
       [&] { (void)bake(cube(), "catmull-clark", {.at = {{.face = 6, .u = 0, .v = 0}}}); },
       baked("face.csv"),
       "sublimit.bake(cube, 'catmull-clark', at=(6, 0, 0))",
       {in_a_file()}},
      {"outside of the square, to bake",
       invalid_parameter,
       [&] { (void)bake(cube(), "catmull-clark", {.at = {{.face = 0, .u = 1.5, .v = 0.25}}}); },
       baked("square.csv"),
       "sublimit.bake(cube, 'catmull-clark', at=(0, 1.5, 0.25))",
       {in_a_file()}},
  });
  // In C++ places outside are no error of `evaluate`, which has a status for each.
  EXPECT_EQ(surface.evaluate({{.face = 6, .u = 0, .v = 0}}).status[0], LimitStatus::outside);
}

TEST_F(ThreeDoors, RefuseWhatNoSearchTakes) {
  const LimitSurface surface(cube(), "catmull-clark"), sheet(grid(2, 2), "catmull-clark"),
      empty(Mesh{}, "catmull-clark");
  write_mesh("grid.obj", grid(2, 2));
  folder().write("points.csv", "x,y,z\n2,0,0\n");
  folder().write("nan.csv", "x,y,z\nnan,0,0\n");
  folder().write("far.csv", "x,y,z\n1e200,0,0\n");
  folder().write("plane.csv", "x,y\n0,0\n");
  folder().write("no_direction.csv", "ox,oy,oz,dx,dy,dz\n0,0,9,0,0,0\n");
  folder().write("nan_ray.csv", "ox,oy,oz,dx,dy,dz\nnan,0,9,0,0,1\n");
  folder().write("ended.csv", "ox,oy,oz,dx,dy,dz,tmin,tmax\n0,0,9,0,0,1,2,1\n");
  const auto near = [](const std::string& points) -> Words {
    return {"closest", "cube.obj", "-s", "catmull-clark", "--points", points, "-o", "out.csv"};
  };
  const auto hit = [](const std::string& rays) -> Words {
    return {"intersect", "cube.obj", "-s", "catmull-clark", "--rays", rays, "-o", "out.csv"};
  };
  expect_refused({
      {"a point that is not finite",
       invalid_parameter,
       [&] {
         (void)closest(surface, Points{{not_a_number, 0, 0}});
       },
       near("nan.csv"),
       "surface.closest([[float('nan'), 0, 0]])",
       {in_a_file("is 'nan'; it should be a finite number"), of_arrays("points[0, 0] is nan")}},
      {"a point too far away", invalid_parameter,
       [&] {
         (void)closest(surface, Points{{1e200, 0, 0}});
       },
       near("far.csv"), "surface.closest([[1e200, 0, 0]])"},
      {"points of two coordinates",
       invalid_parameter,
       [&] {
         (void)closest(surface, Points{{0, 0}});
       },
       near("plane.csv"),
       "surface.closest([[0, 0]])",
       {in_a_file("x,y"), of_arrays("points has shape (1, 2); (n, 3) is right")}},
      {"a sign without an inside",
       unsupported_topology,
       [&] {
         (void)closest(sheet, Points{{2, 0, 0}}, {.is_signed = true});
       },
       {"closest", "grid.obj", "-s", "catmull-clark", "--points", "points.csv", "--signed", "-o", "out.csv"},
       "sublimit.LimitSurface(sublimit.read('grid.obj'), 'catmull-clark').closest([[2, 0, 0]], signed=True)"},
      {"a surface of no faces",
       invalid_mesh,
       [&] {
         (void)closest(empty, Points{{2, 0, 0}});
       },
       {},
       "sublimit.LimitSurface(sublimit.Mesh([], []), 'catmull-clark').closest([[2, 0, 0]])",
       {not_asked(Door::program, "readers refuse files without faces")}},
      {"a ray without a direction",
       invalid_parameter,
       [&] {
         (void)intersect(surface, {{.origin = {0, 0, 9}, .direction = {0, 0, 0}}});
       },
       hit("no_direction.csv"),
       "surface.intersect([0, 0, 9], [0, 0, 0])",
       {in_a_file("the direction is 0, 0, 0; one of them should not be")}},
      {"a ray that is not finite",
       invalid_parameter,
       [&] {
         (void)intersect(surface, {{.origin = {not_a_number, 0, 9}, .direction = {0, 0, 1}}});
       },
       hit("nan_ray.csv"),
       "surface.intersect([float('nan'), 0, 9], [0, 0, 1])",
       {in_a_file("ox is 'nan'"), of_arrays("origins[0] is nan")}},
      {"a ray that ends before it begins",
       invalid_parameter,
       [&] {
         (void)intersect(surface, {{.origin = {0, 0, 9}, .direction = {0, 0, 1}, .tmin = 2, .tmax = 1}});
       },
       hit("ended.csv"),
       "surface.intersect([0, 0, 9], [0, 0, 1], tmin=2, tmax=1)",
       {in_a_file("tmin 2 is above tmax 1")}},
  });
}

TEST_F(ThreeDoors, RefuseTablesThatCannotBe) {
  const Mesh mesh = cube();
  const auto catmark = "catmull-clark";
  bake(mesh, catmark, {.levels = 1}).save("table.safetensors");
  const Table table = load("table.safetensors");
  std::vector<float> points(24), result(table.num_results(3));
  folder().write("seven.csv", "0,0,0\n1,0,0\n2,0,0\n3,0,0\n4,0,0\n5,0,0\n6,0,0\n");
  folder().write("text.safetensors", "this is no table, but some text\n");
  folder().write("short.safetensors", "short");
  const std::string whole = read_file("table.safetensors");
  folder().write("cut.safetensors", whole.substr(0, whole.size() - 8));
  folder().write("header.safetensors", whole.substr(0, 100));
  std::filesystem::create_directory("folder.safetensors");
  const auto baked = [](Words arguments) {
    arguments.insert(arguments.begin(), {"bake", "cube.obj", "-s", "catmull-clark", "-o", "out.safetensors"});
    return arguments;
  };
  const auto applied = [](const std::string& file) -> Words { return {"apply", file, "cube.obj", "-o", "out.obj"}; };
  const std::string on = "sublimit.bake(cube, 'catmull-clark', ", loaded = "sublimit.load('table.safetensors')";
  expect_refused({
      {"none of levels, grid and places",
       invalid_parameter,
       [&] { (void)bake(mesh, catmark, {}); },
       baked({}),
       on + ")",
       {on_the_line("none of -l LEVELS, --grid N"), of_arrays("one of levels, grid, at and tessellation")}},
      {"two of levels, grid and places",
       invalid_parameter,
       [&] { (void)bake(mesh, catmark, {.levels = 1, .grid = 3}); },
       baked({"-l", "1", "--grid", "3"}),
       on + "levels=1, grid=3)",
       {on_the_line("more than one of -l LEVELS, --grid N"), of_arrays("one of levels, grid, at and tessellation")}},
      {"the limit of a grid",
       invalid_parameter,
       [&] { (void)bake(mesh, catmark, {.limit = true, .grid = 3}); },
       baked({"--limit", "--grid", "3"}),
       on + "limit=True, grid=3)",
       {on_the_line("--limit is for -l LEVELS"), of_arrays("limit is of a level; all others are of the limit anyway")}},
      {"derivatives of a level",
       invalid_parameter,
       [&] { (void)bake(mesh, catmark, {.levels = 1, .derivatives = 1}); },
       baked({"-l", "1", "--derivatives", "1"}),
       on + "levels=1, derivatives=1)",
       {on_the_line("--derivatives are those of the limit: -l LEVELS needs --limit for them")}},
      {"third derivatives of a table",
       invalid_parameter,
       [&] { (void)bake(mesh, catmark, {.grid = 3, .derivatives = 3}); },
       baked({"--grid", "3", "--derivatives", "3"}),
       on + "grid=3, derivatives=3)",
       {on_the_line("--derivatives: Value 3 not in range 0 to 2"), of_arrays("derivatives is 3; 0, 1 or 2 are right")}},
      {"level 0 of a table", invalid_parameter, [&] { (void)bake(mesh, catmark, {.levels = 0}); }, baked({"-l", "0"}),
       on + "levels=0)"},
      {"a negative level of a table", invalid_parameter, [&] { (void)bake(mesh, catmark, {.levels = -1}); },
       baked({"-l", "-1"}), on + "levels=-1)"},
      {"a grid of one place on each face", invalid_parameter, [&] { (void)bake(mesh, catmark, {.grid = 1}); },
       baked({"--grid", "1"}), on + "grid=1)"},
      {"a precision that there is not",
       invalid_option,
       {},
       baked({"-l", "1", "--precision", "half"}),
       on + "levels=1, precision='half')",
       {not_asked(Door::cpp, "it is a bool"), on_the_line("--precision: half not in"),
        of_arrays("precision is 'half'; 'float' or 'double' are right")}},
      {"text as a table", format_error, [&] { (void)load("text.safetensors"); }, applied("text.safetensors"),
       "sublimit.load('text.safetensors')"},
      {"five bytes as a table", format_error, [&] { (void)load("short.safetensors"); }, applied("short.safetensors"),
       "sublimit.load('short.safetensors')"},
      {"a table without its end", format_error, [&] { (void)load("cut.safetensors"); }, applied("cut.safetensors"),
       "sublimit.load('cut.safetensors')"},
      {"a table without the end of its header", format_error, [&] { (void)load("header.safetensors"); },
       applied("header.safetensors"), "sublimit.load('header.safetensors')"},
      {"a mesh as a table",
       format_error,
       [&] { (void)load("cube.obj"); },
       applied("cube.obj"),
       "sublimit.load('cube.obj')",
       {before_it_begins("cube.obj is an OBJ file; TABLE is a table of `sublimit bake`")}},
      {"no such table", io_error, [&] { (void)load("none.safetensors"); }, applied("none.safetensors"),
       "sublimit.load('none.safetensors')"},
      {"a folder as a table",
       io_error,
       [&] { (void)load("folder.safetensors"); },
       applied("folder.safetensors"),
       "sublimit.load('folder.safetensors')",
       {before_it_begins("it is a directory; name a file in it (TABLE is a table")}},
      {"a table in a place that there is not",
       io_error,
       [&] { table.save("none/table.safetensors"); },
       {"bake", "cube.obj", "-s", "catmull-clark", "-l", "1", "-o", "none/table.safetensors"},
       loaded + ".save('none/table.safetensors')",
       {before_it_begins("cannot write none/table.safetensors: none is not a directory")}},
      {"points of another mesh",
       invalid_parameter,
       [&] { table.apply(std::span(points).first(21), 3, result); },
       {"apply", "table.safetensors", "seven.csv", "-o", "out.csv"},
       loaded + ".apply(np.zeros((7, 3)))",
       {says(Door::program, "it names both files",
             "7 points, and table.safetensors is a catmull-clark table of a cage of 8 points", invalid_mesh),
        of_arrays("points has shape (7, 3); (8 control points, channels) is right")}},
      {"no channels",
       invalid_parameter,
       [&] { table.apply(points, 0, result); },
       {},
       loaded + ".apply(np.zeros((8, 0)))",
       {not_asked(Door::program, "lines of a file have numbers"), of_arrays("points has shape (8, 0)")}},
      {"results of another size",
       invalid_parameter,
       [&] { table.apply(points, 2, result); },
       {},
       loaded + ".apply(np.zeros((8, 2)), np.zeros((26, 3), np.float32))",
       {not_asked(Door::program, "it makes its results itself"), of_arrays("out has shape (26, 3); (26, 2) is right")}},
      {"points of another number, for a surface",
       invalid_parameter,
       [&] { (void)LimitSurface(mesh, catmark).with(Points::Zero(7, 3)); },
       {},
       "surface.with_points(np.zeros((7, 3)))",
       {not_asked(Door::program, "a surface lives for one command"),
        of_arrays("points has shape (7, 3); (8 control points, 3) is right")}},
  });
}

TEST_F(ThreeDoors, RefuseTargetsThatNoFitCanMeet) {
  const Mesh mesh = cube();
  const auto catmark = "catmull-clark";
  const LimitSurface surface(mesh, catmark);
  folder().write("vertex.csv", "vertex,x,y,z\n8,0,0,0\n");
  folder().write("twice.csv", "vertex,x,y,z\n0,0,0,0\n0,1,0,0\n");
  folder().write("nan.csv", "vertex,x,y,z\n0,nan,0,0\n");
  folder().write("normal.csv", "vertex,x,y,z,nx,ny,nz\n0,0,0,0,0,0,0\n");
  folder().write("one.csv", "vertex,x,y,z\n0,0,0,0\n");
  folder().write("none.csv", "vertex,x,y,z\n");
  folder().write("face.csv", "face,u,v,x,y,z\n6,0,0,0,0,0\n");
  folder().write("outside.csv", "face,u,v,x,y,z\n0,1.5,0.25,0,0,0\n");
  folder().write("weight.csv", "face,u,v,x,y,z,weight\n0,0,0,0,0,0,-1\n");
  folder().write("place.csv", "face,u,v,x,y,z\n0,0,0,0,0,0\n");
  folder().write("no_places.csv", "face,u,v,x,y,z\n");
  folder().write("cloud.csv", "x,y,z\n0,0,0\n");
  folder().write("no_cloud.csv", "x,y,z\n");
  const auto fitted = [](const std::string& file, Words more = {}) {
    more.insert(more.begin(), {"fit", "cube.obj", "-s", "catmull-clark", "--targets", file, "-o", "out.obj"});
    return more;
  };
  const auto near = [](const std::string& file, Words more = {}) {
    more.insert(more.begin(), {"fit", "cube.obj", "-s", "catmull-clark", "--cloud", file, "-o", "out.obj"});
    return more;
  };
  const std::string on = "sublimit.fit(cube, 'catmull-clark', ", at = "sublimit.fit_places(cube, 'catmull-clark', ",
                    of = "sublimit.fit_cloud(cube, 'catmull-clark', ";
  const PlaceTargets corner{.places = {{.face = 0}}, .values = Points::Zero(1, 3)};
  expect_refused({
      {"a vertex that there is not",
       invalid_parameter,
       [&] { (void)fit(mesh, catmark, {{.vertex = 8}}); },
       fitted("vertex.csv"),
       on + "[8], [[0, 0, 0]])",
       {in_a_file()}},
      {"two targets of a vertex",
       invalid_parameter,
       [&] {
         (void)fit(mesh, catmark, {{.vertex = 0}, {.vertex = 0}});
       },
       fitted("twice.csv"),
       on + "[0, 0], [[0, 0, 0], [1, 0, 0]])",
       {in_a_file("vertex 0 has a target already, in line 2; leave one of them")}},
      {"a position that is not finite",
       invalid_parameter,
       [&] {
         (void)fit(mesh, catmark, {{.vertex = 0, .position = {not_a_number, 0, 0}}});
       },
       fitted("nan.csv"),
       on + "[0], [[float('nan'), 0, 0]])",
       {in_a_file("x is 'nan'; it should be a finite number"), of_arrays("points[0, 0] is nan")}},
      {"a normal of length 0",
       invalid_parameter,
       [&] { (void)fit(mesh, catmark, {{.vertex = 0, .normal = Eigen::Vector3d(0, 0, 0)}}); },
       fitted("normal.csv"),
       on + "[0], [[0, 0, 0]], [[0, 0, 0]])",
       {in_a_file("the normal has length 0; any other length will do, or leave nx,ny,nz empty")}},
      {"no targets",
       invalid_parameter,
       [&] { (void)fit(mesh, catmark, {}); },
       fitted("none.csv"),
       on + "[], np.zeros((0, 3)))",
       {in_a_file("no targets after the header; every other line should be one")}},
      {"fewer refinements than none",
       invalid_parameter,
       [&] { (void)fit(mesh, catmark, {{.vertex = 0}}, {.least_refinements = -1}); },
       fitted("one.csv", {"--refine", "-1"}),
       on + "[0], [[0, 0, 0]], refinements=(-1, 2))",
       {on_the_line("--refine -1: it should be auto, or a whole number, 0 or more")}},
      {"a negative weight of fairness",
       invalid_parameter,
       [&] { (void)fit(mesh, catmark, {{.vertex = 0}}, {.fairness = {.thin_plate = -1}}); },
       fitted("one.csv", {"--thin-plate", "-1"}),
       on + "[0], [[0, 0, 0]], thin_plate=-1)",
       {on_the_line("--thin-plate -1: it should be a number, 0 or more")}},
      {"a place on no face",
       invalid_parameter,
       [&] { (void)fit_places(surface, {.places = {{.face = 6}}, .values = Points::Zero(1, 3)}); },
       fitted("face.csv"),
       at + "6, 0, 0, [[0, 0, 0]])",
       {in_a_file()}},
      {"a place outside of its face",
       invalid_parameter,
       [&] { (void)fit_places(surface, {.places = {{.face = 0, .u = 1.5, .v = 0.25}}, .values = Points::Zero(1, 3)}); },
       fitted("outside.csv"),
       at + "0, 1.5, 0.25, [[0, 0, 0]])",
       {in_a_file()}},
      {"a negative weight",
       invalid_parameter,
       [&] {
         (void)fit_places(surface, {corner.places, corner.values, {-1}});
       },
       fitted("weight.csv"),
       at + "0, 0, 0, [[0, 0, 0]], weights=[-1])",
       {in_a_file("weight -1; it should be 0 or more")}},
      {"no targets at places",
       invalid_parameter,
       [&] { (void)fit_places(surface, {}); },
       fitted("no_places.csv"),
       at + "[], [], [], np.zeros((0, 3)))",
       {in_a_file("no targets after the header; every other line should be one")}},
      {"more values than places",
       invalid_parameter,
       [&] {
         (void)fit_places(surface, {corner.places, Points::Zero(2, 3)});
       },
       {},
       at + "0, 0, 0, np.zeros((2, 3)))",
       {not_asked(Door::program, "a line of a file has both"), of_arrays("points has shape (2, 3)")}},
      {"a pin on no control point",
       invalid_parameter,
       [&] { (void)fit_places(surface, corner, {.pins = {.vertices = {8}}}); },
       fitted("place.csv", {"--pin", "8"}),
       at + "0, 0, 0, [[0, 0, 0]], pins=[8])",
       {on_the_line("--pin 8: vertex 8 does not exist; vertices are 0 to 7")}},
      {"a cloud without points",
       invalid_parameter,
       [&] { (void)fit_cloud(surface, {.points = Points(0, 3)}); },
       near("no_cloud.csv"),
       of + "np.zeros((0, 3)))",
       {in_a_file("no points after the header; every other line should be one")}},
      {"a negative number of iterations",
       invalid_parameter,
       [&] {
         (void)fit_cloud(surface, {.points = Points{{0, 0, 0}}}, {.iterations = -1});
       },
       near("cloud.csv", {"--iterations", "-1"}),
       of + "[[0, 0, 0]], iterations=-1)",
       {on_the_line("--iterations -1: it should be 0 or more")}},
  });
}

TEST_F(ThreeDoors, RefuseReportsOfNothing) {
  const auto analyzed = [](const Words& more) {
    Words all{"analyze", "-s", "loop"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const auto claimed = [](const std::string& claim) {
    return [claim] { (void)analyze("loop", {.valences = {3}, .claims = {claim}}); };
  };
  expect_refused({
      {"a valence below 3",
       invalid_parameter,
       [&] { (void)analyze("loop", {.valences = {2}}); },
       analyzed({"--valence", "2"}),
       "sublimit.analyze('loop', [2])",
       {on_the_line("--valence 2: 2 is below 3, the least valence of a closed fan")}},
      {"a valence above 100",
       invalid_parameter,
       [&] { (void)analyze("loop", {.valences = {101}}); },
       analyzed({"--valence", "101"}),
       "sublimit.analyze('loop', [101])",
       {on_the_line("--valence 101: 101 is beyond 100; a scheme would take about")}},
      {"no valences",
       invalid_parameter,
       [&] { (void)analyze("loop", {.valences = {}}); },
       {},
       "",
       {not_asked(Door::program, "there is no empty list of them"),
        not_asked(Door::python, "a report of no valences is one without neighbourhoods")}},
      {"a claim that there is not", invalid_option, claimed("smooth=2"),
       analyzed({"--valence", "3", "--claim", "smooth=2"}), "sublimit.analyze('loop', [3], claims={'smooth': 2})"},
      {"a claim of no number", invalid_option, claimed("regular=two"),
       analyzed({"--valence", "3", "--claim", "regular=two"}),
       "sublimit.analyze('loop', [3], claims={'regular': 'two'})"},
      {"a claim without yes or no", invalid_option, claimed("interpolates=2"),
       analyzed({"--valence", "3", "--claim", "interpolates=2"}),
       "sublimit.analyze('loop', [3], claims={'interpolates': 2})"},
      {"a tolerance that there is not",
       invalid_option,
       [&] { (void)analyze(cube(), "catmull-clark", {.tolerance = {"g3=1"}}); },
       {"analyze", "cube.obj", "-s", "catmull-clark", "--tolerance", "g3=1"},
       "sublimit.analyze_mesh(cube, 'catmull-clark', tolerance={'g3': 1})"},
      {"a report of text",
       format_error,
       [&] { Report("nothing").save_html("report.html"); },
       {},
       "sublimit.Report('nothing')",
       {not_asked(Door::program, "it makes reports and reads none but to verify them"),
        raises("JSONDecodeError", "a report is a dictionary at once", "Expecting value")}},
  });
}

TEST_F(ThreeDoors, RefuseRecipesThatMakeNothing) {
  folder().write("kind.json", R"({"kind": "coone"})");
  folder().write("other.json", R"({"kind": "xyzw"})");
  folder().write("field.json", R"({"kind": "bezier_curve", "points": [[0, 0, 0], [1, 2, 0]], "domian": [0, 1]})");
  folder().write("text.json", "{");
  const auto constructed = [](const std::string& file) -> Words { return {"construct", file, "-o", "out.obj"}; };
  expect_refused({
      {"a misspelt kind", format_error, [&] { (void)construct("kind.json"); }, constructed("kind.json"),
       "sublimit.construct('kind.json')"},
      {"a kind like no other", format_error, [&] { (void)construct("other.json"); }, constructed("other.json"),
       "sublimit.construct('other.json')"},
      {"a misspelt field", format_error, [&] { (void)construct("field.json"); }, constructed("field.json"),
       "sublimit.construct('field.json')"},
      {"no JSON", format_error, [&] { (void)construct("text.json"); }, constructed("text.json"),
       "sublimit.construct('text.json')"},
      {"no such recipe", io_error, [&] { (void)construct("none.json"); }, constructed("none.json"),
       "sublimit.construct('none.json')"},
  });
}

TEST_F(ThreeDoors, RefuseFiles) {
  std::filesystem::create_directory("folder.obj");
  folder().write("mesh.dae", "solid\n");
  folder().write("empty.obj", "");
  folder().write("no_faces.obj", "v 0 0 0\n");
  const auto read = [](const std::string& file) -> Words { return {"info", file}; };
  const auto written = [](const std::string& file) -> Words {
    return {"refine", "cube.obj", "-s", "catmull-clark", "-l", "1", "-o", file};
  };
  expect_refused({
      {"no such file", io_error, [&] { (void)read_mesh("none.obj"); }, read("none.obj"), "sublimit.read('none.obj')"},
      {"a folder",
       io_error,
       [&] { (void)read_mesh("folder.obj"); },
       read("folder.obj"),
       "sublimit.read('folder.obj')",
       {before_it_begins("it is a directory; name a file in it (MESH is a control mesh")}},
      {"another extension", format_error, [&] { (void)read_mesh("mesh.dae"); }, read("mesh.dae"),
       "sublimit.read('mesh.dae')"},
      {"an empty file", format_error, [&] { (void)read_mesh("empty.obj"); }, read("empty.obj"),
       "sublimit.read('empty.obj')"},
      {"a file without faces", invalid_mesh, [&] { (void)read_mesh("no_faces.obj"); }, read("no_faces.obj"),
       "sublimit.read('no_faces.obj')"},
      {"another extension, to write",
       invalid_option,
       [&] { write_mesh("mesh.dae", cube()); },
       written("mesh.dae"),
       "cube.write('mesh.dae')",
       {before_it_begins("cannot write mesh.dae: its name must end in " + words_of_writers())}},
      {"a place that there is not, to write",
       io_error,
       [&] { write_mesh("none/mesh.obj", cube()); },
       written("none/mesh.obj"),
       "cube.write('none/mesh.obj')",
       {before_it_begins("cannot write none/mesh.obj: none is not a directory")}},
      {"a folder, to write",
       io_error,
       [&] { write_mesh("folder.obj", cube()); },
       written("folder.obj"),
       "cube.write('folder.obj')",
       {before_it_begins("cannot write folder.obj: it is a directory; name a file in it")}},
  });
}

// What C++ alone can be given.

TEST(CppDoor, RefusesTheCacheOfAnotherScheme) {
  const auto other = limit_cache("bilinear");
  const auto refused = [&](const std::function<void()>& use) {
    try {
      use();
      ADD_FAILURE() << "nothing thrown";
    } catch (const InvalidParameter& error) {
      expect_parts(error.what(), {"bilinear", "catmull-clark"});
    }
  };
  refused([&] { (void)limit(cube(), "catmull-clark", {.cache = other}); });
  refused([&] { (void)LimitSurface(cube(), "catmull-clark", other); });
  (void)limit(cube(), "bilinear", {.cache = other});
}

/// Results of eight threads that do the same at once.
template <class Make>
void expect_same_by_threads(const char* what, const Make& make) {
  SCOPED_TRACE(what);
  const auto alone = make();
  std::array<std::decay_t<decltype(alone)>, 8> made;
  std::vector<std::thread> threads;
  for (auto& one : made)
    threads.emplace_back([&make, &one] {
      for (int i = 0; i < 4; ++i) one = make();
    });
  for (std::thread& thread : threads) thread.join();
  for (const auto& one : made) EXPECT_TRUE(one == alone);
}

TEST(CppDoor, GivesEightThreadsTheSame) {
  const Mesh mesh = jittered(prism(5));
  const AnyScheme scheme("catmull-clark");
  const auto cache = limit_cache(scheme);
  const LimitSurface surface(mesh, scheme, cache);
  const std::vector<Place> places = surface.grid(5);
  const Table table = bake(mesh, scheme, {.levels = 2, .in_double = true});
  const RayTracer tracer(surface);
  const Points queries = Points::Random(20, 3) * 3;
  expect_same_by_threads("refine", [&] { return refine(mesh, scheme, 2).positions; });
  expect_same_by_threads("limit", [&] { return limit(mesh, scheme, {.levels = 1, .cache = cache}).normals; });
  expect_same_by_threads("LimitSurface", [&] { return LimitSurface(mesh, scheme, cache).evaluate(places).position; });
  expect_same_by_threads("evaluate", [&] { return surface.evaluate(places, 2).duv; });
  expect_same_by_threads("stencils", [&] { return Points(surface.stencils(places).matrices[0] * mesh.positions); });
  expect_same_by_threads("closest", [&] { return closest(surface, queries).distances; });
  expect_same_by_threads("intersect", [&] {
    return intersect(surface, {{.origin = {0.1, 0.2, -5}, .direction = {0, 0, 1}}}, {.all = true}).t;
  });
  expect_same_by_threads("RayTracer", [&] {
    return tracer.trace({.origin = {0.1, 0.2, -5}, .direction = {0, 0, 1}}, {.all = true}).at(0).t;
  });
  expect_same_by_threads("tessellate", [&] { return tessellate(surface, {.chord = 0.01}).points; });
  expect_same_by_threads("Table", [&] {
    std::vector<double> result(table.num_results(3));
    table.apply({mesh.positions.data(), size_t(mesh.positions.size())}, 3, result);
    return result;
  });
  expect_same_by_threads("bake", [&] { return bake(mesh, scheme, {.grid = 3}).num_points(); });
  expect_same_by_threads("info", [&] { return info(mesh, scheme).interior_valences; });
}

}  // namespace
}  // namespace sublimit::testing
