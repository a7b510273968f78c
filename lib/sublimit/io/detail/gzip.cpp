// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <deque>
#include <limits>
#include <new>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/file_extension.h"

namespace sublimit {
namespace {

/// Inflates members of a gzip file from the beginning of `bytes` on.
class Inflater {
 public:
  Inflater(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {
    constexpr int gzip_alone = 15 + 16;  // the largest window, and no other format
    if (inflateInit2(&stream_, gzip_alone) != Z_OK) throw std::bad_alloc();
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream_); }

  std::string read() {
    while (at_ < bytes_.size()) {
      if (at_ > 0 && bytes_.find_first_not_of('\0', at_) == std::string_view::npos)
        break;  // blocks of tapes, as gzip(1)
      if (!is_gzip(bytes_.substr(at_))) fail("bytes that are no gzip file, behind the end of one; cut them off");
      read_member();
      inflateReset(&stream_);
    }
    return joined();
  }

 private:
  void read_member() {
    for (int status = Z_OK; status != Z_STREAM_END;) {
      if (used_ == last_.size()) grow();
      constexpr std::size_t most = std::numeric_limits<uInt>::max();
      const auto given = static_cast<uInt>(std::min(most, bytes_.size() - at_));
      const auto room = static_cast<uInt>(std::min(most, last_.size() - used_));
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes_.data() + at_));
      stream_.avail_in = given;
      stream_.next_out = reinterpret_cast<Bytef*>(last_.data() + used_);
      stream_.avail_out = room;
      status = inflate(&stream_, Z_NO_FLUSH);
      at_ += given - stream_.avail_in;
      used_ += room - stream_.avail_out;
      if (status == Z_MEM_ERROR) throw std::bad_alloc();
      if (status == Z_OK || status == Z_STREAM_END) continue;
      if (status != Z_BUF_ERROR) fail("compressed bytes are damaged (" + std::string(stream_.msg) + "); copy it again");
      if (at_ == bytes_.size()) fail("the compressed file ends too early; copy it again");
    }
  }

  // What a file says of its size is not believed. Blocks are not moved when more is needed, and the last copy of all
  // gives them back one by one: never is there more than the text, a block and the compressed bytes.
  void grow() {
    constexpr std::size_t least = 1 << 16, most = 1 << 24;
    const std::size_t next = std::clamp(size() / 4, least, most);
    if (double(bytes_.size()) + double(size()) + 2.0 * double(next) > memory_limit())
      throw ResourceError(name_ + ": inflates to more than " + bytes_in_words(double(size())) + "; " +
                          memory_limit_in_words() + "; a smaller file can be read");
    if (!last_.empty()) full_.push_back(std::move(last_));
    full_bytes_ += used_;
    last_ = std::string(next, '\0');
    used_ = 0;
  }

  std::size_t size() const { return full_bytes_ + used_; }

  std::string joined() {
    std::string all;
    all.reserve(size());
    for (; !full_.empty(); full_.pop_front()) all += full_.front();
    last_.resize(used_);
    return all.empty() ? std::move(last_) : all += last_;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw FormatError(name_ + ": byte " + format_number(at_) + ": " + what);
  }

  std::string_view bytes_;
  std::string name_;
  std::size_t at_ = 0;  // bytes read
  std::deque<std::string> full_;
  std::string last_;
  std::size_t full_bytes_ = 0, used_ = 0;  // in the full blocks, in the last one
  z_stream stream_{};
};

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

std::string inflated(std::string_view bytes, const std::string& name) {
  try {
    return Inflater(bytes, name).read();
  } catch (const std::bad_alloc&) {
    throw ResourceError(name + ": does not fit into memory");
  }
}

std::string read_inflated(const std::filesystem::path& path) {
  std::string bytes = read_file(path);
  return is_gzip(bytes) ? inflated(bytes, path.string()) : bytes;
}

std::filesystem::path without_gz(const std::filesystem::path& path) {
  return file_extension(path).ends_with(".gz") ? path.parent_path() / path.stem() : path;
}

}  // namespace sublimit
