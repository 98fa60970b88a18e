# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Drives `measured-brdf fetch` against a server of its own on 127.0.0.1; needs no network.

usage: TestFetch.py PROGRAM SHARED_DATA [unittest arguments]
"""

import hashlib
import http.server
import json
import os
import random
import resource
import shutil
import signal
import socket
import stat
import subprocess
import sys
import tempfile
import threading
import time
import unittest

PROGRAM = ""
SHARED = ""

HOST = "/d38rqfq1h7iukm.cloudfront.net/media/materials/"
FREE = "acrylic_felt_green"  # an entry whose size and sum the catalog does not have
SIZED = "satin_purple"  # one whose size it has: 658960


class Resource:
    """Bytes at a path, and what is wrong with the way they are served.

    cut: the connection ends after so many bytes of an answer's body, in the first `cuts` answers that are longer.
    pause: seconds of silence after those bytes, instead of an end.
    status: answers with this status, in the first `failures` answers (all: None).
    redirect: where to. without_length: as it says.
    extra: bytes that are sent beyond what was announced (no length is announced then).
    """

    def __init__(self, content, **faults):
        self.content = content
        self.cut = self.status = self.redirect = self.failures = None
        self.pause = 0
        self.cuts = 1
        self.extra = b""
        self.without_length = False
        for name, value in faults.items():
            assert hasattr(self, name), name
            setattr(self, name, value)


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def log_message(self, *arguments):
        pass

    def do_GET(self):
        server = self.server.owner
        with server.lock:
            server.requests.append((self.path, dict(self.headers)))
            resource = server.resources.get(self.path)
        if resource is None:
            return self.answer(404, b"<html>no such page</html>")
        if resource.redirect:
            return self.answer(302, b"moved", [("Location", resource.redirect)])
        if resource.status and (resource.failures is None or resource.failures > 0):
            resource.failures = resource.failures and resource.failures - 1
            return self.answer(resource.status, b"<html>an error</html>")
        return self.serve(resource)

    def answer(self, status, body, headers=()):
        self.send_response(status)
        for name, value in headers:
            self.send_header(name, value)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def serve(self, resource):
        body = resource.content
        self.send_response(200)
        if not (resource.without_length or resource.extra):
            self.send_header("Content-Length", str(len(body)))
        else:
            self.close_connection = True
            self.send_header("Connection", "close")
        self.end_headers()
        self.send(resource, body + resource.extra if resource.extra else body)

    def send(self, resource, body):
        try:
            if resource.cut is None or resource.cuts <= 0 or len(body) <= resource.cut:
                self.wfile.write(body)
                return
            resource.cuts -= 1
            self.wfile.write(body[: resource.cut])
            self.wfile.flush()
            self.server.owner.stop.wait(resource.pause)
            self.connection.shutdown(socket.SHUT_RDWR)
        except OSError:
            pass
        self.close_connection = True


class Server(http.server.ThreadingHTTPServer):
    daemon_threads = True

    def handle_error(self, request, client_address):
        pass  # clients of these tests come and go


class FileServer:
    """Serves resources, {path: Resource}, at url until close()."""

    def __init__(self):
        self.resources = {}
        self.requests = []  # (path, headers)
        self.lock = threading.Lock()
        self.stop = threading.Event()
        self.http = Server(("127.0.0.1", 0), Handler)
        self.http.owner = self
        self.url = f"http://127.0.0.1:{self.http.server_address[1]}"
        threading.Thread(target=self.http.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True).start()

    def close(self):
        self.stop.set()
        self.http.shutdown()
        self.http.server_close()


def rgl(name):
    return f"{HOST}{name}/{name}_rgb.bsdf"


def make_bytes(count, seed=1):
    return b"tensor_file\0" + random.Random(seed).randbytes(count - 12)


def sha256(content):
    return hashlib.sha256(content).hexdigest()


class FetchTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.server = FileServer()
        self.addCleanup(self.server.close)
        self.cache = os.path.join(self.folder, "cache", "vtkMeasuredBRDF", "vtkMeasuredBRDF-files")
        self.file = os.path.join(self.cache, f"{FREE}_rgb.bsdf")
        self.content = make_bytes(300000)
        self.environment = {key: value for key, value in os.environ.items() if "proxy" not in key.lower()}
        self.environment["XDG_CACHE_HOME"] = os.path.join(self.folder, "cache")

    def serve(self, content=None, path=rgl(FREE), **faults):
        served = Resource(self.content if content is None else content, **faults)
        self.server.resources[path] = served
        return served

    def get_command(self, *arguments):
        retries = [] if "--retries" in arguments else ["--retries", "0"]
        return [PROGRAM, "fetch", "--base-url", self.server.url, *retries, *map(str, arguments)]

    def run_tool(self, *arguments, **options):
        options.setdefault("env", self.environment)
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120,
                              stdin=subprocess.DEVNULL, **options)

    def fetch(self, *arguments, **options):
        return self.run_tool(*self.get_command(*arguments)[1:], **options)

    def fetch_free(self, *arguments, **options):
        return self.fetch(FREE, "--sha256", sha256(self.content), *arguments, **options)

    def check(self, result, status, *words):
        said = result.stdout + result.stderr
        self.assertEqual(result.returncode, status, said)
        for word in words:
            self.assertIn(word, said)

    def check_fetched(self, result, path=None, content=None):
        path = path or self.file
        self.check(result, 0)
        self.assertEqual(result.stdout, path + "\n")
        self.assertEqual(self.read(path), self.content if content is None else content)

    def read(self, path):
        with open(path, "rb") as file:
            return file.read()

    def write(self, path, content):
        os.makedirs(os.path.dirname(path), mode=0o700, exist_ok=True)
        with open(path, "wb") as file:
            file.write(content)

    def check_nothing_kept(self):
        self.assertEqual(os.listdir(self.cache) if os.path.exists(self.cache) else [], [])


class Catalog(FetchTest):
    def test_list(self):
        self.check(self.run_tool("fetch", "--list"), 0, "satin_purple", "potsdamer_platz_1k", "CC0 1.0",
                   "not known")
        some = self.run_tool("fetch", "--list", "satin")
        self.check(some, 0, "satin_gold")
        self.assertNotIn("potsdamer", some.stdout)
        self.check(self.run_tool("fetch", "--list", "no-such-name"), 1, "nothing in the list")

    def test_every_entry_is_in_order(self):
        listed = json.loads(self.run_tool("fetch", "--list", "--json").stdout)
        self.assertGreater(len(listed), 100)
        self.assertEqual(len({entry["name"] for entry in listed}), len(listed))
        self.assertEqual(len({entry["file"] for entry in listed}), len(listed))
        for entry in listed:
            self.assertTrue(entry["url"].startswith("https://"), entry)
            self.assertNotIn("{", entry["url"] + entry["file"] + entry["page"])
            self.assertRegex(entry["file"], r"^[A-Za-z0-9_-]+\.(bsdf|hdr)$")
            self.assertLessEqual(entry["size"] or 1, entry["limit"])
            if entry["sha256"] is not None:
                self.assertRegex(entry["sha256"], r"^[0-9a-f]{64}$")
            self.assertEqual(entry["sum"] in ("published", "copy"), entry["sha256"] is not None, entry)
            self.assertIsNone(entry["fetched"])

    def test_wrong_calls(self):
        self.check(self.run_tool("fetch"), 2, "--list")
        self.check(self.run_tool("fetch", "qqqqqq"), 1, "qqqqqq", "--list")
        self.check(self.run_tool("fetch", FREE, "--sha256", "12"), 2, "64 hexadecimal digits")
        self.check(self.run_tool("fetch", FREE, SIZED, "--sha256", "0" * 64), 2, "one file")
        for url in ("http://example.org", "ftp://127.0.0.1", "file:///etc", "http://user@127.0.0.1", "127.0.0.1"):
            self.check(self.run_tool("fetch", FREE, "--base-url", url), 2, "--base-url", "https")
        self.check(self.fetch_free("--to", self.folder + "/none"), 1, "none")
        del self.environment["XDG_CACHE_HOME"], self.environment["HOME"]
        self.check(self.fetch_free(), 1, "--to", "HOME")


class Download(FetchTest):
    def test_into_the_cache(self):
        self.serve()
        self.check_fetched(self.fetch_free())
        self.assertEqual(stat.S_IMODE(os.stat(self.cache).st_mode), 0o700)
        self.assertEqual(len(self.server.requests), 1)
        self.check_fetched(self.fetch_free())  # from the cache
        self.assertEqual(len(self.server.requests), 1)
        listed = json.loads(self.run_tool("fetch", "--list", "--json", FREE).stdout)
        self.assertEqual([entry["fetched"] for entry in listed], [self.file])

    def test_damaged_file_in_the_cache(self):
        self.serve()
        self.write(self.file, b"damaged")
        self.server.resources[rgl(FREE)].status = 404
        self.check(self.fetch_free(), 1, "404", "downloaded anew", sha256(b"damaged"))
        self.assertEqual(self.read(self.file), b"damaged")
        self.server.resources[rgl(FREE)].status = None
        self.check_fetched(self.fetch_free())

    def test_sum_is_not_known(self):
        self.serve()
        self.check(self.fetch(FREE), 1, FREE, "does not know the SHA-256", "--sha256", "--trust-first")
        self.assertEqual(self.server.requests, [])
        self.check_nothing_kept()

    def test_trust_first(self):
        self.serve()
        first = self.fetch(FREE, "--trust-first")
        self.check(first, 0, "trusted at first sight", sha256(self.content), "CC0 1.0")
        self.assertEqual(self.read(self.file + ".sha256").decode(), f"{sha256(self.content)}  {FREE}_rgb.bsdf\n")
        os.remove(self.file)
        self.serve(make_bytes(300000, seed=2))
        for arguments in ([], ["--trust-first"]):
            self.check(self.fetch(FREE, *arguments), 1, "recorded at the first download", sha256(self.content))
            self.assertEqual(os.listdir(self.cache), [f"{FREE}_rgb.bsdf.sha256"])
        self.serve()
        self.check_fetched(self.fetch(FREE))

    def test_trust_first_wants_such_a_file(self):
        self.serve(b"<html>please log in</html>")
        self.check(self.fetch(FREE, "--trust-first"), 1, "begin with '<html>pleas'", "expected 'tensor_file'")
        self.serve(without_length=True)
        self.check(self.fetch(FREE, "--trust-first"), 1, "Content-Length")
        self.check_nothing_kept()

    def test_folder_of_the_users(self):
        self.serve()
        folder = os.path.join(self.folder, "mine")
        os.mkdir(folder)
        path = os.path.join(folder, f"{FREE}_rgb.bsdf")
        self.check_fetched(self.fetch_free("--to", folder), path)
        self.assertFalse(os.path.exists(self.cache))
        self.write(path, b"the user's")
        self.check(self.fetch_free("--to", folder), 1, "left alone", sha256(self.content))
        self.check(self.fetch(FREE, "--trust-first", "--to", folder), 1, "left alone")
        self.assertEqual(self.read(path), b"the user's")
        self.assertEqual(len(self.server.requests), 1)

    def test_several(self):
        self.serve()
        self.serve(path=rgl("acrylic_felt_orange"))
        result = self.fetch(FREE, "acrylic_felt_purple", "acrylic_felt_orange", "--trust-first")
        self.check(result, 1, "acrylic_felt_purple_rgb.bsdf", "404", "1 of 3 files")
        self.assertEqual(len(result.stdout.splitlines()), 2)

    def test_names_stand_for_files(self):
        path = os.path.join(SHARED, "materials", "rgl", f"{SIZED}_rgb.bsdf")
        if not os.path.exists(path):
            self.skipTest(f"skipped: no real data at {path}")
        advice = f"'measured-brdf fetch {SIZED}' downloads it"
        for name in (SIZED, f"{SIZED}_rgb.bsdf", f"sub/{SIZED}_rgb.bsdf"):
            self.check(self.run_tool("info", name, cwd=self.folder), 1, advice)
        self.check(self.run_tool("lights", "venice_sunset_1k", "-o", self.folder + "/x.csv"), 1,
                   "'measured-brdf fetch venice_sunset_1k' downloads it")
        self.serve(self.read(path), path=rgl(SIZED))
        self.check(self.fetch(SIZED), 0)  # the program knows this sum
        self.check(self.run_tool("info", SIZED), 0, SIZED)
        self.check(self.run_tool("info", f"{SIZED}_rgb.bsdf", cwd=self.folder), 1, f"say {SIZED}")


class Faults(FetchTest):
    def test_wrong_bytes(self):
        """Each row: what is served, which file is asked for, and words of the error. Nothing is kept."""
        sized = rgl(SIZED)
        for content, faults, path, words in (
                (make_bytes(300000, seed=2), {}, rgl(FREE), (sha256(self.content), "Nothing was kept")),
                (bytes((16 << 20) + 1), {}, rgl(FREE), ("more than the 16777216 bytes", "Nothing was kept")),
                (make_bytes(658960), {"extra": b"more"}, sized, ("more than the 658960 bytes",))):
            with self.subTest(words):
                self.serve(content, path=path, **faults)
                result = self.fetch(SIZED) if path == sized else self.fetch_free()
                self.check(result, 1, self.server.url + path, *words)
                self.check_nothing_kept()

    def test_errors_of_the_server(self):
        self.check(self.fetch_free(), 1, "HTTP status 404 (no such file)", "expected 200")
        served = self.serve(status=503, failures=1)
        self.check(self.fetch_free(), 1, "HTTP status 503")
        served.failures = 1
        self.check_fetched(self.fetch_free("--retries", "1"))
        self.assertEqual(len(self.server.requests), 4)

    def test_redirects(self):
        self.serve(redirect="/there")
        self.serve(path="/there")
        self.check_fetched(self.fetch_free())
        os.remove(self.file)
        self.server.requests.clear()
        self.serve(redirect=rgl(FREE))  # to itself
        self.check(self.fetch_free(), 1, "Maximum (5) redirects", rgl(FREE))
        self.assertEqual(len(self.server.requests), 6)
        for bad in ("ftp://127.0.0.1/x", "file:///etc/passwd"):
            self.serve(redirect=bad)
            self.check(self.fetch_free(), 1, rgl(FREE), bad.split(":")[0])
        elsewhere = self.server.url.replace("127.0.0.1", "0.0.0.0") + "/there"
        self.serve(redirect=elsewhere)
        self.check(self.fetch_free(), 1, f"redirects to {elsewhere}", "expected https")
        self.check_nothing_kept()

    def test_slow(self):
        self.serve(cut=1000, pause=30)
        began = time.monotonic()
        self.check(self.fetch_free("--timeout", "1"), 1, "too slow", "within 1 s", "byte 1000")
        self.assertLess(time.monotonic() - began, 20)

    def test_nobody_there(self):
        self.server.close()
        self.check(self.fetch_free(), 1, self.server.url, "byte 0")
        self.check_nothing_kept()


class Cut(FetchTest):
    def test_cut(self):
        self.serve(cut=100000)
        self.check(self.fetch_free(), 1, self.server.url + rgl(FREE), "byte 100000", "cut", "Nothing was kept")
        self.check_nothing_kept()
        self.serve(cut=100000)
        self.check_fetched(self.fetch_free("--retries", "1"))

    def test_cut_without_a_length(self):
        """Only the list says that bytes are missing."""
        content = make_bytes(658960)
        self.serve(content, path=rgl(SIZED), cut=100000, without_length=True)
        result = self.fetch(SIZED, "--sha256", sha256(content), "--retries", "1")
        self.check_fetched(result, os.path.join(self.cache, f"{SIZED}_rgb.bsdf"), content)
        self.assertIn(f"{rgl(SIZED)}, byte 100000: the connection was closed", result.stderr)

    def test_interrupted(self):
        self.serve(cut=100000, pause=30)
        with subprocess.Popen(self.get_command(FREE, "--sha256", sha256(self.content)), env=self.environment,
                              stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
            while not self.server.requests:
                time.sleep(0.02)
            process.send_signal(signal.SIGINT)
            said = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 1)
        self.assertIn("interrupted", said)
        self.check_nothing_kept()


class Folder(FetchTest):
    def test_full_disk(self):
        """A limit of the file's size stands for a disk that is full."""
        self.serve()
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (150000, 150000))
        self.check(self.fetch_free(preexec_fn=limit), 1, self.file, "cannot be written", "File too large")
        self.check_nothing_kept()
        self.check_fetched(self.fetch_free())

    def test_what_is_in_the_way_stays(self):
        self.serve()
        os.makedirs(self.cache, mode=0o700)
        os.mkfifo(self.file)
        self.check(self.fetch_free(), 1, self.file, "no regular file")
        self.assertTrue(stat.S_ISFIFO(os.lstat(self.file).st_mode))
        os.remove(self.file)
        os.symlink(os.path.join(self.folder, "elsewhere"), self.file)
        self.check(self.fetch_free(), 1, self.file, "no regular file")
        self.assertTrue(os.path.islink(self.file))
        os.remove(self.file)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "elsewhere")))
        self.check_nothing_kept()

    def test_unsafe_cache(self):
        os.makedirs(self.cache)
        os.chmod(self.cache, 0o777)
        self.check(self.fetch_free(), 1, "nobody else may write", "--to")
        self.assertEqual(self.server.requests, [])


def main():
    global PROGRAM, SHARED
    PROGRAM, SHARED = sys.argv[1:3]
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])


if __name__ == "__main__":
    main()
