// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/ranks.h"

#include <fmt/core.h>
#include <mpi.h>
#include <petscsys.h>

#include <signal.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

const MPI_Comm all_ranks = MPI_COMM_WORLD;

/// An error that all ranks have.
struct CommonError : Error {
  using Error::Error;
};

std::int64_t sent = 0;

}  // namespace

Ranks::Ranks(int& argc, char**& argv) {
  struct sigaction closed_pipes {};
  ::sigaction(SIGPIPE, nullptr, &closed_pipes);
  int threads = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_MULTIPLE, &threads);  // threads of PT-Scotch send messages too
  PetscInitializeNoArguments();
  PetscPopSignalHandler();                       // a fault is a fault: PETSc's page of advice is for its own
  ::sigaction(SIGPIPE, &closed_pipes, nullptr);  // which that has reset
  PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  MPI_Comm_rank(all_ranks, &rank_);
  MPI_Comm_size(all_ranks, &size_);
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(all_ranks, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, &on_this_machine_);
  MPI_Comm_free(&machine);
}

Ranks::~Ranks() {
  PetscFinalize();
  MPI_Finalize();
}

std::int64_t Ranks::sum(std::int64_t own) const {
  std::int64_t all = 0;
  MPI_Allreduce(&own, &all, 1, MPI_INT64_T, MPI_SUM, all_ranks);
  return all;
}

double Ranks::sum(double own) const {
  double all = 0;
  MPI_Allreduce(&own, &all, 1, MPI_DOUBLE, MPI_SUM, all_ranks);
  return all;
}

std::int64_t Ranks::sum_before(std::int64_t own) const {
  std::int64_t before = 0;
  MPI_Exscan(&own, &before, 1, MPI_INT64_T, MPI_SUM, all_ranks);
  return rank_ == 0 ? 0 : before;  // which MPI leaves undefined
}

std::int64_t Ranks::largest(std::int64_t own) const {
  std::int64_t all = 0;
  MPI_Allreduce(&own, &all, 1, MPI_INT64_T, MPI_MAX, all_ranks);
  return all;
}

double Ranks::largest(double own) const {
  double all = 0;
  MPI_Allreduce(&own, &all, 1, MPI_DOUBLE, MPI_MAX, all_ranks);
  return all;
}

std::vector<std::int64_t> Ranks::each(std::int64_t own) const {
  std::vector<std::int64_t> all(static_cast<size_t>(size_));
  MPI_Allgather(&own, 1, MPI_INT64_T, all.data(), 1, MPI_INT64_T, all_ranks);
  return all;
}

std::string Ranks::told_by_first(std::string text) const {
  std::int64_t size = std::ssize(text);
  MPI_Bcast(&size, 1, MPI_INT64_T, 0, all_ranks);
  text.resize(static_cast<size_t>(size));
  MPI_Bcast(text.data(), static_cast<int>(size), MPI_CHAR, 0, all_ranks);
  return text;
}

void Ranks::wait() const { MPI_Barrier(all_ranks); }

std::array<std::int64_t, 2> Ranks::handed_on(
    std::array<std::int64_t, 2> value,
    const std::function<std::array<std::int64_t, 2>(std::array<std::int64_t, 2>)>& own) const {
  if (rank_ > 0) MPI_Recv(value.data(), 2, MPI_INT64_T, rank_ - 1, 1, all_ranks, MPI_STATUS_IGNORE);
  together([&] {
    std::exception_ptr error;
    try {
      value = own(value);
    } catch (...) {
      error = std::current_exception();  // the ranks behind must not wait for it
    }
    if (rank_ + 1 < size_) MPI_Send(value.data(), 2, MPI_INT64_T, rank_ + 1, 1, all_ranks);
    if (error) std::rethrow_exception(error);
  });
  MPI_Bcast(value.data(), 2, MPI_INT64_T, size_ - 1, all_ranks);
  return value;
}

void Ranks::together(const std::function<void()>& step) const {
  bool failed = true;
  ErrorCode code = ErrorCode::resource_error;
  std::string message;
  try {
    step();
    failed = false;
  } catch (const Error& error) {
    code = error.code(), message = error.what();
  } catch (const std::bad_alloc&) {
    message = fmt::format("rank {}: out of memory", rank_);
  } catch (const std::exception& error) {
    code = ErrorCode::analysis_error, message = fmt::format("rank {}: {}", rank_, error.what());
  }
  const int own = failed ? rank_ : size_;
  int first = size_;
  MPI_Allreduce(&own, &first, 1, MPI_INT, MPI_MIN, all_ranks);
  if (first == size_) return;
  int about[2] = {static_cast<int>(code), static_cast<int>(message.size())};
  MPI_Bcast(about, 2, MPI_INT, first, all_ranks);
  message.resize(static_cast<size_t>(about[1]));
  MPI_Bcast(message.data(), about[1], MPI_CHAR, first, all_ranks);
  throw CommonError(static_cast<ErrorCode>(about[0]), message);
}

