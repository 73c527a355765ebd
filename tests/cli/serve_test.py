"""tidemark serve: what viewers get and may do, by a client over plain sockets, and who is not let in."""
import os
import signal
import socket
import subprocess
import time

from support import png
from support.program import PROGRAM, TIME_LIMIT, ProgramTest, environment, main
from support.websocket import BINARY, TEXT, Service, Viewer, ask

# Smooth, as JPEG likes it, and still.
GRADIENT = """\
#iUniform float blue = 0.25 in { 0.0, 1.0 }
#define GREEN 1.0
void mainImage(out vec4 c, in vec2 p) {
    vec2 uv = p / iResolution.xy;
    c = vec4(uv.x, uv.y * GREEN, iMouse.z > 0.0 ? 1.0 : blue, 1.0);
}
"""
MOVING = "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(iTime), p / iResolution.xy, 1.0); }\n"
KEYBOARD = "#iKeyboard\n#iChannel0 \"keyboard\"\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(texelFetch(iChannel0, ivec2(65, 0), 0).x); }\n"


class Serve(ProgramTest):
    def serve(self, scene: str, *options: str, text: str = "", **variables: str) -> Service:
        if text:
            self.write(scene, text)
        service = Service(self.folder, scene, "--size", "64x36", *options, **variables)
        self.addCleanup(service.close)
        return service

    def viewer(self, service: Service, **arguments) -> Viewer:
        viewer = service.viewer(**arguments)
        self.addCleanup(viewer.close)
        return viewer

    def pixels(self, file: bytes) -> list[bytes]:
        """Rows from the top, RGB, of a JPEG file: OpenImageIO's idea of it, by way of a scene."""
        self.write("seen.jpg", file)
        self.write("seen.glsl", '#iChannel0 "seen.jpg"\nvoid mainImage(out vec4 c, in vec2 p)'
                                " { c = texelFetch(iChannel0, ivec2(p), 0); }\n")
        self.succeed("capture", "seen.glsl", "--size", "64x36", "-o", "seen.png")
        return png.read(self.folder / "seen.png").rows

    def assert_shows(self, file: bytes, *options: str, most: int = 6) -> None:
        """What capture draws, but for what JPEG leaves of it."""
        self.succeed("capture", "a.glsl", "--size", "64x36", *options, "-o", "drawn.png")
        drawn, seen = png.read(self.folder / "drawn.png").rows, self.pixels(file)
        self.assertEqual([len(row) for row in drawn], [len(row) for row in seen])
        worst = max(abs(a - b) for one, other in zip(drawn, seen) for a, b in zip(one, other))
        self.assertLessEqual(worst, most)

    def seen_until(self, viewer: Viewer, wanted) -> bytes:
        """The first picture whose middle pixel is `wanted`."""
        while True:
            _, file = viewer.picture()
            rows = self.pixels(file)
            if wanted(*rows[18][3 * 32:3 * 32 + 3]):
                return file


