"""How much processor time and memory does the complete command take for a stroke over the hand, with one or more builds of the program?

    python3 bench/hand_commands.py build/release/corpuscle [OTHER_PROGRAM ...]      ROUNDS=9

Method: each round runs `respond stroke --population hand -j 1` once with every program, in turn, into a new directory. Processor time is user
and system time of the process, from its start to its end, so it includes building the hand and writing all files. The table gives the median,
minimum and maximum of the rounds, how many times faster than the 10 s of touch the median is, the peak of resident memory, and the work.
"""

import json
import os
import statistics
import sys
import tempfile
import time


def run(program, directory):
    """Processor time (s) and peak memory (MB) of one command."""
    arguments = [program, "respond", "stroke", "--population", "hand", "-j", "1", "--quiet", "--out", directory]
    child = os.posix_spawn(program, arguments, os.environ)
    _, status, used = os.wait4(child, 0)
    if status != 0:
        sys.exit(f"{program}: status {os.waitstatus_to_exitcode(status)}")
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1000


def work(directory):
    """The numbers of afferents and of spikes."""
    with open(os.path.join(directory, "summary.json")) as file:
        afferents = json.load(file)["skin"]["afferents"]
    with open(os.path.join(directory, "spikes.csv")) as file:
        return afferents, sum(1 for _ in file) - 1


def main():
    programs = sys.argv[1:]
    if not programs:
        sys.exit(__doc__)
    seconds, memory, done = {p: [] for p in programs}, {}, {}
    for _ in range(int(os.environ.get("ROUNDS", "9"))):
        for program in programs:
            with tempfile.TemporaryDirectory() as directory:
                used, memory[program] = run(program, directory)
                seconds[program].append(used)
                done[program] = work(directory)
    print(time.strftime("%F"), os.cpu_count(), "cores, load", "%.1f" % os.getloadavg()[0])
    for program in programs:
        median = statistics.median(seconds[program])
        print(f"{program}: {median:.3f} s ({min(seconds[program]):.3f} to {max(seconds[program]):.3f}), {10 / median:.0f} times real time, "
              f"{memory[program]:.0f} MB, {done[program][0]} afferents, {done[program][1]} spikes")


main()
