#!/bin/sh
# How long until `corpuscle list` has printed all it knows, and until `corpuscle run` has solved 10 transistors? 200 whole processes, one
# after another; the mean wall time.
set -eu
program=$1
n=200
time_of() {
  start=$(date +%s%N)
  i=0
  while [ $i -lt $n ]; do
    "$program" "$@" >/dev/null
    i=$((i + 1))
  done
  end=$(date +%s%N)
  echo "corpuscle $1: $(((end - start) / n / 1000)) us a start, mean of $n processes (the shell's fork included)"
}
time_of list
time_of run "$(dirname "$0")/../circuits/bias.cir"
