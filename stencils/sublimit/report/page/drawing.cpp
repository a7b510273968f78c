// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/page/drawing.h"

#include <fmt/core.h>

namespace sublimit::page {

using svg::pixels;

std::string digits(double value, int count) {
  if (value == 0) return "0";
  std::string text = fmt::format("{:.{}g}", value, count);
  const std::size_t e = text.find('e');
  if (e != std::string::npos) {  // 1e-05 -> 1e-5
    std::size_t first = e + 2;
    while (first + 1 < text.size() && text[first] == '0') text.erase(first, 1);
    if (text[e + 1] == '+') text.erase(e + 1, 1);
  }
  for (std::size_t at = 0; (at = text.find('-', at)) != std::string::npos;) text.replace(at, 1, "−");
  return text;
}

std::string drawing(double width, double height, const std::string& title, const std::string& description,
                    const std::string& body) {
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"0 0 " + pixels(width) + " " +
                     pixels(height) + "\"><title>" + escaped(title) + "</title>";
  if (!description.empty()) text += "<desc>" + escaped(description) + "</desc>";
  return text + "\n" + body + "</svg>\n";
}

Json figure(const std::string& svg, const Legend& legend) {
  if (svg.empty()) return {};
  Json figure = {{"svg", svg}};
  if (!legend.empty()) figure["legend"] = legend;
  return figure;
}

std::string text(double x, double y, const std::string& words, TextStyle style) {
  std::string tag = "<text x=\"" + pixels(x) + "\" y=\"" + pixels(y) + "\"";
  if (std::string_view(style.anchor) != "start") tag += std::string(" text-anchor=\"") + style.anchor + "\"";
  if (style.css != nullptr) tag += std::string(" class=\"") + style.css + "\"";
  return tag + ">" + words + "</text>";
}

std::string line(double x1, double y1, double x2, double y2, const char* css) {
  return std::string("<path class=\"") + css + "\" d=\"M" + pixels(x1) + " " + pixels(y1) + "L" + pixels(x2) + " " +
         pixels(y2) + "\"/>";
}

std::string circle(double x, double y, double radius, const std::string& css, const std::string& title) {
  const std::string tag =
      "<circle cx=\"" + pixels(x) + "\" cy=\"" + pixels(y) + "\" r=\"" + pixels(radius) + "\" class=\"" + css + "\"";
  return title.empty() ? tag + "/>" : tag + "><title>" + title + "</title></circle>";
}

std::string path_data(const std::vector<std::pair<double, double>>& points, bool closed) {
  svg::Path path;  // steps in tenths of a pixel
  for (std::size_t i = 0; i < points.size(); ++i) {
    const svg::Spot at = svg::spot(points[i].first, points[i].second);
    i == 0 ? path.move(at) : path.line(at);
  }
  if (closed) path.close();
  return path.data();
}

std::string path(const std::string& data, const std::string& css) {
  return "<path transform=\"scale(.1)\" vector-effect=\"non-scaling-stroke\" class=\"" + css + "\" d=\"" + data +
         "\"/>\n";
}

std::string mark(int kind, double x, double y, double size) {
  const std::string css = "mark f" + std::to_string(kind % 8);
  const double s = size;
  const auto polygon = [&](std::vector<std::pair<double, double>> corners) {
    for (auto& [px, py] : corners) px = x + s * px, py = y + s * py;
    return path(path_data(corners, true), css);
  };
  switch (kind % 8) {
    case 0:
      return circle(x, y, s, css);
    case 1:
      return polygon({{-.9, -.9}, {.9, -.9}, {.9, .9}, {-.9, .9}});
    case 2:
      return polygon({{0, -1.3}, {1.2, .85}, {-1.2, .85}});
    case 3:
      return polygon({{0, -1.35}, {1.35, 0}, {0, 1.35}, {-1.35, 0}});
    case 4:
      return polygon({{0, 1.3}, {1.2, -.85}, {-1.2, -.85}});
    case 5:
      return polygon({{-.4, -1.2},
                      {.4, -1.2},
                      {.4, -.4},
                      {1.2, -.4},
                      {1.2, .4},
                      {.4, .4},
                      {.4, 1.2},
                      {-.4, 1.2},
                      {-.4, .4},
                      {-1.2, .4},
                      {-1.2, -.4},
                      {-.4, -.4}});
    case 6:
      return polygon({{-.55, -1.1}, {.55, -1.1}, {1.15, 0}, {.55, 1.1}, {-.55, 1.1}, {-1.15, 0}});
    default:
      return circle(x, y, .62 * s, css);
  }
}

std::string swatch(const std::string& css) {
  return "<rect x=\"2\" y=\"1\" width=\"18\" height=\"10\" rx=\"2\" class=\"" + css + "\"/>";
}

std::string swatch_of(const std::string& color) {
  return "<rect x=\"2\" y=\"1\" width=\"18\" height=\"10\" rx=\"2\" fill=\"" + color + "\"/>";
}

}  // namespace sublimit::page
