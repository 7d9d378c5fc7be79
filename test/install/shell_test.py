"""The installed manual pages and completions, in the programs that read them: man, bash, zsh and fish."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import unittest

PROGRAM = pathlib.Path(os.environ["CORPUSCLE_PROGRAM"])
SHARE = PROGRAM.parent.parent / "share"
MAN = SHARE / "man" / "man1"
ROOT = pathlib.Path(os.environ["CORPUSCLE_ROOT"])
HERE = ROOT / "test" / "install"


def run(*command, **options):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, cwd=ROOT, **options)


def after(*words):
    """The words that the program offers after these; the last one is being typed."""
    return run(PROGRAM, "__complete", *words).stdout.splitlines()


def names(catalogue):
    return [entry["name"] for entry in json.loads(run(PROGRAM, "list", catalogue, "--json").stdout)[catalogue]]


class ManualPages(unittest.TestCase):
    def test_each_verb_has_a_page_with_all_its_options(self):
        verbs = re.findall(r"^  ([a-z]+) ", run(PROGRAM, "--help").stdout.split("Subcommands:")[-1], re.M)
        self.assertGreater(len(verbs), 7)
        for verb in verbs:
            page = (MAN / f"corpuscle-{verb}.1").read_text().replace("\\-", "-")
            for option in re.findall(r"^  (?:-\w,)?(--[\w-]+)", run(PROGRAM, verb, "--help-all").stdout, re.M):
                self.assertIn(option, page, f"page of {verb}")
        for page in ("corpuscle", "corpuscle-sweep-show", "corpuscle-fit-afferent"):
            self.assertTrue((MAN / f"{page}.1").is_file(), page)

    @unittest.skipUnless(shutil.which("man"), "man-db is not installed")
    def test_man_formats_each_page_without_a_warning(self):
        for page in MAN.glob("*.1"):
            done = run("man", "--warnings", "-E", "UTF-8", "-l", page, env=dict(os.environ, MANWIDTH="100", LC_ALL="C.UTF-8"))
            self.assertEqual((done.returncode, done.stderr), (0, ""), page.name)
            self.assertIn("SYNOPSIS", done.stdout)

    @unittest.skipUnless(shutil.which("mandoc"), "mandoc is not installed")
    def test_mandoc_finds_no_error(self):
        done = run("mandoc", "-T", "lint", "-W", "warning", *MAN.glob("*.1"))
        found = [line for line in done.stdout.splitlines() if "missing date" not in line]
        self.assertEqual(found, [])


class Completion(unittest.TestCase):
    def test_verbs_and_the_verbs_behind_them(self):
        self.assertEqual(after("re"), ["respond"])
        self.assertIn("help", after(""))
        self.assertIn("show", after("sweep", ""))
        self.assertEqual(after("help", "sw"), ["sweep"])

    def test_options_are_those_of_the_verb(self):
        self.assertEqual(after("respond", "press", "--pop"), ["--population"])
        self.assertEqual(after("sweep", "show", "x.sqlite", "--qua"), ["--quantile"])
        self.assertEqual(after("export", "--pop"), [])
        self.assertEqual(after("respond", "--", "--pop"), [":files"])

    def test_values_are_those_of_the_catalogues(self):
        self.assertEqual(after("respond", "press", "-a", ""), [n for n in names("afferents") if not n.startswith("path/own.")])
        self.assertEqual(after("respond", "press", "--afferent", "sa1,fa1-n"), ["sa1,fa1-nerve"])
        self.assertEqual(after("respond", "--method", ""), ["exact", "backward-euler"])
        self.assertEqual(after("respond", "--population=f"), ["--population=fingertip", ":files"])
        self.assertEqual(after("respond", "--contact", "sp"), ["sphere"])
        self.assertEqual(set(names("stimuli")) - set(after("respond", "")), set())
        self.assertEqual(after("run", "sa1-ma"), ["sa1-macro", ":files"])
        self.assertIn("fig24", after("study", "fig3", "fig2"))

    def test_settings_are_completed_in_two_steps(self):
        self.assertIn("sa1.", after("respond", "press", "--set", "sa1"))
        self.assertIn("sa1.f_B=", after("respond", "press", "--set", "sa1."))
        self.assertEqual(after("respond", "press", "--set", "press.F_ma"), ["press.F_max="])

    @unittest.skipUnless(pathlib.Path("/usr/share/bash-completion/bash_completion").is_file(), "bash-completion is not installed")
    def test_bash(self):
        def complete(line, *words):
            found = run("bash", HERE / "complete.bash", SHARE / "bash-completion" / "completions" / "corpuscle", line, *words)
            self.assertEqual(found.stderr, "")
            return found.stdout.split("\n")[:-1]

        program = str(PROGRAM)
        self.assertEqual(complete(f"{program} re", program, "re"), ["respond"])
        self.assertEqual(complete(f"{program} respond press -p ha", program, "respond", "press", "-p", "ha"), ["hand"])
        # bash makes three words of --population=fi, and replaces the last of them
        self.assertEqual(complete(f"{program} respond --population=fi", program, "respond", "--population", "=", "fi"), ["fingertip"])
        self.assertEqual(complete(f"{program} respond -s press.F_ma", program, "respond", "-s", "press.F_ma"), ["compopt -o nospace", "press.F_max="])
        self.assertIn("examples/data/touch.csv", complete(f"{program} respond examples/data/tou", program, "respond", "examples/data/tou"))

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh_reads_the_script(self):
        done = run("zsh", "-f", HERE / "complete.zsh", SHARE / "zsh" / "site-functions")
        self.assertEqual((done.stdout.splitlines()[-1:], done.stderr), (["_corpuscle"], ""))
        self.assertEqual(run("zsh", "-n", SHARE / "zsh" / "site-functions" / "_corpuscle").stderr, "")

    @unittest.skipUnless(shutil.which("fish"), "fish is not installed")
    def test_fish(self):
        def complete(line):
            return run("fish", "--no-config", "-c", f"source {SHARE}/fish/vendor_completions.d/corpuscle.fish; complete -C '{line}'",
                       env=dict(os.environ, PATH=f"{PROGRAM.parent}:{os.environ['PATH']}")).stdout.splitlines()

        self.assertEqual(complete("corpuscle re"), ["respond"])
        self.assertEqual(complete("corpuscle respond press -p ha"), ["hand"])
        self.assertIn("examples/data/touch.csv", complete("corpuscle respond examples/data/tou"))


if __name__ == "__main__":
    unittest.main()
