"""Tries the bundle in fresh systems, each a chroot that debootstrap makes: try_bundle.py ARCHIVE FOLDER [SUITE[=MIRROR]]...

First nothing but the system's base is there: the program must start, and say that a driver is missing. Then Mesa's driver is
installed, and every kind of file is written and read, and `verify` is run. As root; SUITE: bookworm and trixie."""
from __future__ import annotations

import base64
import json
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import time

WRITTEN = ("png", "jpg", "tif", "exr", "hdr")
SAMPLES = bytes([255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 0])  # red, green; below them blue, yellow


def blue_first(rows: bytes) -> bytes:
    return b"".join(rows[at:at + 3][::-1] for at in range(0, len(rows), 3))


READ = {  # the same four pixels, and a WebP of one
    "ppm": b"P6 2 2 255\n" + SAMPLES,
    "tga": struct.pack("<3BHHB4H2B", 0, 0, 2, 0, 0, 0, 0, 0, 2, 2, 24, 0) + blue_first(SAMPLES[6:] + SAMPLES[:6]),
    "bmp": struct.pack("<2sIHHI", b"BM", 70, 0, 0, 54) + struct.pack("<IiiHHIIiiII", 40, 2, 2, 1, 24, 0, 16, 2835, 2835, 0, 0) +
           blue_first(SAMPLES[6:]) + b"\0\0" + blue_first(SAMPLES[:6]) + b"\0\0",
    "webp": base64.b64decode("UklGRhoAAABXRUJQVlA4TA0AAAAvAAAAEAcQERGIiP4HAA=="),
}
READING = "#iChannel0 \"file://{name}\"\nvoid mainImage(out vec4 c, in vec2 p) {{ c = texelFetch(iChannel0, ivec2(p), 0); }}\n"
DRIVER = ("libegl1", "libgl1-mesa-dri")

# A namespace of its own, so that its mounts end with the command.
ENTER = """root=$1; shift
mount --rbind /dev "$root/dev"; mount -t proc proc "$root/proc"; mount -t tmpfs tmpfs "$root/tmp"
exec chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"
"""


class System:
    def __init__(self, root: pathlib.Path) -> None:
        self.root = root

    def run(self, *words: str, codes: tuple[int, ...] = (0,), limit: float = 900) -> subprocess.CompletedProcess:
        done = subprocess.run(["unshare", "--mount", "--propagation", "private", "bash", "-euc", ENTER, "bash", str(self.root), *words],
                              capture_output=True, text=True, timeout=limit)
        if done.returncode not in codes:
            raise SystemExit(f"try_bundle: {self.root.name}: {' '.join(words)} ended with {done.returncode}:\n{done.stdout[-2000:]}{done.stderr[-4000:]}")
        return done


def debian_mirror() -> str:
    found = re.search(r"^(\S+) Debian$", subprocess.run(["apt-get", "indextargets", "--format", "$(REPO_URI) $(LABEL)"],
                                                        capture_output=True, text=True, check=True).stdout, re.MULTILINE)
    return found[1] if found else "http://deb.debian.org/debian"


def make_system(folder: pathlib.Path, suite: str, mirror: str) -> System:
    """A fresh copy of the suite's base, which is made once."""
    base, root = folder / f"{suite}-base", folder / suite
    if not (base / "made").exists():
        shutil.rmtree(base, ignore_errors=True)
        base.mkdir(parents=True)
        with open(base / "debootstrap.log", "w") as log:
            if subprocess.run(["debootstrap", "--variant=minbase", suite, base / "system", mirror], stdout=log, stderr=log).returncode:
                raise SystemExit(f"try_bundle: {suite} could not be made: {base / 'debootstrap.log'} says why")
        (base / "made").touch()
    subprocess.run(["rm", "-rf", "--one-file-system", root], check=True)
    subprocess.run(["cp", "-a", base / "system", root], check=True)
    return System(root)


