// SPDX-License-Identifier: Apache-2.0
// `sublimit analyze FILE.obj` without a scheme: the report as files and on the terminal, exit codes, what is refused.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "meshes/free_form_shapes.h"
#include "stencils/cli_program.h"
#include "stencils/markup.h"

namespace sublimit::testing {
namespace {

using FreeFormJson = nlohmann::ordered_json;
using FreeFormKeys = std::vector<std::string>;

FreeFormKeys keys_of(const FreeFormJson& object) {
  FreeFormKeys all;
  for (const auto& [key, value] : object.items()) all.push_back(key);
  return all;
}

/// Two unit squares that meet at x = 1 in an angle whose tangent is 1/8: 7.125 degrees.
const std::string kink =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 2 0 0.125\nv 2 1 0.125\ncstype bezier\ndeg 1 1\n"
    "surf 0 1 0 1 1 2 3 4\nparm u 0 1\nparm v 0 1\nend\nsurf 0 1 0 1 2 5 4 6\nparm u 0 1\nparm v 0 1\nend\n";

class ShapeFile {
 public:
  explicit ShapeFile(const FreeForm& shapes) { write_free_form(obj, shapes); }
  explicit ShapeFile(const std::string& text) { directory.write("shape.obj", text); }
  std::string path(std::string_view name) const { return (directory / name).string(); }
  Outcome analyzed(std::vector<std::string> more = {}) const {
    std::vector<std::string> all{"analyze", obj};
    all.insert(all.end(), more.begin(), more.end());
    return sublimit(all);
  }
  FreeFormJson report(int status = 0, std::vector<std::string> more = {}, bool warned = false) const {
    more.insert(more.end(), {"--json", path("report.json")});
    const Outcome outcome = analyzed(more);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    if (!warned) {
      EXPECT_EQ(outcome.err, "");
    }
    return FreeFormJson::parse(read_file(path("report.json")));
  }

