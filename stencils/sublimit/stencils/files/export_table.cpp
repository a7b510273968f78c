// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/files/export_table.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <forward_list>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/detail/file_error.h"
#include "sublimit/base/detail/followed_links.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/file/detail/table_tensors.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/formats/matrix_market.h"
#include "sublimit/stencils/formats/npy.h"
#include "sublimit/stencils/formats/npz.h"

namespace sublimit {
namespace {

/// A directory that gets its name when all is in it.
class AtomicDirectory {
 public:
  explicit AtomicDirectory(const std::filesystem::path& target)
      : target_(followed_links(target.has_filename() ? target : target.parent_path())) {
    if (!target_.has_filename()) throw_file_error(target, "write", EISDIR, "name a directory that is not there yet");
    std::error_code error;
    const bool exists = std::filesystem::exists(target_, error);
    if (exists && !std::filesystem::is_directory(target_, error)) throw_file_error(target_, "write", ENOTDIR);
    if (exists && !std::filesystem::is_empty(target_, error))
      throw_file_error(target_, "write", ENOTEMPTY, "name a directory that is not there yet");
    const int failed = temporary_.make_beside(target_, [](const char* name) { return ::mkdir(name, 0777) == 0; });
    if (failed != 0) throw_file_error(target_, "write", failed, "the directory that it is in must exist");
  }
  AtomicDirectory(const AtomicDirectory&) = delete;
  AtomicDirectory& operator=(const AtomicDirectory&) = delete;
  /// Writes a file in it.
  void write(const std::string& name, std::initializer_list<std::string_view> parts) {
    files_.emplace_front(temporary_.name() + "/" + name);
    AtomicFile file(files_.front().name());
    for (const std::string_view part : parts) file.write(part);
    file.commit();
  }
  void commit() {
    if (std::rename(temporary_.name().c_str(), target_.c_str()) != 0) throw_file_error(target_, "write", errno);
    for (Temporary& file : files_) file.forget();
    temporary_.forget();
  }

 private:
  std::filesystem::path target_;
  Temporary temporary_;
  std::forward_list<Temporary> files_;  // go before the directory does
};

void write_directory(const std::filesystem::path& path, const Safetensors& file) {
  AtomicDirectory directory(path);
  for (const Tensor& tensor : file.tensors)
    directory.write(tensor.name + ".npy", {npy_header(tensor.dtype, tensor.shape),
                                           {reinterpret_cast<const char*>(tensor.bytes.data()), tensor.bytes.size()}});
  directory.write("metadata.json", {nlohmann::json(file.metadata).dump(2) + "\n"});
  directory.commit();
}

}  // namespace

void export_table(const std::filesystem::path& path, const AnyTable& table) {
  const bool is_directory = !path.has_extension();
  if (!is_directory && !all_formats().writes(path, contents::table_rows))
    throw InvalidParameter(path.string() + ": exports are " +
                           all_formats().writers_in_words({contents::table_rows}, "") +
                           ", or a directory of .npy, whose name has no extension");
  std::visit(
      [&](const auto& baked) {
        if (is_directory) return write_directory(path, TableTensors(baked).file());
        const auto rows = baked.table.expanded();
        if (all_formats().writes(path, contents::matrices)) return write_matrix_market(path, rows);
        write_scipy_csr(path, rows);
      },
      table);
}

}  // namespace sublimit
