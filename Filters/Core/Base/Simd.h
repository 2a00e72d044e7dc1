// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// A function compiled for every processor and for AVX2, chosen when the program starts. No fused
/// multiply-add in either, so that both give the same bits. Not under the thread sanitizer, which
/// does not run yet when the choice is made.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_THREAD__)
#define WAFT_SIMD_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define WAFT_SIMD_CLONES
#endif
