"""A small WebSocket client of the page server, for its tests: standard library only, also for wrong bytes."""
import base64
import json
import os
import re
import socket
import struct
import subprocess
import threading
import time

BINARY, CLOSE, PING, PONG = 2, 8, 9, 10


def frame(opcode, data, final=True):
    """A frame of a client, masked as it must be."""
    mask = os.urandom(4)
    size = len(data)
    length = bytes([0x80 | size]) if size < 126 else b"\xfe" + struct.pack(">H", size) if size < 65536 else b"\xff" + struct.pack(">Q", size)
    masked = bytes(byte ^ mask[k % 4] for k, byte in enumerate(data))
    return bytes([(0x80 if final else 0) | opcode]) + length + mask + masked


def handshake(host, target="/stream", origin=None):
    key = base64.b64encode(os.urandom(16)).decode()
    lines = [f"GET {target} HTTP/1.1", f"Host: {host}", "Upgrade: websocket", "Connection: Upgrade", "Sec-WebSocket-Version: 13", f"Sec-WebSocket-Key: {key}"]
    if origin:
        lines.append(f"Origin: {origin}")
    return ("\r\n".join(lines) + "\r\n\r\n").encode()


def head_of(message):
    """The head of a message of the server (doc/page-protocol.md)."""
    size, = struct.unpack_from("<I", message)
    return json.loads(message[4:4 + size])


class Frames:
    """Finds the response and the frames of the server in the bytes that arrive."""

    def __init__(self):
        self.buffer = bytearray()
        self.status = None

    def add(self, data):
        self.buffer += data
        if self.status is None and b"\r\n\r\n" in self.buffer:
            self.status = int(self.buffer[9:12])
            del self.buffer[:self.buffer.index(b"\r\n\r\n") + 4]

    def next(self):
        """The next frame as (opcode, data); None if it has not arrived."""
        if self.status != 101 or len(self.buffer) < 2:
            return None
        size, head = self.buffer[1] & 127, 2
        if size == 126:
            size, head = int.from_bytes(self.buffer[2:4], "big"), 4
        elif size == 127:
            size, head = int.from_bytes(self.buffer[2:10], "big"), 10
        if len(self.buffer) < head + size or (head > 2 and len(self.buffer) < head):
            return None
        opcode, data = self.buffer[0] & 15, bytes(self.buffer[head:head + size])
        del self.buffer[:head + size]
        return opcode, data


class Page:
    """A page that waits for what it reads."""

    def __init__(self, address, port, target="/stream", host=None, origin=None, timeout=10):
        self.socket = socket.create_connection((address, port), timeout)
        self.frames = Frames()
        self.socket.sendall(handshake(host or f"{address}:{port}", target, origin))
        while self.frames.status is None:
            self._receive()
        self.status = self.frames.status

    def _receive(self):
        data = self.socket.recv(1 << 16)
        if not data:
            raise ConnectionError("the server has closed the connection")
        self.frames.add(data)

    def next(self):
        """The next frame."""
        while (found := self.frames.next()) is None:
            self._receive()
        return found

    def message(self):
        """The head of the next message."""
        while True:
            opcode, data = self.next()
            if opcode == BINARY:
                return head_of(data)
            if opcode == CLOSE:
                raise ConnectionError(f"closed: {data[2:].decode()}")

    def request(self, head):
        self.socket.sendall(frame(BINARY, json.dumps(head).encode()))
        return self.message()

    def close(self):
        self.socket.close()


def http_status(address, port, target="/", host=None, headers=""):
    """The status of a GET request; 0 if there is no response."""
    with socket.create_connection((address, port), 10) as connection:
        connection.sendall(f"GET {target} HTTP/1.1\r\nHost: {host or f'{address}:{port}'}\r\n{headers}\r\n".encode())
        text = b""
        while chunk := connection.recv(1 << 16):
            text += chunk
    return int(text[9:12]) if text.startswith(b"HTTP/1.1 ") else 0


class Server:
    """corpuscle stream with a page server. `out` and `messages`: its standard output and standard error so far."""

    def __init__(self, program, options, stdin=subprocess.DEVNULL):
        self.process = subprocess.Popen([program, "stream", *options], stdin=stdin, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.out = self.messages = ""
        self.readers = [threading.Thread(target=self._read, args=names, daemon=True) for names in (("out", self.process.stdout), ("messages", self.process.stderr))]
        for reader in self.readers:
            reader.start()
        self.url = self.wait_for(r"open (http://\S+)\n")

    def _read(self, name, pipe):
        for line in pipe:
            setattr(self, name, getattr(self, name) + line)

    def wait_for(self, pattern):
        """Waits until standard error has the pattern; returns its first group."""
        for _ in range(3000):
            is_ended = self.process.poll() is not None
            if found := re.search(pattern, self.messages):
                return found[1]
            if is_ended:
                break
            time.sleep(0.01)
        self.process.kill()
        raise RuntimeError(f"no message {pattern!r}: {self.messages}")

    @property
    def port(self):
        return int(re.search(r":(\d+)/", self.url)[1])

    def memory(self):
        """Resident memory, bytes."""
        with open(f"/proc/{self.process.pid}/status", encoding="ascii") as status:
            return 1024 * int(re.search(r"VmRSS:\s*(\d+)", status.read())[1])

    def wait(self, seconds=30):
        """Waits for its end. Returns the exit status."""
        try:
            status = self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise
        for reader in self.readers:
            reader.join()
        return status

    def stop(self):
        """Ends it as Ctrl-C does. Returns the exit status."""
        started = time.monotonic()
        self.process.send_signal(2)
        status = self.wait()
        self.seconds_to_end = time.monotonic() - started
        return status
