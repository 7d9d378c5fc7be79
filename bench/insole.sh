#!/bin/sh
# How long does `corpuscle respond` take for sa1 and fa1 under two minutes of walking on 16 sensors (gaitpdb GaCo01_01, 1.1 MB of text)?
# Mean wall time of 20 complete processes in sequence, with start and output. The recording is not part of the project: it is in
# $CORPUSCLE_DATA, by default ../shared/data.
set -eu
program=$1
here=$(dirname "$0")
file=${CORPUSCLE_DATA:-$here/../../shared/data}/gait_insole_vgrf/GaCo01_01.txt
[ -f "$file" ] || { echo "insole: $file not found; nothing was measured"; exit 0; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
start=$(date +%s%N)
for _ in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
  "$program" respond "$file" --layout "$here/../examples/layouts/insole.csv" --scale 0.008 --out "$out" --quiet
done
end=$(date +%s%N)
echo "insole, 121 s x 16 channels x 2 afferents: $(((end - start) / 20000000)) ms, $(($(wc -l < "$out/spikes.csv") - 1)) spikes written"
