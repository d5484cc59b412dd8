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
import re
import subprocess
import sys
import time
import urllib.request


PATIENCE_S = 30  # long enough for the slowest machine; what is waited for comes far sooner


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
                     "--enable-unsafe-swiftshader", f"--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE {reachable}",
                     f"--window-size={width},{height}"]
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

    def cdp(self, command, **parameters):
        """Of the DevTools protocol, for what WebDriver does not have: fingers."""
        return self.post(f"/session/{self.session}/goog/cdp/execute", {"cmd": command, "params": parameters})

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

    def become(self, what, condition):
        """What the page does in its own time is waited for; on a page that has failed already, hardly."""
        until = time.monotonic() + (0.5 if self.failed else PATIENCE_S)
        while not condition() and time.monotonic() < until:
            time.sleep(0.02)
        self.hold(what, condition())

    def changes(self, what, canvas, action):
        before = self.browser.run(INK % canvas)
        self.browser.run(action)
        self.hold(what, self.browser.run(INK % canvas) != before)


def check_quiet(browser, checks):
    errors = [entry["message"] for entry in browser.log("browser") if entry["level"] == "SEVERE"]
    checks.hold(f"the page logs no error {errors}", not errors)
    asked = [address for address in requests_made(browser) if not address.startswith(("file:", "data:"))]
    checks.hold(f"the page asks the network for nothing {asked}", not asked)


# One frame's numbers are changed, shown, and put back.
CHANGED = """
const i = recording.at(0, %d), names = ['value', 'raw', 'sigma', 'level', 'raw_level', 'state', 'cause', 'age_s'];
const before = names.map((name) => recording[name][i]);
%s;
show_frame(0);
const said = { note: document.getElementById('drawn-note').textContent,
  row: document.querySelectorAll('#values tr')[%d + 1].textContent,
  grey: document.querySelectorAll('#values tr')[%d + 1].querySelectorAll('.not-valid').length,
  struck: Array.from(document.querySelectorAll('#values tr')[%d + 1].querySelectorAll('.level span'),
    (x) => getComputedStyle(x).textDecorationLine),
  colours: Array.from(document.querySelectorAll('#values tr')[%d + 1].querySelectorAll('.number'),
    (x) => getComputedStyle(x).color) };
const canvas = document.getElementById('top');
said.ink = Array.from(canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data)
  .reduce((sum, x) => (sum * 31 + x) >>> 0, 0);
names.forEach((name, k) => { recording[name][i] = before[k]; });
show_frame(0);
return said;
"""


def check_one_story(browser, checks):
    """Picture, table and note of a frame agree on raw, value and state."""
    changed = lambda q, what: browser.run(CHANGED % (q, what, q, q, q, q))
    equal = "recording.state[i] = 3; recording.value[i] = recording.raw[i] = 0.1; recording.sigma[i] = 0.001"
    as_it_is, apart = changed(2, equal), changed(2, equal + "; recording.value[i] = 0.2")
    checks.hold("raw and value that agree are called so", "Raw and value agree" in as_it_is["note"] and
                "lags behind" not in as_it_is["row"])
    both = all(text in apart["note"] + apart["row"] for text in ("5.730°", "11.459°"))
    checks.hold(f"raw and value apart are both named {apart['note'][:90]}",
                "differ by more than noise" in apart["note"] and both)
    checks.hold("the lag is a part of why", "lags behind this frame by 5.730°" in apart["row"])
    checks.hold("the picture draws both", as_it_is["ink"] != apart["ink"])
    distance = "recording.state[i] = 3; recording.value[i] = recording.raw[i] = 2; recording.sigma[i] = 0.001"
    checks.hold("so for a distance", changed(3, distance)["ink"] !=
                changed(3, distance + "; recording.value[i] = 2.5")["ink"])
    valid = changed(3, "recording.state[i] = 3; recording.level[i] = recording.raw_level[i] = 0.01")
    degraded = changed(3, "recording.state[i] = 2; recording.level[i] = recording.raw_level[i] = 20.9")
    held = changed(3, "recording.state[i] = 1; recording.raw[i] = NaN; recording.age_s[i] = 0.4")
    invalid = changed(3, "recording.state[i] = 0; recording.raw[i] = NaN")
    checks.hold("a valid number is not grey", valid["grey"] == 0 and valid["struck"] == ["none", "none"])
    checks.hold("numbers that are not valid are grey", min(x["grey"] for x in (degraded, held, invalid)) == 2 and
                not set(degraded["colours"]) & set(valid["colours"]))
    checks.hold("a level beyond the alert limit is struck through", degraded["struck"] == ["line-through"] * 2)
    checks.hold("held is named with its age", "measured 0.4 s ago" in held["note"] and "0.4 s ago" in held["row"])
    checks.hold("invalid is named", "Invalid, not drawn: left front" in invalid["note"])
    checks.hold("each state has a picture of its own",
                len({x["ink"] for x in (valid, degraded, held, invalid)}) == 4)


