"""vsplitd for a test: started on free ports, its doors, its memory, its end."""

import http.client
import json
import os
import re
import subprocess
import sys
import tempfile


class Server:
    """`with Server(vsplitd) as server:`; the end of the scope sends SIGTERM and fails where it does not end well."""

    def __init__(self, vsplitd, *options):
        self.log = tempfile.TemporaryFile(mode="w+")
        self.process = subprocess.Popen(
            [vsplitd, "--listen", "127.0.0.1:0", "--log-level", "error", *options], stdout=subprocess.PIPE, stderr=self.log, text=True)
        line = self.process.stdout.readline()
        found = re.fullmatch(r"vsplitd listening on (\S+) and http://(\S+):(\d+)\n", line)
        if not found:
            raise RuntimeError(f"vsplitd said {line!r}: {self.errors()}")
        self.host, self.port = found[2], int(found[3])

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if self.process.poll() is None:
            self.process.terminate()
        status = self.process.wait(timeout=60)
        if kind is None and status != 0:
            raise RuntimeError(f"vsplitd ended with {status}: {self.errors()}")

    def errors(self):
        self.log.seek(0)
        return self.log.read()[-4000:]

    def alive(self):
        return self.process.poll() is None

    def memory(self):
        """Bytes that are its own and not a file's."""
        with open(f"/proc/{self.process.pid}/status", encoding="ascii") as status:
            return int(re.search(r"RssAnon:\s+(\d+)", status.read())[1]) * 1024

    def peak_memory(self):
        """The most bytes that it had at a time, of files and of its own."""
        with open(f"/proc/{self.process.pid}/status", encoding="ascii") as status:
            return int(re.search(r"VmHWM:\s+(\d+)", status.read())[1]) * 1024

    def metric(self, name):
        """What /metrics says of one without labels."""
        for line in self.ask("GET", "/metrics")[1].decode().splitlines():
            if line.startswith(name + " "):
                return float(line.split()[1])
        raise RuntimeError(f"no metric {name}")

    def connect(self, timeout=60):
        return http.client.HTTPConnection(self.host, self.port, timeout=timeout)

    def ask(self, method, target, body=None, headers=None):
        """Status and body of one request on a connection of its own."""
        connection = self.connect()
        try:
            connection.request(method, target, body, headers or {})
            reply = connection.getresponse()
            return reply.status, reply.read()
        finally:
            connection.close()

    def ask_json(self, method, target, body=None, headers=None):
        status, text = self.ask(method, target, body, headers)
        if status != 200:
            raise RuntimeError(f"{method} {target}: {status} {text[:500]!r}")
        return json.loads(text)


def fail(message):
    print(f"FAILED: {message}", file=sys.stderr)
    sys.stdout.flush()
    sys.exit(1)


def sanitized(vsplitd):
    """Whether the program is one of the sanitizers', whose memory tells nothing."""
    with open(vsplitd, "rb") as program:
        return b"__asan_init" in program.read() or os.environ.get("VSPLIT_SANITIZED") == "1"