  TemporaryDirectory directory;
  const std::string obj = (directory / "shape.obj").string();
};

TEST(CliAnalyzeFreeForm, TheReportHasEveryKeyOfTheFormatInOrder) {
  const ShapeFile file(kink + "cstype bezier\ndeg 1\ncurv 0 2 1 2 4\nparm u 0 1 2\nend\n");
  const FreeFormJson report = file.report();
  EXPECT_EQ(keys_of(report), (FreeFormKeys{"format", "version", "program", "kind", "free_form"}));
  EXPECT_EQ(report["kind"], "free-form");
  const FreeFormJson& found = report["free_form"];
  for (const char* list : {"seams", "joints"}) ASSERT_FALSE(found[list]["list"].empty()) << list;
  EXPECT_EQ(keys_of(found),
            (FreeFormKeys{"file", "counts", "box", "verdict", "tolerance", "within_tolerance", "beyond", "patches",
                          "seams", "vertices", "curves", "joints", "surface", "isolines", "net", "warnings"}));
  EXPECT_EQ(keys_of(found["seams"]), (FreeFormKeys{"kinds", "smooth_lines", "boundary_loops", "deviation", "list"}));
  EXPECT_EQ(keys_of(found["seams"]["list"][0]),
            (FreeFormKeys{"kind", "lines", "part", "same_orientation", "columns_c", "measured", "exact", "g0",
                          "g1_degrees", "g2", "curvature_jump", "at", "points"}));
  EXPECT_EQ(keys_of(found["vertices"][0]),
            (FreeFormKeys{"corners", "interior", "degenerate", "plane_angle_degrees", "tangent_plane", "twist_residual",
                          "enclosure", "can_be_enclosed", "at"}));
  EXPECT_EQ(keys_of(found["joints"]["list"][0]),
            (FreeFormKeys{"kind", "curves", "parameters", "reversed", "measured", "exact", "g0", "g1_degrees", "g2",
                          "curvature_jump", "ratios", "at"}));
  EXPECT_EQ(found["verdict"]["seams"]["says"],
            "G^0 at its only seam: largest angle 7.125 degrees between patch 0 and patch 1");
  EXPECT_EQ(found["verdict"]["joints"]["g"], 0);
  EXPECT_EQ(found["seams"]["list"][0]["lines"], FreeFormJson::parse(R"([{"patch":0,"u":1.0},{"patch":1,"u":0.0}])"));
  EXPECT_EQ(found["seams"]["kinds"]["boundary"], 6);
}

TEST(CliAnalyzeFreeForm, PageAndPictureAreWellFormed) {
  for (const FreeForm& shapes : {teapot(), free_form_of({unit_sphere(), torus()})}) {
    const ShapeFile file(shapes);
    const std::string page = file.path("page.html"), picture = file.path("picture.svg");
    EXPECT_EQ(file.analyzed({"-o", page, "--picture", picture}).status, 0);
    const std::string text = read_file(page);
    const Markup markup = read_markup(text);
    EXPECT_EQ(markup.fault, "");
    for (const auto& [id, times] : markup.ids) EXPECT_EQ(times, 1) << id;
    expect_parts(text, {R"("file":"shape.obj")", R"("seams":{"kinds")", R"("patches":[{)", "G²: "});
    EXPECT_EQ(read_markup(read_file(picture)).fault, "");
  }
  const ShapeFile curve(
      "v 0 0 0\nv 1 2 0\nv 2 0 0\nv 3 -2 0\nv 4 1 0\ncstype bezier\ndeg 2\ncurv 0 2 1 2 3 4 5\n"
      "parm u 0 1 2\nend\n");
  const std::string page = curve.path("page.html");
  EXPECT_EQ(curve.analyzed({"-o", page}).status, 0);
  expect_parts(read_file(page), {R"("curves":[{)", R"("figures":{"shapes":{"svg":"\u003csvg)"});
}

TEST(CliAnalyzeFreeForm, TheExitStatusIsTheVerdictOnTolerances) {
  const ShapeFile file(kink);
  expect_parts(expect_done(file.analyzed()).out, {"2 surfaces", "largest angle 7.125 degrees"});
  EXPECT_EQ(expect_done(file.analyzed({"--quiet"})).out, "");
  expect_done(file.analyzed({"--tolerance", "g1=7.2deg"}));
  const Outcome beyond = file.analyzed({"--tolerance", "g1=7deg"});
  EXPECT_EQ(beyond.status, 1);
  expect_parts(beyond.out, {"beyond the tolerance: g1 7.13", "seam 0"});
  const FreeFormJson report = file.report(1, {"--tolerance", "g1=7deg", "--tolerance", "g0=1e-9"});
  EXPECT_EQ(report["free_form"]["within_tolerance"], false);
  ASSERT_EQ(report["free_form"]["beyond"].size(), 1u);
  EXPECT_EQ(report["free_form"]["beyond"][0]["seam"], 0);
  EXPECT_EQ(report["free_form"]["tolerance"]["g1_degrees"], 7);
}

TEST(CliAnalyzeFreeForm, VerifyKnowsTheReport) {
  const ShapeFile file(kink);
  file.report();
  expect_done(sublimit({"verify", file.path("report.json")}));
}

TEST(CliAnalyzeFreeForm, AMeshBesidesNeedsAScheme) {
  const ShapeFile file(kink + "f 1 2 4 3\n");
  const Outcome outcome = file.analyzed();
  EXPECT_EQ(outcome.status, 0);
  expect_parts(outcome.err, {"1 faces of a mesh too, which need -s SCHEME"});
  expect_parts(outcome.out, {"a mesh too, of 1 faces"});
  const FreeFormJson mesh = file.report(0, {"-s", "catmull-clark"}, true);
  EXPECT_EQ(mesh["kind"], "mesh");
}

TEST(CliAnalyzeFreeForm, RefusesWhatItCannotUse) {
  const ShapeFile file(kink), plain("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
      parameters("vp 0 0\nvp 1 1\ncstype bezier\ndeg 1\ncurv2 1 2\nparm u 0 1\nend\n");
  for (const char* tolerance : {"g3=1", "g1", "g1=-1"})
    expect_failure(file.analyzed({"--tolerance", tolerance}), 2, {tolerance, "g1=0.1deg"});
  expect_failure(file.analyzed({"--valence", "3-5"}), 2, {"--valence is for schemes", "free-form shapes"});
  expect_failure(file.analyzed({"--option", "degree=3"}), 2, {"--option is for schemes"});
  expect_failure(file.analyzed({"-o", file.path("r.pdf")}), 2, {"r.pdf", ".html or .htm"});
  expect_failure(plain.analyzed(), 2, {"name a scheme with -s", "free-form curves or surfaces"});
  expect_failure(parameters.analyzed(), 3, {"neither curves in space nor surfaces"});
  expect_failure(ShapeFile("v 0 0 0\ncstype bezier\ndeg 1\ncurv 0 1 1 2\nparm u 0 1\nend\n").analyzed(), 3,
                 {"shape.obj:4"});
}

}  // namespace
}  // namespace sublimit::testing
