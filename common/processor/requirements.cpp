// SPDX-License-Identifier: GPL-3.0-or-later
// Processor features that the flags of the program let the compiler use. Compiled with these flags; data only, no code.
#include "common/processor/requirements.hpp"

namespace tisserand::processor {

const char built_for[] = TISSERAND_BUILT_FOR;

/// Features that compilers use by themselves, with bits from the Intel and AMD manuals (as in <cpuid.h>). Features
/// reached by intrinsics only (AES, SHA, RDRAND) and prefetches, which older processors ignore, are not listed.
constexpr Feature required_features[] = {
#ifdef __SSE3__
    {"SSE3", 1, 0, 'c', 0, State::none},
#endif
#ifdef __SSSE3__
    {"SSSE3", 1, 0, 'c', 9, State::none},
#endif
#ifdef __SSE4_1__
    {"SSE4.1", 1, 0, 'c', 19, State::none},
#endif
#ifdef __SSE4_2__
    {"SSE4.2", 1, 0, 'c', 20, State::none},
#endif
#ifdef __POPCNT__
    {"POPCNT", 1, 0, 'c', 23, State::none},
#endif
#ifdef __GCC_HAVE_SYNC_COMPARE_AND_SWAP_16
    {"CMPXCHG16B", 1, 0, 'c', 13, State::none},
#endif
#ifdef __LAHF_SAHF__
    {"LAHF", 0x80000001, 0, 'c', 0, State::none},
#endif
#ifdef __AVX__
    {"AVX", 1, 0, 'c', 28, State::avx},
#endif
#ifdef __F16C__
    {"F16C", 1, 0, 'c', 29, State::avx},
#endif
#ifdef __FMA__
    {"FMA", 1, 0, 'c', 12, State::avx},
#endif
#ifdef __AVX2__
    {"AVX2", 7, 0, 'b', 5, State::avx},
#endif
#ifdef __BMI__
    {"BMI1", 7, 0, 'b', 3, State::none},
#endif
#ifdef __BMI2__
    {"BMI2", 7, 0, 'b', 8, State::none},
#endif
#ifdef __LZCNT__
    {"LZCNT", 0x80000001, 0, 'c', 5, State::none},
#endif
#ifdef __MOVBE__
    {"MOVBE", 1, 0, 'c', 22, State::none},
#endif
#ifdef __ADX__
    {"ADX", 7, 0, 'b', 19, State::none},
#endif
#ifdef __SSE4A__
    {"SSE4A", 0x80000001, 0, 'c', 6, State::none},
#endif
#ifdef __XOP__
    {"XOP", 0x80000001, 0, 'c', 11, State::avx},
#endif
#ifdef __FMA4__
    {"FMA4", 0x80000001, 0, 'c', 16, State::avx},
#endif
#ifdef __TBM__
    {"TBM", 0x80000001, 0, 'c', 21, State::none},
#endif
#ifdef __GFNI__
    {"GFNI", 7, 0, 'c', 8, State::none},
#endif
#ifdef __MOVDIRI__
    {"MOVDIRI", 7, 0, 'c', 27, State::none},
#endif
#ifdef __AVXVNNI__
    {"AVX-VNNI", 7, 1, 'a', 4, State::avx},
#endif
#ifdef __AVXIFMA__
    {"AVX-IFMA", 7, 1, 'a', 23, State::avx},
#endif
#ifdef __AVX512F__
    {"AVX512F", 7, 0, 'b', 16, State::avx512},
#endif
#ifdef __AVX512DQ__
    {"AVX512DQ", 7, 0, 'b', 17, State::avx512},
#endif
#ifdef __AVX512IFMA__
    {"AVX512IFMA", 7, 0, 'b', 21, State::avx512},
#endif
#ifdef __AVX512CD__
    {"AVX512CD", 7, 0, 'b', 28, State::avx512},
#endif
#ifdef __AVX512BW__
    {"AVX512BW", 7, 0, 'b', 30, State::avx512},
#endif
#ifdef __AVX512VL__
    {"AVX512VL", 7, 0, 'b', 31, State::avx512},
#endif
#ifdef __AVX512VBMI__
    {"AVX512VBMI", 7, 0, 'c', 1, State::avx512},
#endif
#ifdef __AVX512VBMI2__
    {"AVX512VBMI2", 7, 0, 'c', 6, State::avx512},
#endif
#ifdef __AVX512VNNI__
    {"AVX512VNNI", 7, 0, 'c', 11, State::avx512},
#endif
#ifdef __AVX512BITALG__
    {"AVX512BITALG", 7, 0, 'c', 12, State::avx512},
#endif
#ifdef __AVX512VPOPCNTDQ__
    {"AVX512VPOPCNTDQ", 7, 0, 'c', 14, State::avx512},
#endif
#ifdef __AVX512BF16__
    {"AVX512BF16", 7, 1, 'a', 5, State::avx512},
#endif
#ifdef __AVX512FP16__
    {"AVX512FP16", 7, 0, 'd', 23, State::avx512},
#endif
    {"", 0, 0, 'a', 0, State::none},
};

}  // namespace tisserand::processor
