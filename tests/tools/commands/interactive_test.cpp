// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/commands/interactive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

namespace vinebench::tools {
namespace {

using ::testing::HasSubstr;

// In a child process: what is caught stays caught.
TEST(InteractiveDeathTest, TheFirstSignalStopsTheRunAndGivesTheShellsCode) {
  EXPECT_EXIT(
      {
        catch_interrupts();
        const harness::RunOptions options = interactive_options("row");
        if (options.stopped()) exit(1);
        raise(SIGINT);
        if (!options.stopped() || !interrupted()) exit(2);
        exit(interruption_code());
      },
      testing::ExitedWithCode(130), "");  // 128 + SIGINT's 2
}

TEST(InteractiveDeathTest, TheSecondSignalEndsTheProgram) {
  EXPECT_EXIT(
      {
        catch_interrupts();
        raise(SIGINT);
        raise(SIGINT);
        exit(0);
      },
      testing::KilledBySignal(SIGINT), "");
}

TEST(Interactive, AnInterruptionSaysHowMuchThereIsAndWhere) {
  harness::RunOutcome outcome;
  outcome.report.frames = 12;
  testing::internal::CaptureStderr();
  report_interruption(outcome, "out/row");
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("stopped after 12 frames; what there is of them is in out/row"));
}

}  // namespace
}  // namespace vinebench::tools
