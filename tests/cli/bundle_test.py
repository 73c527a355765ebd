"""The bundle: which libraries it takes along, its stand-ins and its starter; `verify`, its verdicts and its page."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

from support.program import PROGRAM, ROOT, TIME_LIMIT, ProgramTest, environment, has_context, main

sys.path.insert(0, str(ROOT / "runner/install/bundle"))
sys.path.insert(0, str(ROOT / "tests/bench"))
import bundle  # noqa: E402
import verify  # noqa: E402
import verify_page  # noqa: E402

BUILD = pathlib.Path(PROGRAM).resolve().parent
VERIFY = ROOT / "tests/bench/verify.py"


@unittest.skipUnless(shutil.which("readelf") and pathlib.Path("/sbin/ldconfig").exists(), "no readelf or ldconfig")
class Libraries(ProgramTest):
    @classmethod
    def setUpClass(cls) -> None:
        programs = [pathlib.Path(PROGRAM), *(file for file in BUILD.glob("tidemark_*.so") if "reset" not in file.name)]
        cls.chosen = bundle.choose(programs, bundle.known_libraries())

    def test_neither_the_c_library_nor_a_driver_is_taken(self) -> None:
        taken = {*self.chosen.private, *self.chosen.fallback}
        self.assertEqual(bundle.forbidden(taken), [])
        for name in ("libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2", "libEGL_mesa.so.0", "libGLX_nvidia.so.0", "libnvidia-glcore.so.580",
                     "libgallium-25.0.7-2.so", "libLLVM-15.so.1"):
            self.assertEqual(bundle.forbidden([name]), [name])
            self.assertNotIn(name, taken)
        self.assertEqual(bundle.forbidden(["libEGL.so.1", "libmd.so.0", "libcap.so.2", "libmp3lame.so.0"]), [])

    def test_every_needed_library_is_taken_along(self) -> None:
        taken = {**self.chosen.private, **self.chosen.fallback, **self.chosen.left_out}
        for name in ("libOpenEXR", "libtiff.", "libwebp.", "libjpeg.", "libsndfile.", "libfmt.", "libstdc++."):
            self.assertTrue([each for each in taken if each.startswith(name)], name)
        for name, file in {**self.chosen.private, **self.chosen.fallback}.items():
            for needed in bundle.needed_by(file):
                self.assertTrue(needed in taken or bundle.C_LIBRARY.match(needed), f"{name} needs {needed}")

    def test_libraries_of_drivers_are_only_a_fallback(self) -> None:
        for name in self.chosen.private:
            self.assertNotRegex(name, r"^lib(stdc\+\+|gcc_s|z|zstd|expat|X11|xcb|EGL|GL|OpenGL|GLdispatch|asound)\.so")
        self.assertIn("libstdc++.so.6", self.chosen.fallback)
        self.assertIn("libEGL.so.1", self.chosen.fallback)

    @unittest.skipUnless(shutil.which("gcc"), "no gcc")
    def test_a_stand_in_has_the_symbols_that_are_imported(self) -> None:
        pictures = [file for name, file in self.chosen.private.items() if bundle.OPENIMAGEIO.match(name)]
        if not self.chosen.left_out:
            self.skipTest("this OpenImageIO needs no other library")
        kept = [file for file in [*self.chosen.private.values(), *self.chosen.fallback.values()] if file not in pictures]
        imported = bundle.imported_by(pictures, kept)
        made = set()
        for name, original in self.chosen.left_out.items():
            bundle.make_stand_in(name, original, imported, self.folder / name, self.folder)
            made |= {(each, version) for each, kind, _, version in bundle.symbols(self.folder / name) if kind.startswith("defined")}
        original = {(each, version) for file in self.chosen.left_out.values() for each, kind, _, version in bundle.symbols(file)
                    if kind.startswith("defined") and each in imported}
        self.assertGreater(len(original), 10)
        self.assertEqual(original - made, set())

    @unittest.skipUnless(shutil.which("gcc"), "no gcc")
    def test_a_stand_in_says_its_version_and_ends_otherwise(self) -> None:
        self.write("a.c", bundle.stand_in_text(["some_version", "read_it"], {"table": 3}))
        self.write("use.c", '#include <stdio.h>\nconst char* some_version(void); const char* read_it(void);\n'
                            'int main(int n, char** w) { puts(some_version()); fflush(stdout); if (n > 1) read_it(); return 0; }\n')
        subprocess.run(["gcc", "a.c", "use.c", "-o", "use"], cwd=self.folder, check=True)
        self.assertEqual(self.succeed(program=str(self.folder / "use")).stdout, b"left out\n")
        done = self.run_program("x", program=str(self.folder / "use"))
        self.assertLess(done.returncode, 0)
        self.assertIn("read_it: this library is left out", done.stderr)

    def test_the_newest_glibc(self) -> None:
        text = "  0x0010: Name: GLIBC_2.2.5  Flags: none\n  0x0020: Name: GLIBC_2.34\n Name: GLIBCXX_3.4.30\n Name: GLIBC_2.9\n"
        self.assertEqual(bundle.newest_version(text), (2, 34))


@unittest.skipUnless(shutil.which("gcc"), "no gcc")
class Starter(ProgramTest):
    def setUp(self) -> None:
        super().setUp()
        self.root = self.folder / "a bundle"
        for name in ("bin", "lib/fallback"):
            (self.root / name).mkdir(parents=True)
        for name in ("libraries.sh", "tidemark.sh"):
            target = self.root / ("tidemark" if name == "tidemark.sh" else "lib/" + name)
            shutil.copy(ROOT / "runner/install/bundle" / name, target)
            target.chmod(0o755)
        self.write("a bundle/bin/tidemark", '#!/bin/sh\nprintf "%s|%s" "$LD_LIBRARY_PATH" "$1"\n').chmod(0o755)
        (self.folder / "link").symlink_to(self.root / "tidemark")

    def want(self, *names: str) -> None:
        """A program that is linked with libc and with these, which this system lacks."""
        self.write("empty.c", "int main(void) { return 0; }\n")
        for name in names:
            subprocess.run(["gcc", "-shared", "-fPIC", f"-Wl,-soname,{name}", "empty.c", "-o", name], cwd=self.folder, check=True)
        subprocess.run(["gcc", "empty.c", "-o", self.root / "lib/wanted", "-Wl,--no-as-needed", *names], cwd=self.folder, check=True)

    def started(self, variable: str | None = None) -> str:
        done = self.succeed("a word", program=str(self.folder / "link"), env=environment(LD_LIBRARY_PATH=variable))
        return done.stdout.decode().replace(str(self.root), "ROOT")

    def test_only_what_the_system_lacks_comes_from_the_bundle(self) -> None:
        self.want()
        self.assertEqual(self.started(), "|a word")
        self.want("libtidemark_lacks_this.so.1", "libtidemark_lacks_that.so.2")
        self.assertEqual(self.started(), "|a word")  # nor has the bundle
        (self.root / "lib/fallback/libtidemark_lacks_this.so.1").mkdir()
        self.assertEqual(self.started(), "ROOT/lib/fallback/libtidemark_lacks_this.so.1|a word")
        self.assertEqual(self.started("/mine"), "ROOT/lib/fallback/libtidemark_lacks_this.so.1:/mine|a word")


def found_by(judge, *recorded) -> dict:
    """What a part says of recorded answers of the program."""
    class Recorder(verify.Findings):
        def __init__(self) -> None:
            self.found = {"said": [], "notes": [], "problems": [], "tables": [], "figures": []}
            self.late = []

        def add(self, kind: str, what) -> None:
            self.found[kind].append(what)
    recorder = Recorder()
    judge(*recorded, recorder)
    return recorder.found


class Verdicts(unittest.TestCase):
    DEVICES = {"devices": [
        {"name": "device:0", "renderer": "A card", "checks": [
            {"check": "loops", "verdict": "warn", "says": "loops are cut off"},
            {"check": "bytes", "verdict": "fail", "says": "a colour is 3 off"},
            {"check": "conformance", "verdict": "pass", "says": "73 projects"}]},
        {"name": "display", "unusable": "no display"}]}

    def test_the_self_test(self) -> None:
        found = found_by(verify.judge_self_test, self.DEVICES)
        self.assertEqual(found["problems"], ["device:0 (A card): bytes: a colour is 3 off"])
        self.assertEqual(found["notes"], ["device:0 (A card): loops: loops are cut off"])
        self.assertIn("display (unusable): no display", found["said"])
        self.assertEqual(found_by(verify.judge_self_test, {"devices": []})["problems"], ["no device can be used"])

    def test_the_projects(self) -> None:
        self.assertEqual(found_by(verify.judge_conformance, self.DEVICES["devices"])["problems"], [])
        self.assertTrue(found_by(verify.judge_conformance, [])["problems"])

    def test_a_check(self) -> None:
        done = {"scene": "waves", "seconds": 3.0, "check": {"probes": [
            {"probe": "times", "verdict": "pass", "found": "no NaN"}, {"probe": "overstep", "verdict": "fail", "found": "5 % of the rays"},
            {"probe": "search", "verdict": "cut", "found": ""}, {"probe": "sine", "verdict": "pass", "found": "92 dB"}]}}
        rows = []
        found = found_by(lambda recorded, findings: rows.extend(verify.judge_check(recorded, findings)), done)
        self.assertEqual(found["problems"], ["waves: overstep: 5 % of the rays"])
        self.assertEqual(found["notes"], ["waves: 1 probes were cut off by the time limit"])
        self.assertEqual([row[1] for row in rows], ["overstep", "search", "sine"])

    def test_a_study(self) -> None:
        study = {"complete": False, "verdict": ["A is fastest"], "points": [{"label": "A"}, {"label": "B", "failure": "no memory"}]}
        found = found_by(verify.judge_study, {"scene": "waves", "study": study})
        self.assertEqual(found["problems"], ["waves: B: no memory"])
        self.assertEqual(len(found["notes"]), 1)

    def test_sines_beside_the_models(self) -> None:
        numbers = verify.numbers
        xs = [numbers.f32(20000.0 * (a - 1.5)) for a, _, _ in numbers.inputs(500)]
        exact = numbers.sine_figures(1e4, xs, [numbers.f32(verify.numbers.math.sin(x)) for x in xs])
        self.assertEqual((exact["covered"], exact["correctly_rounded_percent"]), (True, 100))
        card = numbers.sine_figures(1e4, xs, [numbers.like_nvidia(x) for x in xs])
        self.assertEqual((card["covered"], card["models"]["like NVIDIA's"]["same_bits_percent"]), (True, 100))
        self.assertGreater(card["error"], 1e-4)
        for wrong in (lambda x: 1.01 * numbers.math.sin(x), lambda x: float("nan")):
            self.assertFalse(numbers.sine_figures(1e4, xs, [wrong(x) for x in xs])["covered"])

    def planes(self, fused: bool = False, off: float = 0.0) -> list[list[float]]:
        numbers = verify.numbers
        samples = numbers.inputs(300)
        sums = [numbers.f32((a * b if fused else numbers.f32(a * b)) + c) for a, b, c in samples]
        return [[numbers.f32(f(*s)) for s in samples] for f in numbers.EXACT.values()] + [sums] + [
            [numbers.f32(f(*s) + off * numbers.unit(f(*s))) for s in samples] for f in numbers.INEXACT.values()]

    def test_roundings_beside_the_models(self) -> None:
        numbers = verify.numbers
        for fused in (False, True):
            figures = numbers.rounding_figures(self.planes(fused))
            self.assertEqual(figures["a * b + c"]["rounded_once_percent" if fused else "rounded_twice_percent"], 100)
            self.assertEqual(figures["a * b + c"]["neither_percent"], 0)
            self.assertEqual(found_by(verify.judge_roundings, figures)["problems"], [])
        figures = numbers.rounding_figures(self.planes(off=3.0))
        self.assertIn("a / b 3", found_by(verify.judge_roundings, figures)["notes"][0])
        planes = self.planes()
        planes[1][7] += numbers.unit(planes[1][7])
        self.assertIn("a * b", found_by(verify.judge_roundings, numbers.rounding_figures(planes))["problems"][0])


class Verify(ProgramTest):
    def verified(self, *words: str, program: str = PROGRAM) -> tuple[int, dict, str]:
        done = subprocess.run([sys.executable, VERIFY, "out", *words], cwd=self.folder, env=environment(TIDEMARK=program),
                              capture_output=True, text=True, timeout=TIME_LIMIT)
        out = self.folder / "out"
        return done.returncode, json.loads((out / "verify.json").read_text()), (out / "index.html").read_text()

    def test_a_failed_part_does_not_stop_the_next(self) -> None:
        """A program that ends with an error, whatever it is given."""
        broken = self.write("broken", "#!/bin/sh\necho broken indeed >&2\nexit 3\n")
        broken.chmod(0o755)
        code, report, page = self.verified(program=str(broken))
        self.assertEqual(code, 1)
        self.assertEqual(report["failed"], [part["part"] for part in report["parts"]])
        self.assertEqual(report["failed"], list(verify.PARTS))
        self.assertIn("broken indeed", json.dumps(report))
        self.assertIn("Failed: ", page)

    def test_a_part_that_hangs_is_ended(self) -> None:
        hanging = self.write("hanging", "#!/bin/sh\ncase $* in *--version*) echo tidemark 1;; *self-test*) exec sleep 100;; *) exit 3;; esac\n")
        hanging.chmod(0o755)
        code, report, _ = self.verified("--parts", "self_test,conformance", "--seconds", "13", program=str(hanging))
        self.assertEqual((code, report["failed"]), (1, ["self_test", "conformance"]))
        self.assertIn("before it was done", report["parts"][0]["problems"][-1])
        self.assertLess(report["seconds"], 60)

    def test_a_part_without_a_step_done_in_time_fails(self) -> None:
        slow = self.write("slow", "#!/bin/sh\ncase $* in *--version*) echo tidemark 1;; inspect*) exit 3;; *) exec sleep 100;; esac\n")
        slow.chmod(0o755)
        _, report, _ = self.verified("--parts", "checks", "--seconds", "18", program=str(slow))
        self.assertEqual(report["failed"], ["checks"])
        self.assertIn("no step was done in time", report["parts"][0]["problems"][-1])

    @unittest.skipUnless(has_context(), "no OpenGL context")
    def test_sines_and_roundings_of_this_device(self) -> None:
        code, report, page = self.verified("--parts", "sines,roundings")
        sines, roundings = report["parts"]
        self.assertEqual((code, report["failed"]), (0, []), report["parts"])
        self.assertEqual([figure["up_to"] for figure in sines["figures"]], [1e2, 1e4, 1e6])
        self.assertLess(sines["figures"][0]["error"], 1e-3)
        self.assertEqual(roundings["figures"][0]["exact"], {"a + c": 100, "a * b": 100})
        self.assertEqual(roundings["figures"][0]["a * b + c"]["neither_percent"], 0)
        self.assertIn("All parts passed", page)

    def test_the_page_has_every_part_and_another_device(self) -> None:
        part = {"part": "golden", "title": "Golden pictures", "verdict": "fail", "seconds": 1.0, "said": ["19 of 20 <views>"], "notes": [],
                "problems": ["waves t2: FLIP 0.2"], "tables": [{"head": ["view", ""], "rows": [["waves t2", "fail"]]}],
                "figures": [{"scene": "water_surface", "view": "t2"}]}
        report = {"started": "now", "seconds": 2.0, "machine": {"processor": "P", "cores": 2, "system": "S", "kernel": "6", "glibc": "2.36"},
                  "device": {"renderer": "A card", "chosen": "auto", "tidemark": "1"}, "parts": [part]}
        other = {"device": {"renderer": "Another"}, "parts": [{**part, "verdict": "pass", "problems": []}]}
        page = verify_page.page(report, ROOT / "tests/golden", self.folder, other)
        for text in ("Failed: Golden pictures", "waves t2: FLIP 0.2", "19 of 20 &lt;views&gt;", "Another", "water_surface t2, kept",
                     "data:image/png;base64,", '<td class="fail">fail</td>'):
            self.assertIn(text, page)
        self.assertNotIn("<views>", page)


if __name__ == "__main__":
    main(needs_context=False)
