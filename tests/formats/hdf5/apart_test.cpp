// SPDX-License-Identifier: GPL-3.0-or-later
// The process that reads HDF5 files: what it may do, how its end is told, that nobody else opens the file.
#include "formats/hdf5/apart.hpp"

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/inotify.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/companion/companion.hpp"
#include "formats/companion/owner.hpp"
#include "formats/hdf5/file.hpp"
#include "formats/modal_body/modal_body.hpp"
#include "formats/recovery/recovery.hpp"
#include "formats/results/checkpoint.hpp"
#include "formats/results/results.hpp"
#include "formats/superelement/superelement.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/bodies/lumped_bodies.hpp"
#include "tests/support/bodies/second_order_network.hpp"
#include "tests/support/bodies/small_recovery.hpp"
#include "tests/support/results_rows.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::formats::apart_test {
namespace {

using test_support::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* damaged = "is an HDF5 file, but so damaged that HDF5 cannot read it";

std::string superelement_in(const TemporaryFolder& folder, const std::string& name = "leg.superelement.h5") {
  Superelement beam = test_support::craig_bampton_beam({}, 2);
  write_superelement(folder.file(name), beam);
  return folder.file(name);
}

/// The last child of this thread; 0: there is none, or the kernel does not tell.
pid_t child() {
  std::ifstream list("/proc/thread-self/children");
  pid_t last = 0;
  for (pid_t number = 0; list >> number;) last = number;
  return last;
}

std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

std::string status_of(pid_t process, const std::string& key) {
  std::ifstream lines("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(key)) return line.substr(line.find_first_not_of(" \t", key.size()));
  return "";
}

TEST(Apart, MayOnlyCompute) {
  const TemporaryFolder folder;
  const hdf5::InputFile file(superelement_in(folder), hdf5::Completeness::closed);
  const pid_t process = child();
  if (process == 0 || ::prctl(PR_GET_SECCOMP) < 0) GTEST_SKIP() << "not tested: this kernel lacks what the test needs";
  EXPECT_EQ(status_of(process, "Seccomp:"), "2") << "a filter";
  EXPECT_EQ(status_of(process, "NoNewPrivs:"), "1");
  std::set<std::string> open;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/fd"))
    open.insert(entry.path().filename().string());
  EXPECT_EQ(open, (std::set<std::string>{"0", "1", "2", "3", "4"})) << "nothing, the socket and the file";
}

TEST(Apart, ItsCrashIsReportedAndEndsIt) {
  const TemporaryFolder folder;
  const std::string path = superelement_in(folder);
  const hdf5::InputFile file(path, hdf5::Completeness::closed);
  if (child() == 0) GTEST_SKIP() << "not tested: this kernel does not list children";
  std::array<double, 14> column{};
  file.read_column("/mass", 0, 14, column.data());
  ::kill(child(), SIGSEGV);
  for (int k = 0; k < 2; ++k)
    EXPECT_THAT(error_of([&] { file.read_column("/mass", 0, 14, column.data()); }), StartsWith(path + ": " + damaged));
  EXPECT_EQ(child(), 0) << "it is gone";
  EXPECT_EQ(file.text_attribute("/", "format"), "tisserand-superelement") << "what is known is known";
}

TEST(Apart, ThatWaitsForEverIsEnded) {
  const TemporaryFolder folder;
  const std::string path = superelement_in(folder);
  hdf5::Apart apart({path}, {2.0, 0.5});
  static_cast<void>(apart.open(0, hdf5::Completeness::closed));
  if (child() == 0) GTEST_SKIP() << "not tested: this kernel does not list children";
  ::kill(child(), SIGSTOP);
  EXPECT_THAT(error_of([&] { static_cast<void>(apart.ask(0, hdf5::entry_request("/mass"))); }),
              StartsWith(path + ": could not be read within 1 s"));
  EXPECT_TRUE(apart.is_gone());
}

TEST(Apart, ErrorsOfFilesAreThoseOfReading) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("text.h5")) << "no HDF5\n";
  std::ofstream(folder.file("empty.h5"));
  const auto opening = [&](const std::string& name) {
    return error_of([&] { hdf5::InputFile file(folder.file(name), hdf5::Completeness::closed); });
  };
  EXPECT_THAT(opening("absent.h5"), StartsWith(folder.file("absent.h5") + ": cannot open the file: No such file"));
  EXPECT_THAT(opening("empty.h5"), HasSubstr("the file is empty (0 bytes)"));
  EXPECT_THAT(opening("text.h5"), HasSubstr("is not an HDF5 file (8 bytes without the HDF5 signature)"));
  EXPECT_THAT(opening("."), HasSubstr("is not an ordinary file"));
}

