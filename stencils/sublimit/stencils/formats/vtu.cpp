// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/formats/vtu.h"

#include <algorithm>
#include <array>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/row_writer.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

constexpr std::int64_t cells_per_block = 512;

/// Appends the triangle of lattice points with corner (at, at) and so many steps a side.
void append_triangle(const PolynomialBasis& basis, int at, int degree, std::vector<Eigen::Index>& order) {
  const auto add = [&](int i, int j) { order.push_back(net_row(basis, at + i, at + j)); };
  if (degree < 0) return;
  add(0, 0);
  if (degree == 0) return;
  add(degree, 0);
  add(0, degree);
  for (int k = 1; k < degree; ++k) add(k, 0);
  for (int k = 1; k < degree; ++k) add(degree - k, k);
  for (int k = 1; k < degree; ++k) add(0, degree - k);
  append_triangle(basis, at + 1, degree - 3, order);
}

/// An array of the file, a line for each cell.
class Arrays {
 public:
  Arrays(RowWriter& out, std::int64_t cells) : out_(out), cells_(cells) {}
  /// @param append  (text, cell)
  template <class Append>
  void write(const std::string& attributes, const Append& append) {
    out_.write("<DataArray " + attributes + " format=\"ascii\">\n");
    out_.rows(cells_, cells_per_block, [&](std::string& text, std::int64_t begin, std::int64_t end) {
      for (std::int64_t c = begin; c < end; ++c) {
        append(text, size_t(c));
        text += '\n';
      }
    });
    out_.write("</DataArray>\n");
  }

 private:
  RowWriter& out_;
  std::int64_t cells_;
};

template <class T>
void append_word(std::string& text, T number) {
  append_number(text, number);
  text += ' ';
}

}  // namespace

std::vector<Eigen::Index> vtk_order(int degree, bool triangle) {
  const PolynomialBasis basis(degree, triangle);
  std::vector<Eigen::Index> order;
  if (triangle) {
    append_triangle(basis, 0, degree, order);
    return order;
  }
  const auto add = [&](int i, int j) { order.push_back(net_row(basis, i, j)); };
  add(0, 0), add(degree, 0), add(degree, degree), add(0, degree);
  for (int k = 1; k < degree; ++k) add(k, 0);
  for (int k = 1; k < degree; ++k) add(degree, k);
  for (int k = 1; k < degree; ++k) add(k, degree);
  for (int k = 1; k < degree; ++k) add(0, k);
  for (int j = 1; j < degree; ++j)
    for (int i = 1; i < degree; ++i) add(i, j);
  return order;
}

void write_vtu(const std::filesystem::path& path, const BezierCells& all, const Addresses& addresses,
               const std::function<void(std::int64_t)>& progress) {
  const std::vector<BezierCell>& cells = all.cells;
  std::vector<std::int64_t> ends;
  std::int64_t points = 0;
  std::array<std::vector<std::vector<Eigen::Index>>, 2> orders;  // by shape, then degree
  for (const BezierCell& cell : cells) {
    if (!cell.net.allFinite())
      throw InvalidMesh(path.string() + ": a point of face " + format_number(cell.address) +
                        " is infinite or not a number; nothing is written");
    ends.push_back(points += cell.net.rows());
    auto& known = orders[cell.triangle];
    if (std::ssize(known) <= cell.degree) known.resize(size_t(cell.degree) + 1);
    if (known[size_t(cell.degree)].empty()) known[size_t(cell.degree)] = vtk_order(cell.degree, cell.triangle);
  }
  AtomicFile file(path, progress);
  RowWriter out(file);
  out.write(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
      format_number(points) + "\" NumberOfCells=\"" + format_number(std::ssize(cells)) + "\">\n");
  Arrays arrays(out, std::ssize(cells));
  out.write("<Points>\n");
  arrays.write("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", [&](std::string& text, size_t c) {
    for (const Eigen::Index row : orders[cells[c].triangle][size_t(cells[c].degree)])
      for (Eigen::Index k = 0; k < 3; ++k) append_word(text, cells[c].net(row, k));
  });
  out.write("</Points>\n<Cells>\n");
  arrays.write("type=\"Int64\" Name=\"connectivity\"", [&](std::string& text, size_t c) {
    for (std::int64_t p = ends[c] - cells[c].net.rows(); p < ends[c]; ++p) append_word(text, p);
  });
  arrays.write("type=\"Int64\" Name=\"offsets\"", [&](std::string& text, size_t c) { append_number(text, ends[c]); });
  arrays.write("type=\"UInt8\" Name=\"types\"",
               [&](std::string& text, size_t c) { text += cells[c].triangle ? "76" : "77"; });
  out.write("</Cells>\n<CellData HigherOrderDegrees=\"HigherOrderDegrees\">\n");
  arrays.write("type=\"Float64\" Name=\"HigherOrderDegrees\" NumberOfComponents=\"3\"",
               [&](std::string& text, size_t c) {
                 append_word(text, cells[c].degree);
                 append_word(text, cells[c].degree);
                 text += '0';
               });
  arrays.write("type=\"Int32\" Name=\"face\"",
               [&](std::string& text, size_t c) { append_number(text, cells[c].address); });
  arrays.write("type=\"Int32\" Name=\"control_face\"", [&](std::string& text, size_t c) {
    append_number(text, index(addresses.place(cells[c].address).face));
  });
  arrays.write("type=\"Float64\" Name=\"corners\" NumberOfComponents=\"8\"", [&](std::string& text, size_t c) {
    for (size_t k = 0; k < 4; ++k) {
      const CellCorner& at = cells[c].corners[cells[c].triangle ? std::min(k, size_t{2}) : k];
      append_word(text, double(at.i) / cell_steps);
      append_word(text, double(at.j) / cell_steps);
    }
  });
  arrays.write("type=\"UInt8\" Name=\"exact\"",
               [&](std::string& text, size_t c) { text += cells[c].exact ? '1' : '0'; });
  out.write("</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  file.commit();
}

}  // namespace sublimit
