// SPDX-License-Identifier: Apache-2.0
#pragma once
// How the page looks: on wide and narrow screens, light and dark, on paper.

namespace sublimit::page {

extern const char* const style;

}  // namespace sublimit::page
