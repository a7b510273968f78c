// SPDX-License-Identifier: Apache-2.0
#pragma once
// Running the program as a child process, and its output.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/base/detail/read_file.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {

struct Outcome {
  int status = -1;  ///< -1: killed by a signal
  std::string out, err;
  long peak_kb = 0;  ///< peak memory, KB
};

/// A running program.
class Program {
 public:
  /// @param prepare  called in the child before the program starts, to set limits for example; must not
  ///                 allocate memory
  /// @param error    descriptor for stderr instead of `Outcome::err`
  /// @param program  path of another program, a copy for example
  explicit Program(const std::vector<std::string>& arguments, const std::function<void()>& prepare = {}, int error = -1,
                   const char* program = SUBLIMIT_PROGRAM)
      : out_(std::tmpfile()), err_(std::tmpfile()) {
    if (!out_ || !err_) throw std::runtime_error("no temporary files");
    std::vector<char*> words{const_cast<char*>(program)};
    for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    id_ = ::fork();
    if (id_ < 0) throw std::runtime_error("cannot fork");
    if (id_ > 0) return;
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
    ::dup2(::fileno(out_), STDOUT_FILENO);
    ::dup2(error >= 0 ? error : ::fileno(err_), STDERR_FILENO);
    if (prepare) prepare();
    ::execv(program, words.data());
    ::_exit(127);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() {
    if (!waited_) wait();
    std::fclose(out_);
    std::fclose(err_);
  }

  pid_t id() const { return id_; }

  Outcome wait() {
    int status = 0;
    rusage usage{};
    while (::wait4(id_, &status, 0, &usage) < 0 && errno == EINTR) continue;
    waited_ = true;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text(out_), text(err_), usage.ru_maxrss};
  }

 private:
  static std::string text(std::FILE* file) {
    std::string result;
    char block[4096];
    for (off_t at = 0;;) {
      const ssize_t count = ::pread(::fileno(file), block, sizeof block, at);
      if (count <= 0) return result;
      result.append(block, size_t(count));
      at += count;
    }
  }

  std::FILE *out_, *err_;
  pid_t id_ = -1;
  bool waited_ = false;
};

inline Outcome sublimit(const std::vector<std::string>& arguments, const std::function<void()>& prepare = {}) {
  return Program(arguments, prepare).wait();
}

inline void expect_parts(const std::string& text, std::initializer_list<std::string_view> parts) {
  for (const std::string_view part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << "no '" << part << "' in:\n" << text;
}

/// Expects status 0, and nothing on stderr unless `warned`.
inline Outcome expect_done(const Outcome& outcome, bool warned = false) {
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  if (!warned) {
    EXPECT_EQ(outcome.err, "");
  }
  return outcome;
}

/// Expects an answer, which is no.
inline Outcome expect_no(const Outcome& outcome) {
  EXPECT_EQ(outcome.status, 1) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.err, "");
  return outcome;
}

/// Expects a failure with this status and a message with every part.
inline void expect_failure(const Outcome& outcome, int status, std::initializer_list<std::string_view> parts) {
  EXPECT_EQ(outcome.status, status) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.out, "");
  expect_parts(outcome.err, parts);
}

inline size_t count_of(std::string_view text, std::string_view part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// Runs `refine` and `limit` on a file of this name and text, and expects that they fail and write nothing.
inline void expect_refused(const std::string& name, const std::string& text, const std::vector<std::string>& arguments,
                           int status, std::initializer_list<std::string_view> parts,
                           const std::string& output = "out.obj") {
  const TemporaryDirectory directory;
  const std::string mesh = directory.write(name, text).string();
  for (const char* command : {"refine", "limit"}) {
    std::vector<std::string> all{command, mesh, "-o", (directory / output).string()};
    if (std::ranges::find(arguments, "-l") == arguments.end()) all.insert(all.end(), {"-l", "1"});
    all.insert(all.end(), arguments.begin(), arguments.end());
    SCOPED_TRACE(command + (" " + text.substr(0, 60)));
    const Outcome outcome = sublimit(all);
    expect_failure(outcome, status, parts);
    EXPECT_EQ(count_of(outcome.err, "\n"), 1u) << outcome.err;
    EXPECT_EQ(directory.num_files(), 1);
  }
}

}  // namespace sublimit::testing
