// SPDX-License-Identifier: Apache-2.0
#pragma once
// Processes of one job, by MPI: what they tell each other, and how they fail together. distributed.h is for programs of
// your own; of this header they need `Ranks`.
//
//   const Ranks ranks(argc, argv);
//   return ranks.run([&] { if (ranks.is_first()) std::printf("%d ranks\n", ranks.size()); });
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace sublimit {

/// All processes of the job, the ranks 0 to size - 1. One object a process; all else that uses MPI or PETSc goes before
/// it. Each rank calls its functions from one thread.
class Ranks {
 public:
  /// Begins MPI and PETSc, which must not have begun. MPI takes its arguments out of the command line.
  Ranks(int& argc, char**& argv);
  /// Ends MPI and PETSc.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_first() const { return rank_ == 0; }
  int on_this_machine() const { return on_this_machine_; }  ///< ranks that share its memory

  // Of all ranks together; all must call, in the same order. Sums of doubles depend on the number of ranks, in the last
  // bits.
  std::int64_t sum(std::int64_t own) const;
  double sum(double own) const;
  std::int64_t sum_before(std::int64_t own) const;  ///< of the ranks before
  std::int64_t largest(std::int64_t own) const;
  double largest(double own) const;
  bool all(bool own) const { return largest(std::int64_t{!own}) == 0; }
  std::vector<std::int64_t> each(std::int64_t own) const;  ///< by rank
  std::string told_by_first(std::string text) const;       ///< what the first rank has
  void wait() const;
  /// Handed from rank to rank: each makes its own of what the rank before made, the first of `begin`. What the last one
  /// made is known to all.
  std::array<std::int64_t, 2> handed_on(
      std::array<std::int64_t, 2> begin,
      const std::function<std::array<std::int64_t, 2>(std::array<std::int64_t, 2>)>& own) const;

  /// Runs a step that each rank does by itself, without calls of all ranks inside, and that may fail on some: then it
  /// fails on all. All ranks call.
  /// @throws Error  on all ranks, with code and message of the first rank that failed
  void together(const std::function<void()>& step) const;

  /// Runs a job of all ranks.
  /// @return  the exit status, the same on all; the first rank writes the error in one line to stderr. An error outside
  ///          `together`, which the others cannot know of, ends all ranks at once.
  int run(const std::function<void()>& job) const;

 private:
  int rank_ = 0, size_ = 1, on_this_machine_ = 1;
};

/// What all ranks must say alike, such as options.
/// @throws InvalidOption  on all of them: a rank says something else
void check_alike(const Ranks& ranks, const std::string& said, const std::string& what);

/// Consecutive numbers, a run a rank: vertices, faces, lines as a file has them.
class Runs {
 public:
  Runs() = default;
  /// @param own  how many this rank has
  Runs(const Ranks& ranks, std::int64_t own);
  /// As equal as can be.
  static Runs equal(std::int64_t count, int parts);

  std::int64_t size() const { return begins_.back(); }
  std::int64_t begin(int rank) const { return begins_[size_t(rank)]; }
  std::int64_t size(int rank) const { return begins_[size_t(rank) + 1] - begins_[size_t(rank)]; }
  int rank_of(std::int64_t number) const;

 private:
  std::vector<std::int64_t> begins_{0};
};

/// Bytes for each rank become bytes from each rank; of any size.
std::vector<std::vector<std::byte>> exchange_bytes(const Ranks& ranks, std::vector<std::vector<std::byte>> to);
/// What this process has sent to others so far.
std::int64_t bytes_sent();

/// Items for each rank become items from each rank.
template <class T>
std::vector<std::vector<T>> exchange(const Ranks& ranks, std::vector<std::vector<T>> to) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<std::vector<std::byte>> bytes(to.size());
  for (size_t r = 0; r < to.size(); ++r) {
    const auto items = std::as_bytes(std::span<const T>(to[r]));
    bytes[r].assign(items.begin(), items.end());
    std::vector<T>().swap(to[r]);
  }
  bytes = exchange_bytes(ranks, std::move(bytes));
  for (size_t r = 0; r < to.size(); ++r) {
    to[r].resize(bytes[r].size() / sizeof(T));
    if (!to[r].empty()) std::memcpy(to[r].data(), bytes[r].data(), bytes[r].size());
    std::vector<std::byte>().swap(bytes[r]);
  }
  return to;
}

/// Values of numbers, from the ranks that have these.
/// @param numbers  in any order, repeated or not
/// @param answer   of a number that is this rank's
/// @return         in the order of `numbers`
template <class Value>
std::vector<Value> fetch(const Ranks& ranks, const Runs& runs, std::span<const std::int64_t> numbers,
                         const std::function<Value(std::int64_t)>& answer) {
  std::vector<std::vector<std::int64_t>> asked(size_t(ranks.size()));
  for (const std::int64_t n : numbers) asked[size_t(runs.rank_of(n))].push_back(n);
  asked = exchange(ranks, std::move(asked));
  std::vector<std::vector<Value>> answers(asked.size());
  for (size_t r = 0; r < asked.size(); ++r)
    for (const std::int64_t n : asked[r]) answers[r].push_back(answer(n));
  answers = exchange(ranks, std::move(answers));
  std::vector<size_t> next(answers.size(), 0);
  std::vector<Value> values;
  values.reserve(numbers.size());
  for (const std::int64_t n : numbers) {
    const auto r = size_t(runs.rank_of(n));
    values.push_back(answers[r][next[r]++]);
  }
  return values;
}

/// Lists, one after the other.
struct Lists {
  std::vector<std::int64_t> begins{0}, items;
  std::span<const std::int64_t> operator[](std::int64_t i) const {
    return std::span(items).subspan(size_t(begins[size_t(i)]), size_t(begins[size_t(i) + 1] - begins[size_t(i)]));
  }
  std::int64_t size() const { return std::ssize(begins) - 1; }
};
/// The same of lists of numbers.
/// @param numbers  ascending
Lists fetch_lists(const Ranks& ranks, const Runs& runs, std::span<const std::int64_t> numbers,
                  const std::function<std::span<const std::int64_t>(std::int64_t)>& answer);

/// Ascending, each once.
void sort_unique(std::vector<std::int64_t>& numbers);

}  // namespace sublimit
