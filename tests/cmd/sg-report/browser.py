#!/usr/bin/env python3
"""A page in a browser without a window: browser.py BROWSER FILE. It is told what to do by the browser's own pipe
(--remote-debugging-pipe): two descriptors, messages in JSON, each with a zero behind it.
"""

import json
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(__file__))
from page import data_of  # noqa: E402


class Browser:
    def __init__(self, program, profile):
        to_browser, self.out = os.pipe()
        self.incoming, from_browser = os.pipe()

        def place():  # it reads from 3 and writes to 4
            read, write = os.dup(to_browser), os.dup(from_browser)
            os.dup2(read, 3)
            os.dup2(write, 4)

        self.process = subprocess.Popen(
            [program, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--remote-debugging-pipe",
             f"--user-data-dir={profile}", "about:blank"],
            preexec_fn=place, close_fds=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.text, self.number, self.events, self.session = b"", 0, [], None
        target = [t for t in self.ask("Target.getTargets")["targetInfos"] if t["type"] == "page"][0]["targetId"]
        self.session = self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in "Page", "Runtime", "Log", "Network":
            self.ask(domain + ".enable")

    def receive(self):
        while b"\0" not in self.text:
            chunk = os.read(self.incoming, 1 << 16)
            assert chunk, "the browser has gone"
            self.text += chunk
        message, self.text = self.text.split(b"\0", 1)
        return json.loads(message)

    def ask(self, method, **params):
        self.number += 1
        call = {"id": self.number, "method": method, "params": params}
        if self.session:
            call["sessionId"] = self.session
        os.write(self.out, json.dumps(call).encode() + b"\0")
        while True:
            message = self.receive()
            if message.get("id") == self.number:
                assert "error" not in message, (method, message)
                return message["result"]
            self.events.append(message)

    def value(self, expression):
        result = self.ask("Runtime.evaluate", expression=expression, returnByValue=True)
        assert "exceptionDetails" not in result, result
        return result["result"].get("value")

    def open(self, path, width, dark=False):
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=width < 600)
        self.ask("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        self.ask("Page.navigate", url="file://" + os.path.abspath(path))
        while self.value("document.readyState") != "complete":
            pass
        assert self.value("document.documentElement.dataset.ready") == "yes"

    def press(self, key):
        codes = {"Tab": 9, "Enter": 13, "+": 187}
        text = {"Enter": "\r", "+": "+"}.get(key)
        self.ask("Input.dispatchKeyEvent", type="keyDown", key=key, windowsVirtualKeyCode=codes[key], **({"text": text} if text else {}))
        self.ask("Input.dispatchKeyEvent", type="keyUp", key=key, windowsVirtualKeyCode=codes[key])

    def tab_to(self, selector, most=400):
        for _ in range(most):
            self.press("Tab")
            if self.value(f"document.activeElement.matches({json.dumps(selector)})"):
                return
        raise AssertionError("no way by Tab to " + selector)


def shows_the_data(browser, graph):
    for name in "orderings", "variables", "cliques", "edges", "variants":
        sheet = graph[name]
        names = [column["name"] for column in sheet["columns"]]
        cells = browser.value(f"""[...document.querySelectorAll('[data-sheet="{name}"] tbody tr')].map(row =>
            Object.fromEntries([...row.cells].map(cell => [cell.dataset.column, cell.dataset.value])))""")
        assert len(cells) == len(sheet["rows"]) > 0, name
        for shown, row in zip(cells, sheet["rows"]):
            wanted = dict(zip(names, row))
            assert {key: wanted[key] for key in shown} == shown, (shown, wanted)
    assert browser.value("document.querySelectorAll('.point').length") > 4
    assert browser.value("document.querySelectorAll('[data-map] svg path').length") > 4
    assert browser.value("document.querySelector('.sentence').textContent") == graph["advice"]["sentence"]


def goes_by_keyboard(browser):
    browser.tab_to("[data-sheet=orderings] th:nth-child(2) button")
    for direction, sign in ("descending", -1), ("ascending", 1):
        browser.press("Enter")
        assert browser.value("document.activeElement.parentNode.getAttribute('aria-sort')") == direction
        ec = browser.value("[...document.querySelectorAll('[data-sheet=orderings] td[data-column=ec]')].map(cell => Number(cell.dataset.value))")
        assert ec == sorted(ec, key=lambda x: sign * x), ec
    browser.tab_to("[data-map] svg")
    browser.press("+")
    assert "scale(1.5)" in browser.value("document.querySelector('[data-map] svg > g').getAttribute('transform')")
    browser.tab_to(".point")
    assert not browser.value("document.getElementById('tip').hidden")
    browser.press("Enter")
    chosen = browser.value("document.querySelector('.point.chosen').getAttribute('aria-label').split('\\n')[0]")
    assert chosen == browser.value("document.querySelector('.calls[data-row] h4').textContent").replace(", in the order", ", in the order")
    assert browser.value("document.querySelectorAll('[data-sheet=variants] tr[aria-selected=true]').length") == 1


def fits(browser):
    wide, there = browser.value("[document.documentElement.scrollWidth, innerWidth]")
    assert wide <= there, (wide, there)


def main():
    program, path = sys.argv[1:]
    graph = data_of(path)["graphs"][0]
    # The browser's children may outlive it by a moment, and write.
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = Browser(program, profile)
        try:
            browser.open(path, 1280)
            shows_the_data(browser, graph)
            fits(browser)
            goes_by_keyboard(browser)
            light = browser.value("getComputedStyle(document.body).backgroundColor")
            browser.open(path, 360, dark=True)
            fits(browser)
            assert browser.value("getComputedStyle(document.body).backgroundColor") != light
            assert browser.value("document.querySelector('[data-pareto] svg').viewBox.baseVal.width") < 360
            wrong = [event for event in browser.events if event.get("method") in ("Runtime.exceptionThrown", "Runtime.consoleAPICalled", "Log.entryAdded")]
            assert not wrong, wrong
            loaded = [event["params"]["request"]["url"][:60] for event in browser.events if event.get("method") == "Network.requestWillBeSent"]
            assert all(url.startswith(("file:", "data:")) for url in loaded), loaded
        finally:
            browser.process.terminate()
            browser.process.wait()


if __name__ == "__main__":
    main()
