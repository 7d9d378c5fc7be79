#!/usr/bin/env python3
"""Checks the language of the source tree: identifiers, comments, texts in the program and documents.

    plain_words.py ROOT            checks the files that git tracks below ROOT; exit status 1 if anything is found
    plain_words.py ROOT --counts   also prints how many sentences were read
    plain_words.py --self-test     checks that every rule finds its own example

The rules are in rules.toml, the exceptions in excuses.toml. An excuse that matches nothing is an error, too.
"""

import collections
import fnmatch
import functools
import json
import pathlib
import re
import subprocess
import sys
import textwrap
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
RULES = tomllib.loads((HERE / "rules.toml").read_text())
EXCUSES = tomllib.loads((HERE / "excuses.toml").read_text()).get("excuse", [])

C_LIKE = {".cpp", ".hpp", ".h", ".c", ".def", ".js", ".css"}
HASH = {".sh", ".cmake", ".toml", ".yml", ".in"}
C_TOKEN = re.compile(
    r'(?P<line>//[^\n]*)|(?P<block>/\*.*?\*/)|R"(?P<delimiter>[^(\s]{0,16})\((?P<raw>.*?)\)(?P=delimiter)"'
    r'|(?P<string>"(?:\\.|[^"\\\n])*"|`(?:\\.|[^`\\])*`)|(?P<char>\'(?:\\.|[^\'\\\n])+\')|(?P<name>[A-Za-z_$][\w$]*)|(?P<number>\d[\w.\']*)',
    re.S)
PY_TOKEN = re.compile(
    r'(?P<line>#[^\n]*)|(?P<quote>"""|\'\'\')(?P<doc>.*?)(?P=quote)|(?P<string>"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\')'
    r'|(?P<name>[A-Za-z_]\w*)', re.S)
INCLUDE = re.compile(r'^\s*#\s*include[^\n]*', re.M)
# A sentence ends before a capital letter, after the question of a suggestion, and between the items of a list of definitions.
SENTENCE_END = re.compile(r'(?<=[.!?])["\')\]]*\s+(?=[A-Z"\'(`0-9\[])|(?<=\?);\s+|;\s+(?=[^\s;:]+(?: [^\s;:]+){0,2}:\s)')
WORD = re.compile(r"[A-Za-z][A-Za-z'-]*|\d[\d.,]*")
LABELS = re.compile(r"^(?:[^\s;]+(?: [^\s:;]+){0,2}:\s+)+")  # of a message: program, file:line:column:, option or name
PLACEHOLDER = re.compile(r"%[-+ 0]*[\d.*]*l*[a-zA-Z%]|\$?\{[^{}]*\}")
CODE = re.compile(RULES["strings"]["code"])
EXPRESSIONS = [(re.compile(r["pattern"]), r) for r in RULES["expression"]]
ANY_EXPRESSION = re.compile("|".join(re.sub(r"^\(\?i\)(.*)$", r"(?i:\1)", r["pattern"]) for r in RULES["expression"]))
ITEM = re.compile(r"([-*+]|\d+\.)\s+")
RULER = re.compile(r"[-=*#]{3}|[^A-Za-z]*$")
ASIDE = re.compile(r"\([^()]{0,40}\)|\{[^{}]*\}")
COLUMNS = re.compile(r"\S(?: {3,}|\t)\S")

Prose = collections.namedtuple("Prose", "kind line text")  # kind: comment, string or document
Finding = collections.namedtuple("Finding", "file line rule text")


def sentences(text):
    return [s for s in SENTENCE_END.split(" ".join(text.split())) if s]


def is_data(text):
    """True for a string that is not a sentence: code, or a row that consists mostly of placeholders."""
    words = WORD.findall(PLACEHOLDER.sub(" ", text))
    return bool(CODE.search(text)) or 3 * len(PLACEHOLDER.findall(text)) >= len(words)


def paragraphs(start, rows):
    """Paragraphs of a comment as (line, text). List items, indented rows (formulas, usage) and table rows are separate."""
    found, item = [], False
    for number, row in enumerate(rows, start):
        plain = row.strip()
        indented = len(row) - len(row.lstrip()) >= 2
        alone = COLUMNS.search(plain) or RULER.match(plain) or (indented and not item)
        mark = ITEM.match(plain)
        if mark and plain[0].isdigit() and not item and found and found[-1]:
            mark = None  # not an item but the end of a sentence: "errata 12."
        if not plain:
            found.append(None)
            item = False
        elif mark or alone or not found or found[-1] is None:
            found.append((number, [plain[mark.end():] if mark else plain]))
            item = bool(mark)
            if alone:
                found.append(None)
        else:
            found[-1][1].append(plain)
    return [(number, "\n".join(parts)) for number, parts in (f for f in found if f)]


