// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/gallery/gallery_page.h"

#include "sublimit/stencils/picture/svg.h"

namespace sublimit::gallery {
namespace {

using svg::escaped;

constexpr const char* head = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Subdivision schemes side by side</title>
<style>
:root { --ink: #2b2f38; --quiet: #6a6f7a; --line: #dedad0; --paper: #fbfaf7; --panel: #f4f2ed }
body { margin: 0 auto; max-width: 1240px; padding: 28px 24px 80px; background: var(--paper); color: var(--ink);
  font: 15px/1.5 system-ui, sans-serif }
h1 { font-size: 30px; line-height: 1.2; margin: 12px 0 4px }
h2 { font-size: 21px; margin: 48px 0 12px; padding-top: 12px; border-top: 1px solid var(--line) }
p { max-width: 860px; margin: 8px 0 }
nav { margin: 14px 0 22px; color: var(--quiet) }
a { color: #33658a }
nav a { margin-right: 18px; text-decoration: none }
img { display: block; max-width: 100%; height: auto }
.row { display: grid; grid-template-columns: 270px 1fr; gap: 20px; align-items: center; margin: 14px 0 }
.row h3 { font: 600 16px/1.3 ui-monospace, monospace; margin: 0 }
.source { color: var(--quiet); font-size: 12.5px; line-height: 1.35; margin: 3px 0 8px }
dl { display: grid; grid-template-columns: auto 1fr; gap: 1px 12px; margin: 0; font-size: 12.5px }
dt { color: var(--quiet) }
dd { margin: 0; font-variant-numeric: tabular-nums }
table { border-collapse: collapse; margin: 14px 0; font-size: 13px; font-variant-numeric: tabular-nums }
th { text-align: left; font-weight: 600 }
td:not(:last-child) { white-space: nowrap }
th, td { padding: 3px 18px 3px 0; border-bottom: 1px solid var(--line); vertical-align: top }
@media (max-width: 800px) { .row { grid-template-columns: 1fr } }
</style>
</head>
<body>
)";

constexpr const char* how = R"(<h2 id="how">How it is measured</h2>
<p>Surfaces: the limit positions of a fine level's points, joined as on that level; they lie on the limit surface, only the faces
between them are chords. Lengths are divided by the diameter of the cage. Brown wire is the cage. Blue schemes approximate it, brown
ones interpolate.</p>
<p><b>Volume</b>: inside the limit, over the volume inside the cage. <b>Distance</b>: from the limit to the cage, the mean over its area
and the largest. <b>Symmetry defect</b>: the largest distance between the limit and any of its images under the symmetries of the cage's
points (48 of the cube, 24 of the tetrahedron); cutting the cube's faces into triangles takes some of them away. <b>Bending</b>: the
integral of squared mean curvature over that of a sphere, by cotangents, on meshes of about a sixteenth, a fourth and all of the faces:
1 for a sphere; three numbers that agree are the energy of the surface, numbers that grow say that it has none.</p>
)";

std::string image(const std::string& file, const std::string& description) {
  return "<img src=\"" + escaped(file) + "\" alt=\"" + escaped(description) + "\">";
}

std::string row(const PageRow& row) {
  std::string html = "<div class=\"row\"><div><h3>" + escaped(row.name) + "</h3><p class=\"source\">" +
                     escaped(row.source) + "</p><dl>";
  for (const auto& [what, value] : row.numbers) html += "<dt>" + escaped(what) + "</dt><dd>" + escaped(value) + "</dd>";
  return html + "</dl></div>" + image(row.picture, row.name + ", level by level") + "</div>\n";
}

std::string table(const PageTable& table) {
  if (table.rows.empty()) return {};
  const auto line = [](const std::vector<std::string>& cells, const std::string& tag) {
    std::string html = "<tr>";
    for (const std::string& cell : cells) html += "<" + tag + ">" + escaped(cell) + "</" + tag + ">";
    return html + "</tr>\n";
  };
  std::string html = "<table>\n" + line(table.columns, "th");
  for (const std::vector<std::string>& cells : table.rows) html += line(cells, "td");
  return html + "</table>\n";
}

}  // namespace

std::string page(const std::string& overview, std::span<const PageSection> sections) {
  std::string html = head;
  html +=
      "<h1>Subdivision schemes side by side</h1>\n<p>Every scheme on the same cages, level by level and in the limit, "
      "made by "
      "<code>sublimit schemes --gallery</code>. All of that comes from the schemes' masks; the numbers are in "
      "<a href=\"measures.json\">measures.json</a>. At the end, classical surfaces with their nets.</p>\n<nav><a href=\"#how\">How it is measured</a>";
  for (const PageSection& section : sections)
    html += "<a href=\"#" + escaped(section.id) + "\">" + escaped(section.title) + "</a>";
  html += "</nav>\n" + image(overview, "Limits of the cube and of the tetrahedron under every scheme") + "\n";
  html += how;
  for (const PageSection& section : sections) {
    html += "<h2 id=\"" + escaped(section.id) + "\">" + escaped(section.title) + "</h2>\n";
    html += section.text;
    if (!section.picture.empty()) html += image(section.picture, section.description) + "\n";
    html += table(section.table);
    for (const PageRow& r : section.rows) html += row(r);
  }
  return html + "</body>\n</html>\n";
}

}  // namespace sublimit::gallery
