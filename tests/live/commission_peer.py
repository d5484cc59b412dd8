#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Commissioning from the page, by HTTP as an attacker and as a careless page would, and in a browser as a technician
does: code, record, examine, draw, check, save, start anew. Who has no code changes nothing, and nobody changes what was
not checked and confirmed. Beyond it: names, logins and HTTPS of the page's server.

usage: commission_peer.py ROOT POSE_WALL POSE_WALLD [SCREENSHOT_PREFIX]"""

import base64
import contextlib
import http.client
import json
import pathlib
import socket
import ssl
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT, POSE_WALL, POSE_WALLD = pathlib.Path(sys.argv.pop(1)), sys.argv.pop(1), sys.argv.pop(1)
PICTURES = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else ""
sys.path[:0] = [str(ROOT / "tests/live"), str(ROOT / "tests/checks")]

import check_report_page  # noqa: E402  pylint: disable=wrong-import-position
import live_peer  # noqa: E402  pylint: disable=wrong-import-position

JSON = {"Content-Type": "application/json"}
ALL_CONFIRMED = {"ahead": True, "mounting": True, "boxes": True}
RECORDED_S = 3
STEP_S = 120  # far above what a step takes on a slow machine


class Daemon:
    """With a road that goes round, its own folder, and what a page knows of it."""

    def __init__(self, test, *more, http_place="127.0.0.1", scheme=http.client.HTTPConnection, scene="nominal"):
        self.port, self.cookie, self.scheme = live_peer.free_port(), "", scheme
        self.road = live_peer.simulated_road(POSE_WALL, scene=scene)
        self.words = live_peer.replay_words(POSE_WALLD, self.road, "--http", f"{http_place}:{self.port}", *more)
        self.program = live_peer.Program(*self.words)
        test.addCleanup(self.program.kill)

    def ask(self, method, path, message=None, headers=None, body=None):
        connection = self.scheme("127.0.0.1", self.port, timeout=20)
        with contextlib.closing(connection):
            known = {"Cookie": self.cookie} if self.cookie else {}
            sent = body if body is not None else None if message is None else json.dumps(message)
            kind = JSON if sent is not None else {}
            connection.request(method, path, sent, {**kind, **known, **(headers or {})})
            answer = connection.getresponse()
            return answer, answer.read()

    def status(self, *words, **more):
        return self.ask(*words, **more)[0].status


class Commissioned(Daemon):
    def __init__(self, test, *more, **options):
        self.home = tempfile.TemporaryDirectory()
        test.addCleanup(self.home.cleanup)
        super().__init__(test, "--set", "commissioning=1", "--set", f"commissioned={self.home.name}", *more,
                         **options)
        assert self.program.says("runtime: measures"), self.program.log()

    def code(self):
        told = [line for line in self.program.lines if "opens the page once is " in line]
        return told[-1].rsplit(" ", 1)[1]

    def open(self, code=None):
        time.sleep(0.6)  # one try in half a second
        answer, _ = self.ask("POST", "/commissioning/open", {"code": code or self.code()})
        if answer.status == 200:
            self.cookie = answer.headers["Set-Cookie"].split(";")[0]
        return answer

    def state(self):
        return json.loads(self.ask("GET", "/commissioning.json")[1])

    def step(self, name, message=None):
        """Asks for it and waits; what the state is then."""
        answer, told = self.ask("POST", f"/commissioning/{name}", message or {})
        assert answer.status == 202, (name, answer.status, told)
        assert live_peer.becomes_true(lambda: self.state()["busy"] == "", STEP_S), self.program.log()
        return self.state()


class Http(unittest.TestCase):
    def test_without_the_key_there_is_nothing_to_commission(self):
        daemon = Daemon(self)
        self.assertTrue(daemon.program.says("runtime: measures"))
        self.assertEqual(daemon.status("GET", "/commissioning.json"), 404)
        for step in ("open", "record", "save", "restart"):
            self.assertEqual(daemon.status("POST", f"/commissioning/{step}", {}), 405, step)

    def test_who_has_no_code_changes_nothing(self):
        daemon = Commissioned(self)
        self.assertEqual(daemon.state(), {"schema": 1, "open": False}, "nothing is told")
        for step in ("record", "examine", "check", "save", "restart"):
            self.assertEqual(daemon.status("POST", f"/commissioning/{step}", {}), 403, step)
        for path in ("/commissioning/report.html", "/commissioning/evidence.zip"):
            self.assertEqual(daemon.status("GET", path), 403, path)
        self.assertEqual(daemon.open("AAAAA-AAAAA").status, 403)
        at_once = daemon.status("POST", "/commissioning/open", {"code": daemon.code()})
        self.assertEqual(at_once, 429, "right, but too soon")
        daemon.cookie = "pose_wall_commissioning="
        self.assertFalse(daemon.state()["open"], "an empty token is none")
        self.assertEqual(daemon.status("POST", "/", {}), 405)

    def test_a_code_opens_one_page(self):
        daemon = Commissioned(self)
        code = daemon.code()
        answer = daemon.open(code.lower().replace("-", " "))
        self.assertEqual(answer.status, 200, "as people type it")
        self.assertRegex(answer.headers["Set-Cookie"], "HttpOnly; SameSite=Strict$")
        self.assertTrue(daemon.state()["open"])
        self.assertNotEqual(daemon.code(), code)
        first = daemon.cookie
        self.assertEqual(daemon.open(code).status, 403, "it was used")
        self.assertEqual(daemon.open().status, 200)
        second, daemon.cookie = daemon.cookie, first
        self.assertFalse(daemon.state()["open"], "the other page took over")
        daemon.cookie = second
        self.assertTrue(daemon.state()["open"])

    def test_messages_that_are_none(self):
        daemon = Commissioned(self)
        self.assertEqual(daemon.open().status, 200)
        place = ("POST", "/commissioning/check")
        self.assertEqual(daemon.status(*place, body="{", headers=JSON), 400)
        self.assertEqual(daemon.status(*place, body="[]", headers=JSON), 400)
        of_a_form = daemon.status(*place, body="{}", headers={"Content-Type": "text/plain"})
        self.assertEqual(of_a_form, 415, "on a page of others")
        self.assertEqual(daemon.status(*place, body="x" * 70000, headers=JSON), 413)
        self.assertEqual(daemon.status(*place, body=""), 411)
        for seconds in (-1, 0, 1e9, "30", None):
            self.assertIn(daemon.status("POST", "/commissioning/record", {"seconds": seconds}), (400, 409), seconds)
        # A message that comes byte by byte, and one that never ends, hold up nobody.
        with socket.create_connection(("127.0.0.1", daemon.port), 10) as slow:
            slow.sendall(f"POST /commissioning/check HTTP/1.1\r\nHost: localhost\r\nCookie: {daemon.cookie}\r\n"
                         "Content-Type: application/json\r\nContent-Length: 100\r\n\r\n{".encode())
            for _ in range(3):
                slow.sendall(b" ")
                self.assertEqual(daemon.status("GET", "/health"), 200)
            self.assertLess(daemon.program.stop(), 1.0)
        self.assertEqual(daemon.program.process.returncode, 0)

    def test_the_steps_in_their_order(self):
        daemon = Commissioned(self)
        self.assertEqual(daemon.open().status, 200)
        for step, message in (("examine", {}), ("check", {"changes": {}}), ("save", {})):
            self.assertEqual(daemon.status("POST", f"/commissioning/{step}", message), 409, step)
        state = daemon.step("record", {"seconds": RECORDED_S})
        self.assertEqual(state["error"], "")
        self.assertGreater(state["recorded"]["clouds"], RECORDED_S)
        self.assertEqual(daemon.status("POST", "/commissioning/check", {"changes": {}}), 409, "not examined")
        state = daemon.step("examine", {"language": "zh"})
        self.assertRegex(state["examined"]["because"], "[\u4e00-\u9fff]", "in the page's language")
        self.assertEqual(state["examined"]["grade"], "in_part", "three seconds are short")
        self.assertEqual(set(state["to_confirm"]), set(ALL_CONFIRMED))
        for key, value in (("http", "0.0.0.0:80"), ("recording", "/etc"), ("no_such_key", "1"), ("planar", "off"),
                           ("wall_inlier_min", "many"), ("base_frame", "x\nhttp: 0.0.0.0:80"),
                           ("body_box_1", "1 0 0 1 0 1")):
            with self.subTest(key=key):
                state = daemon.step("check", {"changes": {key: value}})
                self.assertIn(key, state["error"])
                self.assertIsNone(state["checked"])
        state = daemon.step("check", {"changes": {"forward_axis": "-X"}})
        self.assertIn("ahead_otherwise", state["to_confirm"], "the recording shows +X, or the settings say so")
        turned = {"by": "Li", "confirmed": ALL_CONFIRMED, "config_crc32": state["checked"]["config_crc32"]}
        self.assertEqual(daemon.status("POST", "/commissioning/save", turned), 409)
        changes = {"wall_inlier_min": "800", "body_box_2": "1 1.5 -0.2 0.2 -0.3 0.3"}
        state = daemon.step("check", {"changes": changes})
        self.assertEqual(state["error"], "")
        self.assertEqual(state["checked"]["changes"], changes)
        self.assertTrue([line for line in state["checked"]["told"] if line.startswith("may steer: ")], state["checked"])
        answer, report = daemon.ask("GET", "/commissioning/report.html")
        self.assertEqual(answer.headers.get_all("Content-Security-Policy")[0][:21], "sandbox allow-scripts")
        self.assertEqual(len(answer.headers.get_all("Content-Security-Policy")), 1)
        self.assertIn(b"</html>", report[-200:])
        crc = state["checked"]["config_crc32"]
        good = {"by": "Li", "confirmed": ALL_CONFIRMED, "config_crc32": crc}
        for wrong in ({"by": ""}, {"confirmed": {**ALL_CONFIRMED, "boxes": False}}, {"confirmed": {}},
                      {"config_crc32": crc + 1}, {"config_crc32": None}):
            self.assertEqual(daemon.status("POST", "/commissioning/save", {**good, **wrong}), 409, wrong)
        self.assertFalse((pathlib.Path(daemon.home.name) / "settings.yaml").exists(), "nothing was saved")
        state = daemon.step("save", good)
        self.assertEqual(state["error"], "")
        saved = (pathlib.Path(daemon.home.name) / "settings.yaml").read_text(encoding="utf-8")
        self.assertIn("wall_inlier_min: 800", saved)
        answer, evidence = daemon.ask("GET", "/commissioning/evidence.zip")
        self.assertEqual((answer.status, evidence[:2]), (200, b"PK"))
        crc_before = self.config_crc(daemon)
        self.assertNotEqual(crc_before, crc)
        pid = daemon.program.process.pid
        self.assertEqual(daemon.ask("POST", "/commissioning/restart", {})[0].status, 202)
        self.assertTrue(live_peer.becomes_true(lambda: self.config_crc(daemon) == crc), daemon.program.log())
        self.assertIsNone(daemon.program.process.poll(), "it is the same process")
        self.assertEqual(pid, daemon.program.process.pid)
        self.assertFalse(daemon.state()["open"], "a new start takes a new code")
        self.assertTrue(daemon.program.says("body_box_2: 1 1.5 -0.2 0.2 -0.3 0.3 (" + daemon.home.name))
        # Saved settings are the ground of the next ones.
        self.assertEqual(daemon.open().status, 200)
        daemon.step("record", {"seconds": RECORDED_S})
        daemon.step("examine")
        state = daemon.step("check", {"changes": {"body_box_2": ""}})
        self.assertEqual(state["error"], "")
        trial = (pathlib.Path(daemon.home.name) / "trial" / "settings.yaml").read_text(encoding="utf-8")
        self.assertIn("wall_inlier_min: 800", trial)
        self.assertIn("body_box_2: []", trial)

    def config_crc(self, daemon):
        with contextlib.suppress(OSError, ValueError, http.client.HTTPException):
            return json.loads(daemon.ask("GET", "/state.json")[1]).get("config_crc32")
        return None

    def test_what_stands_on_the_command_line_is_not_changed_in_vain(self):
        daemon = Commissioned(self, "--set", "wall_inlier_min=700")
        self.assertEqual(daemon.open().status, 200)
        daemon.step("record", {"seconds": RECORDED_S})
        daemon.step("examine")
        self.assertIn("--set", daemon.step("check", {"changes": {"wall_inlier_min": "800"}})["error"])

    def test_a_recording_without_clouds_says_so(self):
        daemon = Commissioned(self)
        self.assertEqual(daemon.open().status, 200)
        # Its folder is gone, as when a disk is taken out: the daemon measures on.
        subprocess.run(["rm", "-rf", f"{daemon.home.name}/recording"], check=True)
        pathlib.Path(daemon.home.name, "recording").write_text("in the way", encoding="utf-8")
        state = daemon.step("record", {"seconds": 2})
        self.assertNotEqual(state["error"], "")
        self.assertIsNone(state["recorded"])
        self.assertEqual(daemon.status("GET", "/state.json"), 200)

    def test_a_sensor_that_is_silent_meanwhile_makes_no_recording(self):
        daemon = Commissioned(self, "--speed", "0.05")  # a cloud in two seconds
        self.assertEqual(daemon.open().status, 200)
        state = daemon.step("record", {"seconds": 5})
        self.assertIn("the sensor was silent", state["error"])
        self.assertIsNone(state["recorded"])
        self.assertEqual(daemon.status("POST", "/commissioning/examine", {}), 409)

    def test_a_recording_of_no_use_is_saved_only_by_who_says_so(self):
        daemon = Commissioned(self, scene="cavern")  # there is no road
        self.assertEqual(daemon.open().status, 200)
        daemon.step("record", {"seconds": RECORDED_S})
        state = daemon.step("examine")
        self.assertEqual(state["examined"]["grade"], "not")
        state = daemon.step("check", {"changes": {}})
        self.assertEqual(state["to_confirm"], [*ALL_CONFIRMED, "not_usable"])
        good = {"by": "Li", "confirmed": ALL_CONFIRMED, "config_crc32": state["checked"]["config_crc32"]}
        answer, told = daemon.ask("POST", "/commissioning/save", good)
        self.assertEqual((answer.status, json.loads(told)["error"]), (409, "not all is confirmed: tick every box"))
        self.assertEqual(daemon.step("save", {**good, "confirmed": {**ALL_CONFIRMED, "not_usable": True}})["error"], "")

    def test_rules_over_the_keys(self):
        for settings, needle in ((["commissioning=1", "http=127.0.0.1:1"], "commissioned"),
                                 (["commissioning=1", "commissioned=/tmp/x"], "http"),
                                 (["commissioning=1", "commissioned=/tmp/x", "http=0.0.0.0:1"], "http_certificate"),
                                 (["http=0.0.0.0:1", "http_login=/tmp/x"], "http_certificate")):
            done = subprocess.run([POSE_WALLD, *(word for one in settings for word in ("--set", one))], text=True,
                                  capture_output=True, check=False)
            self.assertEqual(done.returncode, 2, settings)
            self.assertIn(needle, done.stderr)


class Access(unittest.TestCase):
    def test_names_beyond_loopback(self):
        daemon = Daemon(self, "--set", "http_names=roadheader7.mine other", http_place="0.0.0.0")
        self.assertTrue(daemon.program.says("runtime: measures"), daemon.program.log())
        for host, status in (("evil.example", 421), ("roadheader7.mine", 200), ("other:8080", 200),
                             ("10.1.2.3:8080", 200), ("[::1]:80", 200), (socket.gethostname(), 200),
                             ("roadheader7.mine.evil.example", 421), ("10.1.2.3.evil.example", 421)):
            self.assertEqual(daemon.status("GET", "/health", headers={"Host": host}), status, host)

    def login_file(self, folder, password):
        hashed = subprocess.run(["openssl", "passwd", "-6", password], check=True, capture_output=True,
                                text=True).stdout
        path = pathlib.Path(folder, "logins")
        path.write_text(f"# who may look\nli:{hashed}", encoding="utf-8")
        return path

    def basic(self, words):
        return {"Authorization": "Basic " + base64.b64encode(words.encode()).decode()}

    def test_a_login_is_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            daemon = Daemon(self, "--set", f"http_login={self.login_file(folder, 'Schacht 7: tief')}")
            self.assertTrue(daemon.program.says("runtime: measures"), daemon.program.log())
            answer, _ = daemon.ask("GET", "/")
            self.assertEqual((answer.status, answer.headers["WWW-Authenticate"][:5]), (401, "Basic"))
            for path in ("/events", "/state.json", "/health", "/nothing"):
                self.assertEqual(daemon.status("GET", path), 401, path)
            right, wrong = self.basic("li:Schacht 7: tief"), self.basic("li:schacht")
            for words in (wrong, self.basic("wang:Schacht 7: tief"), {"Authorization": "Basic ?"}):
                time.sleep(0.3)  # one try in a fifth of a second
                self.assertEqual(daemon.status("GET", "/health", headers=words), 401, words)
            time.sleep(0.3)
            self.assertEqual(daemon.status("GET", "/health", headers=right), 200)
            answers = [daemon.status("GET", "/health", headers=self.basic(f"li:{k}")) for k in range(10)]
            self.assertIn(429, answers, "guesses come one after the other")
            self.assertEqual(daemon.status("GET", "/health", headers=right), 200, "who is known is not kept waiting")

    def test_https_with_a_certificate_of_its_own(self):
        with tempfile.TemporaryDirectory() as folder:
            pem = pathlib.Path(folder, "page.pem")
            live_peer.self_signed_page(pem, pathlib.Path(folder, "cert"))
            trust = ssl.create_default_context(cafile=f"{folder}/cert")
            daemon = Daemon(self, "--set", f"http_certificate={pem}", scheme=lambda host, port, timeout:
                            http.client.HTTPSConnection(host, port, timeout=timeout, context=trust))
            self.assertTrue(daemon.program.says("runtime: measures"), daemon.program.log())
            self.assertTrue(daemon.program.says("https://127.0.0.1"))
            self.assertTrue(live_peer.becomes_true(lambda: daemon.status("GET", "/state.json") == 200))
            answer, page = daemon.ask("GET", "/page.js")
            self.assertEqual(answer.status, 200)
            self.assertEqual(len(page), int(answer.headers["Content-Length"]))
            with socket.create_connection(("127.0.0.1", daemon.port), 10) as plain:
                secure = trust.wrap_socket(plain, server_hostname="127.0.0.1")
                secure.sendall(b"GET /events HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n")
                seen = b""
                while seen.count(b"event: frame\n") < 3:
                    seen += secure.recv(1 << 16)
                self.assertLess(daemon.program.stop(), 1.0)
            self.assertEqual(daemon.program.process.returncode, 0)

    def test_files_of_no_use_end_the_start(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "file")
            for key, text, needle in (("http_login", None, "No such file"), ("http_login", "", "NAME:HASH"),
                                      ("http_login", "li:secret\n", "file:1"),
                                      ("http_certificate", "x", "BEGIN CERTIFICATE")):
                path.unlink(missing_ok=True)
                if text is not None:
                    path.write_text(text, encoding="utf-8")
                done = subprocess.run([POSE_WALLD, "--http", f"127.0.0.1:{live_peer.free_port()}",
                                       "--set", f"{key}={path}"],
                                      text=True, capture_output=True, check=False, timeout=60)
                self.assertEqual(done.returncode, 1, (key, text))
                self.assertIn(f"{key}: ", done.stderr)
                self.assertIn(needle, done.stderr)


class InABrowser(unittest.TestCase):
    def setUp(self):
        if not live_peer.program("chromedriver"):
            self.skipTest("SKIPPED: there is no chromedriver (packages chromium, chromium-driver)")

    def test_a_technician_commissions_in_chinese_on_a_tablet(self):
        daemon = Commissioned(self)
        browser = check_report_page.Browser(768, 1400, "127.0.0.1")
        self.addCleanup(browser.close)
        browser.open(f"http://127.0.0.1:{daemon.port}/")
        panel = "document.getElementById('commission')"

        def become(script, patience=live_peer.PATIENCE_S):
            is_so = live_peer.becomes_true(lambda: browser.run(f"return Boolean({script})"), patience)
            self.assertTrue(is_so, script)

        def click(text):
            browser.run(f"[...{panel}.querySelectorAll('button')].find((b) => b.textContent === '{text}').click()")

        def picture(name):
            if PICTURES:
                browser.screenshot(f"{PICTURES}commission_{name}.png")

        become("page.shown > 3")
        browser.run("if (page.language !== 'zh') document.getElementById('language').click()")
        become(f"!{panel}.hidden && {panel}.textContent.includes('代码')")
        browser.run(f"{panel}.querySelector('input').value = '{daemon.code()}'")
        click("进入")
        become(f"{panel}.textContent.includes('录制 30 秒')")
        browser.run(f"commission.ask('record', {{ seconds: {RECORDED_S} }})")  # half a minute less to wait
        become("commission.state.recorded", STEP_S)
        self.assertFalse(browser.run("return Boolean(commission.canvas.isConnected)"), "nothing to draw yet")
        click("分析")
        become("commission.state.examined", STEP_S)
        become(f"{panel}.querySelector('.use')")
        become("commission.scene && (commission.scene.fault || commission.scene.drawn > 0)")
        picture("examined")
        click("添加机身框")
        click("-X")
        ahead = browser.run("return commission.outline().ahead")
        self.assertEqual(ahead, [-1, 0, 0])
        click("+X")
        click("试算")
        become("commission.is_checked()", STEP_S)
        become(f"/可用于控制：/.test({panel}.querySelector('pre').textContent)")
        self.assertRegex(browser.run(f"return {panel}.textContent"), "设置的 CRC：16#[0-9A-F]{8}")
        picture("checked")
        click("保存")
        become(f"{panel}.textContent.includes('缺少调试人姓名')")
        refusal = browser.run(f"const line = {panel}.querySelector('[role=alert]'), box = line.getBoundingClientRect();"
                              "return [line.textContent, line.previousElementSibling.textContent,"
                              " box.top >= 0 && box.bottom <= innerHeight]")
        self.assertEqual(refusal, ["缺少调试人姓名", "保存", True], "beside the button, in sight")
        # In the other language the sentences of the command are fetched anew, and nothing that was drawn is lost.
        drawn = browser.run("return JSON.stringify(commission.draft.boxes)")
        browser.run("document.getElementById('language').click()")
        become("commission.state.checked && commission.state.checked.told.some((line) => /^may steer: /.test(line))",
               STEP_S)
        self.assertRegex(browser.run(f"return {panel}.innerText"), "(?s)Sensor in the machine.*roll")
        browser.run("document.getElementById('language').click()")
        become("commission.state.checked && commission.state.checked.told.some((line) => /^可用于控制：/.test(line))",
               STEP_S)
        self.assertEqual(browser.run("return JSON.stringify(commission.draft.boxes)"), drawn)
        self.assertNotRegex(browser.run("return Array.from(document.querySelectorAll('#commission label'), "
                                        "(x) => x.textContent).join()"), "roll|pitch|yaw")
        browser.run("commission.by = '李工'; commission.shown = ''; commission.show()")
        browser.run(f"for (const box of {panel}.querySelectorAll('.commission-confirm input')) box.click()")
        click("保存")
        become("commission.state.saved || commission.state.error", STEP_S)
        self.assertEqual(browser.run("return commission.state.error"), "")
        picture("saved")
        crc = browser.run("return commission.state.saved.config_crc32")
        click("用这些设置重新启动")
        become("!commission.state.open", STEP_S)
        become("document.getElementById('link').textContent.startsWith('实时')")
        self.assertEqual(json.loads(daemon.ask("GET", "/state.json")[1])["config_crc32"], crc)
        scrolls = browser.run("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
        self.assertLessEqual(scrolls, 0, "nothing is wider than the screen")


if __name__ == "__main__":
    live_peer.main()
