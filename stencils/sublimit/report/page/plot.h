// SPDX-License-Identifier: Apache-2.0
#pragma once
// Plots of series of numbers: axes with round ticks, lines with gaps at absent values, marks that differ in
// shape.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/report/page/json.h"

namespace sublimit::page {

struct Series {
  std::string name;  ///< name in the legend; empty: not in the legend
  std::vector<std::pair<double, std::optional<double>>> points = {};
  int kind = 0;  ///< number of the colour and mark
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

/// Returns the figure of a plot; null if no series has a point.
Json figure(const Plot& plot);

/// Returns about so many round numbers in an interval.
std::vector<double> ticks(double low, double high, int about);

}  // namespace sublimit::page
