#!/bin/sh
# How long does `corpuscle list` take to print everything, and `corpuscle run` to solve 10 transistors? Mean wall time of 200 complete
# processes in sequence.
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
  echo "corpuscle $1: $(((end - start) / n / 1000)) us per start, mean of $n processes (the shell's fork included)"
}
time_of list
time_of run "$(dirname "$0")/../circuits/bias.cir"
