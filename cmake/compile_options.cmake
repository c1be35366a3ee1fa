# Warnings are errors in our own code. Fused multiply-add is left to explicit calls: contraction chosen by the compiler would make
# the same bake differ between builds. Through precompiled headers GCC 12 finds what it looks for by three of its warnings in its own
# strings, where nothing is wrong (its bugs 105329 and 105651); the sanitizers find the real ones.
add_library(sigmascape_options INTERFACE)
target_compile_options(sigmascape_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -ffp-contract=off
  $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds> $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>)
# Several sources compiled as one hide from these warnings whose names are whose.
set(as_one $<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>)
target_compile_options(sigmascape_options INTERFACE
  $<${as_one}:-Wno-shadow> $<$<AND:${as_one},$<CXX_COMPILER_ID:GNU>>:-Wno-subobject-linkage>)
# What sanitizers put in between keeps GCC from seeing that all is initialized.
if(SIGMASCAPE_SANITIZER)
  target_compile_options(sigmascape_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_compile_options(sigmascape_options INTERFACE -fsanitize=${SIGMASCAPE_SANITIZER} -fno-omit-frame-pointer)
  target_link_options(sigmascape_options INTERFACE -fsanitize=${SIGMASCAPE_SANITIZER})
  if(SIGMASCAPE_SANITIZER STREQUAL "address")
    target_compile_options(sigmascape_options INTERFACE -fsanitize=undefined -fno-sanitize-recover=undefined)
    target_link_options(sigmascape_options INTERFACE -fsanitize=undefined)
  endif()
endif()
