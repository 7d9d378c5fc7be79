"""files_are_grouped.py SOURCE: cmake/unity_units.cmake puts files apart whose local names meet, and others together."""

import pathlib
import subprocess
import sys
import tempfile

# The anonymous namespaces of two files, and whether both may be in one unit.
CASES = (
    ("constexpr double limit = 1;", "constexpr double limit = 2;", False),
    ("constexpr std::pair<int, int> names[] = {{1, 2}};", "constexpr int names[] = {1};", False),
    ("int read(const Text& one) {\n    return 1;\n}", "int read(const Text& other, int n) {\n    return n;\n}", False),
    ("int read(const Text& text) {\n    return 1;\n}", "int read(double x) {\n    return 2;\n}", True),
    ("using Json = nlohmann::json;", "using Json = nlohmann::json;", True),
    ("using Json = nlohmann::json;", "using Json = nlohmann::ordered_json;", False),
    ("struct Row {};", "int count(Row row) {\n    return 1;\n}", False),
    ("struct Row {};", "struct Column {};", True),
)

script = pathlib.Path(sys.argv[1]) / "cmake" / "unity_units.cmake"
failed = 0
for first, second, are_together in CASES:
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for file, body in (("a.cpp", first), ("b.cpp", second)):
            (folder / file).write_text(f"namespace corpuscle {{\nnamespace {{\n\n{body}\n\n}}  // namespace\n}}  // namespace corpuscle\n")
        (folder / "files.txt").write_text(f"{folder}/a.cpp\n{folder}/b.cpp\n")
        subprocess.run(["cmake", "-D", f"FOLDER={folder}", "-D", "COUNT=1", "-D", "LAST=2", "-P", script], check=True)
        units = [path for path in folder.glob("[0-9].cpp") if path.read_text().strip()]
        if (len(units) == 1) != are_together:
            print(f"in {len(units)} units:\n{first}\n{second}\n")
            failed += 1
sys.exit(failed > 0)
