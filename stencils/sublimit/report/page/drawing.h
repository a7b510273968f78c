// SPDX-License-Identifier: Apache-2.0
#pragma once
// Drawings as inline SVG: with a title for screen readers, and colours from the page's style.
#include <string>
#include <utility>
#include <vector>

#include "sublimit/report/page/json.h"
#include "sublimit/stencils/picture/svg.h"

namespace sublimit::page {

using svg::escaped;

/// Returns a number with a minus sign (not a hyphen), to so many digits: "0.54999", "−2.5", "1.2e−5".
std::string digits(double value, int count = 5);

/// Returns an SVG element of this size in pixels around a body; title and description are plain text.
std::string drawing(double width, double height, const std::string& title, const std::string& description,
                    const std::string& body);

/// Signs of a legend, each a small SVG body (22 x 12 pixels), and their meaning.
using Legend = std::vector<std::pair<std::string, std::string>>;
/// Returns a figure of a page, {"svg", "legend"}, for which the page has the caption; null without an SVG.
Json figure(const std::string& svg, const Legend& legend = {});

struct TextStyle {
  const char* anchor = "start";
  const char* css = nullptr;  ///< classes
};
std::string text(double x, double y, const std::string& words, TextStyle style = {});
std::string line(double x1, double y1, double x2, double y2, const char* css);
std::string circle(double x, double y, double radius, const std::string& css, const std::string& title = {});

/// Returns path data through points in pixels.
std::string path_data(const std::vector<std::pair<double, double>>& points, bool closed = false);
std::string path(const std::string& data, const std::string& css);

/// Returns one of eight marks, which differ in shape, not only in colour.
std::string mark(int kind, double x, double y, double size = 3.6);

/// Returns a filled rectangle for a legend.
std::string swatch(const std::string& css);
std::string swatch_of(const std::string& color);

}  // namespace sublimit::page
