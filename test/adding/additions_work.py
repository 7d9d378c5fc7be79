"""Adds a file of each kind in the places that the table "To add X" of HACKING.md names, builds the program, and uses the additions.

usage: additions_work.py SOURCE BUILD    (BUILD: a build of SOURCE by Ninja that contains the program)"""

import difflib
import json
import pathlib
import re
import shutil
import subprocess
import sys

from additions import ADDITIONS
from build_with_additions import Build, run

root, build = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
here = pathlib.Path(__file__).parent
out = build / "adding"
tree = out / "tree"


def check(holds, message):
    if not holds:
        raise SystemExit(f"additions_work: {message}")


def copy_tree():
    """Copies what a configuration reads."""
    shutil.rmtree(out, ignore_errors=True)
    tree.mkdir(parents=True)
    for entry in root.iterdir():
        if entry.name in ("src", "apps"):
            shutil.copytree(entry, tree / entry.name)
        elif entry.name not in ("build", ".git", "out"):
            (tree / entry.name).symlink_to(entry)


def promised_places():
    """The rows of the table: kind, and the text of the cells with the new file and the list."""
    rows = {}
    for line in (root / "HACKING.md").read_text().splitlines():
        cells = [c.strip() for c in line.strip("|").split(" | ")]
        if line.startswith(("| a ", "| an ")) and len(cells) == 3:
            rows[cells[0]] = (re.findall(r"`([^`]+)`", cells[1]), re.findall(r"`([^`]+)`", cells[2]))
    return rows


def add(addition, promised):
    """Adds one file and its lines, and checks that the table promises these places."""
    check(addition.kind in promised, f"HACKING.md has no row '{addition.kind}'")
    files, lists = promised[addition.kind]
    named = [re.escape(f).replace("/x", "/[a-z0-9_]+") for f in files]  # src/measure/x.hpp
    check(any(re.fullmatch(n, addition.file) for n in named), f"HACKING.md does not promise {addition.file} for '{addition.kind}'")
    check(lists == [addition.list], f"HACKING.md promises a line in {lists}, not only in {addition.list}")
    shutil.copy(root / addition.text if addition.text else here / "files" / addition.file, tree / addition.file)
    text = (tree / addition.list).read_text()
    for old, new in addition.insertions:
        check(text.count(old) == 1, f"{addition.list} does not contain once: {old}")
        text = text.replace(old, new)
    (tree / addition.list).write_text(text)


def check_only_these_changed():
    """A list grows by one line for each insertion, or a line of it becomes longer; no other file differs."""
    changed = {}
    for folder in ("src", "apps"):
        for path in (tree / folder).rglob("*"):
            if not path.is_file():
                continue
            name = str(path.relative_to(tree))
            before = (root / name).read_text(errors="replace").splitlines() if (root / name).exists() else None
            after = path.read_text(errors="replace").splitlines()
            if before != after:
                changed[name] = None if before is None else [d for d in difflib.ndiff(before, after) if d[0] == "+" and d[2:].strip()]
    expected = {a.file for a in ADDITIONS} | {a.list for a in ADDITIONS}
    check(set(changed) == expected, f"changed files: {sorted(changed)}, not {sorted(expected)}")
    for name, lines in changed.items():
        most = sum(len(a.insertions) for a in ADDITIONS if a.list == name)
        check(lines is None or len(lines) <= most, f"{name}: {len(lines or [])} lines changed, not at most {most}")


def check_cmake_finds_the_files():
    run(f"cmake -S {tree} -B {out / 'configured'} -G Ninja -D CMAKE_BUILD_TYPE=Release -D CORPUSCLE_UNITY=OFF -D CORPUSCLE_TESTS=OFF", out)
    commands = (out / "configured/compile_commands.json").read_text()
    for addition in ADDITIONS:
        if addition.file.endswith(".cpp"):
            check(f"{tree}/{addition.file}" in commands, f"CMake does not compile {addition.file}")


def use_the_device(corpuscle):
    """A varistor with the new letter y, beside an ideal current: v(out) is 10 V times the root of the current in mA."""
    (out / "surge.cir").write_text(
        """surge
i1 0 out 4m
.subckt clamp a
y1 a 0 surge
.ends
x1 out clamp
.model surge varistor v0=10 i0=1m alpha=2 c=1n
.save v(out) i(x1.y1)
.op
.end
"""
    )

    def number(name, *options):
        return json.loads(corpuscle("run", "surge.cir", "--json", *options))["plots"][0]["curves"][name][0]

    check(abs(number("v(out)") - 20) < 1e-4, "the device has another voltage")
    check(abs(number("i(x1.y1)") - 4e-3) < 1e-8, "the current of the device is not saved")
    check(abs(number("v(out)", "--set", "y1.m=4") - 10) < 1e-4, "--set does not change the parameter of the device")
    exported = corpuscle("export", "surge.cir", "--for", "ngspice")
    check("by_x1_y1 out 0 i=0.001*sgn(v(out,0))*(abs(v(out,0))/10)^2" in exported, f"the export has no varistor:\n{exported}")


