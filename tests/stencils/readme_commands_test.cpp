// SPDX-License-Identifier: Apache-2.0
// Every command line of every document runs as it is written, with the program that ships, in the order of the
// document: a section at a time, in a folder of its own that has the files which the text supposes.
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "stencils/cli_program.h"
#include "stencils/markup.h"
#include "stencils/readme_commands.h"
#include "stencils/readme_files.h"
#include "stencils/summary_rows.h"

namespace sublimit::testing {
namespace {

using Json = nlohmann::ordered_json;
using Path = std::filesystem::path;

/// Command lines that are not run here, and why. Every one must be there.
struct NotRun {
  const char* pattern;
  const char* reason;
};
constexpr NotRun not_run[] = {
    {R"(sublimit .*(\[|\(|\w\|\w).*)", "a synopsis: ReadmeSynopsis holds it to --help"},
    {R"(sublimit info MESH -s SCHEME)", "a synopsis in a sentence, likewise"},
    {R"(\.ci/install-deps.*)", "installs and builds: .ci/run takes the test command from the README and runs it"},
    {R"(sublimit schemes \| head -1)", "ends before its reader has all: CliStreams.ClosedPipeIsAQuietEnd runs it"},
    {R"(sublimit apply cage\.obj level3\.safetensors)", "swapped arguments, an error: CliInputFiles has them"},
    {R"(cmake --install build/release --prefix DIR)", "consumer.lib and consumer.eval install and build against it"},
    {R"(cmake --preset bench.*)", "builds"},
    {R"(cmake --build --preset release --target docs)", "makes the site: full.docs"},
    {R"(sublimit help VERB)", "a synopsis in a sentence: CliHelp asks for the help of every verb"},
    {R"(cmake (--workflow --preset package|--build build/package --target dist))",
     "builds: full.packages, packages.sources"},
    {R"(cmake --install build/release --component \S+)", "packages.components installs each of them"},
    {R"(cmake --build --preset release --target gallery)", "remakes the picture of the first page"},
    {R"(python3 -m pip install \./stencils/python.*)", "python.pip installs it, beside nothing that a user has"},
    {R"(ctest --test-dir .* -L LABEL)", "the tests themselves"},
    {R"(build/\S+/bin/\w+_(bench|accuracy|scaling)( .*)?)", "a benchmark: minutes, on a machine of its own"},
    {R"((mpirun -n \d+|srun) sublimit-mpi .*)", "distributed_tests run them, by other numbers too"},
    {R"(mpirun -n N build/\S+/bin/scale_bench .*)", "a benchmark: minutes, on a machine of its own"},
    {R"(#!/bin/bash\s+#SBATCH --nodes[^]*)", "the head of a script for srun"},
    {R"(build/\S+/bin/fuzz_\w+)",
     "a place of a program; fuzz.obj, fuzz.mesh, fuzz.usd, fuzz.table and fuzz.recipe run them"},
};

/// Why a command line is not run; empty if it is.
std::string reason(const CommandLine& command) {
  for (const NotRun& listed : not_run)
    if (std::regex_match(command.line(), std::regex(listed.pattern))) return listed.reason;
  return "";
}

/// Blocks in other languages, and the tests that run them.
struct Example {
  const char *document, *language;
  long count;
  const char* reason;
};
constexpr Example examples[] = {
    {"README.md", "cpp", 1, "consumer.lib compiles and runs it"},
    {"lib/README.md", "cpp", 4, "consumer.lib compiles and runs them"},
    {"stencils/docs/verbs/bake.md", "cpp", 1, "consumer.lib compiles and runs it"},
    {"eval/README.md", "cpp", 2, "consumer.eval compiles and runs them"},
    {"eval/README.md", "c", 1, "consumer.eval compiles and runs it"},
    {"eval/sublimit/eval/gpu/README.md", "cpp", 2, "consumer.eval compiles and runs them"},
    {"stencils/sublimit/distributed/README.md", "cpp", 1, "consumer.lib compiles and runs it"},
    {"stencils/python/README.md", "python", 1, "tests/python/test_docstrings.py runs it"},
    {"eval/table_format.md", "python", 1, "TableInPython.MakesTheSamePoints runs it"},
};

/// A folder where command lines are typed, and beside it what they print.
class Shell {
 public:
  Path folder() const { return folder_.path(); }

