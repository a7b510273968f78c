// SPDX-License-Identifier: Apache-2.0
// Pages in a real browser: narrow, wide, and with the rules for paper, nothing is wider than the page, cut off, or on
// top of something else, and the console stays silent.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "stencils/report_sample.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/report/page/page.h"
#include "support/skip.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

TEST(ReportPage, FitsNarrowAndWideScreensAndPaperInChromium) {
  SUBLIMIT_NEEDS_PROGRAM(std::system("command -v chromium > /dev/null") == 0, "chromium");
  const TemporaryDirectory directory;
  const std::string script =
      "<script>" + read_file(SUBLIMIT_SOURCE "/tests/stencils/measure_page.js") + "</script></body>";
  struct Sheet {
    const char* name;
    int width;
    bool paper;
  };
  std::string frames;
  int expected = 0;
  for (const auto& [kind, report] : {std::pair{"schemes", sample_schemes(4, 5)},
                                     {"mesh", sample_mesh()},
                                     {"curve", sample_curve()},
                                     {"sweep", sample_sweep()}}) {
    const std::string page = replaced(report_page(report), "</body>", script);
    for (const Sheet& sheet : {Sheet{"narrow", 400, false}, Sheet{"wide", 1280, false}, Sheet{"paper", 680, true}}) {
      const std::string file = std::string(kind) + "-" + sheet.name + ".html";
      directory.write(file, sheet.paper ? replaced(page, "@media print", "@media all") : page);
      frames +=
          "<iframe src=\"" + file + "\" style=\"width:" + std::to_string(sheet.width) + "px;height:900px\"></iframe>";
      ++expected;
    }
  }
  // A page that is known to be wrong: the measure must see it.
  directory.write("bad.html", "<!DOCTYPE html><main><div style=\"width:900px\">x</div></main><body>" + script);
  directory.write("all.html",
                  "<body><pre></pre><script>onmessage = e => { document.querySelector('pre').textContent += e.data + "
                  "'\\n'; };</script>" +
                      frames + "<iframe src=\"bad.html\" style=\"width:400px\"></iframe>");
  // No sandbox, so that root may look; nothing but the pages is loaded, and a profile of its own is gone afterwards.
  const std::string command = "cd '" + directory.path().string() +
                              "' && timeout --kill-after=10 240 chromium --headless --no-sandbox --disable-gpu "
                              "--disable-quic --no-first-run --disable-background-networking "
                              "--disable-component-update --disable-sync --user-data-dir=profile "
                              "--virtual-time-budget=30000 --enable-logging=stderr --dump-dom all.html > dom 2> log";
  ASSERT_EQ(std::system(command.c_str()), 0) << read_file(directory / "log");
  const std::string dom = read_file(directory / "dom"), log = read_file(directory / "log");
  const std::string found = dom.substr(0, dom.find("</pre>"));
  int fine = 0;
  for (std::size_t at = 0; (at = found.find(": 0 wrong", at)) != std::string::npos; ++at) ++fine;
  EXPECT_EQ(fine, expected) << found;
  EXPECT_NE(found.find("measured bad.html: "), std::string::npos) << found;
  EXPECT_EQ(found.find("measured bad.html: 0 wrong"), std::string::npos) << found;
  EXPECT_EQ(log.find("CONSOLE"), std::string::npos) << log;
}

}  // namespace
}  // namespace sublimit::testing
