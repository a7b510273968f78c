// SPDX-License-Identifier: Apache-2.0
// The words of masks: numbers, stencils, sites.
#include <pybind11/operators.h>
#include <pybind11/stl.h>

#include <type_traits>

#include "module.h"
#include "own_stencils.h"

namespace sublimit::python {
namespace {

/// @throws ZeroDivisionError
template <class T>
const T& checked_divisor(const T& x) {
  if (x == T(0)) {
    PyErr_SetString(PyExc_ZeroDivisionError, "division by zero");
    throw py::error_already_set();
  }
  return x;
}

py::object not_implemented() { return py::reinterpret_borrow<py::object>(Py_NotImplemented); }

void add_numbers(py::module_& m) {
  py::class_<Algebraic> numbers(m, "Algebraic");
  const auto operation = [&](const char* name, const char* reflected, auto combined) {
    numbers.def(name, [=](const Algebraic& a, const py::object& b) -> py::object {
      const auto x = exact_number(b);
      return x ? py::cast(combined(a, *x)) : not_implemented();
    });
    numbers.def(reflected, [=](const Algebraic& a, const py::object& b) -> py::object {
      const auto x = exact_number(b);
      return x ? py::cast(combined(*x, a)) : not_implemented();
    });
  };
  operation("__add__", "__radd__", [](const Algebraic& a, const Algebraic& b) { return a + b; });
  operation("__sub__", "__rsub__", [](const Algebraic& a, const Algebraic& b) { return a - b; });
  operation("__mul__", "__rmul__", [](const Algebraic& a, const Algebraic& b) { return a * b; });
  operation("__truediv__", "__rtruediv__",
            [](const Algebraic& a, const Algebraic& b) { return a / checked_divisor(b); });
  numbers.def("__neg__", [](const Algebraic& a) { return -a; })
      .def("__pow__",
           [](const Algebraic& a, int exponent) {
             Algebraic power(1);
             for (int i = 0; i < exponent; ++i) power *= a;
             for (int i = 0; i > exponent; --i) power /= checked_divisor(a);
             return power;
           })
      .def("__eq__",
           [](const Algebraic& a, const py::object& b) -> py::object {
             if (PyFloat_Check(b.ptr())) return not_implemented();
             const auto x = exact_number(b);
             return x ? py::cast(a == *x) : not_implemented();
           })
      .def("__float__", [](const Algebraic& a) { return double(a); })
      .def("__repr__", &Algebraic::text);
}

/// combined(a, b) of two stencils of one number type.
template <class Combined>
AnyStencil both(const AnyStencil& a, const AnyStencil& b, const Combined& combined) {
  if (a.sum.index() != b.sum.index())
    throw InvalidParameter("a stencil of floats and one of exact numbers: one has been kept from another call");
  return std::visit([&](const auto& x) { return AnyStencil{combined(x, std::get<std::decay_t<decltype(x)>>(b.sum))}; },
                    a.sum);
}
/// combined(a, factor); Python asks the factor where it is no number.
template <class Combined>
py::object scaled(const AnyStencil& a, const py::object& factor, const Combined& combined) {
  return std::visit(
      [&]<class T>(const Stencil<T>& x) -> py::object {
        const std::optional<T> by = number<T>(factor);
        return by ? py::cast(AnyStencil{combined(x, *by)}) : not_implemented();
      },
      a.sum);
}

void add_stencils(py::module_& m) {
  py::class_<AnyStencil> stencils(m, "Stencil",
                                  "A sum of points with weights: + and - of stencils, * and / of numbers.");
  const auto times = [](const AnyStencil& a, const py::object& b) {
    return scaled(a, b, [](const auto& x, const auto& by) { return x * by; });
  };
  stencils
      .def(
          "__add__",
          [](const AnyStencil& a, const AnyStencil& b) {
            return both(a, b, [](const auto& x, const auto& y) { return x + y; });
          },
          py::is_operator())
      .def(
          "__sub__",
          [](const AnyStencil& a, const AnyStencil& b) {
            return both(a, b, [](const auto& x, const auto& y) { return x - y; });
          },
          py::is_operator())
      .def("__radd__",
           [](const py::object& a, const py::object& b) {  // sum() begins with 0
             return PyLong_Check(b.ptr()) && b.equal(py::int_(0)) ? a : not_implemented();
           })
      .def("__neg__", [](const AnyStencil& a) { return std::visit([](auto x) { return AnyStencil{x *= -1}; }, a.sum); })
      .def("__mul__", times)
      .def("__rmul__", times)
      .def("__truediv__",
           [](const AnyStencil& a, const py::object& b) {
             return scaled(a, b, [](const auto& x, const auto& by) { return x / checked_divisor(by); });
           })
      .def_property_readonly(
          "terms",
          [](const AnyStencil& a) {
            return std::visit([](const auto& x) { return py::object(py::cast(x.terms())); }, a.sum);
          },
          "Points, numbered in the order of the site, with their weights.");
  stencils.attr("__module__") = "sublimit";
  stencils.attr("__array_ufunc__") = py::none();  // a NumPy number is a number, and no array of stencils
}

template <template <class> class Site>
using SiteClass = py::class_<Seen<Site>>;

template <template <class> class Site>
SiteClass<Site> site_class(py::module_& m, const char* name, const char* meaning) {
  SiteClass<Site> sites(m, name, meaning);
  sites.attr("__module__") = "sublimit";
  return sites.def_property_readonly("level", &Seen<Site>::level, "Level of the points, modulo the scheme's period.")
      .def(
          "ratio",
          [](const Seen<Site>& s, int p, int q) -> py::object {
            if (q == 0) throw InvalidParameter("ratio(p, q) needs a q that is not 0");
            return s.see([&]<class T>(const Site<T>&) -> py::object {
              if constexpr (std::is_same_v<T, double>) return py::float_(Number<T>::ratio(p, q));
              return py::module_::import("fractions").attr("Fraction")(p, q);
            });
          },
          py::arg("p"), py::arg("q"), "p/q in the numbers of this call.")
      .def(
          "cos_2pi",
          [](const Seen<Site>& s, int k, int n) {
            if (n < 1) throw InvalidParameter("cos_2pi(k, n) needs an n of at least 1");
            return s.see([&]<class T>(const Site<T>&) -> py::object { return py::cast(Number<T>::cos_2pi(k, n)); });
          },
          py::arg("k"), py::arg("n"), "The cosine of k/n of a turn, in the numbers of this call.");
}

/// A stencil that takes no argument.
template <template <class> class Site, class Point>
void point(SiteClass<Site>& sites, const char* name, const Point& of, const char* meaning) {
  sites.def_property_readonly(
      name, [of](const Seen<Site>& s) { return s.point(of); }, meaning);
}

/// Of an edge.
template <template <class> class Site>
void ends(SiteClass<Site>& edges, const char* tail) {
  point(
      edges, "tail", [](const auto& e) { return e.tail(); }, tail);
  point(
      edges, "head", [](const auto& e) { return e.head(); }, "The other end.");
}

void add_faces(py::module_& m) {
  auto faces = site_class<FaceSite>(m, "FaceSite", "A face, seen from a corner on.");
  faces
      .def_property_readonly(
          "size", [](const Seen<FaceSite>& f) { return f.see([](const auto& site) { return site.size(); }); },
          "Corners of the face.")
      .def(
          "corner",
          [](const Seen<FaceSite>& f, int i) { return f.point([&](const auto& site) { return site.corner(i); }); },
          py::arg("i"), "Corner i; the last one is corner -1.");
  point(
      faces, "centroid", [](const auto& f) { return f.centroid(); }, "The mean of its corners.");
  point(
      faces, "point", [](const auto& f) { return f.point(); }, "The new point of this face.");
}

void add_edges(py::module_& m) {
  auto edges = site_class<EdgeSite>(
      m, "EdgeSite",
      "An edge inside, with its two faces. The left one begins with (tail, head), the right one with (head, tail).");
  ends(edges, "The end that the left face has first.");
  edges
      .def_property_readonly(
          "left_face",
          [](const Seen<EdgeSite>& e) { return e.part<FaceSite>([](const auto& site) { return site.left_face(); }); },
          "The face that has it from tail to head.")
      .def_property_readonly(
          "right_face",
          [](const Seen<EdgeSite>& e) { return e.part<FaceSite>([](const auto& site) { return site.right_face(); }); },
          "The face that has it from head to tail.");
}

void add_rings(py::module_& m) {
  auto rings = site_class<Ring>(
      m, "Ring", "A vertex with its edges and faces, counter-clockwise: face i is between edges i and i + 1.");
  rings
      .def_property_readonly(
          "is_closed", [](const Seen<Ring>& v) { return v.see([](const auto& r) { return r.is_closed(); }); },
          "Whether faces are all around; in a row at a border or between sharp edges.")
      .def_property_readonly(
          "valence", [](const Seen<Ring>& v) { return v.see([](const auto& r) { return r.valence(); }); }, "Faces.")
      .def(
          "has_neighbor",
          [](const Seen<Ring>& v, int i) { return v.see([&](const auto& r) { return r.has_neighbor(i); }); },
          py::arg("i"), "Whether there is an edge i; in a closed ring always.")
      .def(
          "neighbor", [](const Seen<Ring>& v, int i) { return v.point([&](const auto& r) { return r.neighbor(i); }); },
          py::arg("i"), "The other end of edge i.")
      .def(
          "diagonal", [](const Seen<Ring>& v, int i) { return v.point([&](const auto& r) { return r.diagonal(i); }); },
          py::arg("i"), "The corner of face i, a quadrilateral, that is opposite to the vertex.")
      .def(
          "continued",
          [](const Seen<Ring>& v, int i) { return v.point([&](const auto& r) { return r.continued(i); }); },
          py::arg("i"),
          "Of triangles: neighbor(i) of a ring that two points beyond the border close, each making a parallelogram.")
      .def(
          "face", [](const Seen<Ring>& v, int i) { return v.part<FaceSite>([&](const auto& r) { return r.face(i); }); },
          py::arg("i"), "The face between edges i and i + 1.");
  point(
      rings, "center", [](const auto& v) { return v.center(); }, "The vertex.");
  point(
      rings, "neighbor_mean", [](const auto& v) { return v.neighbor_mean(); },
      "The mean of the other ends of its edges.");
  point(
      rings, "face_centroid_mean", [](const auto& v) { return v.face_centroid_mean(); },
      "The mean of the centroids of its faces.");
  point(
      rings, "face_point_mean", [](const auto& v) { return v.face_point_mean(); },
      "The mean of the new points of its faces.");
}

void add_wide_sites(py::module_& m) {
  auto edges = site_class<WideEdgeSite>(m, "WideEdgeSite", "An edge with all faces at its two ends.");
  ends(edges, "The end that the left face has first.");
  edges
      .def_property_readonly(
          "is_border", [](const Seen<WideEdgeSite>& e) { return e.see([](const auto& s) { return s.is_border(); }); },
          "Whether it has one face.")
      .def_property_readonly(
          "tail_ring",
          [](const Seen<WideEdgeSite>& e) { return e.part<Ring>([](const auto& s) { return s.tail_ring(); }); },
          "The faces at the tail, from this edge on.")
      .def_property_readonly(
          "head_ring",
          [](const Seen<WideEdgeSite>& e) { return e.part<Ring>([](const auto& s) { return s.head_ring(); }); },
          "The faces at the head, from this edge on.");

  using Faces = Seen<WideFaceSite>;
  site_class<WideFaceSite>(m, "WideFaceSite", "A face with all faces at its corners.")
      .def_property_readonly(
          "size", [](const Faces& f) { return f.see([](const auto& s) { return s.size(); }); }, "Corners of the face.")
      .def(
          "corner", [](const Faces& f, int i) { return f.point([&](const auto& s) { return s.corner(i); }); },
          py::arg("i"), "Corner i; the last one is corner -1.")
      .def(
          "ring", [](const Faces& f, int i) { return f.part<Ring>([&](const auto& s) { return s.ring(i); }); },
          py::arg("i"), "The faces at corner i, from the edge to the next corner on.")
      .def(
          "has_across", [](const Faces& f, int i) { return f.see([&](const auto& s) { return s.has_across(i); }); },
          py::arg("i"), "Whether another face is across edge i, which goes from corner i to the next one.")
      .def(
          "edge_point", [](const Faces& f, int i) { return f.point([&](const auto& s) { return s.edge_point(i); }); },
          py::arg("i"), "The new point of edge i.")
      .def(
          "edge_point_beyond",
          [](const Faces& f, int i) { return f.point([&](const auto& s) { return s.edge_point_beyond(i); }); },
          py::arg("i"), "The new point of the edge opposite to edge i in the quadrilateral across it.");
}

void add_creases(py::module_& m) {
  auto vertices =
      site_class<CreaseSite>(m, "CreaseSite", "A vertex of a border or of sharp edges, on the curve of these.");
  point(
      vertices, "center", [](const auto& v) { return v.center(); }, "The vertex.");
  point(
      vertices, "before", [](const auto& v) { return v.before(); }, "The vertex before it on the curve.");
  point(
      vertices, "after", [](const auto& v) { return v.after(); }, "The vertex after it on the curve.");
  auto edges =
      site_class<CreaseEdgeSite>(m, "CreaseEdgeSite", "An edge of a border, or a sharp one, on the curve of these.");
  ends(edges, "The end that comes first on the curve.");
  point(
      edges, "before", [](const auto& e) { return e.before(); },
      "The vertex before the tail on the curve; where it ends there in a corner, its mirror image.");
  point(
      edges, "after", [](const auto& e) { return e.after(); },
      "The vertex after the head on the curve; where it ends there in a corner, its mirror image.");
}

}  // namespace

void add_own_sites(py::module_& m) {
  py::options words;
  words.disable_function_signatures();
  add_numbers(m);
  add_stencils(m);
  add_faces(m);
  add_edges(m);
  add_rings(m);
  add_wide_sites(m);
  add_creases(m);
}

}  // namespace sublimit::python
