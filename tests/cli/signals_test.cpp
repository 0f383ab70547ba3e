// What a first, a second and a third signal do to an analysis. Each test has a process of its own.
#include "src/app/process/signals.hpp"

#include <csignal>
#include <cstdlib>

#include <gtest/gtest.h>
#include <unistd.h>

#include "src/base/interrupt.hpp"
#include "src/base/timer.hpp"
#include "src/io/partial_file.hpp"

namespace rockfold {
namespace {

constexpr int went_on = 7;  // exit status of a process that no signal ended

void raise_times(int count, int signal = SIGTERM) {
  for (int i = 0; i < count; ++i) std::raise(signal);
}

void work(double seconds) {
  const Timer since;
  while (since.seconds() < seconds) usleep(1000);
}

/// Standard output goes where EXPECT_EXIT looks.
void show_stdout() {
  dup2(STDERR_FILENO, STDOUT_FILENO);
}

class Signals : public testing::Test {
 protected:
  void SetUp() override { testing::GTEST_FLAG(death_test_style) = "threadsafe"; }
};

TEST_F(Signals, TheFirstIsRemembered) {
  EXPECT_EXIT(
      {
        remember_interrupts();
        raise_times(1);
        work(1.5);
        std::_Exit(interrupt_signal == SIGTERM ? went_on : 1);
      },
      testing::ExitedWithCode(went_on), "");
}

TEST_F(Signals, TheSecondLeavesTimeForTheStepAndTheAnswer) {
  EXPECT_EXIT(
      {
        remember_interrupts();
        raise_times(2);
        analysis_is_over();
        work(1.5);
        std::_Exit(went_on);
      },
      testing::ExitedWithCode(went_on), "");
}

TEST_F(Signals, TheSecondEndsAStepThatDoesNotEnd) {
  EXPECT_EXIT(
      {
        remember_interrupts();
        std::raise(SIGINT);
        std::raise(SIGTERM);
        work(60);
        std::_Exit(went_on);
      },
      testing::ExitedWithCode(128 + SIGINT), "");
}

TEST_F(Signals, TheThirdEndsAtOnce) {
  EXPECT_EXIT(
      {
        remember_interrupts();
        raise_times(3);
        std::_Exit(went_on);
      },
      testing::ExitedWithCode(128 + SIGTERM), "");
}

TEST_F(Signals, WaitWhileAStateIsWritten) {
  EXPECT_EXIT(
      {
        remember_interrupts();
        raise_times(2);
        {
          const SignalsWait until_it_is_written;
          work(1.5);
          show_stdout();
          [[maybe_unused]] const auto ignored = write(STDERR_FILENO, "written", 7);
        }
        std::_Exit(went_on);
      },
      testing::ExitedWithCode(128 + SIGTERM), "written");
}

TEST_F(Signals, LeaveAnErrorDocumentUnlessAnAnswerHasBegun) {
  EXPECT_EXIT(
      {
        show_stdout();
        exit_at_once_when_interrupted(true);
        remember_interrupts();
        raise_times(3);
      },
      testing::ExitedWithCode(128 + SIGTERM), "\"schema\": \"rockfold/1\"");
  EXPECT_EXIT(
      {
        show_stdout();
        exit_at_once_when_interrupted(true);
        remember_interrupts();
        answer_begins();
        raise_times(3);
      },
      testing::ExitedWithCode(128 + SIGTERM), "^$");
}

TEST_F(Signals, ALimitThatIsMetTwiceEndsAtOnceWithItsReason) {
  EXPECT_EXIT(
      {
        remember_interrupts();
        request_stop("--max-memory", "the program needs more than 1 MB");
        request_stop("--max-memory", "the program needs more than 1 MB");
        std::_Exit(went_on);
      },
      testing::ExitedWithCode(1), "--max-memory: the program needs more than 1 MB: stopped");
}

}  // namespace
}  // namespace rockfold