  /// @param variables  set for the command, as in "A=1 B=2"
  Outcome run(const CommandLine& command, const std::string& variables = "") const {
    const Path text = aside_.write("command", command.text), out = aside_ / "out", err = aside_ / "err";
    aside_.write("parallel", stand_in_for_parallel);
    std::filesystem::permissions(aside_ / "parallel", std::filesystem::perms::owner_all);
    const std::string programs = Path(SUBLIMIT_PROGRAM).parent_path().string() + ":" + aside_.path().string();
    const int status =
        std::system(("cd '" + folder().string() + "' && PATH='" + programs + "':\"$PATH\" " + variables + " bash '" +
                     text.string() + "' > '" + out.string() + "' 2> '" + err.string() + "' < /dev/null")
                        .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out), read_file(err)};
  }

 private:
  /// GNU parallel as far as it is needed: a command with {}, then ::: and what {} stands for, all at once.
  static constexpr const char* stand_in_for_parallel =
      "#!/bin/bash\n"
      "command=() jobs=() status=0\n"
      "while [ \"$1\" != ::: ]; do command+=(\"$1\"); shift; done\n"
      "shift\n"
      "for item; do \"${command[@]//'{}'/$item}\" & jobs+=($!); done\n"
      "for job in \"${jobs[@]}\"; do wait \"$job\" || status=1; done\n"
      "exit $status\n";

