// SPDX-License-Identifier: Apache-2.0
// Faces as SVG: flat ones by their colour, smooth ones by terraces of equal tone.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "sublimit/stencils/picture/color.h"
#include "sublimit/stencils/picture/light.h"
#include "sublimit/stencils/picture/outline.h"
#include "sublimit/stencils/picture/panel.h"

namespace sublimit::picture {
namespace {

// Differences in depth, in a scene of radius 1 to sqrt(3), up to which two samples are taken to be on the same surface.
constexpr double surface_gap = .002, outline_gap = .03;

/// A point of a face on the paper, and its tone.
struct Shaded {
  svg::Spot at;
  double tone = 0;
};

Shaded shaded(const SeenPanel& seen, int corner) {
  return {spot(seen.at[seen.scene.corners[corner].point]), seen.scene.corners[corner].tone};
}

/// Where an edge has a tone; the same point from both of its sides.
svg::Spot crossing(Shaded a, Shaded b, double level) {
  if (b.at < a.at) std::swap(a, b);
  const double t = (level - a.tone) / (b.tone - a.tone);
  return {static_cast<int>(std::lround(a.at.x + t * (b.at.x - a.at.x))),
          static_cast<int>(std::lround(a.at.y + t * (b.at.y - a.at.y)))};
}

void add_terraces(std::array<Outline, tones>& terraces, int step, const std::array<Shaded, 3>& triangle) {
  const auto [low, high] = std::minmax({triangle[0].tone, triangle[1].tone, triangle[2].tone});
  for (int t = 0; t < tones; t += step) {
    const double level = t - .5;
    if (high <= level) break;
    std::vector<svg::Spot> polygon;
    for (int i = 0; i < 3; ++i) {
      const Shaded &a = triangle[i], &b = triangle[(i + 1) % 3];
      if (a.tone > level) polygon.push_back(a.at);
      if ((a.tone > level) != (b.tone > level)) polygon.push_back(crossing(a, b, level));
    }
    terraces[t].add(polygon);
  }
}

void write_fill(std::string& svg, const SeenPanel& seen, int layer, bool back, int tone, const std::string& data) {
  if (data.empty()) return;
  const Color& base = seen.panel.layers[layer].color;
  const Color inside = mix(base, {.45, .30, .22}, .45);  // the back of an open surface is warmer
  const std::string color = hex(ramp(back ? inside : base, tone / (tones - 1.)));
  svg += "<path fill=\"" + color + "\" stroke=\"" + color + "\" d=\"" + data + "\"/>\n";
}

/// Smooth shading by terraces: for each tone the part of the faces that is at least as bright, over the darker ones.
/// Nothing has to fit edge to edge, so there are no seams.
void write_terraces(std::string& svg, const SeenPanel& seen, int layer, bool back, const std::vector<int>& faces) {
  std::array<Outline, tones> terraces;
  for (int f : faces) {
    const SceneFace& face = seen.scene.faces[f];
    const Shaded center{spot(seen.camera.project(face.center)), face.tone};
    for (int c = face.begin; c < face.end; ++c) {
      const Shaded a = shaded(seen, c), b = shaded(seen, seen.scene.next(face, c));
      if (back) {
        add_terraces(terraces, seen.tone_step, {center, b, a});
      } else {
        add_terraces(terraces, seen.tone_step, {center, a, b});
      }
    }
  }
  std::string waiting;  // a terrace that the next one covers entirely is not written
  int tone = 0;
  for (int t = 0; t < tones; t += seen.tone_step) {
    const std::string data = terraces[t].data();
    if (data != waiting) write_fill(svg, seen, layer, back, tone, waiting);
    waiting = data;
    tone = t;
  }
  write_fill(svg, seen, layer, back, tone, waiting);
}

}  // namespace

// A face that nothing hides may be drawn after all others and in any order; so these are merged. What is hidden in
// part is drawn before them, from far to near.
void write_faces(std::string& svg, const SeenPanel& seen) {
  const std::vector<float> nearest = seen.buffer.nearest_around();
  std::vector<int> partial;
  std::map<std::pair<bool, int>, std::vector<int>>
      whole;  // outside or not, layer: insides first, so that outlines stay clean
  for (int f = 0; f < static_cast<int>(seen.scene.faces.size()); ++f) {
    const SceneFace& face = seen.scene.faces[f];
    if (!face.solid) continue;
    int shown = 0, beside = 0, hidden = 0;
    bool touched = false;  // by the outline of something in front, which must be drawn later
    seen.triangles(face, [&](const Projected& a, const Projected& b, const Projected& c) {
      seen.buffer.scan(a, b, c, [&](std::size_t pixel, float near) {
        const bool ours = seen.buffer.face(pixel) == f, behind = seen.buffer.near(pixel) > near + surface_gap;
        ++(ours ? shown : behind ? hidden : beside);
        touched |= nearest[pixel] > near + outline_gap;
      });
    });
    if (shown > 0 && hidden == 0 && !touched && (!face.back || shown > beside)) {
      whole[{!face.back, face.layer}].push_back(f);
    } else if (shown > 0 || (beside > 0 && !face.back)) {
      partial.push_back(f);
    }
  }
  std::stable_sort(partial.begin(), partial.end(),
                   [&](int f, int g) { return seen.scene.faces[f].center.z() < seen.scene.faces[g].center.z(); });
  svg += "<g stroke-width=\"6\">\n";  // strokes of the same colour close the seams
  for (int f : partial) {
    const SceneFace& face = seen.scene.faces[f];
    std::vector<svg::Spot> polygon;
    for (int c = face.begin; c < face.end; ++c) polygon.push_back(spot(seen.at[seen.scene.corners[c].point]));
    Outline outline;
    outline.add(polygon);
    write_fill(svg, seen, face.layer, face.back, static_cast<int>(std::lround(face.tone)), outline.data());
  }
  for (const auto& [where, faces] : whole) write_terraces(svg, seen, where.second, !where.first, faces);
  svg += "</g>\n";
}

}  // namespace sublimit::picture
