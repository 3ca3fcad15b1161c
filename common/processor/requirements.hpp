// SPDX-License-Identifier: GPL-3.0-or-later
// Processor features that the compiler was allowed to use. check.cpp reads them before anything else runs.
#pragma once

namespace tisserand::processor {

/// Register state that a processor feature requires and that the kernel must save (bits of XCR0).
enum class State : unsigned { none = 0, avx = 0x6, avx512 = 0xe6 };

/// Processor feature: one bit of cpuid that must be set. Example AVX2: leaf 7, subleaf 0, register b, bit 5.
struct Feature {
  char name[16];
  unsigned leaf;
  unsigned subleaf;
  char in;  ///< 'a' to 'd': register of the answer
  unsigned bit;
  State state;
};

/// Processor features that the program's other units may use. The last one has an empty name.
extern const Feature required_features[];
/// Value of -march of the build, for example "x86-64-v3".
extern const char built_for[];

}  // namespace tisserand::processor
