# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Drives `measured-brdf fetch` against a server of its own on 127.0.0.1; needs no network.

usage: TestFetch.py PROGRAM SHARED_DATA [unittest arguments]
"""

import hashlib
import io
import json
import os
import pty
import random
import resource
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import time
import unittest
import zipfile

from FileServer import FileServer, Resource

PROGRAM = ""
SHARED = ""

HOST = "/d38rqfq1h7iukm.cloudfront.net/media/materials/"
FREE = "acrylic_felt_green"  # an entry whose size and sum the catalog does not have
SIZED = "satin_purple"  # one whose size it has: 658960
ARCHIVE = "/zenodo.org/records/8101681/files/BRDFDatabase.zip"
ARCHIVE_SIZE = 1253117184
MERL_SIZE = 34992012


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
        self.part = os.path.join(self.cache, f".{FREE}_rgb.bsdf.measured-brdf-part")
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
        self.assertEqual([name for name in os.listdir(os.path.dirname(path)) if "-part" in name], [])

    def read(self, path):
        with open(path, "rb") as file:
            return file.read()

    def write(self, path, content):
        os.makedirs(os.path.dirname(path), mode=0o700, exist_ok=True)
        with open(path, "wb") as file:
            file.write(content)

    def check_kept(self, count):
        """A part of so many right bytes, and no file."""
        self.assertFalse(os.path.exists(self.file))
        self.assertEqual(self.read(self.part), self.content[:count])

    def check_nothing_kept(self):
        self.assertEqual(os.listdir(self.cache) if os.path.exists(self.cache) else [], [])


class Catalog(FetchTest):
    def test_list(self):
        self.check(self.run_tool("fetch", "--list"), 0, "satin_purple", "merl-gold-paint", "potsdamer_platz_1k",
                   "CC0 1.0", "CC BY-SA 4.0 (agree)", "not known")
        some = self.run_tool("fetch", "--list", "satin")
        self.check(some, 0, "satin_gold")
        self.assertNotIn("potsdamer", some.stdout)
        self.check(self.run_tool("fetch", "--list", "no-such-name"), 1, "nothing in the list")

    def test_every_entry_is_in_order(self):
        listed = json.loads(self.run_tool("fetch", "--list", "--json").stdout)
        self.assertGreater(len(listed), 200)
        self.assertEqual(len({entry["name"] for entry in listed}), len(listed))
        self.assertEqual(len({entry["file"] for entry in listed}), len(listed))
        for entry in listed:
            self.assertTrue(entry["url"].startswith("https://"), entry)
            self.assertNotIn("{", entry["url"] + entry["file"] + entry["page"] + (entry["member"] or ""))
            self.assertRegex(entry["file"], r"^[A-Za-z0-9_-]+\.(bsdf|binary|hdr)$")
            self.assertLessEqual(entry["size"] or 1, entry["limit"])
            if entry["sha256"] is not None:
                self.assertRegex(entry["sha256"], r"^[0-9a-f]{64}$")
            self.assertEqual(entry["sum"] in ("published", "copy"), entry["sha256"] is not None, entry)
            self.assertEqual(entry["needs_agreement"], entry["licence"] != "CC0 1.0")
            self.assertIsNone(entry["fetched"])

    def test_wrong_calls(self):
        self.check(self.run_tool("fetch"), 2, "--list")
        self.check(self.run_tool("fetch", "satin_purpel"), 1, "satin_purpel", "satin_purple")
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
        self.check_kept(1000)

    def test_nobody_there(self):
        self.server.close()
        self.check(self.fetch_free(), 1, self.server.url, "byte 0")
        self.check_nothing_kept()


class Resume(FetchTest):
    def test_cut(self):
        self.serve(cut=100000)
        cut = self.fetch_free()
        self.check(cut, 1, self.server.url + rgl(FREE), "byte 100000", "cut", "100000 bytes are kept")
        self.check_kept(100000)
        self.check_fetched(self.fetch_free())
        self.assertEqual(self.server.get_ranges(), [None, "bytes=100000-"])

    def test_cut_without_a_length(self):
        """Only the list says that bytes are missing."""
        content = make_bytes(658960)
        self.serve(content, path=rgl(SIZED), cut=100000, without_length=True)
        result = self.fetch(SIZED, "--sha256", sha256(content), "--retries", "1")
        self.check_fetched(result, os.path.join(self.cache, f"{SIZED}_rgb.bsdf"), content)
        self.assertIn(f"{rgl(SIZED)}, byte 100000: the connection was closed", result.stderr)
        self.assertEqual(self.server.get_ranges(), [None, "bytes=100000-"])

    def test_without_a_sum_nothing_is_resumed(self):
        self.serve(cut=100000, cuts=2)
        self.check(self.fetch(FREE, "--trust-first"), 1, "byte 100000")
        self.check_nothing_kept()
        self.check(self.fetch(FREE, "--trust-first", "--retries", "1"), 0)
        self.assertEqual(self.server.get_ranges(), [None] * 3)

    def test_part_of_another_file(self):
        """Of another version, damaged, longer than the file, and a server that sends all of it."""
        for part, faults in ((make_bytes(100000, seed=2), {}), (bytes(100000), {}), (bytes(400000), {}),
                             (self.content[:100000], {"ignores_range": True})):
            self.write(self.part, part)
            self.serve(**faults)
            result = self.fetch_free()
            self.check_fetched(result)
            self.assertIn("beginning anew", result.stderr)
            os.remove(self.file)

    def test_interrupted(self):
        self.serve(cut=100000, pause=30)
        with subprocess.Popen(self.get_command(FREE, "--sha256", sha256(self.content)), env=self.environment,
                              stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
            while not self.server.requests:
                time.sleep(0.02)
            time.sleep(0.5)
            process.send_signal(signal.SIGINT)
            said = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 1)
        self.assertIn("interrupted. 100000 bytes are kept", said)
        self.check_kept(100000)


class Folder(FetchTest):
    def test_full_disk(self):
        """A limit of the file's size stands for a disk that is full."""
        self.serve()
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (150000, 150000))
        self.check(self.fetch_free(preexec_fn=limit), 1, self.file, "cannot be written", "File too large")
        self.check_nothing_kept()
        self.serve(cut=200000)  # the part is too large, too
        self.check(self.fetch_free(preexec_fn=limit), 1, "the connection was cut", "not kept", "File too large")
        self.check_nothing_kept()
        self.check_fetched(self.fetch_free())

    def test_what_is_in_the_way_stays(self):
        self.serve()
        os.makedirs(self.cache, mode=0o700)
        for path in (self.part, self.file):
            os.mkfifo(path)
            self.check(self.fetch_free(), 1, path, "no regular file")
            self.assertTrue(stat.S_ISFIFO(os.lstat(path).st_mode))
            os.remove(path)
            os.symlink(os.path.join(self.folder, "elsewhere"), path)
            self.check(self.fetch_free(), 1, path, "no regular file")
            self.assertTrue(os.path.islink(path))
            os.remove(path)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "elsewhere")))
        self.check_nothing_kept()

    def test_unsafe_cache(self):
        os.makedirs(self.cache)
        os.chmod(self.cache, 0o777)
        self.check(self.fetch_free(), 1, "nobody else may write", "--to")
        self.assertEqual(self.server.requests, [])

