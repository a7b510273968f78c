// SPDX-License-Identifier: Apache-2.0
#pragma once
// Colours of an OFF file: three or four numbers for each vertex, or behind faces.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/io/detail/text_scanner.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Colours of all vertices, or of all faces, in their order.
class OffColours {
 public:
  /// @param of  whose they are, for messages: "vertices", "faces"
  explicit OffColours(std::string_view of) : of_(of) {}

  /// Adds the colour of the next vertex or face, from the words on the scanner's line. No words are no colour, and
  /// neither are other numbers of them than three or four.
  /// @throws FormatError  a word that is no number
  void add(const TextScanner& scanner, std::span<const std::string_view> words);

  /// Adds red, green, blue, and alpha if all colours have it, to the values of a mesh. Colours that some lack are left
  /// out, with a warning.
  void finish(const TextScanner& scanner, std::vector<Mesh::Values>& values, std::vector<std::string>& warnings) const;

 private:
  std::string_view of_;
  std::vector<double> numbers_;  // four for each colour
  std::vector<bool> is_real_;    // of each colour: some number has a decimal point
  std::optional<std::int64_t> no_colour_, no_alpha_, other_numbers_, out_of_range_;  // first lines
  double largest_ = 0;
  bool has_alpha_ = false;
};

}  // namespace sublimit
