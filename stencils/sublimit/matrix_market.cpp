// SPDX-License-Identifier: Apache-2.0
#include "sublimit/matrix_market.h"

#include <string>

#include "sublimit/base/atomic_file.h"
#include "sublimit/base/format_number.h"

namespace sublimit {

void write_matrix_market(const std::filesystem::path& path, const SparseMatrix& matrix) {
  AtomicFile file(path);
  std::string line = "%%MatrixMarket matrix coordinate real general\n";
  for (const auto number :
       {std::int64_t(matrix.rows()), std::int64_t(matrix.cols()), std::int64_t(matrix.nonZeros())}) {
    append_number(line, number);
    line += ' ';
  }
  line.back() = '\n';
  file.write(line);
  for (Index r = 0; r < matrix.rows(); ++r)
    for (SparseMatrix::InnerIterator it(matrix, r); it; ++it) {
      line.clear();
      append_number(line, r + 1);
      line += ' ';
      append_number(line, it.col() + 1);
      line += ' ';
      append_number(line, it.value());
      line += '\n';
      file.write(line);
    }
  file.commit();
}

}  // namespace sublimit
