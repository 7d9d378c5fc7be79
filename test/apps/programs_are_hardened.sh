#!/bin/sh
# Checks a program as it is shipped (cmake/hardening.cmake). Its code is position-independent. Addresses of libraries are resolved at
# start and read-only afterwards. It has no executable stack and no search path for libraries. Checks of the stack and of copies are
# compiled in.
# Usage: programs_are_hardened.sh PROGRAM...
set -eu
status=0
for program in "$@"; do
  shows() { readelf -W "$1" "$program" | grep -qE "$2" || { echo "$program: no $3"; status=1; }; }
  lacks() { if readelf -W "$1" "$program" | grep -E "$2"; then echo "$program: $3"; status=1; fi; }
  shows -h 'Type: +DYN' 'position-independent code'
  shows -l 'GNU_RELRO' 'RELRO'
  shows -d 'FLAGS.* (BIND_NOW|NOW)' 'BIND_NOW: RELRO is partial'
  shows -l 'GNU_STACK .* RW ' 'stack without code'
  shows --dyn-syms '__stack_chk_fail' 'stack protector'
  shows --dyn-syms '__[a-z]+_chk(@| )' 'checked copy (_FORTIFY_SOURCE)'
  lacks -d '(RPATH|RUNPATH|TEXTREL)' 'looks for libraries in a path of its own, or writes into its code'
  lacks -lW 'LOAD .* RWE ' 'has memory that can be written and run'
done
exit $status
