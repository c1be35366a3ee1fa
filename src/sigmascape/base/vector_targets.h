#pragma once

/// Put before a function whose loops over plain arrays are worth compiling for wide vector units as well: the program
/// picks the widest that the machine has. Without fused multiply-add (see cmake/compile_options.cmake) every width
/// gives the same bits. Sanitizers cannot bear functions that are picked while the program loads, and clang none whose
/// callees are to be inlined ([[gnu::flatten]]).
#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SIGMASCAPE_VECTOR_TARGETS __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define SIGMASCAPE_VECTOR_TARGETS
#endif

/// Put before a loop whose turns do not touch what others write, where there are too many arrays for the compiler to
/// find that out.
#if defined(__GNUC__) && !defined(__clang__)
#define SIGMASCAPE_INDEPENDENT_TURNS _Pragma("GCC ivdep")
#else
#define SIGMASCAPE_INDEPENDENT_TURNS
#endif
