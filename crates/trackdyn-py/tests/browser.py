"""A browser without a window, driven over two pipes by the DevTools protocol."""

from __future__ import annotations

import json
import os
import select
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

PROGRAMS = "chromium", "chromium-browser", "google-chrome", "chrome"
OPTIONS = """--headless --no-sandbox --disable-gpu --disable-quic --no-first-run
--disable-background-networking --disable-component-update --disable-sync
--remote-debugging-pipe""".split()

#: Time that the browser has for an answer, s.
PATIENCE = 60.0

#: What keys are, and what they write.
KEYS = {
    "Enter": {"key": "Enter", "code": "Enter", "windowsVirtualKeyCode": 13, "text": "\r"},
    "ArrowRight": {"key": "ArrowRight", "code": "ArrowRight", "windowsVirtualKeyCode": 39},
    "0": {"key": "0", "code": "Digit0", "windowsVirtualKeyCode": 48, "text": "0"},
}


def missing() -> str:
    """Why no page can be opened here; empty where one can."""
    if sys.platform == "win32":
        return "the pipes of the browser are those of POSIX"
    return "" if _program() else f"none of {', '.join(PROGRAMS)} is installed"


def _program() -> str | None:
    return next((path for path in map(shutil.which, PROGRAMS) if path), None)


def is_own(url: str) -> bool:
    """Whether nothing leaves the browser for an address."""
    return url.startswith(("chrome:", "data:", "about:"))


class Browser:
    """Chromium with a profile of its own, and a page on a screen of this width."""

    def __init__(self, profile: Path, width: int, scheme: str) -> None:
        self._events: list[dict[str, Any]] = []
        self._asked = 0
        self._rest = b""
        self._session: str | None = None
        self._words = tempfile.TemporaryFile()
        program = _program()
        assert program is not None, missing()
        # the browser reads at its descriptor 3 and writes at 4
        its_input, self._to = os.pipe()
        self._from, its_output = os.pipe()
        try:
            self._browser = subprocess.Popen(
                [
                    sys.executable,
                    "-c",
                    _AT_3_AND_4.format(its_input, its_output),
                    program,
                    *OPTIONS,
                    f"--user-data-dir={profile}",
                ],
                stdin=subprocess.DEVNULL,
                stdout=self._words,
                stderr=self._words,
                pass_fds=(its_input, its_output),
            )
        finally:
            os.close(its_input)
            os.close(its_output)
        try:
            page = self._ask("Target.createTarget", {"url": "about:blank"})["targetId"]
            attached = self._ask("Target.attachToTarget", {"targetId": page, "flatten": True})
            self._session = attached["sessionId"]
            for domain in ("Page", "Runtime", "Log", "Network"):
                self._ask(f"{domain}.enable")
            screen = {"width": width, "height": 844, "deviceScaleFactor": 1, "mobile": width < 500}
            self._ask("Emulation.setDeviceMetricsOverride", screen)
            media = [{"name": "prefers-color-scheme", "value": scheme}]
            self._ask("Emulation.setEmulatedMedia", {"features": media})
        except BaseException:
            self.close()
            raise

    def _ask(self, method: str, parameters: Any = None) -> Any:
        """The answer to a command; what the browser says meanwhile is kept."""
        self._asked += 1
        asked = {"id": self._asked, "method": method, "params": parameters or {}}
        if self._session is not None:
            asked["sessionId"] = self._session
        os.write(self._to, json.dumps(asked).encode() + b"\0")
        while True:
            said = self._hear(method)
            if said.get("id") == self._asked:
                assert "error" not in said, f"{method}: {said['error']}"
                return said["result"]
            self._events.append(said)

    def _hear(self, method: str) -> dict[str, Any]:
        """What the browser says next."""
        until = time.monotonic() + PATIENCE
        while b"\0" not in self._rest:
            ready, _, _ = select.select([self._from], [], [], max(until - time.monotonic(), 0.0))
            more = os.read(self._from, 1 << 16) if ready else b""
            if not more:
                self._words.seek(0)
                how = "ended" if ready else f"did not answer within {PATIENCE:g} s"
                words = self._words.read().decode(errors="replace")[-2000:]
                raise AssertionError(f"{_program()} {how} at {method}: {words}")
            self._rest += more
        line, _, self._rest = self._rest.partition(b"\0")
        return json.loads(line)

    def _until(self, method: str) -> None:
        """Wait for an event."""
        while all(of["method"] != method for of in self._events):
            self._events.append(self._hear(method))

    def open(self, page: Path) -> None:
        """Open a page from a file, and wait until it is drawn."""
        self._events.clear()
        self._ask("Page.navigate", {"url": page.as_uri()})
        self._until("Page.loadEventFired")
        self.run("return new Promise(done => requestAnimationFrame(() => setTimeout(done, 100)))")

    def run(self, script: str) -> Any:
        """What a script in the page returns."""
        asked = {
            "expression": f"(() => {{ {script} }})()",
            "awaitPromise": True,
            "returnByValue": True,
        }
        answer = self._ask("Runtime.evaluate", asked)
        assert "exceptionDetails" not in answer, answer["exceptionDetails"]
        return answer["result"].get("value")

    def press(self, key: str) -> None:
        """Press a key, where the focus is."""
        of = KEYS[key]
        self._ask("Input.dispatchKeyEvent", {"type": "keyDown", **of})
        released = {name: value for name, value in of.items() if name != "text"}
        self._ask("Input.dispatchKeyEvent", {"type": "keyUp", **released})

    def complaints(self) -> list[str]:
        """What stands in the console, and what went wrong in scripts."""
        found = []
        for event in self._events:
            of = event["params"]
            if event["method"] == "Log.entryAdded":
                found.append(f"{of['entry']['level']}: {of['entry']['text']}")
            elif event["method"] == "Runtime.consoleAPICalled":
                found.append(f"{of['type']}: {of['args']}")
            elif event["method"] == "Runtime.exceptionThrown":
                found.append(str(of["exceptionDetails"]))
        return found

    def requests(self) -> list[str]:
        """Addresses that the page asked for, but for those of the browser and data in the page."""
        sent = [of for of in self._events if of["method"] == "Network.requestWillBeSent"]
        urls = [of["params"]["request"]["url"] for of in sent]
        return [url for url in urls if not is_own(url)]

    def close(self) -> None:
        """End the browser."""
        os.close(self._to)
        os.close(self._from)
        try:
            self._browser.wait(timeout=10)
        except subprocess.TimeoutExpired:
            self._browser.kill()
            self._browser.wait(timeout=10)
        self._words.close()


#: Puts two descriptors to 3 and 4, then becomes the program.
_AT_3_AND_4 = """
import fcntl, os, sys
ends = ({0}, {1})
# copies lie above, so that none is overwritten, and the program gets 3 and 4 alone
copies = [fcntl.fcntl(one, fcntl.F_DUPFD_CLOEXEC, 10) for one in ends]
for one in ends:
    os.close(one)
for place, one in zip((3, 4), copies):
    os.dup2(one, place)
os.execv(sys.argv[1], sys.argv[1:])
"""
