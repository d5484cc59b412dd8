#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The page of pose_walld as people and machines meet it. In a real browser it shows live frames at their rate, in both
languages. It says at once when nothing comes any more, and comes back after a restart. Four viewers and one that takes
nothing hold up nobody. By HTTP nothing can be changed. What is malformed gets an answer or a closed connection.

usage: page_peer.py ROOT POSE_WALL POSE_WALLD [SCREENSHOT_PREFIX]"""

import contextlib
import http.client
import json
import os
import pathlib
import re
import shutil
import socket
import sys
import tempfile
import time
import unittest
import urllib.request

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT, POSE_WALL, POSE_WALLD = pathlib.Path(sys.argv.pop(1)), sys.argv.pop(1), sys.argv.pop(1)
PICTURES = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else ""
sys.path[:0] = [str(ROOT / "tests/live"), str(ROOT / "tests/checks")]

import check_report_page  # noqa: E402  pylint: disable=wrong-import-position
import live_peer  # noqa: E402  pylint: disable=wrong-import-position

RATE_HZ = 10  # of the simulated road's stamps


def words(port, *more):
    return live_peer.replay_words(POSE_WALLD, live_peer.simulated_road(POSE_WALL), "--http", f"127.0.0.1:{port}", *more)


def cpu_s(pid):
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


# What the pictures write beyond their edges, or one word over another in a row of ticks.
WORDS_CUT = """
const write = CanvasRenderingContext2D.prototype.fillText, cut = [];
CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
  const wide = this.measureText(text).width;
  const left = x - (this.textAlign === 'center' ? wide / 2 : this.textAlign === 'right' ? wide : 0);
  if (left < 0 || left + wide > this.canvas.clientWidth) cut.push(`${this.canvas.id}: ${text}`);
  write.call(this, text, x, y);
};
show_frame();
show_slowly();
CanvasRenderingContext2D.prototype.fillText = write;
return cut;
"""


class Viewer:
    """Takes events as a script does, or nothing at all."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), 10)
        self.socket.sendall(b"GET /events HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n")
        self.bytes = b""

    def frames(self, count):
        """How many come, until there are so many or nobody would wait any longer."""
        until, self.bytes = time.monotonic() + live_peer.PATIENCE_S, b""
        self.socket.settimeout(0.2)
        while self.bytes.count(b"event: frame\n") < count and time.monotonic() < until:
            try:
                self.bytes += self.socket.recv(1 << 20)
            except socket.timeout:
                pass
        return self.bytes.count(b"event: frame\n")

    def close(self):
        self.socket.close()