int Ranks::run(const std::function<void()>& job) const {
  int status = 70;
  try {
    job();
    return 0;
  } catch (const CommonError& error) {
    if (is_first()) std::fprintf(stderr, "sublimit-mpi: error: %s\n", error.what());
    return exit_status(error.code());
  } catch (const Error& error) {
    std::fprintf(stderr, "sublimit-mpi: error: rank %d: %s\n", rank_, error.what());
    status = exit_status(error.code());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sublimit-mpi: error: rank %d: %s\n", rank_, error.what());
  }
  MPI_Abort(all_ranks, status);
  return status;
}

void check_alike(const Ranks& ranks, const std::string& said, const std::string& what) {
  const std::string first = ranks.told_by_first(said);
  ranks.together([&] {
    if (said != first)
      throw InvalidOption(fmt::format("rank {} has other {} than rank 0 ('{}', '{}'); give all ranks the same",
                                      ranks.rank(), what, said, first));
  });
}

Runs::Runs(const Ranks& ranks, std::int64_t own) {
  for (const std::int64_t count : ranks.each(own)) begins_.push_back(begins_.back() + count);
}

Runs Runs::equal(std::int64_t count, int parts) {
  Runs runs;
  for (int part = 1; part <= parts; ++part) runs.begins_.push_back(count / parts * part + count % parts * part / parts);
  return runs;
}

int Runs::rank_of(std::int64_t number) const {
  return static_cast<int>(std::upper_bound(begins_.begin(), begins_.end(), number) - begins_.begin()) - 1;
}

std::vector<std::vector<std::byte>> exchange_bytes(const Ranks& ranks, std::vector<std::vector<std::byte>> to) {
  constexpr std::int64_t piece = std::int64_t{1} << 29;  // MPI counts by int
  const auto own = static_cast<size_t>(ranks.rank());
  std::vector<std::int64_t> out(to.size()), in(to.size());
  for (size_t r = 0; r < to.size(); ++r) out[r] = std::ssize(to[r]);
  MPI_Alltoall(out.data(), 1, MPI_INT64_T, in.data(), 1, MPI_INT64_T, all_ranks);
  std::vector<std::vector<std::byte>> from(to.size());
  from[own] = std::move(to[own]);
  std::vector<MPI_Request> requests;
  const auto pieces = [&](size_t r, std::int64_t bytes, const auto& post) {
    for (std::int64_t at = 0; r != own && at < bytes; at += piece) {
      requests.emplace_back();
      post(at, static_cast<int>(std::min(piece, bytes - at)), &requests.back());
    }
  };
  for (size_t r = 0; r < to.size(); ++r) {
    if (r != own) from[r].resize(static_cast<size_t>(in[r]));
    pieces(r, in[r], [&](std::int64_t at, int count, MPI_Request* request) {
      MPI_Irecv(from[r].data() + at, count, MPI_BYTE, static_cast<int>(r), 0, all_ranks, request);
    });
  }
  for (size_t r = 0; r < to.size(); ++r) {
    pieces(r, out[r], [&](std::int64_t at, int count, MPI_Request* request) {
      MPI_Isend(to[r].data() + at, count, MPI_BYTE, static_cast<int>(r), 0, all_ranks, request);
    });
    if (r != own) sent += out[r];
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return from;
}

std::int64_t bytes_sent() { return sent; }

Lists fetch_lists(const Ranks& ranks, const Runs& runs, std::span<const std::int64_t> numbers,
                  const std::function<std::span<const std::int64_t>(std::int64_t)>& answer) {
  std::vector<std::vector<std::int64_t>> asked(size_t(ranks.size()));
  for (const std::int64_t n : numbers) asked[size_t(runs.rank_of(n))].push_back(n);
  asked = exchange(ranks, std::move(asked));
  std::vector<std::vector<std::int64_t>> answers(asked.size());  // each list behind its length
  for (size_t r = 0; r < asked.size(); ++r)
    for (const std::int64_t n : asked[r]) {
      const std::span<const std::int64_t> list = answer(n);
      answers[r].push_back(std::ssize(list));
      answers[r].insert(answers[r].end(), list.begin(), list.end());
    }
  answers = exchange(ranks, std::move(answers));
  // Numbers ascend, so those of a rank are together.
  Lists lists;
  lists.begins.reserve(numbers.size() + 1);
  for (std::vector<std::int64_t>& from : answers) {
    for (size_t at = 0; at < from.size(); at += size_t(from[at]) + 1) {
      const auto first = from.begin() + std::ptrdiff_t(at) + 1;
      lists.items.insert(lists.items.end(), first, first + std::ptrdiff_t(from[at]));
      lists.begins.push_back(std::ssize(lists.items));
    }
    std::vector<std::int64_t>().swap(from);
  }
  return lists;
}

void sort_unique(std::vector<std::int64_t>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace sublimit