class Pictures(Serve):
    def test_equal_those_of_capture(self):
        viewer = self.viewer(self.serve("a.glsl", "--quality", "95", text=GRADIENT))
        head, file = viewer.picture()
        self.assertEqual((head["number"], head["frame"], len(head["costs"])), (1, 0, 1))
        self.assert_shows(file)

    def test_still_pictures_are_sent_once(self):
        viewer = self.viewer(self.serve("a.glsl", text=GRADIENT))
        viewer.picture()
        viewer.send("turn", name="blue", value=[0.75])
        head, _ = viewer.picture()
        self.assertEqual(head["number"], 2)
        viewer.send("turn", name="blue", value=[0.5])
        self.assertEqual(viewer.picture()[0]["number"], 3, "none was sent between")

    def test_moving_pictures_wait_for_acknowledgement(self):
        service = self.serve("a.glsl", text=MOVING)
        viewer = self.viewer(service)
        numbers = [viewer.picture()[0]["number"] for _ in range(5)]
        self.assertEqual(sorted(set(numbers)), numbers)
        slow = self.viewer(service)
        first = [slow.picture(seen=False)[0]["number"] for _ in range(2)]
        viewer.send("seen", number=1)
        later = [viewer.picture()[0]["number"] for _ in range(20)]
        slow.send("seen", number=first[-1])
        newest = slow.picture()[0]["number"]
        self.assertGreaterEqual(newest, later[-1], "one that was slow gets the newest")

    def test_skipped_frames_are_not_in_the_time_step(self):
        viewer = self.viewer(self.serve("a.glsl", text="void mainImage(out vec4 c, in vec2 p) { c = vec4(iTimeDelta / 8.0); }\n"))
        head, _ = viewer.picture(seen=False)
        second = viewer.picture(seen=False)[0]["number"]
        time.sleep(8)
        viewer.send("seen", number=max(head["number"], second))
        brightest = max(max(self.pixels(viewer.picture()[1])[0]) for _ in range(3))
        self.assertLess(brightest, 200, "iTimeDelta of 8 s is white")

    def test_another_pass_is_shown(self):
        self.write("a/image.glsl", '#iChannel0 "buffer_a.glsl"\nvoid mainImage(out vec4 c, in vec2 p)'
                                   " { c = vec4(0.0, texelFetch(iChannel0, ivec2(p), 0).x, 0.0, 1.0); }\n")
        self.write("a/buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0, 0.0, 0.0, 1.0); }\n")
        viewer = self.viewer(self.serve("a"))
        names = viewer.text("state", lambda state: state["pictures"])["pictures"]
        self.assertEqual(names, ["Buffer A", "Image"])
        self.seen_until(viewer, lambda r, g, b: g > 200 and r < 50)
        viewer.send("show", picture=0)
        self.seen_until(viewer, lambda r, g, b: r > 200 and g < 50)


    def test_time_of_a_frame_drawn_in_parts_covers_all_parts(self):
        """By the program's own clock: a slow frame is drawn over many turns of its loop, not in the last one."""
        slow = """\
void mainImage(out vec4 c, in vec2 p) {
    float x = 0.0;
    for (int i = 0; i < 60000; ++i)
        x += sin(float(i) * 0.01 + p.x + iMouse.x) * cos(p.y);
    c = vec4(fract(x));
}
"""
        viewer = self.viewer(self.serve("a.glsl", text=slow))
        viewer.picture()
        for i in range(3):  # the first frames are drawn whole, or may be
            viewer.send("press" if i == 0 else "move", x=1 + i, y=1, **({"button": "left"} if i == 0 else {}))
            head, _ = viewer.picture()
        self.assertGreaterEqual(head["draw"], head["costs"][0])


class Controls(Serve):
    def test_mouse_and_knobs(self):
        viewer = self.viewer(self.serve("a.glsl", "--quality", "95", text=GRADIENT))
        viewer.picture()
        viewer.send("press", button="left", x=32, y=18)
        self.seen_until(viewer, lambda r, g, b: b > 240)
        viewer.send("release", button="left", x=32, y=18)
        self.seen_until(viewer, lambda r, g, b: b < 100)
        viewer.send("turn", name="blue", value=[0.75])
        self.assert_shows(self.seen_until(viewer, lambda r, g, b: 150 < b < 230), "--set", "blue=0.75", "--mouse", "32,18")
        viewer.send("define", name="GREEN", value="0.0")
        self.seen_until(viewer, lambda r, g, b: g < 20)
        state = viewer.text("state", lambda state: any(each["held"] for each in state["definitions"]))
        self.assertEqual(state["definitions"], [{"name": "GREEN", "value": "0.0", "whole": False, "held": True}])

    def test_keys_of_the_scene(self):
        viewer = self.viewer(self.serve("a.glsl", text=KEYBOARD))
        viewer.text("state", lambda state: state["keyboard"])
        viewer.send("keydown", code=65)
        self.seen_until(viewer, lambda r, g, b: r > 200)
        viewer.send("let go")
        self.seen_until(viewer, lambda r, g, b: r < 50)

    def test_time(self):
        viewer = self.viewer(self.serve("a.glsl", text=MOVING))
        viewer.picture()
        viewer.send("pause")
        viewer.text("state", lambda state: state["time"]["paused"])
        viewer.send("seek", seconds=2.5)
        while viewer.picture()[0]["seconds"] != 2.5:
            pass

    def test_the_command_of_a_moment(self):
        viewer = self.viewer(self.serve("a.glsl", text=GRADIENT))
        viewer.picture()
        viewer.send("turn", name="blue", value=[0.5])
        viewer.picture()
        viewer.send("keydown", code=67)
        command = viewer.text("clipboard")
        self.assertRegex(command, r"^tidemark capture a\.glsl .*--set blue=0\.5")

    def test_shortcuts_of_the_window_are_ignored(self):
        """S would save a file on the other machine, Esc end the program."""
        service = self.serve("a.glsl", text=GRADIENT)
        viewer = self.viewer(service)
        viewer.picture()
        for code in (27, 83, 70, 77, 9, 13):
            viewer.send("keydown", code=code)
            viewer.send("keyup", code=code)
        viewer.send("turn", name="blue", value=[1.0])
        viewer.picture()
        self.assertEqual(sorted(os.listdir(self.folder)), ["a.glsl"])

    def test_unknown_names_are_ignored(self):
        viewer = self.viewer(self.serve("a.glsl", text=GRADIENT))
        viewer.picture()
        viewer.send("turn", name="nothing", value=[1])
        viewer.send("show", picture=99)
        viewer.send("undefine", name="nothing")
        viewer.send("turn", name="blue", value=[1, 2, 3, 4])
        self.seen_until(viewer, lambda r, g, b: b > 240)

    def test_recorded(self):
        service = self.serve("a.glsl", "--record", "hands.txt", text=GRADIENT)
        viewer = self.viewer(service)
        viewer.picture()
        viewer.send("press", button="left", x=10, y=20)
        viewer.picture()
        service.process.send_signal(signal.SIGINT)
        self.assertEqual(service.end()[0], 130)
        self.assertRegex((self.folder / "hands.txt").read_text(), r"(?m)^\d+ press left 10 20$")