def without_a_driver(system: System, program: str, scene: str) -> None:
    version = system.run(program, "--version").stdout.strip()
    system.run(program, "inspect", "--device", "none", scene)
    done = system.run(program, "capture", scene, "-o", "/root/none.png", codes=(77, 1, 2, 3, 4))
    assert "error" in done.stderr, done.stderr
    print(f"  {version}; without a driver: {done.stderr.strip().splitlines()[0]}", flush=True)


def read(system: System, program: str, name: str, size: str) -> str:
    """Draws the picture as a texture. Returns the drawing's file."""
    (system.root / "root/reading.glsl").write_text(READING.format(name=name))
    done = system.run(program, "capture", "/root/reading.glsl", "--size", size, "-o", f"/root/{name}.again.png")
    assert "warning" not in done.stderr, done.stderr
    return f"/root/{name}.again.png"


def psnr(system: System, program: str, one: str, other: str) -> float:
    compared = json.loads(system.run(program, "compare", one, other, "--json", codes=(0, 1)).stdout)["frames"][0]
    return float("inf") if compared["equal"] else compared["psnr"]


def pictures(system: System, program: str, scene: str) -> None:
    """Writes a picture in each format and reads it as a texture."""
    for ending in WRITTEN:
        system.run(program, "capture", scene, "--size", "64x36", "-o", f"/root/picture.{ending}")
        found = psnr(system, program, "/root/picture.png", read(system, program, f"picture.{ending}", "64x36"))
        print(f"  {ending}: written and read, {'the same as the PNG' if found == float('inf') else f'{found:.0f} dB beside the PNG'}", flush=True)
        assert found > 30, ending
    for ending, data in READ.items():
        (system.root / f"root/read.{ending}").write_bytes(data)
        drawing = read(system, program, f"read.{ending}", "1x1" if ending == "webp" else "2x2")
        if ending != "webp":
            assert psnr(system, program, "/root/read.ppm.again.png", drawing) == float("inf"), ending
    print(f"  {', '.join(READ)}: read", flush=True)


def try_in(system: System, archive: pathlib.Path) -> dict:
    home = system.root / "opt"
    subprocess.run(["tar", "-I", "zstd", "-xf", archive, "-C", home], check=True)
    folder = f"/opt/{next(home.iterdir()).name}"
    program, scene = f"{folder}/tidemark", f"{folder}/share/tidemark/shaders/stylized_waves.glsl"
    without_a_driver(system, program, scene)
    system.run("apt-get", "update", "-qq")
    system.run("apt-get", "install", "-y", "-qq", "--no-install-recommends", *DRIVER)
    pictures(system, program, scene)
    system.run(program, "check", f"{folder}/share/tidemark/shaders/examples/ripples.glsl", "--probe", "no_nan")  # loads glslang
    begun = time.monotonic()
    done = system.run(f"{folder}/verify", "/root/verify", codes=(0, 1))
    report = json.loads((system.root / "root/verify/verify.json").read_text())
    print(f"  verify: {time.monotonic() - begun:.0f} s on {report['device']['renderer']}", flush=True)
    print("".join(f"    {line}\n" for line in done.stdout.splitlines()), end="", flush=True)
    return report


def main() -> int:
    archive, folder = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    failed = []
    for given in sys.argv[3:] or ("bookworm", "trixie"):
        suite, _, mirror = given.partition("=")
        print(f"{suite}:", file=sys.stdout, flush=True)
        system = make_system(folder, suite, mirror or debian_mirror())
        report = try_in(system, archive)
        (folder / f"{suite}.json").write_text(json.dumps(report, indent=1) + "\n")
        shutil.copy(system.root / "root/verify/index.html", folder / f"{suite}.html")
        if report["failed"] or report["seconds"] > 480:
            failed.append(suite)
    print(f"failed on {', '.join(failed)}" if failed else "the bundle runs on all")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
