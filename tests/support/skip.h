// SPDX-License-Identifier: Apache-2.0
#pragma once
// Programs that tests need: on a desk a test without its program is skipped, in CI (variable CI) it fails, for
// `.ci/install-deps --all` has installed the program there. Which other skips there may be, and why, is listed in
// tests/stencils/skips_test.cpp.
#include <gtest/gtest.h>

#include <cstdlib>

/// Goes on with a test only if its program is there.
/// @param is_there  whether it is
/// @param package   what to install
#define SUBLIMIT_NEEDS_PROGRAM(is_there, package)                                               \
  if (is_there) {                                                                               \
  } else if (::std::getenv("CI"))                                                               \
    FAIL() << "not installed: " << (package) << "; CI installs it, so this is a failure there"; \
  else                                                                                          \
    GTEST_SKIP() << "not installed: " << (package)
