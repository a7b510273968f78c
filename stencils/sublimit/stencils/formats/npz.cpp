// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/formats/npz.h"

#include <zip.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/detail/file_error.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/formats/npy.h"

namespace sublimit {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, zip_error_t* error) {
  const int code = zip_error_code_zip(error);
  if (code == ZIP_ER_MEMORY || code == ZIP_ER_OK) throw std::bad_alloc();  // which libzip 1.7 does not always say
  if (zip_error_system_type(error) == ZIP_ET_SYS && zip_error_code_system(error) != 0)
    throw_file_error(path, "write", zip_error_code_system(error));
  throw IoError(path.string() + ": cannot write: " + zip_error_strerror(error));
}

/// One .npy file: a header, then data where it lies.
struct Entry {
  std::string header;
  std::string_view data;
  std::uint64_t at = 0;

  std::uint64_t size() const { return header.size() + data.size(); }
  std::uint64_t read(char* out, std::uint64_t length) {
    std::uint64_t done = 0;
    const auto copy = [&](std::string_view part, std::uint64_t offset) {
      if (offset >= part.size()) return;
      const std::uint64_t count = std::min<std::uint64_t>(length - done, part.size() - offset);
      std::memcpy(out + done, part.data() + offset, count);
      done += count;
    };
    if (at < header.size()) copy(header, at);
    if (done < length) copy(data, at + done - header.size());
    at += done;
    return done;
  }
};

/// What libzip asks of an entry.
zip_int64_t answer(void* state, void* data, zip_uint64_t length, zip_source_cmd_t command) {
  Entry& entry = *static_cast<Entry*>(state);
  switch (command) {
    case ZIP_SOURCE_OPEN:
      entry.at = 0;
      return 0;
    case ZIP_SOURCE_READ:
      return zip_int64_t(entry.read(static_cast<char*>(data), length));
    case ZIP_SOURCE_STAT: {
      auto* const status = static_cast<zip_stat_t*>(data);
      zip_stat_init(status);
      status->size = entry.size();
      status->valid = ZIP_STAT_SIZE;
      return sizeof(zip_stat_t);
    }
    case ZIP_SOURCE_ERROR: {
      const int none[2] = {ZIP_ER_OK, 0};
      std::memcpy(data, none, sizeof none);
      return sizeof none;
    }
    case ZIP_SOURCE_SUPPORTS:
      return zip_source_make_command_bitmap(ZIP_SOURCE_OPEN, ZIP_SOURCE_READ, ZIP_SOURCE_CLOSE, ZIP_SOURCE_STAT,
                                            ZIP_SOURCE_ERROR, ZIP_SOURCE_FREE, ZIP_SOURCE_SUPPORTS, -1);
    default:
      return 0;
  }
}

struct NamedEntry {
  std::string name;
  Entry entry;
};

/// The archive itself, which libzip writes through this and goes back in, to the header of each entry.
struct Archive {
  AtomicFile file;
  std::int64_t at = 0, end = 0;
  std::exception_ptr failure = nullptr;

  zip_int64_t write(const void* data, zip_uint64_t length) noexcept {
    try {
      const std::string_view bytes(static_cast<const char*>(data), length);
      const std::int64_t before = std::min(std::int64_t(length), end - at);
      if (before > 0) file.rewrite(at, bytes.substr(0, size_t(before)));
      file.write(bytes.substr(size_t(before)));
      at += std::int64_t(length);
      end = std::max(end, at);
      return zip_int64_t(length);
    } catch (...) {  // libzip is C
      failure = std::current_exception();
      return -1;
    }
  }
};

