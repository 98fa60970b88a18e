# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""A web server on 127.0.0.1 that serves bytes from memory, well or badly: how, each resource says."""

import http.server
import re
import socket
import threading


class Resource:
    """Bytes at a path, and what is wrong with the way they are served.

    cut: the connection ends after so many bytes of an answer's body, in the first `cuts` answers that are longer.
    pause: seconds of silence after those bytes, instead of an end.
    status: answers with this status, in the first `failures` answers (all: None).
    redirect: where to. ignores_range, without_length: as they say.
    extra: bytes that are sent beyond what was announced (no length is announced then).
    """

    def __init__(self, content, **faults):
        self.content = content
        self.cut = self.status = self.redirect = self.failures = None
        self.pause = 0
        self.cuts = 1
        self.extra = b""
        self.ignores_range = self.without_length = False
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
        match = re.fullmatch(r"bytes=(\d+)-", self.headers.get("Range", ""))
        first = int(match.group(1)) if match and not resource.ignores_range else None
        total = len(resource.content)
        if first is not None and first >= total:
            return self.answer(416, b"", [("Content-Range", f"bytes */{total}")])
        body = resource.content[first or 0 :]
        self.send_response(200 if first is None else 206)
        if first is not None:
            self.send_header("Content-Range", f"bytes {first}-{total - 1}/{total}")
        if not (resource.without_length or resource.extra):
            self.send_header("Content-Length", str(len(body)))
        else:
            self.close_connection = True
            self.send_header("Connection", "close")
        self.end_headers()
        self.send(resource, body + resource.extra if resource.extra else body)
        return None

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

    def get_ranges(self):
        return [headers.get("Range") for _, headers in self.requests]
