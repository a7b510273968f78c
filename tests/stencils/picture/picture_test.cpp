// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/picture/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/stencils/patterns/demo_mesh.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

using Eigen::Vector3d;

PictureMesh picture_of(const Mesh& mesh) {
  PictureMesh picture;
  picture.positions = mesh.positions;
  picture.face_sizes = mesh.face_sizes;
  picture.face_vertices = mesh.face_vertices;
  return picture;
}

/// A square of half-width `size` in the plane z = `depth`, its outside towards +z.
PictureMesh square(double size, double depth) {
  PictureMesh mesh;
  mesh.positions.resize(4, 3);
  mesh.positions << -size, -size, depth, size, -size, depth, size, size, depth, -size, size, depth;
  mesh.face_sizes = {4};
  mesh.face_vertices = {0, 1, 2, 3};
  return mesh;
}

/// A ball of quads, its poles cut off; normals are exact.
PictureMesh ball(Index n) {
  PictureMesh mesh;
  mesh.positions.resize(2 * n * (n - 1), 3);
  for (Index j = 0; j + 1 < n; ++j) {
    for (Index i = 0; i < 2 * n; ++i) {
      const double u = std::numbers::pi * i / n, v = std::numbers::pi * (j + 1) / n;
      mesh.positions.row(j * 2 * n + i) << std::sin(v) * std::cos(u), -std::cos(v), -std::sin(v) * std::sin(u);
    }
  }
  for (Index j = 0; j + 2 < n; ++j) {
    for (Index i = 0; i < 2 * n; ++i) {
      const Index next = (i + 1) % (2 * n);
      mesh.face_sizes.push_back(4);
      for (const Index v : {j * 2 * n + i, j * 2 * n + next, (j + 1) * 2 * n + next, (j + 1) * 2 * n + i}) {
        mesh.face_vertices.push_back(v);
      }
    }
  }
  mesh.vertex_normals = mesh.positions;
  return mesh;
}

PictureOptions from_the_front() { return {.azimuth = 0, .elevation = 0, .distance = 0, .ground_shadow = false}; }

std::size_t count(std::string_view text, std::string_view part) {
  std::size_t result = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + part.size())) ++result;
  return result;
}

/// As much of XML as we write: elements nest and close, attributes are quoted, text holds no bare markup.
::testing::AssertionResult well_formed(std::string_view text) {
  const auto fail = [](const std::string& why) { return ::testing::AssertionFailure() << why; };
  std::vector<std::string> open;
  bool any = false;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] != '<') {
      if (text[at] == '>') return fail("a bare '>'");
      if (text[at] == '&') {
        const std::string_view entity = text.substr(at, text.find(';', at) + 1 - at);
        if (entity != "&amp;" && entity != "&lt;" && entity != "&gt;" && entity != "&quot;") return fail("a bare '&'");
      }
      if (open.empty() && text[at] != '\n') return fail("text outside of the root");
      ++at;
      continue;
    }
    const std::size_t end = text.find('>', at);
    if (end == text.npos) return fail("a tag without end");
    std::string_view tag = text.substr(at + 1, end - at - 1);
    at = end + 1;
    if (tag.starts_with('/')) {
      if (open.empty() || open.back() != tag.substr(1)) return fail("closes what is not open: " + std::string(tag));
      open.pop_back();
      continue;
    }
    if (any && open.empty()) return fail("a second root");
    any = true;
    const bool empty = tag.ends_with('/');
    if (empty) tag.remove_suffix(1);
    const std::size_t name_end = std::min(tag.find(' '), tag.size());
    const std::string name(tag.substr(0, name_end));
    for (tag.remove_prefix(name_end); !tag.empty();) {  // attributes
      const std::size_t equals = tag.find("=\"");
      if (tag.front() != ' ' || equals == tag.npos) return fail("a broken attribute in " + name);
      const std::size_t quote = tag.find('"', equals + 2);
      if (quote == tag.npos) return fail("an attribute without end in " + name);
      if (tag.substr(0, quote).find('<') != tag.npos) return fail("a bare '<' in " + name);
      tag.remove_prefix(quote + 1);
    }
    if (!empty) open.push_back(name);
  }
  if (!open.empty()) return fail("not closed: " + open.back());
  return any ? ::testing::AssertionSuccess() : fail("no element");
}

