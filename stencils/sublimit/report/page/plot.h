// SPDX-License-Identifier: Apache-2.0
#pragma once
// Plots of numbers over a number: axes with round ticks, lines with gaps where there is nothing, marks that differ in
// shape.
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sublimit::page {

struct Series {
  std::string name;  ///< HTML; without one, not in the legend
  std::vector<std::pair<double, std::optional<double>>> points = {};
  int kind = 0;  ///< colour and mark
  bool marks = true, line = true, faint = false, dashed = false;
};

struct Plot {
  std::string title, description;  ///< plain text
  std::string x_name, y_name;      ///< plain text, for the axes
  std::vector<Series> series = {};
  struct Rule {
    double y = 0;
    std::string name;
  };
  std::vector<Rule> rules = {};  ///< horizontal lines with a name
  bool whole_x = false;          ///< a tick at every whole number
  bool log_y = false;
  bool zero_y = false;  ///< the axis begins at zero
  double width = 380, height = 250;
};

/// SVG and legend; empty if no series has a point.
struct Drawn {
  std::string svg, legend;
};
Drawn draw(const Plot& plot);

/// The figure of a plot with a caption.
std::string figure(const Plot& plot, const std::string& caption, bool broad = false);

/// Round numbers in an interval, about so many.
std::vector<double> ticks(double low, double high, int about);

}  // namespace sublimit::page
