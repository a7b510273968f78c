// SPDX-License-Identifier: Apache-2.0
#pragma once
// Running `sublimit-mpi` by mpirun, oversubscribed and permitted as root; and `sublimit`, to compare results.
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "sublimit/base/detail/read_file.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {

/// Exit status and output of a run.
struct RanksRun {
  int status = 0;        ///< exit status; 124: timeout
  std::string out, err;  ///< output of all ranks, without mpirun's own

  /// Returns the lines of `err` that the program wrote.
  std::string error() const {
    std::string lines;
    for (std::size_t at = err.find("sublimit-mpi: "); at != std::string::npos; at = err.find("sublimit-mpi: ", at + 1))
      if (at == 0 || err[at - 1] == '\n') lines += err.substr(at, err.find('\n', at) - at + 1);
    return lines;
  }
};

/// @param before  shell text before `mpirun`
inline RanksRun run_ranks(int ranks, const std::string& arguments, const std::string& before = "", int seconds = 100,
                          const std::string& program = SUBLIMIT_MPI_PROGRAM) {
  const TemporaryDirectory directory;
  const std::string out = (directory / "out").string(), err = (directory / "err").string();
  const std::string command =
      before +
      "env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_btl_base_warn_component_unused=0 "
      "OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1 timeout -k 5 " +
      std::to_string(seconds) + " mpirun -n " + std::to_string(ranks) + " " + program + " " + arguments + " > " + out +
      " 2> " + err;
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out), read_file(err)};
}

/// @return  the exit status
inline int run_alone(const std::string& arguments) {
  const int status = std::system((SUBLIMIT_PROGRAM " " + arguments + " > /dev/null 2>&1").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace sublimit::testing
