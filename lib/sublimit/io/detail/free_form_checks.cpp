// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/free_form_checks.h"

#include <algorithm>
#include <optional>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/free_form_counts.h"
#include "sublimit/io/detail/obj_keywords.h"

namespace sublimit {
namespace {

// One direction of an element, with the words for its messages.
class DirectionCheck {
 public:
  DirectionCheck(FreeFormDirection& direction, FreeFormBasis basis, char letter, const FreeFormElement& element,
                 std::string_view keyword, const TextScanner& scanner)
      : direction_(direction),
        basis_(basis),
        counts_(basis, direction.degree, direction.step),
        parm_(std::string("parm ") + letter),
        element_(scanner.place(element.line) + std::string(keyword)),
        scanner_(scanner) {}

  const FreeFormCounts& counts() const { return counts_; }
  std::int64_t num_parameters() const { return std::int64_t(direction_.parameters.size()); }
  std::string place() const { return scanner_.place(direction_.line); }
  const std::string& parm() const { return parm_; }
  const std::string& element() const { return element_; }

  void require_parameters() const {
    if (!direction_.parameters.empty()) return;
    throw FormatError(element_ + " has no '" + parm_ + "'; " + counts_.text() + " needs at least " +
                      format_number(counts_.least_parameters()) + " values, before its 'end'");
  }

  // The control points that belong to the values, perhaps to a knot vector without its first and last knot; 0 if none.
  std::int64_t points(bool without_ends) const {
    if (without_ends && basis_ != FreeFormBasis::bspline) return 0;
    return counts_.points(num_parameters() + (without_ends ? 2 : 0));
  }

  [[noreturn]] void reject_few() const {
    throw FormatError(place() + parm_ + " has " + counted(num_parameters(), "value") + "; " + counts_.text() +
                      " has at least " + format_number(counts_.least_parameters()) + without_ends_text());
  }

  // ", or 7 without the first and the last", for the smallest number of knots or for those of `points`.
  std::string without_ends_text(std::int64_t points = 0) const {
    if (basis_ != FreeFormBasis::bspline) return "";
    const std::int64_t full = points > 0 ? counts_.parameters(points) : counts_.least_parameters();
    return ", or " + format_number(full - 2) + " without the first and the last";
  }

  // Knots and range for a number of control points that is known now.
  void complete(Index count, bool without_ends, FreeFormWarnings& warnings) const {
    std::vector<double>& knots = direction_.parameters;
    if (without_ends) {
      warnings.add(place() + parm_ + " has " + format_number(num_parameters()) + " knots for " +
                   counted(count, "control point") + ", without the first and the last; these are doubled");
      knots.insert(knots.begin(), knots.front());
      knots.push_back(knots.back());
    }
    direction_.count = count;
    const auto [from, to] = free_form_domain(basis_, direction_);
    if (!(from < to))
      throw FormatError(place() + parm_ + ": the domain, knots " + format_number(direction_.degree + 1) + " to " +
                        format_number(count + 1) + " of " + format_number(num_parameters()) + ", is " +
                        format_number(from) + " to " + format_number(to) + "; it should not be empty");
    if (basis_ == FreeFormBasis::bspline) check_multiplicities();
    cut_range(from, to, warnings);
  }

 private:
  void check_multiplicities() const {
    const std::vector<double>& t = direction_.parameters;
    const std::size_t knot = first_excess_knot(t, direction_.degree);
    if (knot == t.size()) return;
    const auto same = std::equal_range(t.begin(), t.end(), t[knot]);
    throw FormatError(place() + parm_ + ": knot " + format_number(t[knot]) + " is there " +
                      format_number(same.second - same.first) + " times, from value " +
                      format_number(same.first - t.begin() + 1) + " on; of degree " + format_number(direction_.degree) +
                      " it can be there " + counted(direction_.degree, "time") + ", at the ends " +
                      format_number(direction_.degree + 1));
  }

  void cut_range(double from, double to, FreeFormWarnings& warnings) const {
    double &first = direction_.first, &last = direction_.last;
    if (first == last) {  // all, as is said of curves in parameter space
      first = from;
      last = to;
      return;
    }
    if (first >= from && last <= to) return;
    const std::string range = format_number(first) + " to " + format_number(last);
    const std::string domain = format_number(from) + " to " + format_number(to);
    if (!(std::max(first, from) < std::min(last, to)))
      throw FormatError(element_ + ": the range " + range + " has nothing of the domain, which is " + domain + " by " +
                        parm_);
    warnings.add(element_ + ": the range " + range + " is cut to the domain, which is " + domain + " by " + parm_);
    first = std::max(first, from);
    last = std::min(last, to);
  }

