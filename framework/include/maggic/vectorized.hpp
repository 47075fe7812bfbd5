#pragma once
/// Loops over batches that use whatever vector instructions the machine has.

/// Put before the definition of a function whose loop the compiler turns into vector instructions
/// by itself: it is compiled for several generations of x86-64, and the machine's is picked when
/// the library is loaded. Only speed may differ: keep to integers and to floating point whose
/// result does not depend on whether a multiplication and an addition are fused. Elsewhere than on
/// x86-64, with another compiler than GCC and under a sanitizer it means nothing.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define MAGGIC_VECTORIZED \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define MAGGIC_VECTORIZED
#endif