TEST(Picture, IsWellFormed) {
  const Mesh mesh = demo_mesh();
  PictureMesh wire = picture_of(mesh);
  wire.wireframe = true;
  for (const Mesh::Crease& crease : mesh.creases) wire.creases.push_back({crease.tail, crease.head, .5});
  wire.dots = {0, 1, 2};
  const std::string svg = svg_picture({{{wire}, "a < b & \"c\"", "x > y"}, {{ball(12)}, "", ""}});
  EXPECT_TRUE(well_formed(svg));
  EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot;"), svg.npos);
  EXPECT_EQ(count(svg, "nan"), 0u);
  EXPECT_EQ(count(svg, "inf"), 0u);
}

TEST(Picture, OfNothingIsAPicture) {
  EXPECT_TRUE(well_formed(svg_picture({})));
  EXPECT_TRUE(well_formed(svg_picture({{{}, "no layers", ""}})));
  EXPECT_TRUE(well_formed(svg_picture({{{PictureMesh{}}, "no faces", ""}})));
  PictureMesh isolated;
  isolated.positions = Points::Constant(3, 3, 7);
  EXPECT_TRUE(well_formed(svg_picture({{{isolated}, "vertices only", ""}})));
}

TEST(Picture, OfDegenerateAndHugeMeshesIsAPicture) {
  EXPECT_TRUE(well_formed(svg_picture({{{square(0, 0)}, "a point", ""}})));
  for (const double size : {1e-300, 1e300}) {
    PictureMesh mesh = square(size, 0);
    mesh.wireframe = true;
    const std::string svg = svg_picture({{{mesh}, "", ""}}, from_the_front());
    EXPECT_TRUE(well_formed(svg));
    PictureMesh unit = square(1, 0);
    unit.wireframe = true;
    EXPECT_EQ(svg, svg_picture({{{unit}, "", ""}}, from_the_front())) << size;
  }
}

TEST(Picture, HasTheSameBytesEveryTime) {
  const std::vector<Panel> panels = {{{picture_of(demo_mesh())}, "demo", ""}, {{ball(16)}, "ball", ""}};
  EXPECT_EQ(svg_picture(panels), svg_picture(panels));
}

TEST(Picture, LeavesOutFacesThatAreHidden) {
  const std::string alone = svg_picture({{{square(1, 0)}, "", ""}}, from_the_front());
  EXPECT_EQ(count(alone, "<path"), 1u);
  EXPECT_EQ(count(svg_picture({{{square(1, 0), square(.5, -.5)}, "", ""}}, from_the_front()), "<path"), 1u);
  EXPECT_EQ(count(svg_picture({{{square(1, 0), square(.5, +.5)}, "", ""}}, from_the_front()), "<path"), 2u);
  EXPECT_EQ(count(svg_picture({{{square(.5, 0), square(1, -.5)}, "", ""}}, from_the_front()), "<path"), 2u);
}

TEST(Picture, LeavesOutLinesAndDotsThatAreHidden) {
  PictureMesh behind = square(.5, -.5);
  behind.faces = false;
  behind.wireframe = true;
  behind.creases = {{0, 1, 1}};
  behind.dots = {2};
  EXPECT_EQ(count(svg_picture({{{square(1, 0), behind}, "", ""}}, from_the_front()), "<path"), 1u);
  PictureMesh before = behind;
  before.positions.col(2).setConstant(.5);
  // Its wire, its crease, its dot and the rim of the dot.
  EXPECT_EQ(count(svg_picture({{{square(1, 0), before}, "", ""}}, from_the_front()), "<path"), 5u);
}

