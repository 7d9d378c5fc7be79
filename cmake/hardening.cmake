# How every object of ours is compiled and linked against damage by a fault in it, or in a library that reads other people's bytes.
# None of it changes a number: a test looks for it in the built program, others hold the bytes of the answers.
#   corpuscle_hardened: for the library, the program and its helpers; not for kernels of lanes, which only compute, nor for tests.
#   corpuscle_checked: also stops at an index outside of a standard container. For code that runs once a command, such as readers of
#   netlists and of sweeps: not for loops over samples or devices.

# One kind of code for all, so that the archive can go into a shared library; functions of ours may still be inlined across it.
add_compile_options(-fPIC -fno-semantic-interposition)

add_library(corpuscle_hardened INTERFACE)
if(NOT CORPUSCLE_SANITIZE)
  target_compile_options(corpuscle_hardened INTERFACE -fstack-protector-strong -fstack-clash-protection
    $<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE> $<$<NOT:$<CONFIG:Debug>>:-D_FORTIFY_SOURCE=3>)  # it asks for an optimised build
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    target_compile_options(corpuscle_hardened INTERFACE -fcf-protection=full)
  endif()
endif()
add_library(corpuscle_checked INTERFACE)
target_compile_definitions(corpuscle_checked INTERFACE _GLIBCXX_ASSERTIONS)
# Addresses of other libraries are settled at the start and read-only from then on; code anywhere; no code on the stack.
target_link_options(corpuscle_hardened INTERFACE LINKER:-z,relro,-z,now,-z,noexecstack)
