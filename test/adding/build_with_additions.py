"""Builds the program from a copy of the tree, with some files added and some lists extended.

Only the objects that depend on an extended list are compiled, with the commands of the build; all others are those of the build."""

import concurrent.futures
import functools
import os
import pathlib
import re
import subprocess


def run(command, folder):
    done = subprocess.run(command, shell=True, cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"failed: {command[-300:]}\n{done.stdout}{done.stderr}")
    return done.stdout


def included_files(path, tree):
    """The files of the tree that a file includes, by their path below src or apps."""
    for name in re.findall(r'#include "([^"]+)"', path.read_text()):
        for folder in (tree / "src", tree / "apps"):
            if (folder / name).exists():
                yield folder / name


@functools.cache
def code_of(path):
    """The text of a file without comments and strings."""
    return re.sub(r'"(?:\\.|[^"\\\n])*"', '""', re.sub(r"//[^\n]*", "", path.read_text()))


def files_read(source, tree, known):
    """The file and all files of the tree that it includes."""
    if source not in known:
        known[source] = {source}
        for file in included_files(source, tree):
            known[source] |= files_read(file, tree, known)
    return known[source]


PRECOMPILED = re.compile(r" -Winvalid-pch| (-Xclang )?-include-pch (-Xclang )?\S+| (-Xclang )?-include (-Xclang )?\S+/cmake_pch.hxx")
QUICK = "-O0 -g0 -U_FORTIFY_SOURCE"  # most of the time is spent on the optimisation of templates


class Build:
    """The commands that build the program, for another tree. Their outputs go to the directory `out`."""

    def __init__(self, root, build, tree, out):
        self.root, self.build, self.tree, self.out = root, build, tree, out
        self.replaced = {}  # object of the build: the objects that take its place
        commands = run("ninja -t commands corpuscle", build).splitlines()
        self.compile = [c for c in commands if " -c " in c]
        self.archive = [c for c in commands if " qc " in c]
        self.link = next(c for c in commands if " -o corpuscle " in c)
        self.known = {}

    def moved(self, text):
        for folder in ("src", "apps"):
            text = text.replace(f"{self.root}/{folder}", f"{self.tree}/{folder}")
        return text

    def sources(self, command):
        """The files of the tree that a command compiles: one, or those of a unit."""
        source = pathlib.Path(command.split(" -c ")[1].split()[0])
        files = [source]
        if source.parent.name.endswith("_units"):
            files = [(source.parent / f).resolve() for f in re.findall(r'#include "([^"]+)"', source.read_text())]
        return [pathlib.Path(self.moved(str(f))) for f in files]

    def uses(self, command, additions):
        """True if a command compiles a file that uses an extended list."""
        for source in self.sources(command):
            files = files_read(source, self.tree, self.known) if source.is_relative_to(self.tree) else set()
            for addition in additions:
                own = self.tree / addition.list
                if own == source:
                    return True
                names = re.compile(rf"\b({addition.list_names})\b")
                if own in files and any(names.search(code_of(f)) for f in files if f != own):
                    return True
        return False

    def compiled(self, command, number, source=None):
        """The command for the other tree, of a source file or of the sources of the command; also its object."""
        if source is None:
            source = self.out / f"unit{number}.cpp"
            source.write_text("".join(f'#include "{s}"\n' for s in self.sources(command)))
        target = self.out / f"object{number}.o"
        mine = re.sub(r" -MD -MT \S+ -MF \S+| -o \S+ -c \S+", "", self.moved(command))
        if "cmake_pch" in command:  # one precompiled header for all, so the options of one target for all, with further directories
            own = re.findall(r" (?:-I|-isystem )\S+| -D\S+", mine)
            mine = self.options + "".join(o for o in own if o not in self.options) + f" -include {self.out}/common.hxx"
        return f"{mine} {QUICK} -o {target} -c {source}", str(target)

    def precompile(self):
        """Makes the precompiled header of the program for QUICK options."""
        command = next(c for c in self.compile if "/cmake_pch.hxx" in c and "-x c++-header" not in c)
        header = re.search(r"(\S+/cmake_pch.hxx)", command)[1]
        includes = re.findall(r"#include <.*", pathlib.Path(header).read_text())
        (self.out / "common.hxx").write_text("\n".join(includes) + "\n")
        self.options = PRECOMPILED.sub("", re.sub(r" -MD -MT \S+ -MF \S+| -o \S+ -c \S+", "", self.moved(command)))
        run(f"{self.options} {QUICK} -x c++-header -o {self.out}/common.hxx.gch -c {self.out}/common.hxx", self.build)

    def make(self, additions):
        """Compiles and links. Returns the path of the program and the number of compiled objects."""
        self.precompile()
        jobs = []
        for command in self.compile:
            if self.uses(command, additions):
                changed, target = self.compiled(command, len(jobs))
                jobs.append(changed)
                self.replaced[re.search(r" -o (\S+)", command)[1]] = [target]
        for addition in additions:
            file = self.tree / addition.file
            if file.suffix != ".cpp":
                continue
            command = next(c for c in self.compile if "cmake_pch" in c and any(s.parent == file.parent for s in self.sources(c)))
            changed, target = self.compiled(command, len(jobs), file)
            jobs.append(changed)
            neighbour = re.search(r" -o (\S+)", command)[1]
            self.replaced[neighbour] = self.replaced.get(neighbour, [neighbour]) + [target]
        with concurrent.futures.ThreadPoolExecutor(min(4, os.cpu_count() or 1)) as pool:
            list(pool.map(lambda job: run(job, self.build), jobs))
        link = self.with_objects(self.link)
        for number, command in enumerate(self.archive):
            library = re.search(r" qc (\S+)", command)[1]
            mine = self.out / f"library{number}.a"
            objects = self.with_objects(command.split(" qc ")[1].split(" && ")[0].split(" ", 1)[1])
            run(f"rm -f {mine} && ar qc {mine} {objects}", self.build)
            link = link.replace(f" {library}", f" {mine}")
        program = self.out / "corpuscle"
        run(link.replace(" -o corpuscle ", f" -o {program} "), self.build)
        return program, len(jobs)

    def with_objects(self, text):
        return " ".join(" ".join(self.replaced.get(word, [word])) for word in text.split(" "))
