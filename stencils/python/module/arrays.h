// SPDX-License-Identifier: Apache-2.0
#pragma once
// Arrays of the library as NumPy arrays, and the reverse. Results are not copied: a NumPy array refers to the
// memory of the library and keeps its owner alive.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit::python {

namespace py = pybind11;

/// An array from the Python package, which has checked it: numbers of type T in C order.
template <class T>
using Array = py::array_t<T, py::array::c_style>;

template <class T>
std::span<const T> span(const Array<T>& array) {
  return {array.data(), size_t(array.size())};
}
template <class T>
std::vector<T> vector(const Array<T>& array) {
  return {array.data(), array.data() + array.size()};
}
inline Points points(const Array<double>& array) {
  return Eigen::Map<const Points>(array.data(), array.shape(0), array.shape(1));
}

/// Returns a read-only array that refers to memory of `owner`, without a copy.
template <class T>
py::array_t<T> view(const T* data, std::vector<py::ssize_t> shape, const py::handle& owner) {
  py::array_t<T> array(std::move(shape), data, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}
template <class T>
py::array_t<T> view(const std::vector<T>& values, const py::handle& owner) {
  return view(values.data(), {py::ssize_t(values.size())}, owner);
}
inline py::array_t<double> view(const Points& points, const py::handle& owner) {
  return view(points.data(), {points.rows(), points.cols()}, owner);
}

/// Moves a value to memory that Python owns: returns a pointer to it, and the object that deletes it.
template <class T>
std::pair<T*, py::capsule> kept(T&& value) {
  auto owned = std::make_unique<T>();
  owned->swap(value);
  py::capsule owner(owned.get(), [](void* memory) { delete static_cast<T*>(memory); });
  return {owned.release(), std::move(owner)};
}
template <class T, class Allocator>
py::array_t<T> array(std::vector<T, Allocator>&& values) {
  auto [all, owner] = kept(std::move(values));
  return py::array_t<T>({py::ssize_t(all->size())}, all->data(), owner);
}
inline py::array_t<double> array(Points&& points) {
  auto [all, owner] = kept(std::move(points));
  return py::array_t<double>({all->rows(), all->cols()}, all->data(), owner);
}

/// Returns a matrix as the arguments of SciPy's csr_array: (weights, columns, starts of rows, (rows, columns)).
inline py::tuple csr(SparseMatrix&& matrix) {
  matrix.makeCompressed();
  auto [all, owner] = kept(std::move(matrix));
  const py::ssize_t count = all->nonZeros();
  return py::make_tuple(py::array_t<double>({count}, all->valuePtr(), owner),
                        py::array_t<Index>({count}, all->innerIndexPtr(), owner),
                        py::array_t<Index>({py::ssize_t(all->rows()) + 1}, all->outerIndexPtr(), owner),
                        py::make_tuple(all->rows(), all->cols()));
}

/// Returns the first row that is not finite of the first of `parts` that has one; absent if all are finite.
inline std::optional<Eigen::Index> first_infinite_row(std::initializer_list<const Points*> parts) {
  for (const Points* part : parts) {
    if (part->allFinite()) continue;
    Eigen::Index row = 0;
    while (part->row(row).allFinite()) ++row;
    return row;
  }
  return std::nullopt;
}

}  // namespace sublimit::python
