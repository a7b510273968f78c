// SPDX-License-Identifier: Apache-2.0
#pragma once
// Errors with messages that say what they should.
#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <string_view>

#include "sublimit/base/error.h"

namespace sublimit::testing {

/// Expects `action` to throw exactly an `Expected` whose message has every one of `parts`.
template <class Expected, class Action>
void expect_error(const Action& action, std::initializer_list<std::string_view> parts) {
  try {
    action();
    ADD_FAILURE() << "nothing thrown";
  } catch (const Expected& error) {
    for (const std::string_view part : parts) {
      EXPECT_NE(std::string_view(error.what()).find(part), std::string_view::npos)
          << "no '" << part << "' in: " << error.what();
    }
  } catch (const Error& error) {
    ADD_FAILURE() << "another kind of error: " << error.what();
  }
}

}  // namespace sublimit::testing
