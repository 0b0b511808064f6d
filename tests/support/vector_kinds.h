// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdint>

namespace vinebench::test {

/// Calls `check` with Highway held to each kind of vectors that the processor has.
template <class Check>
void with_each_kind_of_vectors(const Check& check) {
  const std::int64_t supported = hwy::SupportedTargets();
  for (std::int64_t left = supported; left != 0; left &= left - 1) {
    const std::int64_t kind = left & -left;
    const testing::ScopedTrace trace(__FILE__, __LINE__, hwy::TargetName(kind));
    hwy::SetSupportedTargetsForTest(kind);
    hwy::GetChosenTarget().DeInit();
    check();
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

}  // namespace vinebench::test
