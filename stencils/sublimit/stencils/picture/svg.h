// SPDX-License-Identifier: Apache-2.0
#pragma once
// Parts of SVG files: text that is safe in XML, lengths in tenths of a pixel, paths of relative steps.
#include <string>
#include <string_view>

namespace sublimit::svg {

constexpr int units = 10;  ///< path units per pixel: one decimal without a decimal point

/// Returns text escaped for XML; control characters become blanks.
std::string escaped(std::string_view text);

constexpr int farthest = 100'000'000;  ///< path units from the origin: sums and differences of two are still an int

/// Returns the nearest whole number. NaN becomes 0, and values are clamped to +-`farthest`.
int nearest(double value);

/// Returns a length in pixels as text with at most one decimal, clamped as by `nearest`.
std::string pixels(double value);

/// A point in path units.
struct Spot {
  int x = 0, y = 0;
  auto operator<=>(const Spot&) const = default;
};

/// Returns the nearest spot to a point in pixels.
Spot spot(double x, double y);

/// Path data of relative steps, which is the shortest form.
class Path {
 public:
  void move(Spot to) { step('m', to), start_ = to; }
  void line(Spot to) { step(0, to); }
  void close() { data_ += 'z', at_ = start_; }
  /// Adds a segment of length zero, which a round line cap turns into a disc.
  void dot(Spot to) { move(to), data_ += "h0"; }
  const std::string& data() const { return data_; }

 private:
  void step(char command, Spot to) {
    if (command != 0) data_ += command;
    number(to.x - at_.x, command == 0);
    number(to.y - at_.y, true);
    at_ = to;
  }
  void number(int value, bool separate) {
    if (separate && value >= 0) data_ += ' ';
    data_ += std::to_string(value);
  }
  std::string data_;
  Spot at_, start_;
};

}  // namespace sublimit::svg
