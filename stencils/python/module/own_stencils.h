// SPDX-License-Identifier: Apache-2.0
#pragma once
// Stencils and sites for masks that are written in Python: one class each, for doubles and for exact numbers.
#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "sublimit/base/error.h"
#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/scheme/sites.h"

namespace sublimit::python {

namespace py = pybind11;

/// Returns the exact number of an int, Fraction or Algebraic; absent for other objects.
/// @throws TypeError  a float: it is not exactly the number that is meant
inline std::optional<Algebraic> exact_number(const py::handle& x) {
  if (py::isinstance<Algebraic>(x)) return x.cast<Algebraic>();
  if (PyFloat_Check(x.ptr()))
    throw py::type_error(
        "the weight " + py::repr(x).cast<std::string>() +
        " is a float, and reports need exact ones: int, Fraction, and ratio(p, q) and cos_2pi(k, n) of "
        "the site");
  if (!py::hasattr(x, "numerator") || !py::hasattr(x, "denominator")) return std::nullopt;
  const auto text = [&](const char* part) { return py::str(py::int_(x.attr(part))).cast<std::string>(); };
  return Algebraic::parse(text("numerator") + "/" + text("denominator"));
}

template <class T>
std::optional<T> number(const py::handle& x) {
  if constexpr (std::is_same_v<T, Algebraic>) {
    return exact_number(x);
  } else {
    if (!py::hasattr(x, "__float__") || py::hasattr(x, "__len__")) return std::nullopt;
    return py::float_(py::reinterpret_borrow<py::object>(x)).cast<double>();
  }
}

/// A weighted sum of points, in either number type.
struct AnyStencil {
  std::variant<Stencil<double>, Stencil<Algebraic>> sum;
};

/// State of the call of a mask. Sites and their parts are valid only until it is over.
struct MaskCall {
  int level = 0;  ///< modulo the scheme's period
  bool over = false;
};
template <template <class> class Site>
class Seen {
 public:
  template <class T>
  Seen(Site<T> site, std::shared_ptr<const MaskCall> call) : site_(std::move(site)), call_(std::move(call)) {}

  /// Returns seen(site) with the site in its number type.
  /// @throws InvalidParameter  the mask's call is over
  template <class See>
  auto see(const See& seen) const {
    if (call_->over)
      throw InvalidParameter("a site is known while its mask is called; this one has been kept from another call");
    return std::visit(seen, site_);
  }
  /// Returns the stencil point(site).
  template <class Point>
  AnyStencil point(const Point& point) const {
    return see([&](const auto& site) { return AnyStencil{point(site)}; });
  }
  /// Returns the site find(site), a part of this one.
  template <template <class> class Part, class Find>
  Seen<Part> part(const Find& find) const {
    return see([&](const auto& site) { return Seen<Part>(find(site), call_); });
  }
  int level() const { return call_->level; }

 private:
  std::variant<Site<double>, Site<Algebraic>> site_;
  std::shared_ptr<const MaskCall> call_;
};

}  // namespace sublimit::python
