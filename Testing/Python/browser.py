# SPDX-License-Identifier: BSD-3-Clause
"""A page in chromium without its window, driven through the DevTools protocol over two pipes; Python's own library only."""
import base64
import fcntl
import json
import os
import pathlib
import select
import shutil
import signal
import subprocess
import tempfile
import time

PROGRAM = shutil.which("chromium")
_SWITCHES = ("--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic",
             "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
             "--disable-dev-shm-usage", "--disable-extensions", "--hide-scrollbars", "--remote-debugging-pipe")


def _moved(descriptor):
    """The same file under a number from 10 on."""
    higher = fcntl.fcntl(descriptor, fcntl.F_DUPFD_CLOEXEC, 10)
    os.close(descriptor)
    return higher


LEFT = ("target navigated", "context was destroyed", "Cannot find context")  # what a browser says of a page that it left meanwhile


class LeftPage(RuntimeError):
    """The page went, or was loaded anew, before it had answered."""


class Browser:
    """One page. errors: what the console and scripts complained of; requests: addresses that were asked for."""

    def __init__(self):
        self.errors, self.requests = [], []
        self._answers, self._number, self._text, self._session = {}, 0, b"", None
        self._profile = tempfile.mkdtemp(prefix="waft-browser-")
        orders, self._orders = os.pipe()
        self._told, told = os.pipe()
        # The browser reads orders at 3 and answers at 4, so that neither end may be there already.
        orders, told = (_moved(end) for end in (orders, told))
        command = f'exec "$0" "$@" 3<&{orders} 4>&{told}'
        self._process = subprocess.Popen(
            ["bash", "-c", command, PROGRAM, *_SWITCHES, f"--user-data-dir={self._profile}", "about:blank"], pass_fds=(orders, told),
            start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            env={**os.environ, "HOME": self._profile})
        os.close(orders)
        os.close(told)
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self._session = None
            self.call("Browser.close", timeout=5.0)
            self._process.wait(5.0)
        except (OSError, TimeoutError, subprocess.TimeoutExpired):
            pass
        try:
            os.killpg(self._process.pid, signal.SIGKILL)  # its own session, begun above
        except ProcessLookupError:
            pass
        self._process.wait()
        os.close(self._orders)
        os.close(self._told)
        shutil.rmtree(self._profile, ignore_errors=True)

    def call(self, method, timeout=60.0, **parameters):
        self._number += 1
        order = {"id": self._number, "method": method, "params": parameters}
        if self._session:
            order["sessionId"] = self._session
        os.write(self._orders, json.dumps(order).encode() + b"\0")
        end = time.monotonic() + timeout
        while self._number not in self._answers:
            self._listen(end - time.monotonic(), method)
        answer = self._answers.pop(self._number)
        if "error" in answer:
            message = answer["error"]["message"]
            failure = LeftPage if any(part in message for part in LEFT) else RuntimeError
            raise failure(f"{method}: {message}")
        return answer["result"]

    def _listen(self, seconds, method):
        if seconds <= 0.0 or not select.select([self._told], [], [], seconds)[0]:
            raise TimeoutError(f"{method}: no answer from the browser")
        read = os.read(self._told, 1 << 20)
        if not read:
            raise OSError(f"{method}: the browser has ended")
        *lines, self._text = (self._text + read).split(b"\0")
        for line in lines:
            self._take(json.loads(line))

    def _take(self, message):
        if "id" in message:
            self._answers[message["id"]] = message
            return
        about, told = message["method"], message["params"]
        if about == "Runtime.exceptionThrown":
            details = told["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get("description", details["text"]))
        elif about == "Runtime.consoleAPICalled" and told["type"] in ("error", "warning", "assert"):
            self.errors.append(" ".join(str(part.get("value", part.get("description"))) for part in told["args"]))
        elif about == "Log.entryAdded" and told["entry"]["level"] in ("error", "warning"):
            self.errors.append(told["entry"]["text"])
        elif about == "Network.requestWillBeSent":
            self.requests.append(told["request"]["url"][:200])

    def size(self, width, height, ratio=1.0, is_phone=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=ratio, mobile=is_phone)

    def prefer(self, **features):
        """color_scheme="dark", reduced_motion="reduce": what the system would say."""
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-" + name.replace("_", "-"), "value": value}
                                                          for name, value in features.items()])

    def open(self, path, until="true", seconds=40.0):
        """Opens a file, and waits until an expression is true in it."""
        self.call("Page.navigate", url=pathlib.Path(path).absolute().as_uri())
        self.wait(until, seconds)

    def wait(self, until, seconds=20.0):
        end = time.monotonic() + seconds

        def holds():
            try:
                return self.run(f"document.readyState === 'complete' && ({until})")
            except LeftPage:
                return False

        while not holds():
            if time.monotonic() > end:
                raise TimeoutError(f"{until}: not true after {seconds} s; {self.errors}")
            time.sleep(0.05)

    def run(self, code):
        """The value of an expression in the page."""
        told = self.call("Runtime.evaluate", expression=code, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in told:
            raise RuntimeError(f"{code}: {told['exceptionDetails'].get('exception', {}).get('description')}")
        return told["result"].get("value")

    def press(self, key, **options):
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, **options)

    def picture(self, path=None):
        """The page as the bytes of a PNG."""
        content = base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
        if path:
            pathlib.Path(path).write_bytes(content)
        return content
