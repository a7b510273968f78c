// SPDX-License-Identifier: Apache-2.0
#pragma once
// Programs that tests need. A test without its program is skipped, but fails in CI (environment variable CI),
// where `.ci/install-deps --all` installs all programs. Other permitted skips and their reasons are listed in
// tests/stencils/skips_test.cpp.
#include <gtest/gtest.h>

#include <cstdlib>

/// Skips or fails a test unless its program is installed.
/// @param is_there  true if it is installed
/// @param package   name of the package to install
#define SUBLIMIT_NEEDS_PROGRAM(is_there, package)                                               \
  if (is_there) {                                                                               \
  } else if (::std::getenv("CI"))                                                               \
    FAIL() << "not installed: " << (package) << "; CI installs it, so this is a failure there"; \
  else                                                                                          \
    GTEST_SKIP() << "not installed: " << (package)