  FreeFormDirection& direction_;
  FreeFormBasis basis_;
  FreeFormCounts counts_;
  std::string parm_, element_;
  const TextScanner& scanner_;
};

}  // namespace

void FreeFormWarnings::add(const std::string& warning) {
  constexpr int most = 20;
  if (count_ == most) return;
  warnings_.push_back(warning);
  if (++count_ == most) warnings_.push_back("further warnings about curves and surfaces are not listed");
}

void check_curve(FreeFormCurve& curve, std::string_view keyword, const TextScanner& scanner,
                 FreeFormWarnings& warnings) {
  const DirectionCheck u(curve.u, curve.basis, 'u', curve, keyword, scanner);
  const auto points = std::int64_t(curve.points.size());
  if (!u.counts().fits(points))
    throw FormatError(u.element() + " has " + counted(points, "control point") + "; " + u.counts().text() + " has " +
                      u.counts().points_beside(points));
  u.require_parameters();
  const bool without_ends = u.points(false) != points && u.points(true) == points;
  if (!without_ends && u.points(false) != points)
    throw FormatError(u.place() + u.parm() + " has " + counted(u.num_parameters(), "value") + "; " +
                      counted(points, "control point") + " of " + u.counts().text() + " need " +
                      format_number(u.counts().parameters(points)) + u.without_ends_text(points));
  u.complete(checked_index(points, scanner.name(), "control points"), without_ends, warnings);
}

void check_surface(FreeFormSurface& surface, const TextScanner& scanner, FreeFormWarnings& warnings) {
  const DirectionCheck u(surface.u, surface.basis, 'u', surface, "surf", scanner);
  const DirectionCheck v(surface.v, surface.basis, 'v', surface, "surf", scanner);
  u.require_parameters();
  v.require_parameters();
  const auto points = std::int64_t(surface.points.size());
  checked_index(points, scanner.name(), "control points");
  for (const bool without_ends : {false, true}) {
    const std::int64_t columns = u.points(without_ends), rows = v.points(without_ends);
    if (columns < 1 || rows < 1 || columns > points || rows > points || columns * rows != points) continue;
    u.complete(static_cast<Index>(columns), without_ends, warnings);
    v.complete(static_cast<Index>(rows), without_ends, warnings);
    return;
  }
  for (const DirectionCheck* direction : {&u, &v}) {
    if (direction->points(false) == 0 && direction->points(true) == 0) direction->reject_few();
  }
  // Either way of counting knots, where both directions allow it.
  std::string right;
  for (const bool without_ends : {false, true}) {
    const std::int64_t columns = u.points(without_ends), rows = v.points(without_ends);
    if (columns < 1 || rows < 1) continue;
    right += right.empty() ? " belong to " : ", or without first and last knots to ";
    right += format_number(columns) + " x " + format_number(rows);
    if (columns < 1 << 30 && rows < 1 << 30) right += " = " + format_number(columns * rows);
  }
  const auto words = [&](const DirectionCheck& direction) {
    return direction.parm() + " of " + counted(direction.num_parameters(), "value");
  };
  throw FormatError(
      u.element() + " has " + counted(points, "control point") + "; " + words(u) + " and " + words(v) + ", " +
      std::string(basis_name(surface.basis)) + " of degree " + format_number(surface.u.degree) + " x " +
      format_number(surface.v.degree) + "," +
      (right.empty() ? " do not belong to a surface: one has first and last knots, the other has not" : right));
}

void check_weights(const FreeFormElement& element, const std::vector<double>& weights, std::string_view keyword,
                   const TextScanner& scanner, FreeFormWarnings& warnings) {
  const auto find = [&](auto property) {
    const auto point =
        std::ranges::find_if(element.points, [&](Index i) { return property(weights[static_cast<std::size_t>(i)]); });
    return point == element.points.end() ? std::optional<Index>() : std::optional<Index>(*point);
  };
  const auto message = [&](Index point) {
    return scanner.place(element.line) + std::string(keyword) + ": weight " +
           format_number(weights[static_cast<std::size_t>(point)]) + " of control point " + format_number(point + 1);
  };
  if (!element.rational) {
    if (const std::optional<Index> point = find([](double w) { return w != 1; }))
      warnings.add(message(*point) + " ignored; only elements under 'cstype rat ...' use weights");
    return;
  }
  if (!find([](double w) { return w != 0; }))
    throw InvalidMesh(scanner.place(element.line) + std::string(keyword) +
                      ": the weights of all control points are 0; one at least should not be");
  if (const std::optional<Index> point = find([](double w) { return w <= 0; }))
    warnings.add(message(*point) + " is not positive; there may be poles, and no convex hull");
}

}  // namespace sublimit
