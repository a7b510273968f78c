// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/off_colours.h"

#include <algorithm>
#include <array>

#include "sublimit/io/detail/decimals.h"
#include "sublimit/mesh/detail/attributes.h"

namespace sublimit {

void OffColours::add(const TextScanner& scanner, std::span<const std::string_view> words) {
  const auto note = [&](std::optional<std::int64_t>& line) {
    if (!line) line = scanner.line();
  };
  std::array<double, 4> colour{};
  bool real = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const double number = scanner.real(words[i], "number at the end");
    if (i >= colour.size()) continue;
    colour[i] = number;
    real = real || words[i].find_first_not_of("+-0123456789") != std::string_view::npos;
    if (!(number >= 0 && number <= 255)) note(out_of_range_);
    largest_ = std::max(largest_, number);
  }
  if (words.size() != 3 && words.size() != 4) {
    if (!words.empty()) note(other_numbers_);
    return note(no_colour_);
  }
  if (words.size() == 3) note(no_alpha_);
  has_alpha_ = has_alpha_ || words.size() == 4;
  numbers_.insert(numbers_.end(), colour.begin(), colour.end());
  is_real_.push_back(real);
}

void OffColours::finish(const TextScanner& scanner, std::vector<Mesh::Values>& values,
                        std::vector<std::string>& warnings) const {
  const std::string of(of_);
  if (other_numbers_)
    warnings.push_back(scanner.place(*other_numbers_) +
                       "the numbers at the end are no colour of 3 or 4 numbers and are left out");
  if (is_real_.empty()) return;
  if (out_of_range_) {
    warnings.push_back(scanner.place(*out_of_range_) + "a colour is not within 0 to 1 or 0 to 255; the colours of " +
                       of + " are left out");
    return;
  }
  if (no_colour_) {
    warnings.push_back(scanner.place(*no_colour_) + "no colour here, which other " + of + " have; the colours of " +
                       of + " are left out, all should have one");
    return;
  }
  if (has_alpha_ && no_alpha_)
    warnings.push_back(scanner.place(*no_alpha_) + "a colour of 3 numbers where other " + of +
                       " have 4; alpha is left out, all should have it");
  const bool bytes = largest_ > 1;
  const ValueType type = bytes ? ValueType::uint8 : type_of_decimals(numbers_);
  for (std::size_t k = 0; k < (has_alpha_ && !no_alpha_ ? 4u : 3u); ++k) {
    Mesh::Values channel{colour_names[k], {}, type};
    channel.values.reserve(is_real_.size());
    for (std::size_t i = 0; i < is_real_.size(); ++i) {
      // Beside colours of 0 to 255 one with decimal points may be 0 to 1.
      const bool unit =
          bytes && is_real_[i] && std::all_of(&numbers_[4 * i], &numbers_[4 * i] + 4, [](double x) { return x <= 1; });
      channel.values.push_back(numbers_[4 * i + k] * (unit ? 255 : 1));
    }
    values.push_back(std::move(channel));
  }
}

}  // namespace sublimit
