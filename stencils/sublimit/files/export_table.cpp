// SPDX-License-Identifier: Apache-2.0
#include "sublimit/files/export_table.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "sublimit/base/atomic_file.h"
#include "sublimit/base/error.h"
#include "sublimit/base/file_error.h"
#include "sublimit/base/followed_links.h"
#include "sublimit/files/matrix_market.h"
#include "sublimit/files/npy.h"
#include "sublimit/files/npz.h"
#include "sublimit/io/file_extension.h"
#include "sublimit/table_tensors.h"

namespace sublimit {
namespace {

/// A directory that gets its name when all is in it.
class AtomicDirectory {
 public:
  explicit AtomicDirectory(const std::filesystem::path& target)
      : target_(followed_links(target.has_filename() ? target : target.parent_path())), temporary_(target_) {
    if (!target_.has_filename()) throw_file_error(target, "write", EISDIR, "name a directory that is not there yet");
    std::error_code error;
    const bool exists = std::filesystem::exists(target_, error);
    if (exists && !std::filesystem::is_directory(target_, error)) throw_file_error(target_, "write", ENOTDIR);
    if (exists && !std::filesystem::is_empty(target_, error))
      throw_file_error(target_, "write", ENOTEMPTY, "name a directory that is not there yet");
    std::string name = (target_.parent_path() / ("." + target_.filename().string() + ".XXXXXX")).string();
    if (!::mkdtemp(name.data())) throw_file_error(target_, "write", errno, "the directory that it is in must exist");
    temporary_ = name;
    std::filesystem::permissions(temporary_,
                                 std::filesystem::perms::group_read | std::filesystem::perms::group_exec |
                                     std::filesystem::perms::others_read | std::filesystem::perms::others_exec,
                                 std::filesystem::perm_options::add, error);
  }
  AtomicDirectory(const AtomicDirectory&) = delete;
  AtomicDirectory& operator=(const AtomicDirectory&) = delete;
  ~AtomicDirectory() {
    std::error_code ignored;
    if (!temporary_.empty()) std::filesystem::remove_all(temporary_, ignored);
  }
  const std::filesystem::path& path() const { return temporary_; }
  void commit() {
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) throw_file_error(target_, "write", errno);
    temporary_.clear();
  }

 private:
  std::filesystem::path target_, temporary_;
};

void write_directory(const std::filesystem::path& path, const Safetensors& file) {
  AtomicDirectory directory(path);
  for (const Tensor& tensor : file.tensors) {
    AtomicFile out(directory.path() / (tensor.name + ".npy"));
    out.write(npy_header(tensor.dtype, tensor.shape));
    out.write({reinterpret_cast<const char*>(tensor.bytes.data()), tensor.bytes.size()});
    out.commit();
  }
  AtomicFile metadata(directory.path() / "metadata.json");
  metadata.write(nlohmann::json(file.metadata).dump(2) + "\n");
  metadata.commit();
  directory.commit();
}

}  // namespace

void export_table(const std::filesystem::path& path, const AnyTable& table) {
  const std::string extension = file_extension(path);
  std::visit(
      [&](const auto& baked) {
        if (extension == ".npz") return write_scipy_csr(path, baked.table.expanded());
        if (extension == ".mtx") return write_matrix_market(path, baked.table.expanded());
        if (extension.empty()) return write_directory(path, TableTensors(baked).file());
        throw InvalidParameter(path.string() + ": exports are .npz (SciPy), .mtx (Matrix Market), or a directory of " +
                               ".npy, whose name has no extension");
      },
      table);
}

}  // namespace sublimit
