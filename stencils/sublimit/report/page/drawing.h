// SPDX-License-Identifier: Apache-2.0
#pragma once
// Drawings as inline SVG in figures: a title for screen readers, a caption for all, colours from the page.
#include <string>
#include <utility>
#include <vector>

#include "sublimit/report/page/text.h"

namespace sublimit::page {

/// `<svg>` to `</svg>` of this size around a body; title and description are plain text.
std::string drawing(double width, double height, const std::string& title, const std::string& description,
                    const std::string& body);

/// A figure: an SVG and its caption (HTML); `broad` ones take a row of their own.
std::string figure(const std::string& svg, const std::string& caption, bool broad = false);

/// Several figures beside each other, as many as fit.
std::string figures(const std::string& all);

struct TextStyle {
  const char* anchor = "start";
  const char* css = nullptr;  ///< classes
};
std::string text(double x, double y, const std::string& words, TextStyle style = {});
std::string line(double x1, double y1, double x2, double y2, const char* css);
std::string circle(double x, double y, double radius, const std::string& css, const std::string& title = {});

/// Path data through points in pixels: open, or closed.
std::string path_data(const std::vector<std::pair<double, double>>& points, bool closed = false);
std::string path(const std::string& data, const std::string& css);

/// One of eight signs that differ in shape, not only in colour.
std::string mark(int kind, double x, double y, double size = 3.6);

/// Names of what marks or fills mean, below a drawing: pairs of a small SVG body (22 x 12) and words.
std::string legend(const std::vector<std::pair<std::string, std::string>>& items);
/// A patch of a colour for a legend.
std::string swatch(const std::string& css);
std::string swatch_of(const std::string& color);

}  // namespace sublimit::page