/// What libzip asks of the archive.
zip_int64_t archive_answer(void* state, void* data, zip_uint64_t length, zip_source_cmd_t command) {
  Archive& archive = *static_cast<Archive*>(state);
  switch (command) {
    case ZIP_SOURCE_WRITE:
      return archive.write(data, length);
    case ZIP_SOURCE_SEEK_WRITE: {
      zip_error_t error;
      zip_error_init(&error);
      const zip_int64_t to =
          zip_source_seek_compute_offset(zip_uint64_t(archive.at), zip_uint64_t(archive.end), data, length, &error);
      if (to < 0) return -1;
      archive.at = to;
      return 0;
    }
    case ZIP_SOURCE_TELL_WRITE:
      return archive.at;
    case ZIP_SOURCE_STAT: {
      auto* const status = static_cast<zip_stat_t*>(data);
      zip_stat_init(status);
      status->size = 0;
      status->valid = ZIP_STAT_SIZE;
      return sizeof(zip_stat_t);
    }
    case ZIP_SOURCE_ERROR: {
      const int failed[2] = {ZIP_ER_WRITE, 0};
      std::memcpy(data, failed, sizeof failed);
      return sizeof failed;
    }
    case ZIP_SOURCE_SUPPORTS:
      return ZIP_SOURCE_SUPPORTS_WRITABLE;
    default:
      return 0;
  }
}

void write_archive(const std::filesystem::path& path, std::vector<NamedEntry>& entries) {
  Archive archive{.file = AtomicFile(path, {}, AtomicFile::Access::anywhere)};
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* const whole = zip_source_function_create(archive_answer, &archive, &error);
  if (!whole) fail(path, &error);
  std::unique_ptr<zip_t, void (*)(zip_t*)> open(zip_open_from_source(whole, ZIP_CREATE | ZIP_TRUNCATE, &error),
                                                zip_discard);
  if (!open) {
    zip_source_free(whole);
    fail(path, &error);
  }
  for (NamedEntry& named : entries) {
    zip_source_t* const source = zip_source_function(open.get(), answer, &named.entry);
    if (!source) fail(path, zip_get_error(open.get()));
    const zip_int64_t index = zip_file_add(open.get(), (named.name + ".npy").c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) zip_source_free(source);
    constexpr std::uint16_t january_1980 = 1 << 5 | 1;  // as NumPy has it: no clock in the bytes
    if (index < 0 || zip_set_file_compression(open.get(), zip_uint64_t(index), ZIP_CM_STORE, 0) != 0 ||
        zip_file_set_dostime(open.get(), zip_uint64_t(index), 0, january_1980, 0) != 0)
      fail(path, zip_get_error(open.get()));
  }
  const bool closed = zip_close(open.get()) == 0;
  if (archive.failure) std::rethrow_exception(archive.failure);
  if (!closed) fail(path, zip_get_error(open.get()));
  (void)open.release();  // closing has freed it
  archive.file.commit();
}

std::string_view text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

void write_npz(const std::filesystem::path& path, std::span<const Tensor> arrays) {
  std::vector<NamedEntry> entries;
  for (const Tensor& t : arrays) entries.push_back({t.name, {npy_header(t.dtype, t.shape), text(t.bytes)}});
  write_archive(path, entries);
}

template <class Real>
void write_scipy_csr(const std::filesystem::path& path, const StencilTable<Real>& table) {
  const std::vector<std::int64_t> shape{table.num_rows(), table.num_control_points()};
  const std::vector<std::int64_t> entries{std::int64_t(table.columns().size())};
  static constexpr std::int64_t none[] = {0};
  const std::span<const std::int64_t> offsets = table.offsets().empty() ? none : table.offsets().span();
  std::vector<NamedEntry> files;
  const auto add = [&](const Tensor& t) { files.push_back({t.name, {npy_header(t.dtype, t.shape), text(t.bytes)}}); };
  add(tensor("indices", table.columns().span(), entries));
  add(tensor("indptr", offsets, {std::int64_t(offsets.size())}));
  // An array without dimensions, of three bytes: b'csr'. Its header is that of a byte but for the type.
  std::string header = npy_header(DType::U8, {});
  header.replace(header.find("|u1"), 3, "|S3");
  files.push_back({"format", {header, "csr"}});
  add(tensor("shape", std::span<const std::int64_t>(shape), {2}));
  add(tensor("data", table.weights().span(), entries));
  write_archive(path, files);
}

template void write_scipy_csr(const std::filesystem::path&, const StencilTable<float>&);
template void write_scipy_csr(const std::filesystem::path&, const StencilTable<double>&);

}  // namespace sublimit