TEST(Picture, CutsALineWhereItGoesBehindAFace) {
  PictureMesh line;
  line.positions.resize(2, 3);
  line.positions << -2, 0, -1, 2, 0, -1;
  line.creases = {{0, 1, 1}};
  const std::string svg = svg_picture({{{square(1, 0), line}, "", ""}}, from_the_front());
  const std::size_t stroke = svg.find("stroke-linecap");
  ASSERT_NE(stroke, svg.npos);
  const std::string_view path = std::string_view(svg).substr(stroke, svg.find("/>", stroke) - stroke);
  EXPECT_EQ(count(path, "m"), 2u) << path;  // to the left of the square and to its right
}

TEST(Picture, InkIsOneColourAndWidthForAllLines) {
  PictureMesh lines = square(1, 0);
  lines.faces = false;
  lines.creases = {{0, 1, 0}, {1, 2, 1}};
  EXPECT_EQ(count(svg_picture({{{lines}, "", ""}}, from_the_front()), "<path"), 2u) << "by strength";
  lines.ink = {{1, 0, 0}, 2.5};
  const std::string svg = svg_picture({{{lines}, "", ""}}, from_the_front());
  EXPECT_EQ(count(svg, "<path"), 1u);
  EXPECT_EQ(count(svg, "stroke=\"#ff0000\" stroke-width=\"25\""), 1u) << "tenths of a pixel";
}

TEST(Picture, ShowsTheBackOfAnOpenSurfaceInAnotherColour) {
  PictureMesh turned = square(1, 0);
  turned.face_vertices = {3, 2, 1, 0};
  const std::string front = svg_picture({{{square(1, 0)}, "", ""}}, from_the_front());
  const std::string back = svg_picture({{{turned}, "", ""}}, from_the_front());
  EXPECT_EQ(count(back, "<path"), 1u);
  EXPECT_NE(front, back);
}

TEST(Picture, MergesWhatHasOneToneAndShadesWhatHasNormals) {
  PictureMesh flat = ball(24), smooth = flat;
  flat.vertex_normals.resize(0, 0);
  const auto paths = [](const PictureMesh& mesh) { return count(svg_picture({{{mesh}, "", ""}}), "<path"); };
  EXPECT_GT(paths(flat), 10u);
  EXPECT_LT(paths(flat), flat.face_sizes.size() / 4);
  EXPECT_GT(paths(smooth), paths(flat));  // more tones than faces could have
}

TEST(Picture, TakesNormalsPerVertexOrPerCorner) {
  const PictureMesh by_vertex = ball(10);
  PictureMesh by_corner = by_vertex;
  by_corner.vertex_normals.resize(0, 0);
  by_corner.corner_normals.resize(static_cast<Eigen::Index>(by_vertex.face_vertices.size()), 3);
  for (std::size_t c = 0; c < by_vertex.face_vertices.size(); ++c) {
    by_corner.corner_normals.row(static_cast<Eigen::Index>(c)) =
        by_vertex.vertex_normals.row(by_vertex.face_vertices[c]);
  }
  EXPECT_EQ(svg_picture({{{by_vertex}, "", ""}}), svg_picture({{{by_corner}, "", ""}}));
}

TEST(Picture, StaysSmallForManyFaces) {
  const PictureMesh mesh = ball(100);
  ASSERT_GT(mesh.face_sizes.size(), 19000u);
  EXPECT_LT(svg_picture({{{mesh}, "", ""}}).size(), 250000u);
}

TEST(Picture, RejectsWhatIsNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    PictureMesh mesh = square(1, 0);
    mesh.positions(2, 1) = bad;
    expect_error<InvalidParameter>([&] { svg_picture({{{mesh}, "", ""}}); }, {"panel 0", "layer 0", "not finite"});
    PictureMesh normals = square(1, 0);
    normals.vertex_normals = Points::Constant(4, 3, bad);
    expect_error<InvalidParameter>(
        [&] {
          svg_picture({{}, {{square(1, 0), normals}, "", ""}});
        },
        {"panel 1", "layer 1", "normal", "not finite"});
  }
}

