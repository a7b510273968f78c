// SPDX-License-Identifier: Apache-2.0
#pragma once
// Consistency checks of free-form elements, at their `end` and at the end of the file.
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/io/detail/text_scanner.h"
#include "sublimit/io/free_form.h"

namespace sublimit {

/// Warnings of a reader: the first 20, and a note if there are more.
class FreeFormWarnings {
 public:
  explicit FreeFormWarnings(std::vector<std::string>& warnings) : warnings_(warnings) {}
  void add(const std::string& warning);

 private:
  std::vector<std::string>& warnings_;
  int count_ = 0;
};

/// Checks counts of control points and parameters, domains, and multiplicities of knots; completes directions.
/// Points, parameters, degrees and steps are those of the file; `first` and `last` are the range that it names
/// (for a curve in parameter space equal, meaning the whole domain).
/// @throws FormatError
void check_curve(FreeFormCurve& curve, std::string_view keyword, const TextScanner& scanner,
                 FreeFormWarnings& warnings);
void check_surface(FreeFormSurface& surface, const TextScanner& scanner, FreeFormWarnings& warnings);

/// Checks weights. Those of a rational element must not all be 0, and weights that are not positive give a
/// warning. Weights other than 1 of an element that is not rational are ignored, with a warning.
/// @param weights  weights of all points that `element.points` refers to
/// @throws InvalidMesh
void check_weights(const FreeFormElement& element, const std::vector<double>& weights, std::string_view keyword,
                   const TextScanner& scanner, FreeFormWarnings& warnings);

}  // namespace sublimit
