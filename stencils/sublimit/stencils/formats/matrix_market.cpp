// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/formats/matrix_market.h"

#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/row_writer.h"

namespace sublimit {
namespace {

constexpr std::int64_t matrix_rows_per_text = 256;

/// @param for_each_in_row  (row, body): calls body(column, weight) for the entries of a row
template <class ForEachInRow>
void write(const std::filesystem::path& path, std::int64_t rows, std::int64_t columns, std::int64_t entries,
           const ForEachInRow& for_each_in_row) {
  AtomicFile file(path);
  std::string line = "%%MatrixMarket matrix coordinate real general\n";
  for (const std::int64_t number : {rows, columns, entries}) {
    append_number(line, number);
    line += ' ';
  }
  line.back() = '\n';
  RowWriter out(file);
  out.write(line);
  out.rows(rows, matrix_rows_per_text, [&](std::string& text, std::int64_t begin, std::int64_t end) {
    for (std::int64_t r = begin; r < end; ++r)
      for_each_in_row(r, [&](std::int64_t column, auto weight) {
        append_number(text, r + 1);
        text += ' ';
        append_number(text, column + 1);
        text += ' ';
        append_number(text, weight);
        text += '\n';
      });
  });
  file.commit();
}

}  // namespace

void write_matrix_market(const std::filesystem::path& path, const SparseMatrix& matrix) {
  write(path, matrix.rows(), matrix.cols(), matrix.nonZeros(), [&](std::int64_t r, const auto& body) {
    for (SparseMatrix::InnerIterator it(matrix, static_cast<Index>(r)); it; ++it) body(it.col(), it.value());
  });
}

template <class Real>
void write_matrix_market(const std::filesystem::path& path, const StencilTable<Real>& table) {
  write(path, table.num_rows(), table.num_control_points(), std::int64_t(table.columns().size()),
        [&](std::int64_t r, const auto& body) {
          for (std::int64_t at = table.offsets()[r]; at < table.offsets()[r + 1]; ++at)
            body(table.columns()[at], table.weights()[at]);
        });
}

template void write_matrix_market(const std::filesystem::path&, const StencilTable<float>&);
template void write_matrix_market(const std::filesystem::path&, const StencilTable<double>&);

}  // namespace sublimit
