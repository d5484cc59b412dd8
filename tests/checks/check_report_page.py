#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Opens a page of `pose_wall report` in a headless Chromium and uses it as a person would.

check_report_page.py REPORT.html FRAMES [SCREENSHOT_PREFIX]

Speaks WebDriver to chromedriver (Debian: chromium, chromium-driver) by the standard library alone. Fails when the page
logs an error, asks the network for anything, shows another number of frames, or when slider, play, layers, theme,
language or charts do not do what they say. With a prefix, pictures are left for people to look at.
"""
import base64
import json
import pathlib
import subprocess
import sys
import time
import urllib.request


class Browser:
    def __init__(self, width=1400, height=2300, reachable="127.0.0.2"):
        self.driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE, text=True)
        for line in self.driver.stdout:
            if "successfully on port" in line:
                self.port = int(line.rsplit(" ", 1)[1].rstrip(".\n"))
                break
        else:
            raise RuntimeError("chromedriver did not start")
        arguments = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     f"--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE {reachable}", f"--window-size={width},{height}"]
        options = {"browserName": "chrome", "goog:chromeOptions": {"args": arguments},
                   "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"}}
        self.session = self.post("/session", {"capabilities": {"alwaysMatch": options}})["sessionId"]

    def call(self, method, path, body=None):
        data = json.dumps(body).encode() if body is not None else None
        request = urllib.request.Request(f"http://127.0.0.1:{self.port}{path}", data, method=method,
                                         headers={"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=120) as answer:
            return json.load(answer)["value"]

    def post(self, path, body):
        return self.call("POST", path, body)

    def open(self, address):
        self.post(f"/session/{self.session}/url", {"url": address})

    def run(self, script):
        return self.post(f"/session/{self.session}/execute/sync", {"script": script, "args": []})

    def log(self, kind):
        return self.post(f"/session/{self.session}/se/log", {"type": kind})

    def screenshot(self, path):
        picture = self.call("GET", f"/session/{self.session}/screenshot")
        pathlib.Path(path).write_bytes(base64.b64decode(picture))

    def close(self):
        try:
            self.call("DELETE", f"/session/{self.session}")
        finally:
            self.driver.terminate()
            self.driver.wait()


def requests_made(browser):
    addresses = []
    for entry in browser.log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            addresses.append(message["params"]["request"]["url"])
    return addresses


# What is drawn on a canvas, as a number that changes with it.
INK = """
const canvas = document.getElementById('%s');
const bytes = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
let sum = 0;
for (let i = 0; i < bytes.length; ++i) sum = (sum * 31 + bytes[i]) >>> 0;
return sum;
"""


class Checks:
    def __init__(self, browser):
        self.browser = browser
        self.failed = []

    def hold(self, what, is_so):
        print(("ok      " if is_so else "FAILED  ") + what)
        if not is_so:
            self.failed.append(what)

    def changes(self, what, canvas, action):
        before = self.browser.run(INK % canvas)
        self.browser.run(action)
        self.hold(what, self.browser.run(INK % canvas) != before)


def check_quiet(browser, checks):
    errors = [entry["message"] for entry in browser.log("browser") if entry["level"] == "SEVERE"]
    checks.hold(f"the page logs no error {errors}", not errors)
    asked = [address for address in requests_made(browser) if not address.startswith(("file:", "data:"))]
    checks.hold(f"the page asks the network for nothing {asked}", not asked)


def check(browser, frames, prefix):
    run, checks = browser.run, Checks(browser)
    text = lambda name: run(f"return document.getElementById('{name}').textContent")
    checks.hold("the verdict says something", len(text("verdict")) > 20)
    slider_at = lambda: int(run("return document.getElementById('slider').value"))
    last = int(run("return document.getElementById('slider').max"))
    checks.hold(f"the slider reaches {frames} frames", last == frames - 1)
    checks.hold("seven charts, seven rows of values", run(
        "const count = (what) => document.querySelectorAll(what).length;"
        "return count('.chart canvas') == 7 && count('#values tr') == 8"))
    checks.hold("seven rows of parts for the frame, seven of medians", run(
        "const count = (what) => document.querySelectorAll(what).length;"
        "return count('#levels tr') == 8 && count('#level-parts tr') == 8"))
    checks.hold("bars are as long as their parts", run(
        "return Array.from(document.querySelectorAll('#levels .bar')).every((bar) => {"
        "  const widths = Array.from(bar.children, (part) => part.getBoundingClientRect().width);"
        "  const sum = widths.reduce((total, width) => total + width, 0);"
        "  return !widths.length || Math.abs(sum - bar.getBoundingClientRect().width) < 1; })"))
    checks.hold("an angle says what its sign means", "roll (+ right side down)" in text("values"))
    without_lag = "lags behind" not in text("values")
    run("const i = recording.at(0, 2), cause = recording.cause[i];"
        "recording.cause[i] = recording.words.parts.indexOf('lag'); show_frame(0); recording.cause[i] = cause;")
    checks.hold("the lag is named where it is the largest part", without_lag and "lags behind" in text("values"))
    run("show_frame(0)")
    for canvas in ("top", "section", "chart-yaw"):
        checks.hold(f"{canvas} is not empty", run(
            f"const c = document.getElementById('{canvas}'), pen = c.getContext('2d');"
            "return pen.getImageData(0, 0, c.width, c.height).data.some((x) => x)"))
    if prefix:
        browser.screenshot(f"{prefix}_light_en.png")
    slide = "const s = document.getElementById('slider'); s.value = %d; s.dispatchEvent(new Event('input'));"
    checks.changes("the slider moves the view", "top", slide % (frames // 2))
    checks.hold("the slider names the frame", f"frame {frames // 2} " in text("frame-name"))
    broken = run("return recording.error.findIndex((text) => text)")
    if broken >= 0:
        run(slide % broken)
        states = run("return Array.from(document.querySelectorAll('#values .state'), (x) => x.textContent)")
        checks.hold(f"a frame that could not be read says so {states}", states == ["unreadable"] * 7)
        run(slide % (frames // 2))
    toggle = "document.querySelectorAll('#layers input')[%d].click()"
    for k, layer in enumerate(("other", "floor", "left", "right")):
        if not run(f"return recording.point_label.includes({k})"):
            continue
        checks.changes(f"the layer '{layer}' can be taken away", "top", toggle % k)
        run(toggle % k)
    checks.changes("the planes can be taken away", "section", toggle % 5)
    run(toggle % 5)
    on_top = "document.getElementById('top').dispatchEvent(new %s)"
    checks.changes("the wheel zooms the view", "top", on_top % "WheelEvent('wheel', {deltaY: -1, cancelable: true})")
    checks.changes("a double click takes the zoom back", "top", on_top % "MouseEvent('dblclick')")
    run(slide % 0)
    run("const c = document.getElementById('chart-yaw'), b = c.getBoundingClientRect();"
        "c.dispatchEvent(new PointerEvent('pointerdown', {clientX: b.left + 0.8 * b.width, clientY: b.top + 20}))")
    checks.hold("a click into a chart goes to the frame", slider_at() > frames // 2)
    run(slide % 0)
    run("document.getElementById('play').click()")
    time.sleep(1.0)
    run("document.getElementById('play').click()")
    checks.hold("play goes on by itself", slider_at() > 0)
    first_theme = run("return document.documentElement.dataset.theme")
    checks.changes("the theme changes the pictures", "top", "document.getElementById('theme').click()")
    checks.hold("the theme has changed", run("return document.documentElement.dataset.theme") != first_theme)
    english = text("summary")
    run("document.getElementById('language').click()")
    checks.hold("the other language is Chinese", text("summary") != english and "有效" in text("summary"))
    checks.hold("so are parts and signs", "测距偏差" in text("level-parts") and "右侧下倾" in text("values"))
    checks.hold("no word is missing", "undefined" not in run("return document.body.innerText") and
                "NaN" not in run("return document.body.innerText"))
    if prefix:
        browser.screenshot(f"{prefix}_dark_zh.png")
    check_quiet(browser, checks)
    return checks.failed


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    page, frames = pathlib.Path(sys.argv[1]).resolve(), int(sys.argv[2])
    browser = Browser()
    try:
        browser.open(page.as_uri())
        failed = check(browser, frames, sys.argv[3] if len(sys.argv) > 3 else "")
    finally:
        browser.close()
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