# states: of (frame, quantity); the truth is put aside. What is not valid may not steer, by a wall that is unseen.
VERDICT = """
const state = recording.state.slice(), steer = recording.steer.slice(), truth = recording.has_truth;
const before = Object.assign({}, summary), causes = recording.words.steer_causes;
for (let f = 0; f < recording.frames; ++f) for (let q = 0; q < 7; ++q) {
  const i = recording.at(f, q);
  recording.state[i] = %s;
  recording.steer[i] = recording.state[i] === 3 ? causes.length : causes.indexOf('extrapolated');
}
recording.has_truth = false;
Object.assign(summary, summarise(recording));
show_verdict();
const box = document.getElementById('verdict'), said = [box.className.split(' ')[1], box.innerText];
recording.state.set(state);
recording.steer.set(steer);
recording.has_truth = truth;
Object.assign(summary, before);
show_verdict();
return said;
"""


def check_verdicts(browser, checks):
    verdict = lambda states: [text.replace("\u00a0", " ") for text in browser.run(VERDICT % states)]
    grade, text = verdict("2")
    checks.hold("nothing valid is not usable", grade == "bad" and "\nNot usable" in text and
                "Never act on roll, pitch, yaw, left front, left back, right front, right back" in text)
    checks.hold("the first line says that none may steer", text.startswith("May steer: none.\n") and
                re.search(r"May not: roll, pitch, yaw \(valid in 0 % of the frames, else mostly level .*, limit 1.000°"
                          r": the wall is unseen beside the machine\); left front", text) is not None and
                "To look at: mount the sensor where nothing hides the wall at the sampling point, " in text)
    grade, text = verdict("f === 0 && q === 2 ? 3 : 2")
    checks.hold("one valid value is not usable", grade == "bad" and
                "Do not rely on yaw: valid in less than 50 % of the frames" in text)
    grade, text = verdict("q < 2 ? 3 : q === 2 && f % 4 ? 3 : 2")
    checks.hold("angles alone are usable in part", grade == "fair" and
                "\nUsable in part: roll, pitch, yaw alone. Not usable: left front" in text and
                text.startswith("May steer: roll, pitch.\n") and "May not: yaw (valid in 7" in text and
                "Usable: roll, pitch." in text and "often not valid: yaw" in text and "Never act on left front" in text)
    grade, text = verdict("3")
    checks.hold("all valid is usable", grade == "good" and "\nUsable: every value" in text and
                text.startswith("May steer: roll, pitch, yaw, left front, left back, right front, right back.\n"))
    checks.hold("the rule stands on the page", "Rule, the same in run, report and doctor" in text and
                "at least 90 % of the frames" in text and "from 50 %" in text)


def check_words(browser, checks):
    text = lambda name: browser.run(f"return document.getElementById('{name}').textContent")
    whole = browser.run("return document.body.innerText")
    checks.hold("nothing is called a value to act on", "value to act on" not in whole and "±" not in text("values"))
    checks.hold("signs and units are said", "Turned left is negative; in ROS (REP 103) it is positive" in text("signs")
                and "Signs with forward_axis +X" in text("signs") and "hold radians" in text("signs"))
    browser.run("recording.head.forward_axis = '+Y'; show_frame(0)")
    checks.hold("a machine along Y is explained", "roll tilts nose and tail" in text("signs"))
    browser.run("recording.head.forward_axis = '+X'; show_frame(0)")
    checks.hold("the title says that it is a report", browser.run("return document.title").endswith("pose_wall report"))


def check_chinese(browser, checks):
    """Names of files, keys and programs have no language; three English words in a row are a sentence."""
    whole = browser.run("return document.body.innerText")
    english = re.findall(r"[A-Za-z]{2,}(?: [a-z]{2,}){2,}", whole)
    checks.hold(f"nothing is left in English {english[:3]}", not english)
    title = browser.run("return document.title").rsplit(" – ", 1)[-1]
    checks.hold(f"so is the title, {title}", re.fullmatch("pose_wall (运动)?报告", title) is not None)
    titles = browser.run("return Array.from(document.querySelectorAll('[title]'), (x) => x.title)")
    checks.hold("so are the hints", all(re.search(r"[\u3400-\u9fff]", title) for title in titles))


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
    may = run("return QUANTITIES.map((_, q) => recording.state[recording.at(0, q)] === VALID)")
    checks.hold("the frame's first line says what may steer in it", text("steer-frame").startswith("May steer: ") and
                ("May not" in text("steer-frame")) != all(may))
    check_one_story(browser, checks)
    check_verdicts(browser, checks)
    check_words(browser, checks)
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
    run("location.hash = '#2'")
    checks.become("an address with a frame opens it", lambda: slider_at() == 2)
    run(slide % 0)
    run("document.getElementById('play').click()")
    checks.become("play goes on by itself", lambda: slider_at() > 0)
    run("document.getElementById('play').click()")
    first_theme = run("return document.documentElement.dataset.theme")
    checks.changes("the theme changes the pictures", "top", "document.getElementById('theme').click()")
    checks.hold("the theme has changed", run("return document.documentElement.dataset.theme") != first_theme)
    english = text("summary")
    run("document.getElementById('language').click()")
    checks.hold("the other language is Chinese", text("summary") != english and "有效" in text("summary"))
    checks.hold("so are parts and signs", "测距偏差" in text("level-parts") and "右侧下倾" in text("values"))
    check_chinese(browser, checks)
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
