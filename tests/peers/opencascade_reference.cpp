// SPDX-License-Identifier: Apache-2.0
#include "peers/opencascade_reference.h"

#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <memory>

namespace sublimit::testing {
namespace {

/// Distinct knots and how often each is there.
struct DistinctKnots {
  std::unique_ptr<TColStd_Array1OfReal> knots;
  std::unique_ptr<TColStd_Array1OfInteger> times;
  explicit DistinctKnots(const Knots<double>& all) {
    std::vector<double> values;
    std::vector<int> counts;
    for (const double t : all.all()) {
      if (values.empty() || values.back() != t) {
        values.push_back(t);
        counts.push_back(0);
      }
      ++counts.back();
    }
    const auto size = static_cast<int>(values.size());
    knots = std::make_unique<TColStd_Array1OfReal>(1, size);
    times = std::make_unique<TColStd_Array1OfInteger>(1, size);
    for (int i = 0; i < size; ++i) {
      knots->SetValue(i + 1, values[size_t(i)]);
      times->SetValue(i + 1, counts[size_t(i)]);
    }
  }
};

gp_Pnt point_of(const Points& columns, Eigen::Index row) {
  const double w = columns.cols() == 4 ? columns(row, 3) : 1;
  return {columns(row, 0) / w, columns(row, 1) / w, columns(row, 2) / w};
}
double weight_of(const Points& columns, Eigen::Index row) { return columns.cols() == 4 ? columns(row, 3) : 1; }

Handle(Geom_BSplineSurface) surface_of(const Knots<double>& u, const Knots<double>& v, const Points& columns) {
  const DistinctKnots in_u(u), in_v(v);
  TColgp_Array2OfPnt poles(1, u.num_functions(), 1, v.num_functions());
  TColStd_Array2OfReal weights(1, u.num_functions(), 1, v.num_functions());
  for (Index j = 0; j < v.num_functions(); ++j)
    for (Index i = 0; i < u.num_functions(); ++i) {
      const Eigen::Index row = u.point(i) + u.num_points() * v.point(j);
      poles.SetValue(i + 1, j + 1, point_of(columns, row));
      weights.SetValue(i + 1, j + 1, weight_of(columns, row));
    }
  if (columns.cols() == 3)
    return new Geom_BSplineSurface(poles, *in_u.knots, *in_v.knots, *in_u.times, *in_v.times, u.degree(), v.degree());
  return new Geom_BSplineSurface(poles, weights, *in_u.knots, *in_v.knots, *in_u.times, *in_v.times, u.degree(),
                                 v.degree());
}

Eigen::Vector3d vector_of(const gp_Vec& v) { return {v.X(), v.Y(), v.Z()}; }
Eigen::Vector3d vector_of(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }

}  // namespace

std::vector<CurveDerivatives> opencascade_curve(const Knots<double>& knots, const Points& columns,
                                                std::span<const double> parameters) {
  const DistinctKnots distinct(knots);
  TColgp_Array1OfPnt poles(1, knots.num_functions());
  TColStd_Array1OfReal weights(1, knots.num_functions());
  for (Index i = 0; i < knots.num_functions(); ++i) {
    poles.SetValue(i + 1, point_of(columns, knots.point(i)));
    weights.SetValue(i + 1, weight_of(columns, knots.point(i)));
  }
  const Handle(Geom_BSplineCurve) curve =
      new Geom_BSplineCurve(poles, weights, *distinct.knots, *distinct.times, knots.degree());
  std::vector<CurveDerivatives> result;
  for (const double t : parameters) {
    gp_Pnt p;
    gp_Vec first, second;
    curve->D2(t, p, first, second);
    result.push_back({vector_of(p), vector_of(first), vector_of(second)});
  }
  return result;
}

std::vector<SurfaceDerivatives> opencascade_surface(const Knots<double>& u, const Knots<double>& v,
                                                    const Points& columns,
                                                    std::span<const Patch::Parameters> parameters) {
  const Handle(Geom_BSplineSurface) surface = surface_of(u, v, columns);
  std::vector<SurfaceDerivatives> result;
  for (const Patch::Parameters& at : parameters) {
    gp_Pnt p;
    gp_Vec du, dv, duu, dvv, duv;
    surface->D2(at.u, at.v, p, du, dv, duu, dvv, duv);
    result.push_back({vector_of(p), vector_of(du), vector_of(dv), vector_of(duu), vector_of(duv), vector_of(dvv)});
  }
  return result;
}

std::function<void(std::span<const Patch::Parameters>, bool, std::span<double>)> opencascade_run(
    const Knots<double>& u, const Knots<double>& v, const Points& columns) {
  // The adaptor keeps the Bezier pieces of where it was last: its fastest way.
  const auto adaptor = std::make_shared<GeomAdaptor_Surface>(surface_of(u, v, columns));
  return [adaptor](std::span<const Patch::Parameters> places, bool derivatives, std::span<double> out) {
    const size_t width = derivatives ? 9 : 3;
    for (size_t i = 0; i < places.size(); ++i) {
      gp_Pnt p;
      double* const to = out.data() + i * width;
      if (derivatives) {
        gp_Vec du, dv;
        adaptor->D1(places[i].u, places[i].v, p, du, dv);
        du.Coord(to[3], to[4], to[5]);
        dv.Coord(to[6], to[7], to[8]);
      } else {
        adaptor->D0(places[i].u, places[i].v, p);
      }
      p.Coord(to[0], to[1], to[2]);
    }
  };
}

}  // namespace sublimit::testing
