# Compile and link options that limit the damage of a memory fault, in our code or in a library that reads foreign files.
# They change no result: one test looks for them in the built program, others compare the bytes of the output.
#   corpuscle_hardened: for the library, the program and its helper programs. Not for SIMD kernels, which only compute, nor for tests.
#   corpuscle_cold_code: also aborts on an index outside a standard container, and is compiled with -O1. For code that runs once per
#   command, such as the readers of netlists and sweeps. Not for loops over samples or devices.

# Position-independent code, so that the archive can be linked into a shared library. The second option keeps inlining possible in it.
add_compile_options(-fPIC -fno-semantic-interposition)

add_library(corpuscle_hardened INTERFACE)
# Each function in a section of its own, so that the linker leaves out those that a program does not call: the helper programs call few.
target_compile_options(corpuscle_hardened INTERFACE -ffunction-sections -fdata-sections)
target_link_options(corpuscle_hardened INTERFACE LINKER:--gc-sections)
if(NOT CORPUSCLE_SANITIZE)
  target_compile_options(corpuscle_hardened INTERFACE -fstack-protector-strong -fstack-clash-protection
    $<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE> $<$<NOT:$<CONFIG:Debug>>:-D_FORTIFY_SOURCE=3>)  # needs an optimised build
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    target_compile_options(corpuscle_hardened INTERFACE -fcf-protection=full)
  endif()
endif()
add_library(corpuscle_cold_code INTERFACE)
target_compile_definitions(corpuscle_cold_code INTERFACE _GLIBCXX_ASSERTIONS)
target_compile_options(corpuscle_cold_code INTERFACE $<$<CONFIG:Release>:-O1>)
if(CORPUSCLE_SANITIZE)
  target_compile_options(corpuscle_cold_code INTERFACE -O0)  # optimised, it takes three times as long to compile
endif()
# Resolve addresses of other libraries at start and make them read-only. No executable stack.
target_link_options(corpuscle_hardened INTERFACE LINKER:-z,relro,-z,now,-z,noexecstack)
