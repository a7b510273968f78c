// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the parts of a free-form element must have in common, checked at its `end` and at the end of the file.
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/io/detail/text_scanner.h"
#include "sublimit/io/free_form.h"

namespace sublimit {

/// Collected warnings of a reader: the first 20, and a note if there are more.
class FreeFormWarnings {
 public:
  explicit FreeFormWarnings(std::vector<std::string>& warnings) : warnings_(warnings) {}
  void add(const std::string& warning);

 private:
  std::vector<std::string>& warnings_;
  int count_ = 0;
};

/// Counts of control points and parameters, domains, multiplicities of knots; completes directions. Points, parameters,
/// degrees and steps are those of the file, `first` and `last` the range that it names (of a curve in parameter space:
/// equal, for all).
/// @throws FormatError
void check_curve(FreeFormCurve& curve, std::string_view keyword, const TextScanner& scanner,
                 FreeFormWarnings& warnings);
void check_surface(FreeFormSurface& surface, const TextScanner& scanner, FreeFormWarnings& warnings);

/// Weights of a rational element that are all 0, or some not positive; weights that nothing uses.
/// @param weights  of all points that `element.points` counts
/// @throws InvalidMesh
void check_weights(const FreeFormElement& element, const std::vector<double>& weights, std::string_view keyword,
                   const TextScanner& scanner, FreeFormWarnings& warnings);

}  // namespace sublimit
