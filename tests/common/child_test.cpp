// SPDX-License-Identifier: GPL-3.0-or-later
// Children: what they say and cost, how they end, and those that cannot begin.
#include "common/child.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <csignal>

#include "common/error.hpp"

namespace tisserand::child_test {
namespace {

using ::testing::HasSubstr;

ChildRequest shell(const std::string& script) {
  ChildRequest request;
  request.words = {"sh", "-c", script};
  return request;
}

TEST(Child, GivesBackWhatItWritesAndItsCode) {
  ChildRequest request = shell("cat; echo wrong >&2; exit 7");
  request.input = "some text";
  const ChildReport report = run_child(request);
  EXPECT_EQ(report.ending, ChildEnding::left);
  EXPECT_EQ(report.code, 7);
  EXPECT_EQ(report.text, "some text");
  EXPECT_EQ(report.complaint, "wrong\n");
}

TEST(Child, TalksThroughItsDescriptors) {
  ChildRequest request = shell("read line <&3; echo \"$line again\" >&4; cat <&3 >/dev/null; exit 5");
  std::string answer(100, '\0');
  request.talk = [&](int socket) {
    ASSERT_EQ(::write(socket, "once\n", 5), 5);
    answer.resize(static_cast<std::size_t>(::read(socket, answer.data(), answer.size())));
  };
  EXPECT_EQ(run_child(request).code, 5);  // cat ended, since the socket was closed
  EXPECT_EQ(answer, "once again\n");
  request.talk = [](int) { throw Error("enough", "", ""); };
  EXPECT_THROW(run_child(request), Error);
}

TEST(Child, TellsTheSignalThatEndsIt) {
  const ChildReport report = run_child(shell("kill -9 $$"));
  EXPECT_EQ(report.ending, ChildEnding::killed);
  EXPECT_EQ(report.code, SIGKILL);
}

TEST(Child, EndsAtItsLimitAndWhenItIsStopped) {
  ChildRequest request = shell("exec sleep 60");
  request.seconds = 0.2;
  EXPECT_EQ(run_child(request).ending, ChildEnding::timed_out);
  request.seconds = 0.0;
  request.is_stopped = [] { return true; };
  EXPECT_EQ(run_child(request).ending, ChildEnding::stopped);
}

TEST(Child, CostsWhatItComputes) {
  const double idle = run_child(shell("sleep 0.3")).cpu_seconds;
  const double busy = run_child(shell("i=0; while [ $i -lt 200000 ]; do i=$((i + 1)); done")).cpu_seconds;
  EXPECT_LT(idle, 0.1);
  EXPECT_GT(busy, idle);
}

TEST(Child, SaysThatAProgramIsMissing) {
  ChildRequest request;
  request.words = {"no-such-program"};
  try {
    (void)run_child(request);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("no-such-program: cannot be started"));
  }
  EXPECT_FALSE(is_program("no-such-program"));
  EXPECT_TRUE(is_program("sh"));
  EXPECT_TRUE(is_program(own_program()));
}

}  // namespace
}  // namespace tisserand::child_test