ARRAY = """\
const int A = 4;
void mainImage(out vec4 c, in vec2 p) {
    float values[A];
    for (int i = 0; i < 2; ++i)
        values[(int(p.x) + i) % A] = float((-2147483647 - 1) / A);
    c = vec4(values[int(p.y) % A] < 0.0 ? 1.0 : 0.0);
}
"""


def nested(depth: int) -> str:
    """A structure of 2^depth numbers: the time of drivers doubles with each step."""
    return "struct S0 { float a; };\n" + "".join(f"struct S{i} {{ S{i - 1} a; S{i - 1} b; }};\n" for i in range(1, depth + 1)) + (
        f"void mainImage(out vec4 c, in vec2 p) {{ S{depth} s; c = vec4(0.5); }}\n")


class Crashes(Serve):
    def test_a_definition_is_compiled_in_another_process(self):
        """The driver divides by zero at compile time, or takes all memory: in a process of its own."""
        viewer = self.viewer(self.serve("a.glsl", "--memory", "1G", text=ARRAY))
        viewer.picture()
        for value, wrong in (("-1", "the driver crashed"), ("100000000", "takes more than 1 GiB of memory|no memory|too large|crashed")):
            with self.subTest(value):
                viewer.send("define", name="A", value=value)
                errors = viewer.text("state", lambda state: state["errors"])["errors"]
                self.assertRegex(errors[0]["text"], wrong)
                viewer.send("define", name="A", value="2")
                viewer.text("state", lambda state: not state["errors"])

    def test_an_endless_compilation_is_cancelled_by_the_next_save(self):
        viewer = self.viewer(self.serve("a.glsl", text=GRADIENT))
        viewer.picture()
        for depth in (40, 41, 42, 43):
            self.write("a.glsl", nested(depth))
            time.sleep(0.3)
        self.write("a.glsl", GRADIENT.replace("uv.x", "1.0"))
        self.seen_until(viewer, lambda r, g, b: r > 240)