TEST(Apart, ManyFilesShareAChildUntilItDies) {
  const TemporaryFolder folder;
  const std::string a = superelement_in(folder, "a.h5"), b = superelement_in(folder, "b.h5");
  const hdf5::Together together({a, folder.file("absent.h5"), b});
  const pid_t process = child();
  EXPECT_EQ(read_superelement(a).superelement.content_id, read_superelement(b).superelement.content_id);
  EXPECT_THAT(error_of([&] { read_superelement(folder.file("absent.h5")); }), HasSubstr("No such file"));
  if (process == 0) GTEST_SKIP() << "not tested: this kernel does not list children";
  EXPECT_EQ(child(), process) << "no other was started";
  EXPECT_FALSE(together.failed());
  ::kill(process, SIGSEGV);
  EXPECT_THAT(error_of([&] { read_superelement(b); }), StartsWith(b + ": " + damaged));
  EXPECT_TRUE(together.failed());
}

// --- one open of each file ------------------------------------------------------------------------------------------

struct Kind {
  const char* name;
  void (*write)(const std::string& path);
  void (*read)(const std::string& path);
};

test_support::SecondOrderBody network() { return test_support::second_order_network(6, {0.1, 0.2, 0.3, 0.4}); }

class EveryKind : public ::testing::TestWithParam<Kind> {};

/// The parent does not open the file at all, the child once.
TEST_P(EveryKind, IsOpenedOnceByTheChild) {
  const TemporaryFolder folder;
  const std::string path = folder.file("file.h5");
  GetParam().write(path);
  const int watch = ::inotify_init1(IN_NONBLOCK);
  ASSERT_GE(::inotify_add_watch(watch, path.c_str(), IN_OPEN | IN_CLOSE), 0);
  GetParam().read(path);
  std::array<char, 4096> events;
  const ssize_t size = ::read(watch, events.data(), events.size());
  ::close(watch);
  // Equal events one after the other count once, but not an opening after the first has been closed.
  EXPECT_EQ(size, static_cast<ssize_t>(2 * sizeof(inotify_event))) << "opened and closed";
}

INSTANTIATE_TEST_SUITE_P(
    Files, EveryKind,
    ::testing::Values(
        Kind{"superelement",
             [](const std::string& path) {
               Superelement beam = test_support::craig_bampton_beam({}, 2);
               write_superelement(path, beam);
             },
             [](const std::string& path) { read_superelement(path); }},
        Kind{"companion",
             [](const std::string& path) {
               auto body = network();
               write_companion(path, body.companion, body.element);
             },
             [](const std::string& path) { read_companion(path, network().element); }},
        Kind{"owner",
             [](const std::string& path) {
               auto body = network();
               write_companion(path, body.companion, body.element);
             },
             [](const std::string& path) { EXPECT_TRUE(companion_owner(path)); }},
        Kind{"modal_body",
             [](const std::string& path) {
               write_modal_body(path,
                                test_support::modal_body(
                                    test_support::lumped_rod({0.0, 1.0, 1e-3, 1e6, 4e5, 1e-7, 2000.0, 20}), {}, 8));
             },
             [](const std::string& path) { read_modal_body(path); }},
        Kind{"recovery", test_support::write_small_recovery,
             [](const std::string& path) { RecoveryReader reader(path); }},
        Kind{"results",
             [](const std::string& path) { test_support::write_rows(path, test_support::example_layout(), 5); },
             [](const std::string& path) { static_cast<void>(ResultsReader(path).time()); }},
        Kind{"checkpoint",
             [](const std::string& path) {
               write_checkpoint(path, {"scene", "mechanism", "print", 1, 0.5, "a", "run", 3, {1.0, 2.0}, {4.0}, ""});
             },
             [](const std::string& path) { read_checkpoint(path); }}),
    [](const auto& kind) { return std::string(kind.param.name); });

// --- where seccomp is forbidden -------------------------------------------------------------------------------------

/// Refuses seccomp(), here and in what this process starts.
bool take_seccomp_away() {
  std::array<sock_filter, 4> code{sock_filter BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
                                  sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_seccomp, 0, 1),
                                  sock_filter BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM),
                                  sock_filter BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  const sock_fprog program{static_cast<unsigned short>(code.size()), code.data()};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

TEST(WithoutSeccomp, FilesAreReadWithOneNote) {
  const TemporaryFolder folder;
  const std::string path = superelement_in(folder), said = folder.file("said");
  const pid_t process = ::fork();
  if (process == 0) {
    ::dup2(::open(said.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    if (!take_seccomp_away()) ::_exit(2);
    const bool read = error_of([&] {
                        read_superelement(path);
                        read_superelement(path);
                      }) == "no error";
    ::_exit(read ? 0 : 1);
  }
  int status = 0;
  ::waitpid(process, &status, 0);
  if (WEXITSTATUS(status) == 2)
    GTEST_SKIP() << "not tested: this kernel lacks seccomp, by which the test takes it away";
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(test_support::text_of(said),
            "note: HDF5 files are read without a sandbox, because this system lacks seccomp or forbids it. "
            "A malicious file could do more harm\n");
}

}  // namespace
}  // namespace tisserand::formats::apart_test
