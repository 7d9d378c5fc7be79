"""page_server_network_test.py PROGRAM: access to the page server from another address, through a network namespace of its own.

From there: nothing on a server that listens on loopback, and only with the token on one that listens everywhere. Without the right to make a
namespace the test is skipped (exit status 77)."""
import os
import shutil
import signal
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
from page_clients import Server, http_status  # noqa: E402

NAME = f"corpuscle-test-{os.getpid()}"
SERVER_ADDRESS, CLIENT_ADDRESS = "198.18.97.1", "198.18.97.2"  # reserved for tests of networks
LINK = f"cp{os.getpid() % 100000}"


def run(*words, check=True):
    return subprocess.run(words, check=check, capture_output=True, text=True)


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


def make_network():
    if run("ip", "netns", "add", NAME, check=False).returncode != 0:
        skip("a network namespace needs the rights of root")
    if run("ip", "netns", "exec", NAME, "true", check=False).returncode != 0:
        skip("no program can be started in a network namespace (in a chroot, its root must be a mount point)")
    if run("ip", "link", "add", f"{LINK}a", "type", "veth", "peer", "name", f"{LINK}b", "netns", NAME, check=False).returncode != 0:
        skip("this machine makes no virtual network links (veth)")
    run("ip", "address", "add", f"{SERVER_ADDRESS}/30", "dev", f"{LINK}a")
    run("ip", "link", "set", f"{LINK}a", "up")
    for words in (("address", "add", f"{CLIENT_ADDRESS}/30", "dev", f"{LINK}b"), ("link", "set", f"{LINK}b", "up"), ("link", "set", "lo", "up")):
        run("ip", "-n", NAME, *words)


def remove_network():
    run("ip", "link", "delete", f"{LINK}a", check=False)
    run("ip", "netns", "delete", NAME, check=False)


def from_outside(code):
    """Runs a Python expression in the namespace; its value as text, or the name of its error."""
    program = f"import sys; sys.path.insert(0, {HERE!r})\nfrom page_clients import *\ntry: print({code})\nexcept OSError as error: print(type(error).__name__)"
    return run("ip", "netns", "exec", NAME, sys.executable, "-c", program).stdout.strip()


def check_loopback_server(program):
    server = Server(program, ["--in", "page", "--serve", "0"])
    try:
        assert http_status("127.0.0.1", server.port) == 200
        refused = from_outside(f"http_status('{SERVER_ADDRESS}', {server.port})")
        assert refused == "ConnectionRefusedError", refused
    finally:
        status = server.stop()
    assert status == 130, server.messages


def check_open_server(program, address):
    server = Server(program, ["--in", "page", "--serve", "0", "--bind", address])
    try:
        target = server.url[server.url.index("/?token="):]
        port = server.port
        for wrong in ("/", "/?token=" + 32 * "0", "/x", target[:-1]):
            assert from_outside(f"http_status('{SERVER_ADDRESS}', {port}, {wrong!r})") == "401", wrong
            assert from_outside(f"Page('{SERVER_ADDRESS}', {port}, {'/engine' + wrong[1:]!r}).status") == "401", wrong
        assert from_outside(f"http_status('{SERVER_ADDRESS}', {port}, {target!r})") == "200"
        socket = "/engine" + target[1:]
        page = f"Page('{SERVER_ADDRESS}', {port}, {socket!r}, origin='http://{SERVER_ADDRESS}:{port}')"
        assert from_outside(f"{page}.request({{'request': 'catalogue'}})['answer']") == "catalogue"
        evil = f"Page('{SERVER_ADDRESS}', {port}, {socket!r}, origin='http://evil.example').status"
        assert from_outside(evil) == "403"
    finally:
        status = server.stop()
    assert status == 130, server.messages
    assert server.messages.count(target) == 1 or address == "0.0.0.0", "the token is printed once for each address of the machine"


def main(program):
    if shutil.which("ip") is None:
        skip("the program ip (package iproute2) is missing")
    try:
        make_network()
        check_loopback_server(program)
        check_open_server(program, SERVER_ADDRESS)
        check_open_server(program, "0.0.0.0")
    finally:
        remove_network()
    print("passed")


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    main(sys.argv[1])