def c_like(text):
    """Comments and strings as prose, identifiers as (line, name)."""
    text = INCLUDE.sub(lambda m: "\n" * m.group().count("\n"), text)
    prose, names = [], []
    comment, last_line = None, -2
    line, at = 1, 0
    joined = None  # adjacent strings are one text
    joined_end = 0
    for m in C_TOKEN.finditer(text):
        line += text.count("\n", at, m.start())
        at = m.start()
        if m["line"]:
            body = re.sub(r"^//[/!<]* ?", "", m["line"]).rstrip()
            alone = not text[text.rfind("\n", 0, at) + 1:at].strip()
            if comment and alone and last_line == line - 1 and comment[2]:
                comment[1].append(body)
            else:
                comment = (line, [body], alone)
                prose.append(("comment", comment))
            last_line = line
        elif m["block"]:
            body = textwrap.dedent(re.sub(r"^\s*\*", "", "  " + m["block"][2:-2].lstrip("*! "), flags=re.M))
            prose.append(("comment", (line, body.split("\n"), True)))
        elif m["string"] is not None or m["raw"] is not None:
            body = m["raw"] if m["raw"] is not None else m["string"][1:-1].replace("\\n", "\n").replace('\\"', '"')
            if joined and not text[joined_end:at].strip():
                joined[1].append(body)
            else:
                joined = (line, [body], False)
                prose.append(("string", joined))
            joined_end = m.end()
        elif m["name"]:
            names.append((line, m["name"]))
    out = []
    for kind, (start, parts, _) in prose:
        if kind == "string":
            body = "".join(parts)
            if body.count(" ") >= 2:
                out.extend(Prose(kind, start, p) for p in re.split(r"\n", body) if p.strip())
        else:
            out.extend(Prose(kind, *p) for p in paragraphs(start, parts))
    return out, names


def python(text):
    """Like c_like(), for Python: triple-quoted texts are comments."""
    prose, names, comments = [], [], []
    line, at = 1, 0
    for m in PY_TOKEN.finditer(text):
        line += text.count("\n", at, m.start())
        at = m.start()
        if m["line"]:
            body = re.sub(r"^# ?", "", m["line"]).rstrip()
            alone = not text[text.rfind("\n", 0, at) + 1:at].strip()
            if alone and comments and comments[-1][0] + len(comments[-1][1]) == line:
                comments[-1][1].append(body)
            elif line > 1 or not m["line"].startswith("#!"):
                comments.append((line, [body]))
        elif m["doc"] is not None and CODE.search(m["doc"]):
            continue
        elif m["doc"] is not None:
            comments.append((line, textwrap.dedent("    " + m["doc"]).split("\n") + [""]))
        elif m["string"]:
            if m["string"].count(" ") >= 2:
                prose.extend(Prose("string", line, p) for p in m["string"][1:-1].split("\\n") if p.strip())
        else:
            names.append((line, m["name"]))
    return prose + [Prose("comment", *p) for start, rows in comments for p in paragraphs(start, rows)], names


def hash_comments(text, mark="#"):
    prose, start, parts = [], 0, []
    for number, row in enumerate(text.split("\n") + [""], 1):
        stripped = row.strip()
        if stripped.startswith(mark) and not stripped.startswith("#!"):
            if not parts:
                start = number
            parts.append(re.sub("^ ", "", stripped.lstrip(mark)).rstrip())
            continue
        if parts:
            prose.extend(Prose("comment", *p) for p in paragraphs(start, parts))
            parts = []
        tail = re.search(r"\s" + re.escape(mark) + r"\s(.*)$", row) if mark == "#" else None
        if tail and '"' not in tail[1]:
            prose.append(Prose("comment", number, tail[1]))
    return prose