TEST(Picture, RejectsArraysThatDoNotFit) {
  const std::vector<std::function<void(PictureMesh&)>> faults = {
      [](PictureMesh& m) { m.face_vertices[1] = 4; },
      [](PictureMesh& m) { m.face_vertices[1] = -1; },
      [](PictureMesh& m) { m.face_sizes[0] = 3; },
      [](PictureMesh& m) {
        m.face_sizes = {2, 2};
      },
      [](PictureMesh& m) { m.positions = Points::Zero(4, 2); },
      [](PictureMesh& m) { m.vertex_normals = Points::Ones(3, 3); },
      [](PictureMesh& m) { m.corner_normals = Points::Ones(4, 2); },
      [](PictureMesh& m) {
        m.creases = {{0, 4, 1}};
      },
      [](PictureMesh& m) {
        m.creases = {{0, 1, 1.5}};
      },
      [](PictureMesh& m) { m.dots = {-1}; },
      [](PictureMesh& m) { m.color[0] = 2; },
      [](PictureMesh& m) {
        m.ink = {{0, 0, 0}, 6};
      },
      [](PictureMesh& m) {
        m.ink = {{0, -1, 0}, 1};
      },
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    SCOPED_TRACE(i);
    PictureMesh mesh = square(1, 0);
    faults[i](mesh);
    expect_error<InvalidParameter>([&] { svg_picture({{{mesh}, "", ""}}); }, {"panel 0, layer 0"});
  }
}

TEST(Picture, PanelsGoInRows) {
  const Panel panel{{square(1, 0)}, "a", ""};
  PictureOptions options = from_the_front();
  options.panel_width = options.panel_height = 100;
  options.columns = 2;
  const std::string svg = svg_picture({panel, panel, panel}, options);
  EXPECT_TRUE(well_formed(svg));
  EXPECT_NE(svg.find("viewBox=\"0 0 228 330\""), std::string::npos);  // two of 100 wide; two of 158 high; borders of 14
  EXPECT_NE(svg.find("translate(114 14)"), std::string::npos);
  EXPECT_NE(svg.find("translate(14 172)"), std::string::npos);
}

TEST(Picture, WhatIsInViewDecidesTheCamera) {
  PictureOptions options = from_the_front();
  options.in_view = square(2, 0).positions;
  const auto panels = [](double size) { return std::vector<Panel>{{{square(size, 0)}, "", ""}}; };
  EXPECT_EQ(svg_picture(panels(1), from_the_front()), svg_picture(panels(2), from_the_front()));
  EXPECT_NE(svg_picture(panels(1), options), svg_picture(panels(2), options));
  EXPECT_EQ(svg_picture(panels(2), options), svg_picture(panels(2), from_the_front()));
}

TEST(Picture, RejectsOptionsOutsideTheirRange) {
  const std::vector<PictureOptions> wrong = {{.panel_width = 0},        {.panel_height = 1e9}, {.up = Vector3d::Zero()},
                                             {.azimuth = std::nan("")}, {.distance = 1},       {.columns = -1}};
  for (const PictureOptions& options : wrong) {
    expect_error<InvalidParameter>([&] { svg_picture({}, options); }, {"picture"});
  }
}

TEST(Picture, TakesAnyDirectionForUp) {
  for (const Vector3d& up : {Vector3d(1, 0, 0), Vector3d(0, 0, 1), Vector3d(0, 0, -2), Vector3d(1, 1, 1)}) {
    PictureOptions options;
    options.up = up;
    const std::string svg = svg_picture({{{ball(8)}, "", ""}}, options);
    EXPECT_TRUE(well_formed(svg));
    EXPECT_GT(count(svg, "<path"), 10u);
  }
}

}  // namespace
}  // namespace sublimit::testing
