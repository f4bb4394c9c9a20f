"""A browser without a window, driven as the standard of WebDriver says."""

from __future__ import annotations

import json
import shutil
import socket
import subprocess
import time
import urllib.error
import urllib.request
from pathlib import Path
from typing import Any

PROGRAMS = "chromium", "chromium-browser", "google-chrome"
DRIVER = "chromedriver"
OPTIONS = """--headless --no-sandbox --disable-gpu --disable-quic --no-first-run
--disable-background-networking --disable-component-update --disable-sync""".split()


def missing() -> str:
    """What is not installed; empty where all is."""
    programs = [name for name in PROGRAMS if shutil.which(name)]
    wanted = [] if programs else ["Chromium"]
    return " and ".join(wanted + ([] if shutil.which(DRIVER) else [DRIVER]))


def is_own(url: str) -> bool:
    """Whether nothing leaves the browser for an address."""
    return url.startswith(("chrome:", "data:", "about:"))


class Browser:
    """Chromium with a profile of its own, on a screen of this width."""

    def __init__(self, profile: Path, width: int, scheme: str) -> None:
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self._port = free.getsockname()[1]
        self._driver = subprocess.Popen(
            [DRIVER, f"--port={self._port}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        self._session = ""
        try:
            self._until_ready()
            screen = {"width": width, "height": 844, "pixelRatio": 1.0, "mobile": width < 500}
            chromium = {
                "binary": next(path for path in map(shutil.which, PROGRAMS) if path),
                "args": [*OPTIONS, f"--user-data-dir={profile}"],
                "mobileEmulation": {"deviceMetrics": screen},
            }
            wanted = {
                "browserName": "chrome",
                "goog:chromeOptions": chromium,
                "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"},
            }
            made = self._ask("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})
            self._session = f"/session/{made['sessionId']}"
            media = [{"name": "prefers-color-scheme", "value": scheme}]
            self._tell("Emulation.setEmulatedMedia", {"features": media})
        except BaseException:
            self.close()
            raise

    def _until_ready(self) -> None:
        for _ in range(200):
            try:
                if self._ask("GET", "/status")["ready"]:
                    return
            except urllib.error.URLError:
                time.sleep(0.05)
        raise TimeoutError(f"{DRIVER} does not answer within 10 s")

    def _ask(self, method: str, path: str, body: Any = None) -> Any:
        data = None if body is None else json.dumps(body).encode()
        head = {"Content-Type": "application/json"}
        url = f"http://127.0.0.1:{self._port}{path}"
        request = urllib.request.Request(url, data, head, method=method)
        # a proxy knows nothing of this machine
        opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        with opener.open(request, timeout=60) as answer:
            return json.load(answer)["value"]

    def _tell(self, command: str, parameters: Any) -> Any:
        body = {"cmd": command, "params": parameters}
        return self._ask("POST", f"{self._session}/goog/cdp/execute", body)

    def open(self, page: Path) -> None:
        """Open a page from a file, and wait until it is drawn."""
        self._ask("POST", f"{self._session}/url", {"url": page.as_uri()})
        self.run("return new Promise(done => requestAnimationFrame(() => setTimeout(done, 100)))")

    def run(self, script: str) -> Any:
        """What a script in the page returns."""
        return self._ask(
            "POST", f"{self._session}/execute/sync", {"script": script, "args": []}
        )

    def press(self, keys: str) -> None:
        """Press keys one after the other, where the focus is."""
        events = [
            {"type": kind, "value": key} for key in keys for kind in ("keyDown", "keyUp")
        ]
        board = {"type": "key", "id": "board", "actions": events}
        self._ask("POST", f"{self._session}/actions", {"actions": [board]})

    def complaints(self) -> list[str]:
        """What stands in the console."""
        entries = self._ask("POST", f"{self._session}/se/log", {"type": "browser"})
        return [f"{entry['level']}: {entry['message']}" for entry in entries]

    def requests(self) -> list[str]:
        """Addresses that pages asked for; those of the browser's own pages and inline data apart."""
        entries = self._ask("POST", f"{self._session}/se/log", {"type": "performance"})
        events = [json.loads(entry["message"])["message"] for entry in entries]
        sent = [of for of in events if of["method"] == "Network.requestWillBeSent"]
        by_pages = [of["params"] for of in sent if not is_own(of["params"]["documentURL"])]
        return [of["request"]["url"] for of in by_pages if not is_own(of["request"]["url"])]

    def close(self) -> None:
        """Close the browser, then its driver."""
        try:
            if self._session:
                self._ask("DELETE", self._session)
        finally:
            self._driver.terminate()
            self._driver.wait(timeout=20)
