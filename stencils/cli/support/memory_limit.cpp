// SPDX-License-Identifier: Apache-2.0
#include "support/memory_limit.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"

namespace sublimit::cli {

void add_memory_limit(CLI::App& command, std::string& limit) {
  command.add_option(
      "--mem-limit", limit,
      "Fail, before it is taken, if more memory is needed than this: 500M, 2G (10^9 bytes), 2GiB (2^30); "
      "default: what the machine has, less a sixteenth");
}

double parse_memory_limit(const std::string& text) {
  if (text.empty()) return INFINITY;
  const size_t digits = std::min(text.find_first_not_of("0123456789."), text.size());
  const auto number = parse_number<double>(std::string_view(text).substr(0, digits));
  std::string unit = text.substr(digits);
  const bool binary = unit.size() == 3 && unit.ends_with("iB");
  if (binary || (unit.size() == 2 && unit.ends_with("B"))) unit.resize(1);
  const size_t power = unit.empty() ? 0 : 1 + std::string_view("KMGT").find(unit);
  if (!number || !(number.value > 0) || unit.size() > 1 || (power == 0 && !unit.empty()))
    throw InvalidOption("--mem-limit " + text + ": it should be a size like 500M, 2G or 1.5GiB");
  return number.value * std::pow(binary ? 1024.0 : 1000.0, double(power));
}

void limit_memory(const std::string& text) { sublimit::limit_memory(parse_memory_limit(text)); }

void check_mesh_memory(const std::string& name, const Mesh& mesh) {
  constexpr double bytes_of_face = 300;  // who is around it, as bakes count it
  check_memory(name + ": limits of " + std::to_string(mesh.num_faces()) + " faces", bytes_of_face * mesh.num_faces(),
               "use a smaller mesh");
}

}  // namespace sublimit::cli
