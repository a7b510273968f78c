// SPDX-License-Identifier: Apache-2.0
#pragma once
// Drawings as inline SVG in figures: with a title for screen readers, a caption, and colours from the page's
// style.
#include <string>
#include <utility>
#include <vector>

#include "sublimit/report/page/text.h"

namespace sublimit::page {

/// Returns an SVG element of this size in pixels around a body; title and description are plain text.
std::string drawing(double width, double height, const std::string& title, const std::string& description,
                    const std::string& body);

/// Returns a figure of an SVG and its caption (HTML). A broad figure takes a whole row.
std::string figure(const std::string& svg, const std::string& caption, bool broad = false);

/// Returns several figures beside each other, as many in a row as fit.
std::string figures(const std::string& all);

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

/// Returns a legend for below a drawing, from pairs of a small SVG body (22 x 12 pixels) and its meaning.
std::string legend(const std::vector<std::pair<std::string, std::string>>& items);
/// Returns a filled rectangle for a legend.
std::string swatch(const std::string& css);
std::string swatch_of(const std::string& color);

}  // namespace sublimit::page
