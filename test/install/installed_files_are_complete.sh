#!/bin/sh
# The installed tree is complete: examples, documents, licences, and an archive that can be linked into a shared library.
# Usage: installed_files_are_complete.sh PREFIX COMPILER
set -eu
prefix=$1
compiler=$2
status=0
"$prefix/bin/corpuscle" study fig4 --quiet || { echo "the installed corpuscle does not find corpuscle-study"; status=1; }
for file in bin/corpuscle bin/corpuscle-study libexec/corpuscle/corpuscle-hdf5 libexec/corpuscle/corpuscle-sound include/corpuscle.hpp include/corpuscle.h share/corpuscle/circuits/sa1.cir \
  share/corpuscle/circuits/schematics/sa1.sch share/corpuscle/circuits/schematics/parts/invb.sym share/corpuscle/circuits/schematics/symbols/nch.sym share/corpuscle/circuits/schematics/xschemrc \
  share/corpuscle/skins/hand.toml share/corpuscle/examples/respond.cpp share/corpuscle/examples/data/touch.csv \
  share/corpuscle/examples/sweeps/bias.toml share/doc/corpuscle/README.md share/doc/corpuscle/LICENSE share/doc/corpuscle/NOTICE \
  share/doc/corpuscle/doc/concepts.md share/doc/corpuscle/doc/press.png; do
  [ -s "$prefix/$file" ] || { echo "$prefix/$file is missing"; status=1; }
done
for work in CLI11 nlohmann-json xsimd toml++ fmt 'Frances Y. Kuo and Stephen Joe'; do
  grep -qF "$work" "$prefix/share/doc/corpuscle/NOTICE" || { echo "NOTICE lacks $work"; status=1; }
done
headers=$(cd "$prefix/include" && find . -type f | sort | tr '\n' ' ')
[ "$headers" = "$(cd "$(dirname "$0")/../../include" && find . -type f | sort | tr '\n' ' ')" ] || { echo "installed headers: $headers; only the public ones are expected"; status=1; }
library=$(find "$prefix" -name libcorpuscle.a)
shared=$prefix/try.so
"$compiler" -shared -o "$shared" -Wl,-z,text -Wl,--whole-archive "$library" -Wl,--no-whole-archive || status=1
rm -f "$shared"
exit $status
