// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/report/asset/asset_report.h"

namespace sublimit {

void read_tolerance(const std::string& text, SeamTolerance& tolerance) {
  const auto refuse = [&](const std::string& why) {
    throw InvalidOption("tolerance " + text + ": " + why +
                        "; it should be like g0=1e-9, g0=0.01%, g1=0.1deg, g1=0.002rad or g2=5%");
  };
  const size_t equals = text.find('=');
  if (equals == std::string::npos) refuse("there is no =");
  const std::string name = text.substr(0, equals);
  if (name != "g0" && name != "g1" && name != "g2") refuse("'" + name + "' is not g0, g1 or g2");
  const size_t unit_at = [&] {
    for (const char* unit : {"deg", "rad", "%"})
      if (text.size() > equals && text.ends_with(unit)) return text.size() - std::string(unit).size();
    return text.size();
  }();
  const std::string unit = text.substr(unit_at);
  if (name == "g1" ? unit == "%" : unit == "deg" || unit == "rad") refuse(name + " is not measured in " + unit);
  const Parsed<double> number = parse_number<double>(text.substr(equals + 1, unit_at - equals - 1));
  if (!number || !std::isfinite(number.value)) refuse("there is no number behind the =");
  if (number.value < 0) refuse("it is negative");
  const double value = unit == "%" ? number.value / 100 : number.value;
  if (name == "g0") {
    tolerance.g0 = value;
    tolerance.g0_of_box = unit == "%";
  } else if (name == "g1") {
    tolerance.g1_degrees = unit == "rad" ? value * 180 / std::numbers::pi : value;
  } else {
    tolerance.g2 = value;
  }
}

}  // namespace sublimit
