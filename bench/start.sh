#!/bin/sh
# How long until `corpuscle list` has printed all it knows? 200 whole processes, one after another; the mean wall time.
set -eu
program=$1
n=200
start=$(date +%s%N)
i=0
while [ $i -lt $n ]; do
  "$program" list >/dev/null
  i=$((i + 1))
done
end=$(date +%s%N)
echo "corpuscle list: $(((end - start) / n / 1000)) us a start, mean of $n processes (the shell's fork included)"
