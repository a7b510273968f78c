// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/ranks.h"

#include <fcntl.h>
#include <mpi.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "sublimit/base/atomic_file.h"
#include "sublimit/base/error.h"

namespace sublimit {

Ranks::Ranks(int& argc, char**& argv) {
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

Ranks::~Ranks() { MPI_Finalize(); }

std::int64_t Ranks::sum(std::int64_t own) const {
  std::int64_t all = 0;
  MPI_Allreduce(&own, &all, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

std::int64_t Ranks::sum_before(std::int64_t own) const {
  std::int64_t before = 0;
  MPI_Exscan(&own, &before, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
  return rank_ == 0 ? 0 : before;  // which MPI leaves undefined
}

void Ranks::wait() const { MPI_Barrier(MPI_COMM_WORLD); }

int Ranks::run(const std::function<void()>& job) const {
  try {
    job();
    return 0;
  } catch (const ResourceError& error) {
    std::fprintf(stderr, "sublimit-mpi: rank %d: %s\n", rank_, error.what());
    MPI_Abort(MPI_COMM_WORLD, 4);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sublimit-mpi: rank %d: %s\n", rank_, error.what());
    MPI_Abort(MPI_COMM_WORLD, 3);
  }
  return 70;
}

SharedFile::SharedFile(const Ranks& ranks, const std::filesystem::path& target) : ranks_(ranks), target_(target) {
  temporary_ = target_.parent_path() / ("." + target_.filename().string() + ".shared.tmp");
  if (ranks_.rank() == 0) {
    file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file_ < 0) throw_file_error(target_, "write", errno);
  }
  ranks_.wait();
  if (ranks_.rank() > 0) file_ = ::open(temporary_.c_str(), O_WRONLY | O_CLOEXEC);
  if (file_ < 0) throw_file_error(target_, "write", errno);
}

SharedFile::~SharedFile() {
  if (file_ >= 0) ::close(file_);
  if (ranks_.rank() == 0 && !temporary_.empty()) ::unlink(temporary_.c_str());
}

void SharedFile::write(std::int64_t offset, const void* data, std::size_t bytes) {
  const char* from = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t done = ::pwrite(file_, from, bytes, offset);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) throw_file_error(target_, "write", errno);
    from += done, offset += done, bytes -= size_t(done);
  }
}

void SharedFile::commit() {
  if (::close(file_) != 0) throw_file_error(target_, "write", errno);
  file_ = -1;
  ranks_.wait();
  if (ranks_.rank() == 0) std::filesystem::rename(temporary_, target_);
  temporary_.clear();
  ranks_.wait();
}

void write_whole(const std::filesystem::path& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace sublimit
