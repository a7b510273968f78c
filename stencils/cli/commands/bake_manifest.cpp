// SPDX-License-Identifier: Apache-2.0
#include "commands/bake_manifest.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <nlohmann/json.hpp>
#include <string_view>

#include "support/ending.h"
#include "support/peak_memory.h"
#include "sublimit/base/detail/file_error.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/error.h"

namespace sublimit::cli {
namespace {

/// A file that several machines may append lines to: each goes in one piece.
class Log {
 public:
  explicit Log(const std::string& path) : path_(path) {
    if (path.empty()) return;
    file_ = ::open(opened_path(path).c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) throw_file_error(path, "write", errno);
  }
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;
  ~Log() {
    if (file_ >= 0) ::close(file_);
  }
  void write(const std::string& line) {
    if (file_ < 0) return;
    const std::string whole = line + "\n";
    for (std::string_view rest = whole; !rest.empty();) {  // the rest of a short write: it says why it was short
      const ssize_t count = ::write(file_, rest.data(), rest.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) throw_file_error(path_, "write", count < 0 ? errno : EIO);
      rest.remove_prefix(static_cast<size_t>(count));
    }
  }

 private:
  std::string path_;
  int file_ = -1;
};

struct Report {
  BakeOutcome outcome;
  int status = 0;
  std::string error;
  double seconds = 0;
  std::int64_t peak = 0;
  const char* word() const { return status != 0 ? "failed" : outcome.was_there ? "skipped" : "done"; }
};

Report done(const BakeJob& job, Dictionaries& dictionaries, Progress& progress) {
  Report report;
  forget_peak_memory();
  const auto start = std::chrono::steady_clock::now();
  try {
    check(job);
    report.outcome = bake_table(job, dictionaries, progress, true);
    dictionaries.save();
  } catch (...) {
    report.status = status_of_exception(&report.error);
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report.peak = peak_memory();
  return report;
}

std::string log_line(const ManifestJob& job, const Report& report) {
  nlohmann::ordered_json line{{"line", job.line},          {"mesh", job.job.common.mesh}, {"output", job.job.output},
                              {"status", report.word()},   {"exit", report.status},       {"seconds", report.seconds},
                              {"peak_memory", report.peak}};
  if (report.status != 0) {
    line["error"] = report.error;
  } else if (!report.outcome.was_there) {
    line["points"] = report.outcome.statistics.points;
    line["types"] = report.outcome.statistics.types;
    line["bytes"] = report.outcome.file_bytes;
  }
  return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

int bake_manifest(const std::string& path, const Shard& shard, const std::string& log_path,
                  const std::string& dictionary, const BakeJob& defaults) {
  std::vector<ManifestJob> jobs = read_manifest(path, defaults), own;
  for (size_t i = 0; i < jobs.size(); ++i)
    if (shard.has(i)) own.push_back(std::move(jobs[i]));
  Log log(log_path);
  Progress progress(defaults.common.quiet);
  Dictionaries dictionaries(dictionary);
  int worst = 0;
  std::array<std::int64_t, 3> counts{};  // done, skipped, failed
  for (const ManifestJob& job : own) {
    const Report report = done(job.job, dictionaries, progress);
    progress.step("");
    worst = std::max(worst, report.status);
    ++counts[report.status != 0 ? 2 : report.outcome.was_there ? 1 : 0];
    log.write(log_line(job, report));
    if (report.status != 0)
      fmt::print(stderr, "sublimit: {}:{}: {}\n", path, job.line, report.error);
    else if (!defaults.common.quiet)
      fmt::print("{}: {} in {:.3f} s, {} of memory\n", job.job.output, report.word(), report.seconds,
                 bytes_in_words(double(report.peak)));
    std::fflush(stdout);
  }
  if (!defaults.common.quiet)
    fmt::print("{} jobs: {} done, {} skipped, {} failed\n", own.size(), counts[0], counts[1], counts[2]);
  return worst;
}

}  // namespace sublimit::cli