class Http(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.port = live_peer.free_port()
        cls.daemon = live_peer.Program(*words(cls.port))
        assert cls.daemon.says("runtime: measures"), cls.daemon.log()

    @classmethod
    def tearDownClass(cls):
        took_s = cls.daemon.stop()
        print(f"stopped in {took_s:.2f} s")
        assert cls.daemon.process.returncode == 0, cls.daemon.log()

    def ask(self, method, path, headers=None, body=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=10)
        self.addCleanup(connection.close)
        connection.request(method, path, body, headers or {})
        answer = connection.getresponse()
        return answer, answer.read()

    def test_the_page_and_what_it_needs(self):
        for path, kind, needle in (("/", "text/html", b"<canvas"), ("/page.css", "text/css", b"--valid"),
                                   ("/page.js", "text/javascript", b"class Viewer")):
            answer, body = self.ask("GET", path)
            self.assertEqual(answer.status, 200)
            self.assertTrue(answer.headers["Content-Type"].startswith(kind))
            self.assertIn(needle, body)
            self.assertIn("default-src 'none'", answer.headers["Content-Security-Policy"])
            self.assertNotIn(b"http://", body.replace(b"http://www.w3.org", b""), "nothing of other places")

    def test_numbers_for_scripts(self):
        self.assertTrue(live_peer.becomes_true(lambda: self.ask("GET", "/state.json")[0].status == 200))
        state = json.loads(self.ask("GET", "/state.json")[1])
        self.assertEqual(set(state["values"]), {"roll", "pitch", "yaw", "d_lf", "d_lb", "d_rf", "d_rb"})
        for entry in state["steer"]:
            self.assertEqual(entry["may_steer"], state["values"][entry["value"]]["state"] == "valid", entry)
            self.assertEqual(entry["cause"] is None, entry["may_steer"], entry)
        self.assertRegex(state["steer_line"]["en"], r"^may steer: .*\.$")
        self.assertRegex(state["steer_line"]["zh"], "^可用于控制：.*。$")
        answer, body = self.ask("GET", "/health")
        self.assertEqual(answer.status, 200, body)
        self.assertEqual([part["part"] for part in json.loads(body)["parts"]][:2], ["runtime", "source replay"])

    def test_without_a_map_there_is_none(self):
        for path in ("/planar.json", "/map.png"):
            self.assertEqual(self.ask("GET", path)[0].status, 404, path)

    def test_nothing_can_be_changed(self):
        for method in ("POST", "PUT", "DELETE", "PATCH", "OPTIONS"):
            self.assertEqual(self.ask(method, "/", body="x")[0].status, 405, method)
        for path in ("/x", "/../etc/passwd", "/%2e%2e/etc/passwd"):
            self.assertEqual(self.ask("GET", path)[0].status, 404, path)
        for path in ("/page.js/..", "//"):
            self.assertEqual(self.ask("GET", path)[1], self.ask("GET", "/")[1], "another name of the page itself")
        self.assertEqual(self.ask("GET", "/", {"Host": "evil.example"})[0].status, 421, "a name pointed here")
        self.assertEqual(self.ask("GET", "/", {"Host": f"localhost:{self.port}"})[0].status, 200)
        self.assertEqual(self.ask("GET", "/page.js", {"Range": "bytes=" + ",".join(["0-"] * 900)})[0].status, 416)

    def test_malformed_requests_hold_up_nobody(self):
        for request in (b"\r\n\r\n", b"GET\r\n\r\n", b"\x00" * 100, b"GET / HTTP/9.9\r\n\r\n", b"GET /" + b"a" * 100000,
                        b"GET / HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n", b"GET / HTTP/1.1\r\n"):
            with socket.create_connection(("127.0.0.1", self.port), 10) as connection:
                connection.sendall(request)
        self.assertEqual(self.ask("GET", "/health")[0].status, 200)

    def test_a_viewer_that_takes_nothing_holds_up_nobody(self):
        pid = self.daemon.process.pid
        before = cpu_s(pid)
        time.sleep(3)
        alone = (cpu_s(pid) - before) / 3
        stalled, viewers = Viewer(self.port), [Viewer(self.port) for _ in range(4)]
        before, began = cpu_s(pid), time.monotonic()
        counts = []
        for viewer in viewers:
            counts.append(viewer.frames(6))
        with_viewers = (cpu_s(pid) - before) / (time.monotonic() - began)
        print(f"processor time: {alone:.3f} s/s without viewers, {with_viewers:.3f} with four and one that stalls; "
              f"frames by viewer: {counts}")
        self.assertGreater(min(counts), 5)
        for viewer in viewers + [stalled]:
            viewer.close()

    def nobody_looks(self):
        return b'"viewers":"0"' in self.ask("GET", "/health")[1].replace(b" ", b"")

    def test_too_many_viewers_are_told(self):
        self.assertTrue(live_peer.becomes_true(self.nobody_looks), "those of other tests are gone")
        viewers = [Viewer(self.port) for _ in range(16)]
        for viewer in viewers:  # all are served; who took nothing for seconds would be cut off
            self.assertIn(b"HTTP/1.1 200", viewer.socket.recv(200))
        late = Viewer(self.port)
        self.assertTrue(late.socket.recv(100).startswith(b"HTTP/1.1 503"))
        self.assertEqual(self.ask("GET", "/health")[0].status, 200, "who only asks is served all the same")
        for viewer in viewers:
            viewer.close()
        self.assertTrue(live_peer.becomes_true(self.nobody_looks))


class SlowClients(unittest.TestCase):
    """Who is slow, idle or silent takes nothing from the others, and holds up no stop."""

    SLOW = 60

    def test_they_cost_nobody_anything(self):
        port = live_peer.free_port()
        with tempfile.TemporaryDirectory() as folder:
            daemon = live_peer.Program(*words(port, "--set", f"recording={folder}"))
            self.addCleanup(daemon.kill)
            self.assertTrue(daemon.says("runtime: measures"), daemon.log())
            slow = [socket.create_connection(("127.0.0.1", port), 10) for _ in range(self.SLOW)]
            for connection in slow:
                self.addCleanup(connection.close)
                connection.sendall(b"GET /health HTTP/1.1\r\nHost: 127")  # and then a byte now and then
            greedy = socket.create_connection(("127.0.0.1", port), 10)  # asks for much and takes nothing
            self.addCleanup(greedy.close)
            greedy.sendall(b"GET /page.js HTTP/1.1\r\nHost: localhost\r\n\r\n" * 20)
            idle = http.client.HTTPConnection("127.0.0.1", port, timeout=10)  # a monitor between two looks
            self.addCleanup(idle.close)
            took_s = []
            for _ in range(20):
                for connection in slow:
                    with contextlib.suppress(OSError):  # ended, as it may be
                        connection.send(b".")
                began = time.monotonic()
                idle.request("GET", "/health")
                self.assertEqual(idle.getresponse().read()[:1], b"{")
                took_s.append(time.monotonic() - began)
                time.sleep(0.1)
            print(f"/health beside {self.SLOW} slow clients: {1000 * sorted(took_s)[10]:.1f} ms in the middle, "
                  f"{1000 * max(took_s):.0f} at most")
            self.assertIsNotNone(idle.sock, "it stays connected")
            self.assertTrue(daemon.stops_by_itself(), daemon.log())
            recording = sorted(pathlib.Path(folder).glob("*.mcap"))[-1]
            self.assertEqual(recording.read_bytes()[-8:], b"\x89MCAP0\r\n", "it is whole")

    def test_what_nobody_reads_costs_nothing(self):
        port = live_peer.free_port()
        with live_peer.running(*words(port)) as daemon:
            self.assertTrue(daemon.says("runtime: measures"), daemon.log())
            asked = b"GET /events HTTP/1.1\r\nHost: localhost\r\n"
            viewers = [Viewer(port) for _ in range(3)]
            for viewer in viewers:
                viewer.frames(1)
            before = cpu_s(daemon.process.pid)
            time.sleep(3)
            usual = cpu_s(daemon.process.pid) - before
            viewers[0].socket.sendall(b"x")  # behind its request
            viewers[1].socket.shutdown(socket.SHUT_WR)
            together = socket.create_connection(("127.0.0.1", port), 10)
            together.sendall(asked + b"\r\nGET / HTTP/1.1\r\n")
            upgrade = socket.create_connection(("127.0.0.1", port), 10)
            upgrade.sendall(asked + b"Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                            b"Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n")
            body = socket.create_connection(("127.0.0.1", port), 10)
            body.sendall(asked + b"Content-Length: 9\r\n\r\nx")
            for connection in (viewers[0].socket, viewers[1].socket, upgrade, body):
                connection.settimeout(live_peer.PATIENCE_S)
                self.assertTrue(self.is_ended(connection))
            before = cpu_s(daemon.process.pid)
            time.sleep(3)
            spent = cpu_s(daemon.process.pid) - before
            print(f"processor time in 3 s: {usual:.2f} s with three viewers, {spent:.2f} s beside what nobody reads")
            self.assertLess(spent, usual + 1.0, "no loop runs for nothing")  # a third of a processor
            for connection in (together, upgrade, body):
                connection.close()
            for viewer in viewers:
                viewer.close()

    def is_ended(self, connection):
        until = time.monotonic() + live_peer.PATIENCE_S
        try:
            while connection.recv(1 << 20):
                if time.monotonic() > until:
                    return False
        except ConnectionError:
            pass
        return True

    def test_a_connection_that_is_to_close_is_closed(self):
        port = live_peer.free_port()
        with live_peer.running(*words(port)) as daemon:
            self.assertTrue(daemon.says("runtime: measures"), daemon.log())
            for path in ("/health", "/page.js"):
                with socket.create_connection(("127.0.0.1", port), 10) as connection:
                    connection.settimeout(live_peer.PATIENCE_S)
                    request = f"GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"
                    connection.sendall(request.encode())
                    began = time.monotonic()
                    self.assertTrue(self.is_ended(connection))
                    self.assertLess(time.monotonic() - began, 3, "before an idle one would be")

    def test_a_request_that_never_ends_is_ended(self):
        port = live_peer.free_port()
        with live_peer.running(*words(port)) as daemon:
            self.assertTrue(daemon.says("runtime: measures"), daemon.log())
            with socket.create_connection(("127.0.0.1", port), 10) as half:
                half.sendall(b"GET / HTTP/1.1\r\nHost: ")
                half.settimeout(live_peer.PATIENCE_S)
                self.assertIn(half.recv(100)[:12], (b"", b"HTTP/1.1 408", b"HTTP/1.1 403"), "it is not waited for")


class Failing(unittest.TestCase):
    def test_two_daemons_do_not_share_a_port(self):
        port = live_peer.free_port()
        with live_peer.running(*words(port)) as first, live_peer.running(*words(port)) as second:
            self.assertTrue(live_peer.becomes_true(
                lambda: first.process.poll() is not None or second.process.poll() is not None))

    def test_a_port_that_is_taken_is_named(self):
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            port = taken.getsockname()[1]
            with live_peer.running(*words(port)) as daemon:
                self.assertEqual(daemon.process.wait(live_peer.PATIENCE_S), 1)
                self.assertTrue(daemon.says(f"http: cannot listen at 127.0.0.1:{port}"), daemon.log())


@unittest.skipUnless(shutil.which("chromedriver"), "SKIPPED: no chromedriver (packages chromium, chromium-driver)")
class InABrowser(unittest.TestCase):
    def setUp(self):
        self.port = live_peer.free_port()
        self.daemon = live_peer.Program(*words(self.port))
        self.addCleanup(lambda: self.daemon.kill())
        self.assertTrue(self.daemon.says("runtime: measures"), self.daemon.log())

    def browser(self, width=1400, height=2000):
        browser = check_report_page.Browser(width, height, "127.0.0.1")
        self.addCleanup(browser.close)
        browser.open(f"http://127.0.0.1:{self.port}/")
        self.assertTrue(live_peer.becomes_true(lambda: self.shown(browser) > 3), "frames are shown")
        return browser

    def shown(self, browser):
        return browser.run("return page.shown")

    def text(self, browser, name):
        return browser.run(f"return document.getElementById('{name}').textContent")

    def is_drawn(self, browser, canvas):
        return browser.run(f"const c = document.getElementById('{canvas}');"
                           "return c.getContext('2d').getImageData(0, 0, c.width, c.height).data.some((x) => x)")

    def test_the_first_line_says_what_may_steer(self):
        browser = self.browser()
        told = self.crafted(browser, "3")
        self.assertEqual(told["grade"], "good")
        self.assertEqual(told["may"], "May steer: roll, pitch, yaw, left front, left back, right front, right back.")
        self.assertEqual((told["not"], told["help"]), ("", ""))
        told = self.crafted(browser, "q === 3 ? 2 : 3")
        self.assertEqual(told["grade"], "fair")
        self.assertEqual(told["may"], "May steer: roll, pitch, yaw, left back, right front, right back.")
        self.assertEqual(told["not"], "May not: left front (level 0.140 m, limit 0.100 m: the wall is unseen beside "
                                      "the machine).")
        self.assertEqual(told["help"][:60], "To look at: mount the sensor where nothing hides the wall at")
        self.assertEqual(told["why"], "beyond the limit of 0.100 m: the wall is unseen beside the machine")
        browser.run("document.getElementById('language').click()")
        self.assertEqual(self.crafted(browser, "q === 3 ? 2 : 3")["not"],
                         "不可用：左前（保护级 0.140 m，限值 0.100 m：机器旁的巷帮不可见）。")
        browser.run("document.getElementById('language').click()")
        self.assertEqual(self.crafted(browser, "2")["grade"], "bad")
        self.assertEqual(self.crafted(browser, "2")["may"], "May steer: none.")
        self.assertEqual(self.crafted(browser, "3", "page.paused = true")["grade"], "fair", "the picture stands still")
        for stop, grade in (("go", "good"), ("slow", "fair"), ("stop", "bad")):
            answer = f"roadway = told_stop(true, '{stop}')"
            self.assertEqual(self.crafted(browser, "3", answer)["grade"], grade, stop)
        silent = self.crafted(browser, "3", "roadway = told_stop(false, 'go')")
        self.assertEqual(silent["grade"], "bad", "a stop that does not answer stops")
        lost = self.crafted(browser, "3", "page.heard_ms = performance.now() - 1e5")
        self.assertEqual((lost["grade"], lost["may"]), ("bad", "May steer: none. Nothing that is shown is current."))

    def crafted(self, browser, state, before=""):
        """What the first line says of states that a real road shows too seldom. Levels: 0.14 m and 0.14 rad."""
        return browser.run(f"""
const {{ grade, spoken }} = RoadwayView.prototype;
const told_stop = (is_known, state) => ({{ stop: {{ state }}, is_stop_known: () => is_known, grade, spoken }});
const kept = [recording, roadway, page.paused, page.heard_ms], f = recording.frames - 1, r = recording;
const series = ['state', 'steer', 'level', 'raw'].map((name) => [name, r[name].slice()]);
const causes = r.words.steer_causes;
for (let q = 0; q < 7; ++q) {{
  const i = r.at(f, q);
  r.state[i] = {state};
  r.steer[i] = r.state[i] === 3 ? causes.length : causes.indexOf('extrapolated');
  r.level[i] = 0.14;
  r.raw[i] = 1;
}}
page.heard_ms = performance.now();
{before};
show_link();
const text = (id) => document.getElementById(id).textContent;
const said = {{ grade: document.getElementById('steer').className.split(' ')[1], why: tile_why(f, 3),
  may: text('steer-may'), not: text('steer-not'), help: text('steer-help') }};
for (const [name, numbers] of series) r[name].set(numbers);
[recording, roadway, page.paused, page.heard_ms] = kept;
return said;""")

    def test_what_stands_still_is_grey_and_what_is_old_is_pale(self):
        browser = self.browser()
        # As if something had come just now, which a busy machine shows late.
        grey = lambda: browser.run("page.heard_ms = performance.now(); show_link();"
                                   "return Array.from(document.querySelectorAll('.current'), (x) => "
                                   "getComputedStyle(x).filter)")
        self.assertEqual(set(grey()), {"none"}, "it is live")
        browser.run("document.getElementById('pause').click()")
        self.assertEqual(set(grey()), {"grayscale(1)"})
        self.assertGreaterEqual(len(grey()), 7)
        self.assertEqual(browser.run("return getComputedStyle(document.getElementById('steer')).filter"), "none")
        # A result of silence as it comes when the sensor goes away.
        said = browser.run("""
const kept = [page.told, page.paused], f = recording.frames - 1, w = words(), said = {};
const states = recording.state.slice(), ages = recording.age_s.slice();
const tell = (state, age_s) => {
  for (let q = 0; q < 7; ++q) {
    recording.state[recording.at(f, q)] = state;
    recording.age_s[recording.at(f, q)] = age_s;
  }
  return silence_text('3.2');
};
const floor = () => {
  const c = document.getElementById('top'), wanted = colour('floor').match(/[0-9a-f]{2}/g).map((x) => parseInt(x, 16));
  const bytes = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
  let points = 0;
  for (let i = 0; i < bytes.length; i += 4) points += wanted.every((x, k) => bytes[i + k] === x);
  return points;
};
show_frame();
said.fresh = floor();
page.told = { told_by: 'silence', frame: 7, age_ms: 3200 };
show_frame();
Object.assign(said, { old: floor(), note: document.getElementById('drawn-note').textContent,
  aging: tell(HELD, 3.2), gone: tell(INVALID, 3.2), never: tell(INVALID, NaN) });
said.old_in_space = viewer.space.scene.fault ? 1 : viewer.space.scene.cloud.material.uniforms.is_old.value;
recording.state.set(states);
recording.age_s.set(ages);
[page.told, page.paused] = kept;
return said;""")
        self.assertGreater(said["fresh"], 20)
        self.assertEqual(said["old"], 0, "no point keeps its colour")
        self.assertEqual(said["old_in_space"], 1)
        self.assertTrue(said["note"].startswith("The points are 3.2 s old and pale. "), said["note"])
        self.assertTrue(said["aging"].endswith("values age and become invalid."))
        self.assertTrue(said["gone"].endswith("all values have become invalid."))
        self.assertTrue(said["never"].endswith("nothing was measured yet."))

    def test_who_hears_the_page_is_told_of_grades_and_not_of_numbers(self):
        browser = self.browser()
        regions = browser.run("return Array.from(document.querySelectorAll('#first [role=status], #first [aria-live]'),"
                              " (x) => x.id)")
        self.assertEqual(regions, ["spoken"])
        said = browser.run("""
const kept = recording.state.slice(), steer = recording.steer.slice(), f = recording.frames - 1, out = [];
const tell = (state, level) => {
  for (let q = 0; q < 7; ++q) {
    const i = recording.at(f, q);
    [recording.state[i], recording.level[i]] = [state, level];
    recording.steer[i] = state === VALID ? recording.words.steer_causes.length : 0;
  }
  page.heard_ms = performance.now();
  show_link();
  out.push([document.getElementById('steer').innerText, document.getElementById('spoken').textContent]);
};
tell(VALID, 0.01);
tell(DEGRADED, 0.14);
tell(DEGRADED, 0.15);
tell(VALID, 0.01);
recording.state.set(kept);
recording.steer.set(steer);
return out;""")
        self.assertNotEqual(said[1][0], said[2][0], "the level is another one")
        self.assertEqual(said[1][1], said[2][1], "nobody is told")
        self.assertIn("May steer: none.", said[1][1])
        self.assertNotEqual(said[2][1], said[3][1], "a change of the grade is told")

    def test_page_and_script_say_the_same(self):
        browser = self.browser()
        self.assertTrue(live_peer.becomes_true(lambda: self.text(browser, "steer-may").startswith("May steer: ")))

        def same():
            with urllib.request.urlopen(f"http://127.0.0.1:{self.port}/state.json", timeout=10) as answer:
                state = json.load(answer)
            said = browser.run("const list = steering_of(recording.frames - 1), causes = recording.words.steer_causes;"
                               "return list.filter((x) => x.may).map((x) => QUANTITIES[x.q]).concat("
                               "list.filter((x) => !x.may).map((x) => causes[x.cause]))")
            return said == ([x["value"] for x in state["steer"] if x["may_steer"]] +
                            [x["cause"] for x in state["steer"] if not x["may_steer"]])
        self.assertTrue(live_peer.becomes_true(same))

    def test_on_a_tablet_one_finger_scrolls_and_two_zoom(self):
        browser = self.browser(768, 1024)
        browser.cdp("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
        browser.run("document.getElementById('top').scrollIntoView({block: 'center'})")
        box = browser.run("const b = document.getElementById('top').getBoundingClientRect();"
                          "return [b.left, b.top, b.width, b.height]")
        x, y = box[0] + box[2] / 2, box[1] + box[3] / 2
        metres = lambda: browser.run("return viewer.top.metres[0]")
        centre = lambda: browser.run("return viewer.top.centre")
        scrolled = lambda: browser.run("return window.scrollY")

        def touch(kind, *fingers):
            browser.cdp("Input.dispatchTouchEvent", type=kind,
                        touchPoints=[{"x": fx, "y": fy, "id": k} for k, (fx, fy) in enumerate(fingers)])

        self.assertTrue(browser.run("return matchMedia('(pointer: coarse)').matches"))
        small = browser.run("return Array.from(document.querySelectorAll('button, select, label'))"
                            ".filter((x) => x.offsetHeight && x.offsetHeight < 40).map((x) => x.textContent)")
        self.assertEqual(small, [], "what a finger takes is as high as a finger")
        before = (metres(), centre(), scrolled())
        touch("touchStart", (x, y + 60))
        for step in range(1, 13):
            touch("touchMove", (x, y + 60 - 10 * step))
        touch("touchEnd")
        self.assertTrue(live_peer.becomes_true(lambda: scrolled() > before[2] + 40), "a swipe scrolls the page")

        def rests():
            here = scrolled()
            time.sleep(0.3)
            return scrolled() == here
        self.assertTrue(live_peer.becomes_true(rests), "the page comes to rest")
        self.assertEqual((metres(), centre()), before[:2], "and leaves the picture")
        # Where the picture is on the screen: a text above it may grow meanwhile, and the browser scrolls by as much.
        top = lambda: browser.run("return document.getElementById('top').getBoundingClientRect().top")
        y = top() + box[3] / 2
        before = (metres(), centre(), top())
        touch("touchStart", (x - 20, y))
        touch("touchStart", (x - 20, y), (x + 20, y))
        for step in range(1, 11):
            touch("touchMove", (x - 20 - 4 * step + 30, y), (x + 20 + 4 * step + 30, y))
        touch("touchEnd")
        self.assertAlmostEqual(metres(), before[0] / 3, delta=0.1 * before[0], msg="two fingers zoom")
        self.assertNotEqual(centre(), before[1], "and move")
        self.assertAlmostEqual(top(), before[2], delta=1, msg="and leave the page")

    def test_nothing_is_cut_on_small_screens(self):
        for width in (390, 768, 1280):
            browser = self.browser(width, 1024)
            # A window has a least width of its own.
            browser.cdp("Emulation.setDeviceMetricsOverride", width=width, height=1024, deviceScaleFactor=1,
                        mobile=False)
            self.assertEqual(browser.run("return window.innerWidth"), width)
            cut = browser.run("""
return Array.from(document.querySelectorAll('main table')).filter((table) => {
  for (let node = table.parentElement; node !== document.body; node = node.parentElement) {
    if (['auto', 'scroll'].includes(getComputedStyle(node).overflowX)) {
      return node.getBoundingClientRect().right > innerWidth + 1;
    }
  }
  return table.getBoundingClientRect().right > innerWidth + 1;
}).map((table) => table.parentElement.id)""")
            self.assertEqual(cut, [], width)
            wide = browser.run("return document.documentElement.scrollWidth - window.innerWidth")
            self.assertLessEqual(wide, 0, width)
            self.assertEqual(browser.run(WORDS_CUT), [], width)
            # At first sight of the table: value and state.
            seen = browser.run("return Array.from(document.querySelectorAll('#values tr:nth-child(2) td'))"
                               ".slice(0, 3).map((x) => [x.className, x.getBoundingClientRect().right])")
            self.assertTrue(seen[1][0].startswith("state "), seen)
            self.assertLessEqual(seen[2][1], width, "state and value are seen before the table is moved")
            if PICTURES:
                browser.screenshot(f"{PICTURES}_{width}.png")

    def test_map_place_and_stop(self):
        self.daemon.kill()
        self.daemon = live_peer.Program(*words(self.port, "--set", "planar=map", "--set", "planar_map_every_s=1"))
        self.assertTrue(self.daemon.says("planar roadway: maps"), self.daemon.log())
        told = http.client.HTTPConnection("127.0.0.1", self.port, timeout=10)
        self.addCleanup(told.close)
        told.request("GET", "/map.png")
        answer = told.getresponse()
        self.assertEqual((answer.status, answer.headers["Content-Type"]), (200, "image/png"))
        self.assertEqual(answer.read()[:8], b"\x89PNG\r\n\x1a\n")
        told.request("GET", "/planar.json")
        planar = json.loads(told.getresponse().read())
        self.assertEqual(planar["stop"]["state"], "stop")
        why = planar["stop"]["why"]
        self.assertRegex(why["en"], r", for [0-9.]+ s\. [A-Z].*\.$")
        self.assertRegex(why["zh"], "，已 [0-9.]+ 秒。.*。$")
        self.assertEqual(len(planar["roadway"]["pose"]), 3)
        browser = self.browser()
        self.assertTrue(live_peer.becomes_true(lambda: "Place: known" in self.text(browser, "place-line")))
        self.assertFalse(browser.run("return document.getElementById('roadway-panel').hidden"))
        self.assertTrue(live_peer.becomes_true(lambda: browser.run("return roadway.map !== null")), "the picture came")
        self.assertTrue(self.is_drawn(browser, "roadway"))
        grade = lambda: browser.run("return document.getElementById('steer').className")
        self.assertTrue(live_peer.becomes_true(lambda: grade() == "panel bad"), "whatever may steer, it may not drive")
        tops = browser.run("return ['steer', 'stop-line'].map((id) => "
                           "document.getElementById(id).getBoundingClientRect().top)")
        self.assertEqual(tops[0], tops[1], "the stop stands beside what may steer")
        # On a busy machine an answer may be late, which the line says, too.
        stands = lambda: re.search(r"^Obstacle stop: STOP\. [A-Z].* s\. [A-Z].*\.$", self.text(browser, "stop-line"))
        self.assertTrue(live_peer.becomes_true(stands), self.text(browser, "stop-line"))
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=10)
        self.addCleanup(connection.close)
        connection.request("GET", "/map.png")
        picture = connection.getresponse().read()
        unknown = list(picture[picture.index(b"PLTE") + 4:][:3])
        for theme in ("light", "dark"):
            browser.run(f"document.documentElement.dataset.theme = '{theme}'; roadway.draw()")
            ground = browser.run("return Array.from(document.getElementById('roadway').getContext('2d')"
                                 ".getImageData(3, 3, 1, 1).data)")
            self.assertEqual(ground, unknown + [255], "beside the map all is unknown")
        browser.run("document.documentElement.dataset.theme = 'light'")
        with tempfile.TemporaryDirectory() as folder:
            browser.cdp("Browser.setDownloadBehavior", behavior="allow", downloadPath=folder)
            browser.run("document.getElementById('roadway-png').click()")
            self.assertTrue(live_peer.becomes_true(lambda: list(pathlib.Path(folder).glob("*_roadway.png"))))
        browser.run("document.getElementById('roadway-zoom').click()")
        self.assertEqual(self.text(browser, "roadway-zoom"), "Whole map")
        browser.run("page.paused = true; roadway.place_heard_ms -= 1e5; roadway.show_place()")
        self.assertEqual(self.text(browser, "place-line"), "Paused: map and place stand still.")
        browser.run("page.paused = false")
        if PICTURES:
            time.sleep(0.5)
            browser.run("document.getElementById('roadway-panel').scrollIntoView()")
            browser.screenshot(f"{PICTURES}_roadway_en.png")
        browser.run("document.getElementById('language').click(); document.documentElement.dataset.theme = 'dark'")
        self.assertTrue(live_peer.becomes_true(lambda: re.search("障碍停车：停车。 .*，已 [0-9.]+ 秒。.*。$",
                                                                 self.text(browser, "stop-line"))))
        self.assertTrue(live_peer.becomes_true(lambda: "位置：已知" in self.text(browser, "place-line")))
        for bad in ("undefined", "NaN", "[object"):
            self.assertNotIn(bad, browser.run("return document.body.innerText"))
        if PICTURES:
            browser.screenshot(f"{PICTURES}_roadway_zh.png")
        errors = [entry["message"] for entry in browser.log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(errors, [])
        self.daemon.kill()
        self.assertTrue(live_peer.becomes_true(lambda: "没有应答" in self.text(browser, "stop-line")))
        self.assertTrue(live_peer.becomes_true(lambda: "没有新的扫描" in self.text(browser, "place-line")))

    def test_it_lives(self):
        browser = self.browser()
        first, began = self.shown(browser), time.monotonic()
        self.assertTrue(live_peer.becomes_true(lambda: self.shown(browser) >= first + 3 * RATE_HZ))
        rate = (self.shown(browser) - first) / (time.monotonic() - began)
        print(f"{rate:.1f} frames a second shown of {RATE_HZ}")
        self.assertIn("Live: frame", self.text(browser, "link"))
        self.assertRegex(self.text(browser, "steer-may"), "^May steer: ")
        self.assertIn("roll (+ right side down)", self.text(browser, "tiles"))
        self.assertIn("sampling point", self.text(browser, "mount"))
        self.assertIn("body box 1", self.text(browser, "mount"))
        self.assertTrue(live_peer.becomes_true(lambda: "source replay" in self.text(browser, "health")))
        for canvas in ("top", "section", "chart-yaw"):
            self.assertTrue(self.is_drawn(browser, canvas), canvas)
        self.assertTrue(browser.run("return document.getElementById('roadway-panel').hidden"), "there is no map")
        if PICTURES:
            browser.run("document.documentElement.dataset.theme = 'light'")
            time.sleep(0.6)  # for the picture alone
            browser.screenshot(f"{PICTURES}_light_en.png")
        browser.run("document.getElementById('language').click(); document.documentElement.dataset.theme = 'dark'")
        self.assertTrue(live_peer.becomes_true(lambda: "实时" in self.text(browser, "link")))
        self.assertTrue(live_peer.becomes_true(lambda: "右侧下倾" in self.text(browser, "tiles")))
        shown = browser.run("return document.body.innerText")
        for bad in ("undefined", "NaN", "[object"):
            self.assertNotIn(bad, shown)
        if PICTURES:
            browser.screenshot(f"{PICTURES}_dark_zh.png")
        browser.run("document.getElementById('pause').click()")
        time.sleep(0.5)
        still = self.shown(browser)
        time.sleep(1)
        self.assertEqual(self.shown(browser), still, "paused")
        errors = [entry["message"] for entry in browser.log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(errors, [])
        asked = [a for a in check_report_page.requests_made(browser)
                 if not a.startswith((f"http://127.0.0.1:{self.port}/", "data:"))]
        self.assertEqual(asked, [])

    def test_it_says_when_it_is_not_live_and_comes_back(self):
        browser = self.browser(820, 1180)
        if PICTURES:
            browser.screenshot(f"{PICTURES}_tablet.png")
        wide = browser.run("return document.documentElement.scrollWidth - window.innerWidth")
        self.assertLessEqual(wide, 0, "nothing sticks out of a tablet")
        self.daemon.kill()
        self.assertTrue(live_peer.becomes_true(lambda: "Connection lost" in self.text(browser, "link")))
        self.assertTrue(browser.run("return document.body.classList.contains('waiting')"))
        if PICTURES:
            browser.screenshot(f"{PICTURES}_lost.png")
        before = self.shown(browser)
        self.daemon = live_peer.Program(*words(self.port))
        self.assertTrue(live_peer.becomes_true(lambda: self.shown(browser) > before + 5), self.daemon.log())
        self.assertIn("Live: frame", self.text(browser, "link"))
        self.assertFalse(browser.run("return document.body.classList.contains('waiting')"))

    def test_four_browsers_see_the_same(self):
        browsers = [self.browser() for _ in range(4)]
        first = [self.shown(browser) for browser in browsers]
        gained = lambda: [self.shown(browser) - before for browser, before in zip(browsers, first)]
        self.assertTrue(live_peer.becomes_true(lambda: min(gained()) > 3), gained())

    def test_silence_of_the_sensor_is_told(self):
        self.daemon.kill()
        road = live_peer.simulated_road(POSE_WALL)
        port = live_peer.free_port(socket.SOCK_DGRAM)
        self.daemon = live_peer.Program(POSE_WALLD, "--config", road / "pose_wall.yaml", "--set", f"udp_port={port}",
                                        "--http", f"127.0.0.1:{self.port}")
        self.assertTrue(self.daemon.says("listens"), self.daemon.log())
        browser = check_report_page.Browser(1400, 2000, "127.0.0.1")
        self.addCleanup(browser.close)
        browser.open(f"http://127.0.0.1:{self.port}/")
        self.assertTrue(live_peer.becomes_true(lambda: "No frame from the sensor" in self.text(browser, "link")))
        states = browser.run("return Array.from(document.querySelectorAll('.tile .state'), (x) => x.textContent)")
        self.assertEqual(len(states), 7)
        self.assertTrue(all(state.startswith("invalid") for state in states), states)
        self.assertEqual(self.text(browser, "steer-may"), "May steer: none.")
        self.assertEqual(browser.run("return document.getElementById('steer').className"), "panel bad")


if __name__ == "__main__":
    live_peer.main()
