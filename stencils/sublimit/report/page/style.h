// SPDX-License-Identifier: Apache-2.0
#pragma once
// The style sheet of the page: for wide and narrow screens, light and dark, and for print.

namespace sublimit::page {

extern const char* const style;

}  // namespace sublimit::page
