# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Examples/Python/trame_materials.py in a headless browser: the page shows pictures, plans and errors.

usage: TestTrame.py [SCREENSHOT.png]

Needs trame, aiohttp (which trame brings) and Chromium: the program chromium, or $MEASUREDBRDF_CHROMIUM.
"""

import asyncio
import base64
import contextlib
import importlib.util
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time

CHROMIUM = os.environ.get("MEASUREDBRDF_CHROMIUM") or shutil.which("chromium")
for module in ("pyvista", "trame", "trame_vuetify", "aiohttp"):
    if importlib.util.find_spec(module) is None:
        print(f"Skipped: {module} is not installed; Debian has no package of trame_vuetify")
        sys.exit(77)
if not CHROMIUM:
    print("Skipped: Chromium is not installed (./test.sh does not install it, because it takes some 300 MB)")
    sys.exit(77)

import aiohttp

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
EXAMPLE = os.path.join(ROOT, "Examples", "Python", "trame_materials.py")
WAIT = 90.0  # seconds; a first plan takes some


def free_port():
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return found.getsockname()[1]


class Page:
    """A page of the browser, through its debugging protocol."""

    def __init__(self, socket_):
        self.socket = socket_
        self.number = 0

    async def call(self, method, **parameters):
        self.number += 1
        await self.socket.send_json({"id": self.number, "method": method, "params": parameters})
        while True:
            answer = await self.socket.receive_json(timeout=WAIT)
            if answer.get("id") == self.number:
                return answer.get("result", answer)

    async def evaluate(self, text):
        result = await self.call("Runtime.evaluate", expression=text, awaitPromise=True)
        return result["result"].get("value")

    async def wait_for(self, text, what):
        end = time.monotonic() + WAIT
        while not await self.evaluate(text):
            if time.monotonic() > end:
                sys.exit(f"the page never shows {what}")
            await asyncio.sleep(0.2)


async def connect(session, port):
    """The browser's first page, when it is ready."""
    end = time.monotonic() + WAIT
    while True:
        with contextlib.suppress(aiohttp.ClientError):
            async with session.get(f"http://127.0.0.1:{port}/json") as answer:
                pages = [page for page in await answer.json(content_type=None) if page["type"] == "page"]
            if pages:
                return Page(await session.ws_connect(pages[0]["webSocketDebuggerUrl"], max_msg_size=0))
        if time.monotonic() > end:
            sys.exit("the browser does not answer")
        await asyncio.sleep(0.2)


async def check(url, port, screenshot):
    picture = "(document.getElementById('picture') || {}).src || ''"
    text = "(document.getElementById('{}') || {{}}).textContent || ''".format
    async with aiohttp.ClientSession() as session:
        page = await connect(session, port)
        end = time.monotonic() + WAIT
        while True:  # until the server is up
            await page.call("Page.navigate", url=url)
            await asyncio.sleep(1.0)
            if await page.evaluate("!!document.getElementById('app')"):
                break
            if time.monotonic() > end:
                sys.exit("the server does not answer")
        await page.wait_for(f"({picture}).startsWith('data:image/jpeg')", "a picture")
        await page.wait_for(f"({text('error')}).includes('predicted error')", "an error")
        first = await page.evaluate(picture)
        await page.evaluate("trame.state.set('material', 'nickel')")
        await page.wait_for(f"({picture}) != '{first[:100]}' && ({picture}).length != {len(first)}", "another material")
        before = await page.evaluate(picture)
        await page.evaluate("trame.state.set('material', 'missing.bsdf')")
        await page.wait_for("document.body.textContent.includes('missing.bsdf')", "what is wrong")
        await page.evaluate("trame.state.set('material', 'gold-paint')")
        await page.wait_for(f"({picture}).length != {len(before)}", "a material after an error")
        await page.wait_for(f"({text('error')}).includes('predicted error')", "its error")
        print(await page.evaluate(text("error")))
        if screenshot:
            await asyncio.sleep(1.0)
            result = await page.call("Page.captureScreenshot", format="png")
            with open(screenshot, "wb") as file:
                file.write(base64.b64decode(result["data"]))
        await page.call("Browser.close")


def main():
    server_port, browser_port = free_port(), free_port()
    with tempfile.TemporaryDirectory() as folder, open(os.path.join(folder, "log"), "w+", encoding="utf-8") as log:
        server = subprocess.Popen([sys.executable, "-B", EXAMPLE, "--server", "--port", str(server_port)],
                                  stdout=log, stderr=log)
        browser = subprocess.Popen(
            [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--window-size=1200,800", "--remote-allow-origins=*",
             f"--remote-debugging-port={browser_port}", f"--user-data-dir={folder}/profile", "about:blank"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            asyncio.run(check(f"http://127.0.0.1:{server_port}/index.html", browser_port, *sys.argv[1:2] or [None]))
        except BaseException:
            log.seek(0)
            print(log.read())
            raise
        finally:
            for process in (server, browser):
                process.terminate()
                process.wait(30)


if __name__ == "__main__":
    main()
