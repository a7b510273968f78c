// SPDX-License-Identifier: Apache-2.0
// Limit curves and classical curves.
#include <pybind11/stl.h>

#include <memory>
#include <string>

#include "arrays.h"
#include "calls.h"
#include "module.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/curves/limit_curve.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/stencils/recipes/construct.h"

namespace sublimit::python {
namespace {

CurveScheme<double> curve_scheme(const std::string& name, const SchemeOptions& options) {
  if (auto scheme = find_curve_scheme(name, options)) return *std::move(scheme);
  std::string all;
  for (const CurveScheme<double>& scheme : all_curve_schemes()) all += (all.empty() ? "" : ", ") + scheme.name;
  throw InvalidOption("no linear scheme of curves is called '" + name + "'; there are " + all);
}

std::vector<CurvePlace> places(const Array<Index>& segments, const Array<double>& t) {
  std::vector<CurvePlace> all(size_t(segments.size()));
  for (size_t i = 0; i < all.size(); ++i) all[i] = {segments.data()[i], t.data()[i]};
  return all;
}

/// @throws InvalidMesh  a point or a derivative larger than numbers are: says where
py::dict sampled(CurveSamples&& found, const std::vector<CurvePlace>& at, int order) {
  if (const auto row = first_infinite_row({&found.position, &found.first, &found.second}))
    throw InvalidMesh("segment " + std::to_string(at[size_t(*row)].segment) + ", t " +
                      format_number(at[size_t(*row)].t) +
                      ": the point or a derivative there is larger than numbers are (1.8e308); give points in "
                      "another unit of length");
  std::vector<std::int8_t> status;
  for (const LimitStatus one : found.status) status.push_back(std::int8_t(one));
  py::dict all;
  all["points"] = array(std::move(found.position));
  if (order >= 1) all["first"] = array(std::move(found.first));
  if (order >= 2) all["second"] = array(std::move(found.second));
  if (order >= 1) all["normals"] = array(std::move(found.normal));
  all["status"] = array(std::move(status));
  all["order"] = array(std::move(found.order));
  return all;
}

/// Places of any curve that is linear in its points.
py::dict evaluated(const CurveSource& curve, const Points& columns, Coordinates coordinates,
                   const Array<Index>& segments, const Array<double>& t, int order, int threads) {
  const std::vector<CurvePlace> at = places(segments, t);
  CurveSamples found = without_gil([&] {
    const Threads held(threads);
    return curve.evaluate(columns, at, order, coordinates);
  });
  return sampled(std::move(found), at, order);
}

/// One curve with its points, and tangents where its scheme takes them.
class Curve {
 public:
  Curve(const Array<double>& given, const std::optional<Array<double>>& tangents, const std::string& scheme,
        const SchemeOptions& options, bool closed)
      : scheme_(curve_scheme(scheme, options)), polygon_(polygon_through(points(given), closed)) {
    if (tangents) polygon_.tangents = points(*tangents);
    unknowns_ = unknowns(scheme_, polygon_);
    curve_ = std::make_unique<LimitCurve>(scheme_, polygon_);
  }

  Index num_segments() const { return curve_->num_segments(); }
  Index num_unknowns() const { return curve_->num_unknowns(); }

  py::dict evaluate(const Array<Index>& segments, const Array<double>& t, int order, int threads) const {
    return evaluated(*curve_, unknowns_, Coordinates::plain, segments, t, order, threads);
  }

  /// A matrix for the position and for each derivative; rows of what does not exist are empty.
  py::list stencils(const Array<Index>& segments, const Array<double>& t, int order) const {
    const std::vector<CurvePlace> at = places(segments, t);
    PlaceStencils found = without_gil([&] { return place_stencils(*curve_, at, order); });
    py::list all;
    for (SparseMatrix& matrix : found.matrices) all.append(csr(std::move(matrix)));
    return all;
  }

 private:
  CurveScheme<double> scheme_;
  ControlPolygon polygon_;
  Points unknowns_;
  std::unique_ptr<LimitCurve> curve_;
};

py::dict evaluate_curves(const Curves& curves, const Array<Index>& segments, const Array<double>& t, int order,
                         int threads) {
  return evaluated(curves.set(), curves.points(), curves.rational() ? Coordinates::homogeneous : Coordinates::plain,
                   segments, t, order, threads);
}

/// Points of a level, one curve.
py::array_t<double> refined(const Array<double>& given, const std::string& scheme, const SchemeOptions& options,
                            bool closed, int levels) {
  Points control = points(given);
  return array(without_gil([&] {
    const CurveScheme<double> found = curve_scheme(scheme, options);
    const ControlPolygon polygon = polygon_through(control, closed);
    Points x = unknowns(found, polygon);
    for (const CurveLevel& level : sublimit::refine(found, polygon, levels)) x = level.S * x;
    return x;
  }));
}

}  // namespace

void add_curves(py::module_& m) {
  py::class_<Curve, std::shared_ptr<Curve>>(m, "Curve")
      .def(py::init<const Array<double>&, const std::optional<Array<double>>&, const std::string&, const SchemeOptions&,
                    bool>(),
           py::arg("points"), py::arg("tangents"), py::arg("scheme"), py::arg("options"), py::arg("closed"))
      .def_property_readonly("num_segments", &Curve::num_segments)
      .def_property_readonly("num_unknowns", &Curve::num_unknowns)
      .def("evaluate", &Curve::evaluate, py::arg("segment"), py::arg("t"), py::arg("derivatives"), py::arg("threads"))
      .def("stencils", &Curve::stencils, py::arg("segment"), py::arg("t"), py::arg("derivatives"));
  py::class_<Curves, std::shared_ptr<Curves>>(m, "Curves")
      .def_property_readonly("columns",
                             [](const py::object& self) { return view(self.cast<const Curves&>().points(), self); })
      .def_property_readonly("rational", &Curves::rational)
      .def_property_readonly("num_curves", &Curves::num_curves)
      .def_property_readonly("num_segments", &Curves::num_segments)
      .def("evaluate", &evaluate_curves, py::arg("segment"), py::arg("t"), py::arg("derivatives"), py::arg("threads"));
  m.def("refine_curve", &refined, py::arg("points"), py::arg("scheme"), py::arg("options"), py::arg("closed"),
        py::arg("levels"));
}

}  // namespace sublimit::python
