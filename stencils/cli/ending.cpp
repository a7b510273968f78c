// SPDX-License-Identifier: Apache-2.0
#include "ending.h"

#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>
#include <thread>

#include "sublimit/base/error.h"
#include "sublimit/base/temporaries.h"
#include "sublimit/certificates/out_of_memory.h"

namespace sublimit::cli {
namespace {

constexpr int fault_of_ours = 70;
constexpr int lacking_resources = exit_status(ErrorCode::resource_error);
constexpr const char* out_of_memory = "out of memory; use fewer levels or samples";

std::atomic<bool> interrupted = false;

/// A line on standard error, whatever becomes of it: neither takes memory nor throws.
void tell(const char* what, const char* more = "") noexcept {
  for (const char* part : {"sublimit: ", what, more, "\n"}) std::fputs(part, stderr);
}

struct Failure {
  int status = fault_of_ours;
  const char *what = "", *more = "";
};

/// An output or a thread that the system refuses.
Failure refused(const char* what, int number) noexcept {
  const bool lacking = number == ENOSPC || number == EFBIG || number == EDQUOT || number == ENOMEM || number == EAGAIN;
  return {lacking ? lacking_resources : exit_status(ErrorCode::io_error), what, std::strerror(number)};
}

Failure failure(const std::exception& error) noexcept {
  if (const auto* ours = dynamic_cast<const Error*>(&error)) {
    const int status = exit_status(ours->code());
    return {status, status == fault_of_ours ? "a fault of ours: " : "", error.what()};
  }
  if (dynamic_cast<const std::bad_alloc*>(&error)) return {lacking_resources, out_of_memory};
  if (const auto* system = dynamic_cast<const std::system_error*>(&error)) {
    const int number = system->code().value();
    if (std::ferror(stdout)) return refused("cannot write standard output: ", number);
    if (std::ferror(stderr)) return refused("cannot write standard error: ", number);
    if (number == ENOMEM) return {lacking_resources, out_of_memory};
    if (number == EAGAIN) return refused("cannot start a thread: ", number);
  }
  if (std::strstr(error.what(), "pthread_create"))  // of oneTBB
    return {lacking_resources, "cannot start a thread; use fewer of them, by --threads: ", error.what()};
  return {fault_of_ours, "a fault of ours: ", error.what()};
}

[[noreturn]] void end_at_once(int status) noexcept {
  Temporary::remove_all();
  ::_exit(status);
}

}  // namespace

void handle_interrupts() {
  sigset_t interrupts;
  sigemptyset(&interrupts);
  for (const int number : {SIGINT, SIGTERM}) {
    struct sigaction action {};
    ::sigaction(number, nullptr, &action);
    if (action.sa_handler != SIG_IGN) sigaddset(&interrupts, number);  // nohup and `&` ask us not to care
  }
  pthread_sigmask(SIG_BLOCK, &interrupts, nullptr);
  std::thread([interrupts] {
    int signal = 0;
    while (sigwait(&interrupts, &signal) != 0) ::pause();  // only if there are none to wait for
    interrupted = true;
    end_at_once(130);
  }).detach();
}

void handle_lack_of_memory() {
  std::set_terminate([] { end_at_once(std::current_exception() ? status_of_exception() : fault_of_ours); });
  set_out_of_memory_handler([] {
    tell(out_of_memory);
    end_at_once(lacking_resources);
  });
}

int status_of_exception(std::string* message) noexcept {
  const auto report = [message](const Failure& failed) noexcept {
    if (interrupted) return 130;  // its temporary was taken away
    if (!message) {
      tell(failed.what, failed.more);
      return failed.status;
    }
    try {
      *message = failed.what;
      *message += failed.more;
    } catch (const std::bad_alloc&) {  // what of it there is room for
    }
    return failed.status;
  };
  try {
    throw;
  } catch (const std::exception& error) {
    return report(failure(error));
  } catch (...) {
    return report({fault_of_ours, "a fault of ours"});
  }
}

int guarded(const std::function<int()>& body) noexcept {
  try {
    return body();
  } catch (...) {
    return status_of_exception();
  }
}

void end(int status) noexcept {
  const bool failed_before = std::ferror(stdout) != 0;
  errno = 0;
  const bool failed = std::fflush(stdout) != 0 || failed_before;
  if (status == 0 && failed) {
    const Failure why = refused("cannot write standard output: ", errno == 0 ? EIO : errno);
    tell(why.what, why.more);
    status = why.status;
  }
  ::_exit(interrupted ? 130 : status);  // the thread that waits for interrupts has nothing to finish
}

}  // namespace sublimit::cli