def document(text):
    """Paragraphs, list items and table cells of Markdown, without code."""
    prose, fence, start, parts = [], False, 0, []

    def flush():
        nonlocal parts
        if parts:
            prose.append(Prose("document", start, " ".join(parts)))
        parts = []

    for number, row in enumerate(text.split("\n") + [""], 1):
        stripped = row.strip()
        if stripped.startswith("```"):
            fence = not fence
            flush()
            continue
        if fence:
            continue
        plain = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", re.sub(r"`[^`]*`", "`x`", stripped))
        plain = re.sub(r"<[^>]*>", " ", plain)
        if plain.startswith("|"):
            flush()
            prose.extend(Prose("document", number, cell.strip()) for cell in plain.strip("|").split("|") if cell.strip(" -:"))
        elif not plain or plain.startswith("#"):
            flush()
            if plain.lstrip("# "):
                prose.append(Prose("document", number, plain.lstrip("# ")))
        else:
            if ITEM.match(plain):
                flush()
                plain = plain[ITEM.match(plain).end():]
            if not parts:
                start = number
            parts.append(plain)
    return prose


def notebook_texts(text, kind):
    return ["".join(cell["source"]) for cell in json.loads(text)["cells"] if cell["cell_type"] == kind]


def read(path, name):
    text = path.read_text(errors="replace")
    if path.suffix in C_LIKE:
        return c_like(text)
    if path.suffix == ".md":
        return document(text), []
    if path.suffix == ".py":
        return python(text)
    if path.suffix == ".ipynb":
        return [prose for text in notebook_texts(text, "markdown") for prose in document(text)] + \
            [prose for text in notebook_texts(text, "code") for prose in python(text)[0]], []
    if path.suffix in HASH or path.name in ("Makefile", "CMakeLists.txt", "packages", "install", "run"):
        names = [(n, word) for n, row in enumerate(text.split("\n"), 1) for word in re.findall(r"[A-Za-z_]\w*", row.split("#")[0])]
        return hash_comments(text), names if path.suffix == ".cmake" or path.name == "CMakeLists.txt" else []
    if path.suffix in (".cir", ".lib", ".inc"):
        return hash_comments(text, "*"), []
    return [], []


@functools.cache
def parts_of(name):
    return [p.lower() for p in re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+", name)]


def check_names(file, names):
    rules = RULES["identifiers"]
    exact, parts = rules["retired"], rules["retired_parts"]
    for line, name in names:
        if name in exact:
            yield Finding(file, line, f"retired name: {exact[name]}", name)
        else:
            for p in parts_of(name):
                if p in parts:
                    yield Finding(file, line, f"retired word in a name: {parts[p]}", name)


def check_prose(file, prose):
    for p in prose:
        for pattern, rule in EXPRESSIONS if ANY_EXPRESSION.search(p.text) else ():
            if p.kind not in rule.get("where", ("comment", "string", "document")):
                continue
            for m in pattern.finditer(p.text):
                yield Finding(file, p.line, f"{rule['instead']}", p.text[max(0, m.start() - 40):m.end() + 40])
        if p.kind == "string" and is_data(p.text):
            continue
        text = LABELS.sub("", p.text) if p.kind == "string" else p.text
        for s in sentences(re.sub(r'"[^"\n]*"', "x", text)):
            count = len(WORD.findall(s))
            if count > RULES["sentence"]["most_words"]:
                yield Finding(file, p.line, f"a sentence of {count} words; at most {RULES['sentence']['most_words']}", s)
            marks = len(re.findall(r"[;:](?=\s)", ASIDE.sub("", s)))
            if marks > RULES["sentence"]["most_colons"]:
                yield Finding(file, p.line, f"{marks} colons and semicolons in a sentence; at most {RULES['sentence']['most_colons']}", s)


def check_types(file, text):
    """Checks that a type is not a bare participle, and that functions that can fail return Result<void>."""
    for m in re.finditer(r"^\s*(?:struct|class|enum class|enum|using)\s+(?:\[\[\w+\]\]\s+)?([A-Z]\w*)\b(?=\s*[:{=]|\s+final)", text, re.M):
        name, line = m[1], text.count("\n", 0, m.start(1)) + 1
        if re.fullmatch(RULES["types"]["participle"], name):
            yield Finding(file, line, "a type is a noun, not a bare participle", name)
    for m in re.finditer(r"^[^\n/]*std::optional<Error>\s+\w+\(", text, re.M):
        yield Finding(file, text.count("\n", 0, m.start()) + 1, "a function that can fail returns Result<void>", m[0].strip())


def check_file_names(files):
    seen = collections.defaultdict(list)
    for f in files:
        path = pathlib.PurePosixPath(f)
        if path.suffix in (".hpp", ".cpp") and path.parts[0] in ("src", "apps", "reproduction"):
            seen[path.name].append(f)
    for name, paths in seen.items():
        if len(paths) > 1:
            yield Finding(paths[1], 0, "a file name that occurs twice", " ".join(paths))


def check(root):
    listed = subprocess.run(["git", "-C", root, "ls-files", "-z"], capture_output=True, check=True).stdout.decode().split("\0")
    files = [f for f in listed if f and not any(fnmatch.fnmatch(f, skip["files"]) for skip in RULES["skip"])]
    findings, read_sentences = list(check_file_names(files)), 0
    for f in files:
        path = pathlib.Path(root) / f
        if not path.is_file():
            continue
        prose, names = read(path, f)
        read_sentences += sum(len(sentences(p.text)) for p in prose)
        findings += check_names(f, names)
        findings += check_prose(f, prose)
        if path.suffix in (".hpp", ".cpp"):
            findings += check_types(f, path.read_text(errors="replace"))
    used = set()

    def excused(finding):
        for k, e in enumerate(EXCUSES):
            if fnmatch.fnmatch(finding.file, e["files"]) and re.search(e["text"], finding.text):
                used.add(k)
                return True
        return False

    left = [x for x in findings if not excused(x)]
    for k, e in enumerate(EXCUSES):
        if k not in used:
            left.append(Finding("test/words/excuses.toml", 0, "an unused excuse", e["text"]))
        if not e.get("reason"):
            left.append(Finding("test/words/excuses.toml", 0, "an excuse without a reason", e["text"]))
    if len(EXCUSES) >= RULES["excuses"]["fewer_than"]:
        left.append(Finding("test/words/excuses.toml", 0, f"too many excuses; there must be fewer than {RULES['excuses']['fewer_than']}", str(len(EXCUSES))))
    return left, read_sentences


def self_test():
    """Checks that each expression finds its bad example and not its good one, and that the other rules find a test case."""
    wrong = []
    for rule in RULES["expression"]:
        kind = rule.get("where", ["comment"])[0]
        if not any(f.rule == rule["instead"] for f in check_prose("x", [Prose(kind, 1, rule["bad"])])):
            wrong.append(f"{rule['pattern']} does not find: {rule['bad']}")
        if any(f.rule == rule["instead"] for f in check_prose("x", [Prose(kind, 1, rule["good"])])):
            wrong.append(f"{rule['pattern']} finds: {rule['good']}")
    prose, names = c_like('/// True if it\n/// fits.\nint Wish = f("one two "\n "three"); // and then\n')
    if [p.text for p in prose] != ["True if it\nfits.", "one two three", "and then"] or (3, "Wish") not in names:
        wrong.append(f"comments and strings are not read: {prose} {names}")
    if not list(check_names("x", names)):
        wrong.append("a retired name is not found")
    if len(list(check_prose("x", [Prose("comment", 1, "word " * 60 + ".")]))) != 1:
        wrong.append("a long sentence is not found")
    if len(list(check_types("x", "struct Told {\n};\nstd::optional<Error> f(int);\n"))) != 2:
        wrong.append("a participle as a type, or an optional error, is not found")
    if not list(check_file_names(["src/a/x.cpp", "src/b/x.cpp"])):
        wrong.append("a file name that occurs twice is not found")
    formula = "/// With a\n///     b = c\n/// one has table\n/// 3. Here:\n/// - d\n///   e\n/// - f\n/// g    h\n/// ---- i ----\n/// j - k\nint x;"
    if [p.text for p in c_like(formula)[0]] != ["With a", "b = c", "one has table\n3. Here:", "d\ne", "f", "g    h", "---- i ----", "j - k"]:
        wrong.append(f"formulas, items and columns of a comment are not separate: {c_like(formula)[0]}")
    prose, names = python('"""One.\n\nTwo."""\nwish = f("a b c")  # d\n')
    if sorted(p.text for p in prose) != ["One.", "Two.", "a b c", "d"] or (4, "wish") not in names or (4, "a") in names:
        wrong.append(f"Python is not read: {prose} {names}")
    for kind, text in RULES["strings"]["good"]:
        if list(check_prose("x", [Prose(kind, 1, text)])):
            wrong.append(f"a rule of sentences finds: {text}")
    for kind, text in RULES["strings"]["bad"]:
        if not list(check_prose("x", [Prose(kind, 1, text)])):
            wrong.append(f"no rule of sentences finds: {text}")
    if document("a `b`\n\n```sh\nwhoever\n```\n| c | d |\n") != [Prose("document", 1, "a `x`"), Prose("document", 6, "c"), Prose("document", 6, "d")]:
        wrong.append("Markdown is not read")
    return wrong


def main():
    if "--self-test" in sys.argv:
        wrong = self_test()
        print("\n".join(wrong) or "every rule finds its example")
        return bool(wrong)
    findings, count = check(sys.argv[1])
    for f in findings:
        print(f"{f.file}:{f.line}: {f.rule}\n    {' '.join(f.text.split())[:300]}")
    print(f"{count} sentences read, {len(findings)} found, {len(EXCUSES)} excuses")
    return bool(findings)


if __name__ == "__main__":
    sys.exit(main())
