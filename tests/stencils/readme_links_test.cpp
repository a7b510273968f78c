// SPDX-License-Identifier: Apache-2.0
// What documents point to is there: files and sections of links and pictures, sources that they name. The first page is
// short.
#include <gtest/gtest.h>

#include <set>

#include "stencils/readme_commands.h"

namespace sublimit::testing {
namespace {

namespace fs = std::filesystem;
const fs::path root = SUBLIMIT_SOURCE;

/// Targets of links and pictures, those of code left out.
std::vector<std::string> links_in(const std::string& paragraph) {
  static const std::regex code("`[^`]*`"), link(R"(\]\(([^)\s]+)\))");
  const std::string text = std::regex_replace(paragraph, code, "");
  std::vector<std::string> links;
  for (std::sregex_iterator at(text.begin(), text.end(), link), end; at != end; ++at) links.push_back((*at)[1]);
  return links;
}

/// Names of sources and documents in code: `mesh/topology.h`, `<sublimit/schemes/schemes.h>`.
std::vector<std::string> files_in(const std::string& paragraph) {
  static const std::regex file(R"((?:^|[\s<])([\w./]+\.(?:h|cpp|cmake|md|py))(?=[>\s]|$))");
  std::vector<std::string> files;
  for (const std::string& span : code_spans(paragraph))
    for (std::sregex_iterator at(span.begin(), span.end(), file), end; at != end; ++at) files.push_back((*at)[1]);
  return files;
}

/// What a section is called in a link: "What is exact, and what is not" -> "what-is-exact-and-what-is-not".
std::string anchor(const std::string& section) {
  std::string name;
  for (const char c : section)
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (c == ' ')
      name += '-';
  return name;
}

/// Anchors of a document's sections.
std::set<std::string> anchors(const std::string& document) {
  std::set<std::string> names;
  for (const auto& [name, page] : pages())
    if (name == document)
      for (const Paragraph& paragraph : page.paragraphs) names.insert(anchor(paragraph.section));
  return names;
}

/// True for the pictures of the manual that its site makes; full.docs fails if one of them is not there then.
bool is_made(const std::string& picture) {
  static const std::string site = read_file(root / "stencils/docs/pages.py");
  return site.find("pictures / \"" + picture + '"') != std::string::npos;
}

TEST(ReadmeLinks, LeadToFilesAndSections) {
  int seen = 0;
  for (const auto& [document, page] : pages())
    for (const Paragraph& paragraph : page.paragraphs)
      for (const std::string& link : links_in(paragraph.text)) {
        if (link.starts_with("https://")) continue;
        SCOPED_TRACE(document + ", " + paragraph.section + ": " + link);
        ++seen;
        const size_t hash = link.find('#');
        const std::string file = link.substr(0, hash);
        const fs::path target =
            file.empty() ? fs::path(document) : (fs::path(document).parent_path() / file).lexically_normal();
        if (target.parent_path() == "stencils/docs/pictures")
          EXPECT_TRUE(is_made(target.filename().string())) << "the site does not make " << target;
        else
          EXPECT_TRUE(fs::exists(root / target)) << "there is no " << target;
        EXPECT_TRUE(hash == std::string::npos || anchors(target.string()).contains(link.substr(hash + 1)))
            << "no such section";
      }
  EXPECT_GE(seen, 50);
  EXPECT_TRUE(is_made("fit.svg"));
  EXPECT_FALSE(is_made("none.svg"));
  EXPECT_EQ(links_in("![a](b.svg) and [c](d.md#e), `[x](y)`"), (std::vector<std::string>{"b.svg", "d.md#e"}));
  EXPECT_EQ(anchor("What is exact, and what is not"), "what-is-exact-and-what-is-not");
}

TEST(ReadmeLinks, SourcesThatAreNamedExist) {
  int seen = 0;
  for (const auto& [document, page] : pages()) {
    if (document == "CHANGELOG.md") continue;  // which also tells what once was
    for (const Paragraph& paragraph : page.paragraphs)
      for (const std::string& file : files_in(paragraph.text)) {
        ++seen;
        // As the document's own folder sees it, or an #include, or a path in a room of the house.
        bool found = fs::exists(root / fs::path(document).parent_path() / file);
        for (const char* folder :
             {".", "lib", "eval", "stencils", "lib/sublimit", "eval/sublimit", "stencils/sublimit"})
          found = found || fs::exists(root / folder / file);
        EXPECT_TRUE(found) << document << ", " << paragraph.section << ": there is no " << file;
      }
  }
  EXPECT_GE(seen, 100);
  EXPECT_EQ(files_in("`<sublimit/a.h>` `b/c.h` `f(x.h)`"), (std::vector<std::string>{"sublimit/a.h", "b/c.h"}));
}

TEST(ReadmeLinks, TheFirstPageIsShort) { EXPECT_LE(fs::file_size(root / "README.md"), 12 * 1024u); }

}  // namespace
}  // namespace sublimit::testing
