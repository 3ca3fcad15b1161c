// SPDX-License-Identifier: GPL-3.0-or-later
// The first code of each program: if the processor lacks a feature that the program was compiled for, it prints a
// message instead of crashing by an illegal instruction. It is compiled for plain x86-64 without the standard library,
// so that it shares no function with units that need more.
#include "common/processor/requirements.hpp"

#if defined(__x86_64__)
#include <cpuid.h>
#include <unistd.h>

namespace tisserand::processor {
namespace {

unsigned answer(const Feature& feature) {
  unsigned a = 0, b = 0, c = 0, d = 0;
  if (__get_cpuid_count(feature.leaf, feature.subleaf, &a, &b, &c, &d) == 0) return 0;
  return feature.in == 'a' ? a : feature.in == 'b' ? b : feature.in == 'c' ? c : d;
}

/// XCR0: registers that the kernel saves when it switches between programs; 0 if it cannot be read.
unsigned saved_state() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  if (__get_cpuid(1, &a, &b, &c, &d) == 0 || (c & bit_OSXSAVE) == 0) return 0;
  __asm__("xgetbv" : "=a"(a), "=d"(d) : "c"(0));
  return a;
}

bool is_there(const Feature& feature, unsigned saved) {
  const unsigned state = static_cast<unsigned>(feature.state);
  return (answer(feature) >> feature.bit & 1) != 0 && (saved & state) == state;
}

unsigned length(const char* text) {
  unsigned count = 0;
  while (text[count] != '\0') ++count;
  return count;
}

void say(const char* text) {
  if (write(STDERR_FILENO, text, length(text)) < 0) _exit(1);
}

const char* name_of_program(int argc, char** argv) {
  if (argc < 1) return "tisserand";
  const char* name = argv[0];
  for (const char* c = name; *c != '\0'; ++c)
    if (*c == '/') name = c + 1;
  return name;
}

void check(int argc, char** argv, char**) {
  const unsigned saved = saved_state();
  bool is_complete = true;
  for (const Feature* feature = required_features; feature->name[0] != '\0'; ++feature) {
    if (is_there(*feature, saved)) continue;
    if (is_complete) {
      say(name_of_program(argc, argv));
      say(": compiled with -march=");
      say(built_for);
      say(", but this processor lacks ");
    } else {
      say(", ");
    }
    say(feature->name);
    is_complete = false;
  }
  if (is_complete) return;
  say("\nCompile it on this machine: cmake --preset native && cmake --build --preset native\n"
      "or for older processors: cmake --preset release -DTISSERAND_PROCESSOR=x86-64-v2 && "
      "cmake --build --preset release\n");
  _exit(1);
}

/// Calls check() before the constructors of the program and of its shared libraries.
[[gnu::section(".preinit_array"), gnu::used]] void (*const first)(int, char**, char**) = check;

}  // namespace
}  // namespace tisserand::processor
#endif
