// SPDX-License-Identifier: Apache-2.0
#pragma once
// Pages in a real browser, which runs their scripts, and one of the tests' own.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "sublimit/base/detail/read_file.h"
#include "support/skip.h"
#include "support/temporary_directory.h"

/// Skips or fails a test without a browser.
#define SUBLIMIT_NEEDS_BROWSER SUBLIMIT_NEEDS_PROGRAM(std::system("command -v chromium > /dev/null") == 0, "chromium")

namespace sublimit::testing {

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// A page with one of the tests' scripts at its end.
inline std::string with_script(const std::string& page, const std::string& script, const std::string& before = {}) {
  return replaced(page, "</body>",
                  "<script>" + before + read_file(SUBLIMIT_SOURCE "/tests/stencils/" + script) + "</script></body>");
}

/// Opens pages beside each other, and returns what they post: "checked NAME: 0 wrong".
class Browser {
 public:
  void add(const std::string& name, const std::string& page, int width = 1280) {
    directory_.write(name + ".html", page);
    frames_ +=
        "<iframe src=\"" + name + ".html\" style=\"width:" + std::to_string(width) + "px;height:900px\"></iframe>";
  }
  std::string read() const {
    directory_.write(
        "all.html",
        "<body><pre></pre><script>onmessage = e => { document.querySelector('pre').textContent += e.data + "
        "'\\n'; };</script>" +
            frames_);
    // No sandbox, so that root may look; nothing but the pages is loaded, and a profile of its own is gone afterwards.
    const std::string command =
        "cd '" + directory_.path().string() +
        "' && timeout --kill-after=10 240 chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
        "--disable-background-networking --disable-component-update --disable-sync --user-data-dir=profile "
        "--virtual-time-budget=60000 --enable-logging=stderr --dump-dom all.html > dom 2> log";
    EXPECT_EQ(std::system(command.c_str()), 0) << read_file(directory_ / "log");
    const std::string dom = read_file(directory_ / "dom"), log = read_file(directory_ / "log");
    EXPECT_EQ(log.find("CONSOLE"), std::string::npos) << log;
    return dom.substr(0, dom.find("</pre>"));
  }

 private:
  TemporaryDirectory directory_;
  std::string frames_;
};

}  // namespace sublimit::testing
