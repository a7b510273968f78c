// SPDX-License-Identifier: Apache-2.0
#include "support/standard_streams.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>

#include "sublimit/base/detail/file_error.h"
#include "sublimit/base/error.h"

namespace sublimit::cli {
namespace {

/// A standard descriptor, and what became of it.
struct Stream {
  int descriptor;
  bool missing = false;  ///< closed before the program began
  bool closed = false;   ///< by its reader
  int error = 0;         ///< errno of the first write that failed for another reason
};
Stream standard_input{STDIN_FILENO}, standard_output{STDOUT_FILENO}, standard_error{STDERR_FILENO};

/// Writes all, or forgets it: code that prints need not ask whether somebody still reads.
ssize_t write_or_drop(void* cookie, const char* data, size_t size) {
  Stream& stream = *static_cast<Stream*>(cookie);
  for (size_t done = 0; done < size && !stream.closed && stream.error == 0;) {
    const ssize_t count = ::write(stream.descriptor, data + done, size - done);
    if (count > 0) {
      done += size_t(count);
    } else if (count < 0 && errno == EAGAIN) {  // whoever shares the pipe made it so
      pollfd ready{stream.descriptor, POLLOUT, 0};
      ::poll(&ready, 1, -1);
    } else if (count < 0 && errno == EPIPE) {
      stream.closed = true;
    } else if (count == 0 || errno != EINTR) {
      stream.error = count == 0 ? EIO : errno;
    }
  }
  return ssize_t(size);
}

std::FILE* stream_to(Stream& stream, int buffering) {
  std::FILE* file = ::fopencookie(&stream, "w", {nullptr, write_or_drop, nullptr, nullptr});
  if (file) std::setvbuf(file, nullptr, ::isatty(stream.descriptor) ? _IOLBF : buffering, BUFSIZ);
  return file;
}

}  // namespace

void prepare_standard_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  for (Stream* stream : {&standard_input, &standard_output, &standard_error}) {
    stream->missing = ::fcntl(stream->descriptor, F_GETFD) < 0;
    if (stream->missing)  // the lowest that is free is the one that `open` gives
      (void)!::open("/dev/null", stream == &standard_input ? O_RDONLY : O_WRONLY);
  }
  if (std::FILE* file = stream_to(standard_output, _IOFBF)) stdout = file;
  if (std::FILE* file = stream_to(standard_error, _IOLBF)) stderr = file;
}

void print_on_stderr() {
  std::fflush(stdout);
  stdout = stderr;
}

void check_standard_stream(int descriptor) {
  if (descriptor == STDIN_FILENO && standard_input.missing)
    throw IoError("standard input is closed; give a file, or a pipe");
  if (descriptor == STDOUT_FILENO && standard_output.missing)
    throw IoError("standard output is closed; give a file, or a pipe");
}

int finish_standard_streams(const char* program, int status) {
  std::fflush(stdout);
  std::fflush(stderr);
  if (standard_output.error == 0) return status;
  try {
    throw_file_error("standard output", "write", standard_output.error);
  } catch (const Error& error) {
    fmt::print(stderr, "{}: {}\n", program, error.what());
    std::fflush(stderr);
    return status == 0 ? exit_status(error.code()) : status;
  }
}

}  // namespace sublimit::cli
