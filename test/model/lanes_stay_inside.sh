#!/bin/sh
# Checks objects that are compiled for one instruction set. The linker must not use a function of such an object where the program runs on
# machines without this instruction set. So the object may export no weak symbol, except those whose name contains its lane type (of xsimd),
# and no global symbol except its tables of functions.
# Usage: lanes_stay_inside.sh OBJECT...
set -eu
test $# -ge 3 || { echo "expected objects for three instruction sets, not $#"; exit 1; }
status=0
table='corpuscle::(circuit::)?lanes::(baseline|avx2|avx512)::(kernels_in_double|kernels_in_float|field_kernels|frame_kernels|transistor_kernel_table|chip_kernel_table|front_kernel_table)$'
for object in "$@"; do
  wide=$(nm -C "$object" | grep -E ' [WVuw] ' | grep -v 'xsimd' || true)
  strong=$(nm -C --defined-only "$object" | grep -E ' [TDBRG] ' | grep -vE "$table" || true)
  tables=$(nm -C --defined-only "$object" | grep -cE "$table" || true)
  if [ -n "$wide$strong" ] || [ "$tables" -eq 0 ]; then
    printf '%s has %s tables and exports:\n%s\n%s\n' "$object" "$tables" "$wide" "$strong"
    status=1
  fi
done
exit $status