class Viewers(Serve):
    def test_one_viewer_has_control(self):
        service = self.serve("a.glsl", text=GRADIENT)
        first = self.viewer(service)
        self.assertEqual(first.text("steering"), {"you": True, "viewers": 1})
        second = self.viewer(service)
        self.assertEqual(second.text("steering"), {"you": False, "viewers": 2})
        second.picture()
        second.send("turn", name="blue", value=[1.0])
        second.send("steer")
        self.assertEqual(second.text("steering"), {"you": True, "viewers": 2})
        self.assertEqual(first.text("steering", lambda steering: not steering["you"])["viewers"], 2)
        second.send("turn", name="blue", value=[0.5])
        state = second.text("state", lambda state: state["knobs"] and state["knobs"][0]["turned"])
        self.assertEqual(state["knobs"][0]["value"], [0.5], "what it did before it steered did nothing")
        second.close()
        self.assertEqual(first.text("steering", lambda steering: steering["you"]), {"you": True, "viewers": 1})

    def test_receive_the_saved_scene_and_its_errors(self):
        viewer = self.viewer(self.serve("a.glsl", text=GRADIENT))
        viewer.picture()
        self.write("a.glsl", GRADIENT.replace("uv.x", "nowhere"))
        errors = viewer.text("state", lambda state: state["errors"])["errors"]
        self.assertRegex(errors[0]["text"], r"^a\.glsl:5:\d+: error: .*nowhere")
        self.assertIn("nowhere", errors[0]["line"])
        self.assertTrue(errors[0]["mark"].endswith("^"))
        self.assertEqual(errors[-1]["text"], "error: 'a.glsl' does not compile", "said of the whole, behind the errors")
        self.write("a.glsl", "#define TWICE(x) (2.0 * nowhere(x))\n" + GRADIENT.replace("uv.x", "TWICE(uv.x) + there"))
        errors = viewer.text("state", lambda state: state["errors"] and len(state["errors"]) > 2)["errors"]
        places = [each["text"].split(": ")[0] for each in errors[:-1]]
        for before, place, error in zip(places, places[1:], errors[1:]):
            self.assertEqual(bool(error["line"] or error["mark"]), place != before, "no line twice in a row")
        self.write("a.glsl", GRADIENT.replace("uv.x", "1.0"))
        self.seen_until(viewer, lambda r, g, b: r > 240)
        viewer.text("state", lambda state: not state["errors"])

    def test_wait_for_a_scene_file(self):
        viewer = self.viewer(self.serve("a.glsl"))
        viewer.text("state", lambda state: state["errors"])
        self.write("a.glsl", GRADIENT)
        self.assert_shows(viewer.picture()[1], most=12)

    def test_the_last_viewer_ends_the_service_with_once(self):
        service = self.serve("a.glsl", "--once", text=GRADIENT)
        viewer = self.viewer(service)
        viewer.picture()
        viewer.close()
        self.assertEqual(service.end(), (0, ""))

    def test_may_reconnect(self):
        service = self.serve("a.glsl", text=GRADIENT)
        for _ in range(2):
            viewer = self.viewer(service)
            viewer.picture()
            viewer.close()
        service.process.send_signal(signal.SIGINT)
        self.assertEqual(service.end(), (130, ""))

    def test_are_limited_in_number(self):
        service = self.serve("a.glsl", text=GRADIENT)
        viewers = [self.viewer(service) for _ in range(16)]
        for viewer in viewers:
            viewer.picture(seen=False)
        closed = self.viewer(service).end()
        self.assertEqual((closed.code, closed.reason), (1013, "too many viewers already"))


