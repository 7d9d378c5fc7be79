#!/bin/sh
# What is compiled for one instruction set must not be taken by the linker for what every machine can run. Of each object no weak
# symbol may leave that does not name its lanes (xsimd's type says which), and nothing global but its two tables.
# Usage: lanes_stay_inside.sh OBJECT...
set -eu
test $# -ge 3 || { echo "objects for three instruction sets were to come, not $#"; exit 1; }
status=0
for object in "$@"; do
  wide=$(nm -C "$object" | grep -E ' [WVuw] ' | grep -v 'xsimd' || true)
  strong=$(nm -C --defined-only "$object" | grep -E ' [TDBRG] ' | grep -vE 'corpuscle::lanes::(baseline|avx2|avx512)::(doubles|floats)$' || true)
  tables=$(nm -C --defined-only "$object" | grep -cE 'corpuscle::lanes::(baseline|avx2|avx512)::(doubles|floats)$')
  if [ -n "$wide$strong" ] || [ "$tables" -ne 2 ]; then
    printf '%s has %s tables and lets out:\n%s\n%s\n' "$object" "$tables" "$wide" "$strong"
    status=1
  fi
done
exit $status
