"""wasm_engine_test.py CORPUSCLE ENGINE.js: the WebAssembly engine responds as the program does.

Afferents of equations give the same spikes within 1 ns, to which the program writes them. A chip's time steps have the same tolerances, but its matrices are solved with other pivots (Eigen
instead of KLU), so its spikes differ by rounding that the step control amplifies: `max_chip_difference` bounds it."""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy

program, engine = sys.argv[1:]
max_chip_difference = 1e-6  # s
if not pathlib.Path(engine).exists():
    print(f"{engine} is not built; make page builds it")
    sys.exit(77)

here = pathlib.Path(__file__).parent
node = subprocess.Popen(["node", str(here / "ask_engine.js"), engine], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def answer_of(**request):
    node.stdin.write(json.dumps(request) + "\n")
    node.stdin.flush()
    return json.loads(node.stdout.readline())


def ask(**request):
    answer = answer_of(**request)
    assert "error" not in answer, answer["error"]
    return answer


def native(afferent):
    """Spike times of the program, s, rounded to ns."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "respond", "press", "--afferent", afferent, "--quiet", "--out", folder], check=True)
        with open(pathlib.Path(folder) / "spikes.csv", newline="") as file:
            return numpy.array([float(row["time_s"]) for row in csv.DictReader(file)])


def of_page(afferent):
    return numpy.array(ask(request="respond", rate=10000, stimulus="press", rows=[{"afferent": afferent}])["data"]["time"])


failed = False
for afferent, bound in [("sa1", 1e-9), ("fa1", 1e-9), ("sa1-nerve", 1e-9), ("fa1-nerve", 1e-9), ("sa1-circuit", max_chip_difference), ("fa1-circuit", max_chip_difference)]:
    expected, found = native(afferent), of_page(afferent)
    same_count = len(expected) == len(found)
    difference = float(numpy.abs(expected - found).max()) if same_count else float("inf")
    print(f"{afferent}: {len(expected)} spikes, {len(found)} as WebAssembly; largest difference {difference:.3g} s")
    failed = failed or not same_count or len(expected) == 0 or difference > bound

# A skin, pressed and advanced in blocks: as many spikes as in one block.
counts = []
for length in (10, 500):
    ask(request="start", rate=1000, skin={"population": "fingertip"})
    counts.append(sum(len(ask(request="advance", samples=length, force=1.5)["data"]["time"]) for _ in range(500 // length)))
print(f"fingertip: {counts[0]} spikes in 500 ms")
failed = failed or counts[0] != counts[1] or counts[0] < 100

# The remedy for an older MATLAB file makes an archive, which this engine cannot read and says so.
error = answer_of(request="read", name="old.mat", data={"file": "MATLAB 5.0 MAT-file, Platform: GLNXA64" + " " * 500})["error"]
print(error)
failed = failed or "'old.npz'" not in error or not error.endswith("; the page cannot read NPZ and HDF5 files, `corpuscle respond` can")

node.stdin.close()
sys.exit(failed or node.wait() != 0)