class Access(Serve):
    def test_the_page(self):
        service = self.serve("a.glsl", text=GRADIENT)
        path = service.address.partition("/?")[2]
        status, page = ask(service.address, f"/?{path}")
        self.assertEqual(status, 200)
        self.assertTrue(page.startswith(b"<!doctype html>"))
        self.assertNotIn(service.address.partition("token=")[2].encode(), page)

    def test_is_refused_without_a_token(self):
        service = self.serve("a.glsl", text=GRADIENT)
        path = "/?" + service.address.partition("/?")[2]
        other = "0" * 22
        for what, headers, method, status in (
                ("/socket", {}, "GET", 403), (f"/?token={other}", {}, "GET", 403), (path, {"Host": "evil.example"}, "GET", 403),
                (path.replace("/?", "/etc/passwd?"), {}, "GET", 404), (path, {}, "POST", 405)):
            with self.subTest(what=what, method=method):
                self.assertEqual(ask(service.address, what, headers, method)[0], status)
        self.assertEqual(self.viewer(service, token=other).status, 403)
        self.assertEqual(self.viewer(service, token="").status, 403)
        self.assertEqual(self.viewer(service, Origin="http://evil.example").status, 403)
        self.assertEqual(self.viewer(service, Origin="http://" + service.address.split("/")[2]).status, 101)

    def test_pages_that_may_frame_it_and_forwarded_addresses(self):
        origin = "https://name-8080.example.dev"
        service = self.serve("a.glsl", "--frame-ancestor", "vscode-webview:", "--frame-ancestor", "https://*.vscode-cdn.net",
                             "--allow-origin", origin, text=GRADIENT)
        self.assertEqual(ask(service.address, "/", {"Host": "name-8080.example.dev"})[0], 200)
        self.assertEqual(self.viewer(service, Origin=origin).status, 101)
        self.assertEqual(self.viewer(service, Origin=origin + ":1").status, 403)
        self.expect_error(["serve", "a.glsl", "--frame-ancestor", "https:"], 2, "--frame-ancestor: 'https:' cannot frame")
        self.expect_error(["serve", "a.glsl", "--allow-origin", "example.dev"], 2, "--allow-origin: 'example.dev' is no origin")

    def test_texts_of_an_editor(self):
        self.write("a.glsl", GRADIENT)
        for lines, wrong in (("", "ended before the first line"), ("{}\n", "needs lines such as"), ("7\n", "needs lines such as"),
                             ('{"texts": {"a.glsl": 7}}\n', "needs lines such as")):
            with self.subTest(lines):
                self.assertIn("--editor: standard input " + wrong, self.refused("a.glsl", lines))
        self.assertIn("--editor: standard input cannot hold the scene, too", self.refused("-", GRADIENT))

    def refused(self, scene: str, texts: str) -> str:
        done = subprocess.run([PROGRAM, "serve", scene, "--editor"], cwd=self.folder, input=texts, capture_output=True, text=True,
                              env=environment(), timeout=TIME_LIMIT, check=False)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        return done.stderr

    def test_hostile_messages(self):
        service = self.serve("a.glsl", text=GRADIENT)
        for kind, data, code, reason in ((TEXT, b"x" * 5000, 1009, ""), (TEXT, b"{", 1008, "a message must be a JSON object"),
                                         (TEXT, b'{"do":"fly"}', 1008, '"do": give a known request'),
                                         (BINARY, b"{}", 1003, "a message must be text"), (TEXT, b"\xff\xfe", 1007, "")):
            with self.subTest(data=data[:20]):
                viewer = self.viewer(service)
                viewer.send_frame(kind, data)
                closed = viewer.end()
                self.assertEqual(closed.code, code)
                self.assertEqual(closed.reason, reason or closed.reason)
        self.viewer(service).picture()

    def test_hostile_requests(self):
        service = self.serve("a.glsl", text=GRADIENT)
        at = service.address.split("/")[2].split(":")
        for data in (b"\0" * 1000, b"GET / HTTP/1.1\r\nHost: " + b"a" * 100000, b"\r\n\r\n", b""):
            with socket.create_connection((at[0], int(at[1]))) as connection:
                try:
                    connection.sendall(data)
                except ConnectionError:
                    pass
        self.viewer(service).picture()

    def test_silent_connections_do_not_block_viewers(self):
        service = self.serve("a.glsl", text=GRADIENT)
        at = service.address.split("/")[2].split(":")
        mute = [socket.create_connection((at[0], int(at[1]))) for _ in range(100)]
        self.viewer(service).picture()
        for connection in mute:
            connection.settimeout(60)
            self.assertEqual(connection.recv(1), b"", "closed without a word")
            connection.close()

    def test_token(self):
        self.write("token", "0123456789abcdef\n")
        service = self.serve("a.glsl", "--token-file", "token", text=GRADIENT)
        self.assertTrue(service.address.endswith("/?token=0123456789abcdef"))
        self.viewer(service).picture()
        service = self.serve("a.glsl", TIDEMARK_TOKEN="fedcba9876543210")
        self.assertTrue(service.address.endswith("/?token=fedcba9876543210"))
        self.expect_failure(["serve", "a.glsl"], 2, "tidemark: error: the token has 5 characters: give 16 to 128 letters, digits, "
                            "- or _, as in `openssl rand -hex 16`", env=environment(TIDEMARK_TOKEN="short"))

    def test_host_and_port_to_listen_at(self):
        service = self.serve("a.glsl", text=GRADIENT)
        port = service.address.split("/")[2].split(":")[1]
        self.assertEqual(service.address.split("/")[2].split(":")[0], "127.0.0.1")
        self.expect_failure(["serve", "a.glsl", "--port", port], 2, f"tidemark: error: cannot listen at --host 127.0.0.1 --port {port}: "
                            "Address already in use")
        self.expect_error(["serve", "a.glsl", "--port", "65536"], 2, "--port", "65535", "'65536'")
        self.expect_error(["serve", "a.glsl", "--host", ""], 2, "--host ''", "0.0.0.0")
        self.expect_failure_like(["serve", "a.glsl", "--size", "65500x1"], 2, r"tidemark: error: --size 65500x1: this driver draws at most "
                                 r"\d+ pixels on a side")
        everywhere = self.serve("a.glsl", "--host", "0.0.0.0")
        self.assertTrue(everywhere.address.startswith(f"http://{socket.gethostname()}:"))
        everywhere.process.send_signal(signal.SIGTERM)
        self.assertRegex(everywhere.end()[1], "^warning: the connection is not encrypted")


class Loading(Serve):
    def libraries(self, process: int) -> str:
        with open(f"/proc/{process}/maps", encoding="utf-8") as maps:
            return maps.read()

    def test_loads_only_needed_libraries(self):
        service = self.serve("a.glsl", text=GRADIENT)
        self.viewer(service).picture()
        loaded = self.libraries(service.process.pid)
        self.assertTrue("tidemark_serve.so" in loaded)
        for name in ("OpenImageIO", "tidemark_overlay", "tidemark_spirv"):
            self.assertFalse(name in loaded, name)


if __name__ == "__main__":
    main()