  TemporaryDirectory folder_, aside_;
};

/// Files that a command line says it writes; names with variables or {} in them are looked at with their section.
std::vector<std::string> outputs(const std::string& command) {
  static const std::regex option(
      R"((?:^|\s)(?:-o|--output|--picture|--report|--json|--matrix|--log|--export|--gallery))"
      R"(\s+([^\s${}]+)(?=\s|$))");
  std::vector<std::string> names;
  for (std::sregex_iterator at(command.begin(), command.end(), option), end; at != end; ++at)
    if ((*at)[1] != "-") names.push_back((*at)[1]);
  return names;
}

/// The file is there and what its name says.
void expect_readable(const Path& file) {
  SCOPED_TRACE(file.filename());
  ASSERT_TRUE(std::filesystem::exists(file));
  ASSERT_FALSE(std::filesystem::is_empty(file));
  const std::string kind = file.extension().string();
  if (kind == ".obj" || kind == ".ply" || kind == ".usda" || kind == ".usdz") {
    const Mesh mesh = read_mesh(file);
    EXPECT_GT(mesh.num_faces(), 0);
    EXPECT_TRUE(mesh.positions.allFinite());
  } else if (kind == ".safetensors") {
    expect_done(sublimit({"verify", file.string()}));
  } else if (kind == ".json") {
    EXPECT_TRUE(Json::accept(read_file(file)));
  } else if (kind == ".npy") {
    EXPECT_GT(NpyArray(file).size(), 0);
  } else if (kind == ".csv") {
    std::ifstream rows(file);  // too long to be read whole
    std::string head, first;
    EXPECT_TRUE(std::getline(rows, head) && std::getline(rows, first));
    EXPECT_EQ(count_of(first, ","), count_of(head, ",")) << head << "\n" << first;
  } else if (kind == ".mtx") {
    EXPECT_TRUE(read_file(file).starts_with("%%MatrixMarket matrix coordinate real general\n"));
  } else if (kind == ".npz") {
    EXPECT_TRUE(read_file(file).starts_with("PK"));
  } else if (kind == ".glb") {
    EXPECT_TRUE(read_file(file).starts_with("glTF"));
  } else if (kind == ".vtu") {
    const std::string text = read_file(file);
    EXPECT_TRUE(text.starts_with("<?xml") && text.ends_with("</VTKFile>\n"));
  } else if (kind == ".step") {
    EXPECT_TRUE(read_file(file).starts_with("ISO-10303-21;"));
  } else if (kind == ".svg" || kind == ".html") {
    const std::string text = read_file(file);
    EXPECT_EQ(read_markup(text).fault, "");
    for (const char* number : {" nan", "\"nan", ",nan"}) EXPECT_EQ(text.find(number), std::string::npos) << number;
  } else {
    EXPECT_TRUE(std::filesystem::is_directory(file)) << "no check for files of this kind";
  }
}

/// A section with command lines: what must be there before, and what else must be true afterwards.
struct Section {
  const char *document, *name;
  std::function<void(const Path&)> prepare, check;
};
void PrintTo(const Section& section, std::ostream* out) { *out << section.document << ": " << section.name; }

void log_has_what_the_document_shows(const Path& folder) {
  Json shown;
  for (const auto& [document, page] : pages())
    for (const CodeBlock& block : page.blocks)
      if (block.lines.front().starts_with("{\"line\"")) shown = Json::parse(block.lines.front());
  std::map<std::string, int> statuses;
  for (int shard = 1; shard <= 8; ++shard) {
    std::istringstream log(read_file(folder / ("log." + std::to_string(shard) + ".jsonl")));
    for (std::string line; std::getline(log, line);) {
      const Json entry = Json::parse(line);
      ++statuses[entry["status"]];
      for (const auto& [key, value] : entry.items()) EXPECT_TRUE(shown.contains(key)) << key << " in " << line;
      for (const auto& [key, value] : shown.items())
        EXPECT_TRUE(entry["status"] != "done" || entry.contains(key)) << "no " << key << " in " << line;
    }
  }
  // Both ways of sharing take the same jobs: the second one finds their tables.
  EXPECT_EQ(statuses, (std::map<std::string, int>{{"done", 2}, {"skipped", 2}}));
  for (const Json& job : shown_jobs()) expect_readable(folder / job["output"].get<std::string>());
}

void frames_are_refined(const Path& folder) {
  const std::vector<std::int64_t> in = NpyArray(folder / "animation.npy").shape(),
                                  out = NpyArray(folder / "refined.npy").shape();
  const Index points = read_mesh(folder / "level3.obj").num_vertices();
  EXPECT_EQ(out, (std::vector<std::int64_t>{in[0], points, in[2]}));
}

void first_vertices_are_the_targets(const Path& folder) {
  const Points surface = read_mesh(folder / "surface.obj").positions, targets = cube().positions;
  ASSERT_GE(surface.rows(), targets.rows());
  EXPECT_LE((surface.topRows(targets.rows()) - targets).cwiseAbs().maxCoeff(), reference * diagonal(targets));
}

/// The table makes the file's own vertices, in float, and has its triangles.
void pose_has_the_triangles(const Path& folder) {
  const Mesh triangles = read_mesh(folder / "triangles.ply"), pose = read_mesh(folder / "pose.ply");
  EXPECT_EQ(pose.face_vertices, triangles.face_vertices);
  ASSERT_EQ(pose.num_vertices(), triangles.num_vertices());
  const double size = triangles.positions.cwiseAbs().maxCoeff();
  EXPECT_LE((pose.positions - triangles.positions).cwiseAbs().maxCoeff(), float_reference * size);
}

/// The recipe that the document shows.
void write_spindle(const Path& folder) {
  run_demo(folder);
  for (const auto& [document, page] : pages())
    for (const CodeBlock& block : page.blocks)
      if (block.section == "CAD" && block.lines.front().starts_with("{")) {
        std::ofstream file(folder / "spindle.json");
        for (const std::string& line : block.lines)
          if (line.starts_with("{")) file << line << "\n";
      }
}

const std::vector<Section>& sections() {
  static const std::vector<Section> all = {
      {"README.md", "In the shell", {}, {}},
      {"stencils/docs/tour.md", "Five minutes", {}, {}},
      {"stencils/docs/guides/closest.md", "Closest points", run_demo, {}},
      {"stencils/docs/program.md", "The program", run_demo, {}},
      {"stencils/docs/curves.md", "Curves", write_polygon, {}},
      {"stencils/docs/verbs/info.md", "Area, volume, inertia", write_spindle, {}},
      {"stencils/docs/verbs/tessellate.md", "Triangles", write_spindle, pose_has_the_triangles},
      {"stencils/docs/verbs/flatten.md", "Scenes of USD", write_cages, {}},
      {"stencils/docs/verbs/step.md", "CAD", write_spindle, {}},
      {"stencils/docs/verbs/bake.md", "Tables", write_cages, frames_are_refined},
      {"stencils/docs/verbs/bake.md", "Many tables", write_cages, log_has_what_the_document_shows},
      {"stencils/docs/verbs/analyze.md", "Continuity reports", run_demo,
       [](const Path& folder) { expect_rows_name_their_valences(Json::parse(read_file(folder / "schemes.json"))); }},
      {"stencils/docs/verbs/fit.md", "Surfaces through given data", write_cube_with_normals,
       first_vertices_are_the_targets},
      {"stencils/docs/verbs/schemes.md",
       "Gallery",
       {},
       [](const Path& folder) {
         for (const char* name :
              {"DIR/overview.svg", "DIR/patches.svg", "DIR/patches.json", "DIR/index.html", "DIR/measures.json"})
           expect_readable(folder / name);
       }},
  };
  return all;
}

std::vector<CommandLine> commands_run_in(const Section& section) {
  std::vector<CommandLine> commands;
  for (const CommandLine& command : command_lines())
    if (command.document == section.document && command.section == section.name && reason(command).empty())
      commands.push_back(command);
  return commands;
}

class ReadmeSection : public ::testing::TestWithParam<Section> {};

TEST_P(ReadmeSection, RunsAsItIsWritten) {
  const Section& section = GetParam();
  const Shell shell;
  if (section.prepare) section.prepare(shell.folder());
  for (const CommandLine& command : commands_run_in(section)) {
    SCOPED_TRACE(command.text);
    const std::vector<std::string> files = outputs(command.text);
    const auto expect_well = [&](const Outcome& outcome) {
      EXPECT_EQ(outcome.status, 0);
      EXPECT_EQ(outcome.err, "");
      EXPECT_FALSE(outcome.out.empty() && files.empty() && command.text.find('>') == std::string::npos);
    };
    const auto begin = std::chrono::steady_clock::now();
    const JobArray array = job_array(command.text);
    if (array.last == 0) expect_well(shell.run(command));
    for (int task = array.first; array.last > 0 && task <= array.last; ++task)
      expect_well(shell.run(command, array.variables(task)));
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    std::printf("%6.1f s  %s\n", seconds.count(), command.text.c_str());
    for (const std::string& name : files) expect_readable(shell.folder() / name);
  }
  if (section.check) section.check(shell.folder());
}

INSTANTIATE_TEST_SUITE_P(Every, ReadmeSection, ::testing::ValuesIn(sections()), [](const auto& tested) {
  std::string name = tested.param.name;
  std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
  return name;
});

TEST(ReadmeCommands, AreAllRunOrListed) {
  const std::vector<CommandLine> all = command_lines();
  EXPECT_GE(all.size(), 30u);
  std::set<std::string> run;  // a document may say what another one does
  for (const Section& section : sections())
    for (const CommandLine& command : commands_run_in(section)) run.insert(command.text);
  for (const CommandLine& command : all)
    EXPECT_TRUE(run.contains(command.text) || !reason(command).empty())
        << command.document << ", " << command.section << ": no test runs\n    " << command.text;
  for (const NotRun& listed : not_run)
    EXPECT_TRUE(std::ranges::any_of(
        all, [&](const CommandLine& c) { return std::regex_match(c.line(), std::regex(listed.pattern)); }))
        << "no document has " << listed.pattern;
  for (const Section& section : sections())
    EXPECT_FALSE(commands_run_in(section).empty()) << section.document << ", " << section.name;
}

TEST(ReadmeCommands, ExamplesInOtherLanguagesAreRunElsewhere) {
  std::map<std::pair<std::string, std::string>, long> found, listed;
  for (const auto& [document, page] : pages())
    for (const CodeBlock& block : page.blocks)
      if (!block.language.empty() && commands_of(block).empty()) ++found[{document, block.language}];
  for (const Example& example : examples) listed[{example.document, example.language}] = example.count;
  EXPECT_EQ(found, listed) << "an example is new or gone; name the test that runs it";
}

TEST(ReadmeCommands, AreSeenWhereverTheyStand) {
  const std::string text =
      "# One\n\n    sublimit info a.obj  # why\n    sublimit refine \\\n      -o b.obj\n\n- a list\n    that goes on\n"
      "## Two\n\n    #!/bin/bash\n    #SBATCH x\n    sublimit demo\n\n```bash\nparallel true ::: 1\n```\n";
  std::vector<std::string> seen, in;
  for (const CodeBlock& block : read_page("a.md", text).blocks)
    for (const CommandLine& command : commands_of(block)) seen.push_back(command.text), in.push_back(command.section);
  EXPECT_EQ(seen, (std::vector<std::string>{"sublimit info a.obj  # why", "sublimit refine \\\n  -o b.obj",
                                            "#!/bin/bash\n#SBATCH x\nsublimit demo", "parallel true ::: 1"}));
  EXPECT_EQ(in, (std::vector<std::string>{"One", "One", "Two", "Two"}));
  EXPECT_EQ(outputs("sublimit fit a -o b.obj --report c.json --log l.$I.jsonl --picture d.svg"),
            (std::vector<std::string>{"b.obj", "c.json", "d.svg"}));
}

}  // namespace
}  // namespace sublimit::testing
