// SPDX-License-Identifier: Apache-2.0
#include "sublimit/files/place_files.h"

#include "sublimit/base/atomic_file.h"
#include "sublimit/base/row_writer.h"
#include "sublimit/files/csv_fields.h"

namespace sublimit {

void write_places(const std::filesystem::path& path, std::span<const Sample> places) {
  constexpr std::int64_t rows_per_block = 4096;
  AtomicFile file(path);
  RowWriter out(file);
  out.write("face,u,v\n");
  out.rows(std::ssize(places), rows_per_block, [&](std::string& text, std::int64_t begin, std::int64_t end) {
    for (const Sample& s : places.subspan(size_t(begin), size_t(end - begin))) {
      append_place(text, s);
      text += '\n';
    }
  });
  file.commit();
}

}  // namespace sublimit
