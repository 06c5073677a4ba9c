"""A browser without a window and without a network, driven through its debugging port."""

from __future__ import annotations

import base64
import json
import os
import re
import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

NAMES = ("chromium", "chromium-browser", "google-chrome")
NOWHERE = "--host-resolver-rules=MAP * ~NOTFOUND"
OFFLINE = ("--disable-background-networking", "--no-first-run")
QUIET = ("--headless=new", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
WAIT = 60.0
"""[s] How long anything is waited for."""


def browser_path() -> str | None:
    """Return where a browser is; None without one."""
    return next((found for name in NAMES if (found := shutil.which(name))), None)


class Page:
    """One page; `errors` are what it wrote to its console as errors, and exceptions, and `asked` what it fetched."""

    def __init__(self, address: str) -> None:
        from websockets.sync.client import connect

        self.socket = connect(address, max_size=None)
        self.count, self.errors, self.asked = 0, list[str](), list[str]()
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def call(self, method: str, **parameters: Any) -> dict[str, Any]:
        """Ask for something, and return what comes back."""
        self.count += 1
        self.socket.send(json.dumps({"id": self.count, "method": method, "params": parameters}))
        while True:
            message = json.loads(self.socket.recv(timeout=WAIT))
            self._hear(message)
            if message.get("id") == self.count:
                assert "error" not in message, message
                return dict(message["result"])

    def _hear(self, message: dict[str, Any]) -> None:
        method, told = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            self.errors.append(json.dumps(told["exceptionDetails"])[:500])
        if method == "Runtime.consoleAPICalled" and told["type"] == "error":
            self.errors.append(json.dumps(told["args"])[:500])
        if method == "Log.entryAdded" and told["entry"]["level"] == "error":
            self.errors.append(json.dumps(told["entry"])[:500])
        if method == "Network.requestWillBeSent" and told["request"]["url"].startswith(("http", "ws")):
            self.asked.append(told["request"]["url"])

    def open(self, path: Path) -> None:
        """Open a file."""
        self.go(path.resolve().as_uri())

    def go(self, address: str) -> None:
        """Open what is at an address."""
        self.call("Page.navigate", url=address)
        self.until("document.readyState === 'complete'")

    def value(self, expression: str) -> Any:
        """Return what a JavaScript expression comes to."""
        return self.call("Runtime.evaluate", expression=expression, returnByValue=True)["result"].get("value")

    def until(self, expression: str, seconds: float = WAIT) -> Any:
        """Wait until an expression is true, and return it."""
        end = time.monotonic() + seconds
        while not (found := self.value(expression)):
            assert time.monotonic() < end, f"never: {expression}; {self.errors}"
            time.sleep(0.1)
        return found

    def picture(self, path: Path) -> None:
        """Save what is seen."""
        data = self.call("Page.captureScreenshot", format="png")["data"]
        path.write_bytes(base64.b64decode(data))


@contextmanager
def browsing(wide: int = 1260, high: int = 1000, *, this_machine: bool = False) -> Iterator[Page]:
    """Open an empty page in a browser of its own, which reaches nothing, or servers of this machine alone."""
    path = browser_path()
    assert path is not None
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as own:
        reached = NOWHERE + ", EXCLUDE 127.0.0.1" * this_machine
        options = [*QUIET, *OFFLINE, reached, f"--window-size={wide},{high}", f"--user-data-dir={own}"]
        options += ["--remote-debugging-port=0"] + ["--no-sandbox"] * (os.geteuid() == 0)
        process = subprocess.Popen([path, *options, "about:blank"], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL)
        try:
            yield Page(_address(process))
        finally:
            process.kill()
            process.wait()
            if process.stderr:
                process.stderr.close()


def _address(process: subprocess.Popen[bytes]) -> str:
    """Return the address of the first page of a browser that has just been started."""
    from urllib.request import urlopen

    assert process.stderr is not None
    for line in process.stderr:
        if found := re.search(rb"ws://([^/]+)/devtools/browser", line):
            break
    else:
        raise AssertionError("the browser does not start")
    with urlopen(f"http://{found[1].decode()}/json") as answer:
        pages = json.load(answer)
    return next(str(page["webSocketDebuggerUrl"]) for page in pages if page["type"] == "page")