class Shifted(io.BytesIO):
    """The end of a long file whose beginning is nobody's concern."""

    begin = 0  # where the file's first byte stands

    def tell(self):
        return super().tell() + self.begin

    def seek(self, offset, whence=0):
        return super().seek(offset - (self.begin if whence == 0 else 0), whence) + self.begin


class Sparse:
    """Zeros, then the tail."""

    def __init__(self, tail):
        self.tail = tail

    def __len__(self):
        return ARCHIVE_SIZE

    def __getitem__(self, span):
        begin, end, _ = span.indices(ARCHIVE_SIZE)
        first = ARCHIVE_SIZE - len(self.tail)
        return bytes(max(0, min(end, first) - begin)) + self.tail[max(0, begin - first) : max(0, end - first)]


class Archive(FetchTest):
    def setUp(self):
        super().setUp()
        self.file = os.path.join(self.cache, "gold-paint.binary")
        noise = random.Random(3).randbytes(200000)
        self.content = (90).to_bytes(4, "little") * 2 + (180).to_bytes(4, "little") + noise
        self.content += bytes(MERL_SIZE - len(self.content))

    def pack(self):
        file = Shifted()
        with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
            archive.writestr("BRDFDatabase/readme.txt", "another file")
            archive.writestr("BRDFDatabase/brdfs/gold-paint.binary", self.content)
            self.packed = archive.infolist()[1].compress_size
        return file.getvalue()

    def serve_archive(self, **faults):
        Shifted.begin = 0
        Shifted.begin = ARCHIVE_SIZE - len(self.pack())  # the archive's end is where the catalog says
        return self.serve(Sparse(self.pack()), path=ARCHIVE, **faults)

    def fetch_member(self, *arguments, **options):
        return self.fetch("merl-gold-paint", "--sha256", sha256(self.content), "--accept-license", *arguments, **options)

    def test_agreement(self):
        self.serve_archive()
        result = self.fetch("merl-gold-paint", "--trust-first")
        self.check(result, 1, "CC BY-SA 4.0", "Name the authors", "--accept-license")
        self.assertEqual(self.server.requests, [])

    def run_on_terminal(self, answer):
        """Status and what is said of a program that can ask."""
        ours, its = pty.openpty()
        command = self.get_command("merl-gold-paint", "--sha256", sha256(self.content))
        with subprocess.Popen(command, env=self.environment, stdin=its, stderr=its,
                              stdout=subprocess.DEVNULL) as process:
            os.close(its)
            os.write(ours, answer)
            said = b""
            try:
                while piece := os.read(ours, 4096):
                    said += piece
            except OSError:  # the terminal's other end is closed
                pass
            os.close(ours)
            process.wait(timeout=60)
        return process.returncode, said.decode()

    def test_question(self):
        self.serve_archive()
        for answer in (b"n\n", b"\n", b"no way\n"):
            status, said = self.run_on_terminal(answer)
            self.assertEqual(status, 1, said)
            self.assertIn("Do you agree", said)
        self.assertEqual(self.server.requests, [])
        status, said = self.run_on_terminal(b"y\n")
        self.assertEqual(status, 0, said)
        self.assertIn("100 %", said)  # the progress
        self.assertEqual(self.read(self.file), self.content)

    def test_member(self):
        self.serve_archive()
        self.check_fetched(self.fetch_member())
        self.assertEqual(len(self.server.requests), 1)  # the block that holds the directory and the member
        self.assertNotIn(None, self.server.get_ranges())

    def test_cut_and_damaged(self):
        served = self.serve_archive()
        served.cut, served.cuts = 1000, 1
        self.check(self.fetch_member(), 1, ARCHIVE, "the connection was cut")
        served.cuts = 1
        self.check_fetched(self.fetch_member("--retries", "1"))
        os.remove(self.file)
        tail = bytearray(served.content.tail)
        tail[len(tail) - self.packed] ^= 1
        served.content = Sparse(bytes(tail))
        self.check(self.fetch_member(), 1, "damaged", "Nothing was kept")
        self.check_nothing_kept()

    def test_other_servers(self):
        self.serve_archive(ignores_range=True, cut=10)
        self.check(self.fetch_member(), 1, ARCHIVE, "HTTP status 200", "expected 206")
        Shifted.begin = 0
        self.serve(self.pack(), path=ARCHIVE)  # of another size
        self.check(self.fetch_member(), 1, ARCHIVE, "HTTP status 416", "expected 206")
        self.serve(Sparse(bytes(1000)), path=ARCHIVE)
        self.check(self.fetch_member(), 1, ARCHIVE, "no ZIP archive")
        self.check_nothing_kept()


def main():
    global PROGRAM, SHARED
    PROGRAM, SHARED = sys.argv[1:3]
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])


if __name__ == "__main__":
    main()
