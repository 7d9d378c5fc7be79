"""page_server_test.py PROGRAM: corpuscle stream --serve as a user meets it: a sensor's stream on pages, sessions, errors, Ctrl-C."""
import json
import os
import struct
import subprocess
import sys
import tempfile
import time

from page_clients import BINARY, CLOSE, Page, Server, head_of, http_status

TYPES = {"f32": ("f", 4), "f64": ("d", 8), "u32": ("I", 4), "u8": ("B", 1)}


def arrays_of(message):
    """The arrays of a message, by name."""
    size, = struct.unpack_from("<I", message)
    at, found = 4 + size, {}
    for row in head_of(message).get("arrays", []):
        letter, width = TYPES[row["type"]]
        found[row["name"]] = struct.unpack_from(f"<{row['count']}{letter}", message, at)
        at += (row["count"] * width + 7) // 8 * 8
    assert at == len(message), "the arrays fill the message"
    return found


def fails(program, *options):
    """Runs a stream that must end with an error. Returns the exit status and the error."""
    done = subprocess.run([program, "stream", *options], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60)
    assert done.returncode in (1, 2), done
    return done.returncode, done.stderr


def check_sensor(program):
    """A page sees all spikes and the forces of a stream: those of the file that the stream writes."""
    with tempfile.TemporaryDirectory() as folder:
        spikes = os.path.join(folder, "spikes.csv")
        server = Server(program, ["--population", "grid 4x4", "--rate", "1kHz", "--serve", "0", "-o", spikes], stdin=subprocess.PIPE)
        page, late = Page("127.0.0.1", server.port), None
        opcode, greeting = page.next()
        head, arrays = head_of(greeting), arrays_of(greeting)
        assert opcode == BINARY and head["event"] == "stream" and head["rate"] == 1000 and head["force_rate"] == 1000, head
        assert len(arrays["site_x"]) == 16 and len(arrays["x"]) == head["units"] == sum(c["count"] for c in head["classes"]), head
        late = Page("localhost", server.port, host=f"localhost:{server.port}", origin=f"http://localhost:{server.port}")
        assert late.message()["event"] == "stream"
        for k in range(500):
            server.process.stdin.write(",".join("3" if k >= 100 and s in (3, 7) else "0" for s in range(16)) + "\n")
            if k % 20 == 0:
                server.process.stdin.flush()
        server.process.stdin.close()
        seen, forces, times = [], [], []
        while True:
            opcode, message = page.next()
            head = head_of(message)
            if head["event"] == "end":
                break
            assert head["event"] == "frames" and "lost" not in head, head
            arrays = arrays_of(message)
            seen += list(zip(arrays["time"], arrays["unit"]))
            times += arrays["frame_time"]
            at = 0
            for touched in arrays["touched"]:
                forces.append(list(zip(arrays["site"][at:at + touched], arrays["force"][at:at + touched])))
                at += touched
        assert head["frames"] == 500 and head["spikes"] == len(seen) > 10, (head, len(seen))
        opcode, close = page.next()
        assert opcode == CLOSE and struct.unpack(">H", close[:2])[0] == 1001, close
        page.close(), late.close()
        assert server.wait() == 0, server.messages
        assert server.out == "", "spikes go to the file only"
        assert "2 pages connected, at most 2 at once" in server.messages, server.messages
        with open(spikes, encoding="utf-8") as lines:
            written = [float(line.rsplit(",", 1)[1]) for line in lines if line[0] not in "#a" or line.split(",")[-1][0].isdigit()]
        assert len(written) == len(seen)
        assert all(abs(a - b[0]) < 1e-8 for a, b in zip(sorted(written), sorted(seen)))
        assert [abs(t - k / 1000) < 1e-12 for k, t in enumerate(times)] == 500 * [True]
        assert forces == 100 * [[]] + 400 * [[(3, 3.0), (7, 3.0)]]


def check_recording_waits(program):
    """A stimulus begins when a page is open. Without --out, its spikes go to the page only."""
    server = Server(program, ["--in", "press", "--serve", "0", "--json"])
    server.wait_for("(begins when a page is open)")
    time.sleep(0.3)
    assert server.process.poll() is None, "the stream waits"
    page = Page("127.0.0.1", server.port)
    spikes = 0
    while (message := page.message())["event"] != "end":
        spikes += sum(row["count"] for row in message["arrays"] if row["name"] == "unit" and message["event"] == "frames")
    page.close()
    assert server.wait() == 0, server.messages
    summary = json.loads(server.out)
    assert summary["spikes"] == message["spikes"] == spikes > 0, (summary, message, spikes)
    assert summary["pages"]["connections"] == 1 and summary["events"]["to"] == "nowhere", summary


def check_sessions(program):
    """Each page has a session of its own; a page too many is refused; Ctrl-C ends the server quickly."""
    server = Server(program, ["--in", "page", "--serve", "0", "--max-viewers", "2"])
    assert server.url.startswith("http://localhost:"), server.url
    assert http_status("localhost", server.port) == 200
    pages = [Page("127.0.0.1", server.port, "/engine") for _ in range(2)]
    for page in pages:
        answer = page.request({"request": "catalogue"})
        assert answer.get("answer") == "catalogue", answer
        assert "error" in page.request({"request": "no such request"})
    third = Page("127.0.0.1", server.port, "/engine")
    assert "--max-viewers 2" in third.message()["error"]
    third.close()
    pages[0].close()  # as a reload does
    for _ in range(100):
        page = Page("127.0.0.1", server.port, "/engine")
        if page.request({"request": "catalogue"}).get("answer") == "catalogue":
            break
        page.close()
        time.sleep(0.05)
    else:
        raise AssertionError("the place of a page that has left is not given to another")
    assert server.stop() == 130 and server.out == "", (server.out, server.messages)
    assert server.seconds_to_end < 5, server.seconds_to_end
    assert "at most 2 at once" in server.messages, server.messages


def check_errors(program):
    server = Server(program, ["--in", "page", "--serve", "0", "--json"])
    status, error = fails(program, "--in", "page", "--serve", str(server.port))
    assert status == 1 and f":{server.port}" in error and "give --serve another number, or 0" in error, error
    second = Server(program, ["--in", "page", "--serve", "0", "--quiet"])
    assert second.port != server.port and http_status("127.0.0.1", second.port) == 200
    assert (second.stop(), second.out, second.messages.count("\n")) == (130, "", 1), "--quiet prints the address only"
    assert server.stop() == 130 and json.loads(server.out)["pages"]["connections"] == 0, server.out
    for options, part in ((["--in", "page"], "add --serve 8080"), (["--rate", "1kHz", "--bind", "0.0.0.0"], "add --serve 8080"),
                          (["--rate", "1kHz", "--max-viewers", "3"], "add --serve 8080"),
                          (["--in", "page", "--serve", "0", "--rate", "1kHz"], "--rate cannot be used with --in page"),
                          (["--in", "page", "--serve", "65536"], "65535"),
                          (["--rate", "1kHz", "--serve", "0", "--bind", "203.0.113.1"], "give --bind an address of this machine")):
        status, error = fails(program, *options)
        assert part in error, (options, error)


def main(program):
    for check in (check_sensor, check_recording_waits, check_sessions, check_errors):
        check(program)
        print(check.__name__, "passed")


if __name__ == "__main__":
    main(sys.argv[1])