def use_the_analysis(corpuscle):
    """Two nodes and the current of the source."""
    (out / "size.cir").write_text("size\nv1 in 0 1\nr1 in out 1k\nr2 out 0 1k\n.op\n.size\n.expect unknowns 3 0.1\n.end\n")
    check("holds" in corpuscle("run", "size.cir"), "the analysis has another number, or .expect does not find it")
    check(".size" in corpuscle("run", "--help"), "--help of run does not list the analysis")
    exported = corpuscle("export", "size.cir", "--for", "ngspice")
    check("* left out: .size (ngspice has no such directive)" in exported, f"the export does not say that it has no .size:\n{exported}")


def use_the_additions(program):
    def corpuscle(*arguments):
        done = subprocess.run([program, *arguments], capture_output=True, text=True, cwd=out)
        check(done.returncode == 0, f"corpuscle {' '.join(arguments)}: {done.stderr}")
        return done.stdout

    def spikes(*arguments):
        return [train["times_s"] for train in json.loads(corpuscle("respond", *arguments, "--json"))["spikes"]]

    listed = json.loads(corpuscle("list", "--json"))
    for section, name, parameter in (
        ("measures", "longest_interval", None),
        ("formats", "hexadecimal", None),
        ("stimuli", "triangle", "F_max"),
        ("receptors", "proportional", "k"),
        ("neurons", "qif", "V_peak"),
        ("sensors", "gauge", "gain"),
    ):
        entry = next((e for e in listed[section] if e["name"] == name), None)
        check(entry is not None, f"'corpuscle list' has no {name} among the {section}")
        check(parameter is None or parameter in [p["name"] for p in entry["parameters"]], f"{name} has no parameter {parameter}")

    check(corpuscle("quantity", "10ms") == "0.01\n", "the verb quantity gives another number")
    check("print a quantity in SI units" in corpuscle("--help"), "--help does not list the verb")
    check("--unit" in corpuscle("quantity", "--help"), "--help of the verb does not list its option")

    use_the_device(corpuscle)
    use_the_analysis(corpuscle)

    if any(a.list == "src/run/sinks.cpp" for a in ADDITIONS):
        corpuscle("respond", "press", "--afferent", "sa1,sa2", "--names", "--out", "result")
        check((out / "result/names.txt").read_text() == "sa1,press\nsa2,press\n", "the output format writes another text")

    # 1 s without force, 1 s under 0x7d0 = 2000 mN; the spikes are those of the same recording as text.
    values = [0] * 1000 + [2000] * 1000
    (out / "touch.hex").write_text("".join(f"{v:x}\n" for v in values))
    (out / "touch.csv").write_text("".join(f"{v}\n" for v in values))
    options = ("--rate", "1kHz", "--unit", "mN")
    from_text = spikes("touch.csv", *options)
    check(any(from_text) and spikes("touch.hex", *options) == from_text, "the format reads other forces")

    document = json.loads(corpuscle("respond", "sine", "--afferent", "sa1,sa2", "--json"))  # of one phase
    for row, train in zip(document["rates"], document["spikes"]):
        longest = max((b - a for a, b in zip(train["times_s"], train["times_s"][1:])), default=None)
        check(longest is not None and abs(row["longest_interval_s"] - longest) < 1e-9, "the measure has another value")

    afferents = ("--afferent", "proportional+qif,gauge+f2i+sa1", "--set", "triangle.F_max=4N")
    alone = spikes("triangle", *afferents)
    check(all(alone), "an afferent with an added component does not fire")
    weaker = spikes("triangle", *afferents, "--set", "proportional+qif.k=1e-7")
    check(len(weaker[0]) < len(alone[0]), "--set does not change the parameter of the receptor")
    on_lanes = spikes("triangle", "--afferent", "proportional+qif", "--set", "triangle.F_max=4N", "--copies", "9")
    check(all(train == alone[0] for train in on_lanes), "the spikes on lanes differ")


copy_tree()
promised = promised_places()
for one in ADDITIONS:
    add(one, promised)
check_only_these_changed()
check_cmake_finds_the_files()
program, objects = Build(root, build, tree, out).make(ADDITIONS)
use_the_additions(program)
print(f"{len(ADDITIONS)} additions work; {objects} files were compiled")
