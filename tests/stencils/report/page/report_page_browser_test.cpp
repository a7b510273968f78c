// SPDX-License-Identifier: Apache-2.0
// Pages in a real browser: narrow, wide, and with the rules for paper, nothing is wider than the page, cut off, or on
// top of something else; their script makes of a report what it says, and copes with any; the console stays silent.
#include <gtest/gtest.h>

#include <string>

#include "stencils/browser.h"
#include "stencils/cli_program.h"
#include "stencils/report_sample.h"
#include "sublimit/report/page/page.h"

namespace sublimit::testing {
namespace {

const std::string shapes =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 2 0 0.125\nv 2 1 0.125\ncstype bezier\ndeg 1 1\n"
    "surf 0 1 0 1 1 2 3 4\nparm u 0 1\nparm v 0 1\nend\nsurf 0 1 0 1 2 5 4 6\nparm u 0 1\nparm v 0 1\nend\n"
    "cstype bezier\ndeg 1\ncurv 0 2 1 2 4\nparm u 0 1 2\nend\n";
const std::string recipes =
    R"({"recipes": [{"kind": "ruled", "name": "a < b", "c0": {"degree": 1, "knots": [0, 0, 1, 1], "points": [[0, 0, 0], [1, 0, 1]]},
        "c1": {"degree": 1, "knots": [0, 0, 1, 1], "points": [[0, 1, 1], [1, 1, 0]]}}]})";

TEST(ReportPage, FitsNarrowAndWideScreensAndPaperInChromium) {
  Browser browser;
  SUBLIMIT_NEEDS_BROWSER;
  int expected = 0;
  for (const auto& [kind, report] : {std::pair{"schemes", sample_schemes(4, 5)},
                                     {"mesh", sample_mesh()},
                                     {"curve", sample_curve()},
                                     {"sweep", sample_sweep()}}) {
    const std::string page = with_script(report_page(report), "measure_page.js");
    browser.add(std::string(kind) + "-narrow", page, 400);
    browser.add(std::string(kind) + "-wide", page);
    browser.add(std::string(kind) + "-paper", replaced(page, "@media print", "@media all"), 680);
    expected += 3;
  }
  // A page that is known to be wrong: the measure must see it.
  browser.add(
      "bad",
      with_script("<!DOCTYPE html><main><div style=\"width:900px\">x</div></main><body></body>", "measure_page.js"),
      400);
  const std::string found = browser.read();
  int fine = 0;
  for (std::size_t at = 0; (at = found.find(": 0 wrong", at)) != std::string::npos; ++at) ++fine;
  EXPECT_EQ(fine, expected) << found;
  EXPECT_NE(found.find("measured bad.html: "), std::string::npos) << found;
  EXPECT_EQ(found.find("measured bad.html: 0 wrong"), std::string::npos) << found;
}

TEST(ReportPage, SaysWhatItsReportHasInChromium) {
  Browser browser;
  SUBLIMIT_NEEDS_BROWSER;
  const TemporaryDirectory directory;
  const std::string out = (directory / "page.html").string();
  const auto analyzed = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "analyze");
    arguments.insert(arguments.end(), {"-o", out});
    expect_done(sublimit(arguments));
    return read_file(out);
  };
  const std::string obj = directory.write("shape.obj", shapes).string(),
                    json = directory.write("r.json", recipes).string();
  struct Said {
    const char* name;
    std::string page;
    std::vector<std::string> parts;
  };
  const std::vector<Said> all = {
      {"schemes",
       report_page(sample_schemes(3, 5)),
       {"How smooth are subdivision schemes?", "How to read it", "id=\"summary\"", "id=\"scheme-catmull-clark\"",
        "id=\"scheme-loop\"", "id=\"scheme-four-point\"", "id=\"scheme-catmull-clark-vertex-3\"",
        "id=\"scheme-catmull-clark-vertex-5\" open", "id=\"scheme-loop-border-3\"", "id=\"scheme-loop-corner-4\"",
        "id=\"scheme-loop-dart-5\"", "<b>The mask.</b>", "<b>Characteristic map.</b>", "<b>Gauss curvature.</b>"}},
      {"sweep", report_page(sample_sweep()), {", by tension?", "<b>Smoothness over the option.</b>"}},
      {"curve", report_page(sample_curve()), {"How smooth is this curve?", "<b>The curve</b>"}},
      {"mesh",
       report_page(sample_mesh()),
       {"id=\"surface\"", "id=\"warnings\"", "id=\"worst\"", "id=\"inventory\"", "id=\"seams\"", "id=\"curvature\"",
        "<b>Zebra stripes</b>", "<b>Isophotes</b>", "G<sup>1</sup> deviations listed below</b> by size, in degrees"}},
      {"scheme",
       analyzed({"-s", "butterfly", "--valence", "3-4,8"}),
       {"How smooth is butterfly?", "</span> at valence 4</td>", "C<sup>1</sup> disproved at valence 3, 8",
        "id=\"key\""}},
      {"shapes",
       analyzed({obj, "--tolerance", "g1=91deg"}),
       {"How smooth is shape.obj?", "<section id=\"seams\">", "<section id=\"vertices\">", "<section id=\"curves\">",
        "<section id=\"patches\">", "G⁰: ", "combs of the curvature", "✓ within", "largest angle 7.125 degrees"}},
      {"recipes", analyzed({json}), {"How smooth is r.json?", "recipe 0 'a &lt; b' (ruled)"}}};
  for (const auto& [name, page, parts] : all)
    browser.add(name, with_script(page, "check_page.js", "const expected = " + SampleJson(parts).dump() + ";\n"));
  browser.add("wrong", with_script(all[2].page, "check_page.js", "const expected = [\"How rough?\"];\n"));
  const std::string found = browser.read();
  for (const Said& said : all)
    EXPECT_NE(found.find("checked " + std::string(said.name) + ".html: 0 wrong\n"), std::string::npos) << said.name;
  EXPECT_NE(found.find("checked wrong.html: 1 wrong"), std::string::npos);
  if (HasFailure()) std::puts(found.c_str());
}

}  // namespace
}  // namespace sublimit::testing
