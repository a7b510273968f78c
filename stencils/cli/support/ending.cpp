// SPDX-License-Identifier: Apache-2.0
#include "support/ending.h"

#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <system_error>
#include <thread>

#include "support/standard_streams.h"
#include "sublimit/base/detail/temporaries.h"
#include "sublimit/base/error.h"
#include "sublimit/certificates/numbers/detail/out_of_memory.h"

namespace sublimit::cli {
namespace {

constexpr int fault_of_ours = 70;
constexpr int lacking_resources = exit_status(ErrorCode::resource_error);
constexpr const char* out_of_memory = "out of memory; use fewer levels or samples";
constexpr const char* no_thread = "cannot start a thread; use fewer of them, by --threads: ";

std::atomic<bool> interrupted = false;

/// A line on standard error, whatever becomes of it: neither takes memory nor throws.
void tell(const char* what, const char* more = "") noexcept {
  for (const char* part : {"sublimit: ", what, more, "\n"}) std::fputs(part, stderr);
}

struct Failure {
  int status = fault_of_ours;
  const char *what = "", *more = "";
};

Failure failure(const std::exception& error) noexcept {
  if (const auto* ours = dynamic_cast<const Error*>(&error)) {
    const int status = exit_status(ours->code());
    return {status, status == fault_of_ours ? "a fault of ours: " : "", error.what()};
  }
  if (dynamic_cast<const std::bad_alloc*>(&error)) return {lacking_resources, out_of_memory};
  if (const auto* system = dynamic_cast<const std::system_error*>(&error)) {
    if (system->code() == std::errc::not_enough_memory) return {lacking_resources, out_of_memory};
    if (system->code() == std::errc::resource_unavailable_try_again)
      return {lacking_resources, no_thread, error.what()};
  }
  if (std::strstr(error.what(), "pthread_create"))  // of oneTBB
    return {lacking_resources, no_thread, error.what()};
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
  std::set_terminate([] {
    if (std::current_exception()) end_at_once(status_of_exception());
    // Thrown out of what throws nothing, as libraries do that make threads while they are loaded.
    if (std::uncaught_exceptions() > 0) {
      tell("out of memory, or of threads");
      end_at_once(lacking_resources);
    }
    end_at_once(fault_of_ours);
  });
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
  status = finish_standard_streams("sublimit", status);
  ::_exit(interrupted ? 130 : status);  // the thread that waits for interrupts has nothing to finish
}

}  // namespace sublimit::cli
