// SPDX-License-Identifier: Apache-2.0
#pragma once
// Temporary files and directories, which are removed unless they are finished. A process has one list of them,
// so that a program that ends early, by Ctrl-C or a lack of memory, can remove them without allocating memory.
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <string>
#include <utility>

namespace sublimit {

/// The name of a file or directory that the destructor removes; may be empty. Directories must be empty by
/// then, so that their files must be listed after them.
class Temporary {
 public:
  Temporary() = default;
  /// Adds a name to the list. To be called before the file is made, so that it cannot be missed.
  explicit Temporary(std::string name) { list(std::move(name)); }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    if (!name_.empty()) std::remove(name_.c_str());
    forget();
  }

  /// Makes a new file or directory beside `target`, named ".NAME.PID-N.tmp".
  /// @param make  make(name) makes the file or directory and returns true on success. The name is
  ///              null-terminated. With errno EEXIST another name is tried
  /// @return  0, or errno
  template <class Make>
  int make_beside(const std::filesystem::path& target, const Make& make) {
    static std::atomic<unsigned> counter{0};
    // By characters: operator/ of paths ends the program where it gets no memory (libstdc++ 12).
    const std::string& whole = target.native();
    const std::size_t start = whole.rfind('/') + 1;                                            // 0 without one
    const std::string prefix = whole.substr(0, start) + "." + whole.substr(start, 200) + ".";  // 255 bytes in all
    for (;;) {
      list(prefix + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp");
      if (make(name_.c_str())) return 0;
      const int error = errno;
      forget();  // it may belong to another process
      if (error != EEXIST) return error;
    }
  }

  /// Removes the name from the list; the file stays.
  void forget() noexcept {
    if (name_.empty()) return;
    {
      const std::lock_guard lock(mutex_);
      (next_ ? next_->before_ : last_) = before_;
      if (before_) before_->next_ = next_;
      before_ = next_ = nullptr;
    }
    name_.clear();
  }
  bool empty() const { return name_.empty(); }
  const std::string& name() const { return name_; }

  /// Removes all listed files and directories, the last one first. Threads that list or forget a name afterwards block
  /// for ever: the process must end at once.
  static void remove_all() noexcept {
    mutex_.lock();
    for (const Temporary* at = last_; at; at = at->before_) std::remove(at->name_.c_str());
  }

 private:
  void list(std::string name) {
    name_ = std::move(name);
    const std::lock_guard lock(mutex_);
    before_ = last_;
    if (before_) before_->next_ = this;
    last_ = this;
  }

  std::string name_;  // never changes while it is in the list
  Temporary *before_ = nullptr, *next_ = nullptr;
  inline static constinit std::mutex mutex_{};
  inline static constinit Temporary* last_ = nullptr;
};

}  // namespace sublimit
