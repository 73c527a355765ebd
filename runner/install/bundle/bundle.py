"""Makes a folder, and an archive of it, with Tidemark and all that it needs except libc and the OpenGL driver:
bundle.py BUILD_FOLDER OUTPUT_FOLDER. README.md beside this file says what goes where and why. Prints the archive's path."""
from __future__ import annotations

import dataclasses
import json
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import sysconfig

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[2]
MOST_BYTES = 60 << 20  # of the archive
OLDEST_GLIBC = (2, 36)  # of Debian 12

# The C library and the OpenGL drivers: always the system's.
C_LIBRARY = re.compile(r"(ld-linux.*|lib(c|m|dl|rt|pthread|util|resolv|anl|mvec|nsl|nss_\w+|thread_db|BrokenLocale))\.so\.\d+$")
DRIVER = re.compile(r"lib((EGL|GLX|GLES\w*)_\w+|nvidia.*|cuda|gallium.*|LLVM.*|glapi|gbm|vulkan\w*|drm.*|OSMesa)[.-]")

# The system's library if it has one. OpenGL drivers, X and sound servers' plug-ins use these, too, and a process has only one
# of each name: an older one than the driver's own would keep the driver from loading.
SYSTEM_FIRST = re.compile(r"lib(stdc\+\+|gcc_s|atomic|z|zstd|lzma|bz2|expat|ffi|xml2|elf|tinfo|md|bsd|cap|dbus-1|systemd|"
                          r"EGL|GL|GLX|OpenGL|GLdispatch|GLES\w+|X\w*(-xcb)?|xcb(-\w+)?|xkbcommon(-x11)?|wayland-\w+|decor-0|"
                          r"asound|jack|pulse\w*|db-5\.3|crypt|gomp)\.so\b")

# Libraries that OpenImageIO needs for the formats that Tidemark reads and writes. The others, which are three hundred
# megabytes with all that they need, are replaced by stand-ins.
OPENIMAGEIO = re.compile(r"libOpenImageIO\.so\.")
KEPT_FOR_PICTURES = re.compile(r"lib(OpenImageIO_Util|OpenEXR\w*|Imath|Iex|IlmThread|OpenColorIO|tiff|jpeg|png16|webp\w*|"
                               r"sharpyuv|boost_\w+|tbb|z|stdc\+\+|gcc_s|fmt)[.-]")

# Loaded by name if they are there; the program does without.
OPTIONAL = re.compile(r"lib(vulkan|OSMesa|GLES\w+)\.")


class Problem(Exception):
    """A message for the user."""


def output_of(*words) -> str:
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode:
        raise Problem(f"{' '.join(map(str, words))} failed: {done.stderr.strip() or done.returncode}")
    return done.stdout


# Reading ELF files.

def is_elf(file: pathlib.Path) -> bool:
    return file.is_file() and not file.is_symlink() and file.open("rb").read(4) == b"\x7fELF"


def needed_by(file: pathlib.Path) -> list[str]:
    return re.findall(r"\(NEEDED\).*\[(.+)\]", output_of("readelf", "-d", file))


def loaded_later(file: pathlib.Path) -> set[str]:
    """Names of libraries in the file's strings, which it opens when it needs them."""
    names = {name.decode() for name in re.findall(rb"(?<![\w/.-])lib[\w+-]+\.so\.\d+(?=\0)", file.read_bytes())}
    return {name for name in names if not C_LIBRARY.match(name) and not OPTIONAL.match(name)}


def newest_version(text: str, name: str = "GLIBC") -> tuple[int, ...]:
    """The newest version of a library's symbols that `readelf -V` prints."""
    return max((tuple(map(int, found.split("."))) for found in re.findall(rf"{name}_([\d.]+)", text)), default=(0,))


def forbidden(names) -> list[str]:
    """Those that must stay the system's."""
    return sorted(name for name in names if C_LIBRARY.match(name) or DRIVER.match(name))


# Choosing libraries.

@dataclasses.dataclass
class Chosen:
    """Files of this system by their names for the loader."""
    private: dict[str, pathlib.Path] = dataclasses.field(default_factory=dict)
    fallback: dict[str, pathlib.Path] = dataclasses.field(default_factory=dict)
    left_out: dict[str, pathlib.Path] = dataclasses.field(default_factory=dict)


def known_libraries() -> dict[str, pathlib.Path]:
    machine = {"x86_64": "x86-64", "aarch64": "AArch64"}.get(platform.machine(), "")
    found: dict[str, pathlib.Path] = {}
    for name, kind, file in re.findall(r"^\t(\S+) \((.*)\) => (\S+)$", output_of("/sbin/ldconfig", "-p"), re.MULTILINE):
        if machine in kind:
            found.setdefault(name, pathlib.Path(file))
    return found


def wanted_by(file: pathlib.Path, own: bool, known: dict[str, pathlib.Path]) -> set[str]:
    names = set(needed_by(file))
    if own or file.name.startswith("libglfw"):
        names |= {name for name in loaded_later(file) if name in known}
    return names


def choose(programs: list[pathlib.Path], known: dict[str, pathlib.Path]) -> Chosen:
    """Follows what programs and libraries need. Libraries that only a library that is left out needs are not reached."""
    chosen, seen = Chosen(), {file.name for file in programs}
    to_do = [(file, name) for file in programs for name in sorted(wanted_by(file, True, known))]
    while to_do:
        user, name = to_do.pop()
        if C_LIBRARY.match(name):
            continue
        picture_only = OPENIMAGEIO.match(user.name) and not KEPT_FOR_PICTURES.match(name)
        if name in seen and not (name in chosen.left_out and not picture_only):
            continue
        seen.add(name)
        if name not in known:
            raise Problem(f"{user.name} needs {name}, which is not installed here")
        file = known[name]
        if picture_only:
            chosen.left_out[name] = file
            continue
        chosen.left_out.pop(name, None)
        (chosen.fallback if SYSTEM_FIRST.match(name) else chosen.private)[name] = file
        to_do += [(pathlib.Path(name), each) for each in sorted(wanted_by(file, False, known))]
    return chosen


# Stand-ins for the libraries that are left out.

def symbols(file: pathlib.Path) -> list[tuple[str, str, int, str]]:
    """Name, kind (FUNC, OBJECT, …), size and version of the file's dynamic symbols; a name that it imports has size 0 and
    the kind NOTYPE or FUNC."""
    found = []
    for line in output_of("readelf", "--dyn-syms", "--wide", file).splitlines():
        words = line.split()
        if len(words) >= 8 and words[0].endswith(":") and words[0][:-1].isdigit():
            name, _, version = words[7].replace("@@", "@").partition("@")
            where = "" if words[6] == "UND" else "defined "
            found.append((name, where + words[3], int(words[2], 0), version))
    return found


# OpenImageIO calls these when it is loaded and when it lists its formats: functions that return a version's text, and
# constructors and destructors of static objects.
HARMLESS = re.compile(r"[Vv]ersion|^_ZN.*[CD][12]E")


def stand_in_text(functions: list[str], objects: dict[str, int]) -> str:
    """C source. A function that is not harmless is called for formats that Tidemark does not read, so never."""
    lines = ["#include <stdlib.h>", "#include <string.h>", "#include <unistd.h>",
             "static const char* left_out(const char* name) {",
             "    static const char told[] = \": this library is left out of Tidemark's bundle\\n\";",
             "    if (write(2, name, strlen(name)) < 0 || write(2, told, sizeof told - 1) < 0) abort();",
             "    abort();", "}"]
    lines += [f"const char* {name}(void) {{ return " + ("\"left out\"" if HARMLESS.search(name) else f"left_out(\"{name}\")") + "; }"
              for name in functions]
    lines += [f"char {name}[{max(size, 8)}] __attribute__((aligned(64)));" for name, size in objects.items()]
    return "\n".join(lines) + "\n"


def imported_by(users: list[pathlib.Path], kept: list[pathlib.Path]) -> set[str]:
    """Names of the symbols that the users import and that no library that is kept defines."""
    provided = {each for file in kept for each, kind, _, _ in symbols(file) if kind.startswith("defined")}
    return {each for user in users for each, kind, _, _ in symbols(user) if not kind.startswith("defined")} - provided


def make_stand_in(name: str, original: pathlib.Path, imported: set[str], target: pathlib.Path, work: pathlib.Path) -> None:
    """A library of that name with the original's symbols that are imported."""
    used = sorted({each for each in symbols(original) if each[1].startswith("defined") and each[0] in imported})
    functions = sorted({each for each, kind, _, _ in used if not kind.endswith("OBJECT")})
    objects = {each: size for each, kind, size, _ in used if kind.endswith("OBJECT")}
    source, script = work / f"{name}.c", work / f"{name}.map"
    source.write_text(stand_in_text(functions, objects))
    by_version: dict[str, list[str]] = {}
    for each, _, _, version in used:
        by_version.setdefault(version, []).append(each)
    words = ["gcc", "-shared", "-fPIC", "-O1", "-fno-builtin", f"-Wl,-soname,{name}", source, "-o", target]
    if by_version.keys() - {""}:
        script.write_text("".join(f"{version} {{ global: {'; '.join(names)}; }};\n" for version, names in by_version.items() if version))
        words.append(f"-Wl,--version-script={script}")
    output_of(*words)
    output_of("strip", "--strip-unneeded", target)


# The folder.

def copy_libraries(chosen: Chosen, root: pathlib.Path, work: pathlib.Path) -> None:
    private, fallback = root / "lib/private", root / "lib/fallback"
    private.mkdir(parents=True)
    for name, file in chosen.private.items():
        shutil.copy(file, private / name)
        if "PATH)" in output_of("readelf", "-d", file):
            output_of("patchelf", "--remove-rpath", private / name)
    for name, file in chosen.fallback.items():
        (fallback / name).mkdir(parents=True)
        shutil.copy(file, fallback / name / name)
    users = [file for name, file in chosen.private.items() if OPENIMAGEIO.match(name)]
    imported = imported_by(users, [file for file in [*chosen.private.values(), *chosen.fallback.values()] if file not in users])
    for name, file in chosen.left_out.items():
        make_stand_in(name, file, imported, private / name, work)
    # The loader lists what of these it does not find.
    (work / "wanted.c").write_text("int main(void) { return 0; }\n")
    output_of("gcc", "-O1", "-s", work / "wanted.c", "-o", root / "lib/wanted", "-Wl,--no-as-needed", "-Wl,--allow-shlib-undefined",
              *(fallback / name / name for name in sorted(chosen.fallback)))


def set_library_path(file: pathlib.Path, path: str) -> None:
    """As DT_RPATH, which also counts for what the libraries need and what is loaded later; DT_RUNPATH does not."""
    output_of("patchelf", "--force-rpath", "--set-rpath", path, file)


def copy_python(root: pathlib.Path) -> list[pathlib.Path]:
    """This Python with those modules that need no library but the C library's. Returns its program."""
    stdlib = pathlib.Path(sysconfig.get_paths()["stdlib"])
    target = root / "lib/python/lib" / stdlib.name
    target.mkdir(parents=True)
    for package in ("collections", "concurrent", "encodings", "html", "importlib", "json", "re", "unittest", "urllib"):
        if (stdlib / package).is_dir():
            shutil.copytree(stdlib / package, target / package, ignore=shutil.ignore_patterns("__pycache__", "test*"))
    for file in stdlib.glob("*.py"):
        if file.name not in ("turtle.py", "pydoc.py", "sitecustomize.py"):
            shutil.copy(file, target)
    (target / "lib-dynload").mkdir()
    for module in (stdlib / "lib-dynload").glob("*.so"):
        if all(C_LIBRARY.match(name) for name in needed_by(module)) and "test" not in module.name:
            shutil.copy(module, target / "lib-dynload")
    program = root / "lib/python/bin/python3"
    program.parent.mkdir()
    shutil.copy(pathlib.Path(sys.executable).resolve(), program)
    return [program]


def pythons_files(stdlib: pathlib.Path) -> list[pathlib.Path]:
    """One file of each package that Python comes from."""
    return [pathlib.Path(sys.executable).resolve(), stdlib / "os.py", stdlib / "unittest/__init__.py"]


def copy_verify(root: pathlib.Path, build: pathlib.Path) -> list[pathlib.Path]:
    """The folders of the tests as they lie in the sources, so that their scripts run unchanged. Returns the programs."""
    target = root / "verify.d"
    for folder in ("tests/bench", "tests/support", "tests/golden"):
        shutil.copytree(SOURCE / folder, target / folder, ignore=lambda at, names: [
            name for name in names if not (pathlib.Path(at) / name).is_dir() and not name.endswith((".py", ".png", ".html", ".css"))
            or name == "__pycache__"])
    (target / "shaders").symlink_to("../share/tidemark/shaders")
    (target / "textures").symlink_to("../share/tidemark/textures")
    floor = target / "build/release/tests/bench/tidemark_floor"
    floor.parent.mkdir(parents=True)
    (target / "build/release/tidemark").symlink_to("../../../bin/tidemark")
    shutil.copy(build / "tests/bench/tidemark_floor", floor)
    output_of("strip", floor)
    return [floor]


def copy_licences(root: pathlib.Path, files: list[pathlib.Path]) -> dict[str, str]:
    """The copyright page of each package that a file comes from, and the licences that the pages name. Returns the packages'
    versions."""
    target, versions = root / "share/licences", {}
    target.mkdir(parents=True)
    sys.path.insert(0, str(SOURCE / "tests"))
    from support import package_contents
    names = {str(file.resolve()) for file in files}
    owners = package_contents.packages_of(names)
    if missing := names - owners.keys():
        raise Problem(f"no package of this system brings {', '.join(sorted(missing))}: its licence is not known")
    for package in sorted(set(owners.values())):
        shutil.copy(f"/usr/share/doc/{package}/copyright", target / f"{package}.txt")
        versions[package] = output_of("dpkg-query", "-W", "-f", "${source:Package} ${source:Version}\n", package).split("\n")[0]
    shutil.copy(root / "share/doc/tidemark/copyright", target / "tidemark.txt")
    pages = "".join(page.read_text(errors="replace") for page in target.glob("*.txt"))
    for licence in sorted(set(re.findall(r"/usr/share/common-licenses/([\w.-]*\w)", pages))):
        if pathlib.Path("/usr/share/common-licenses", licence).exists():
            shutil.copy(f"/usr/share/common-licenses/{licence}", target / licence)
    return versions


def make_folder(build: pathlib.Path, root: pathlib.Path, work: pathlib.Path) -> Chosen:
    output_of("cmake", "--install", build, "--prefix", root, "--strip")
    for unused in ("share/applications", "share/mime", "share/icons"):
        shutil.rmtree(root / unused, ignore_errors=True)
    program = root / "bin/tidemark"
    floors, pythons = copy_verify(root, build), copy_python(root)
    chosen = choose([program, *sorted((root / "lib/tidemark").glob("*.so")), *floors, *pythons], known_libraries())
    if wrong := forbidden([*chosen.private, *chosen.fallback]):
        raise Problem(f"{', '.join(wrong)}: a bundle must not have the C library or a driver of OpenGL")
    copy_libraries(chosen, root, work)
    set_library_path(program, "$ORIGIN/../lib/private")
    for name in ("tidemark", "verify"):
        shutil.copy(HERE / f"{name}.sh", root / name)
        (root / name).chmod(0o755)
    shutil.copy(HERE / "libraries.sh", root / "lib")
    shutil.copy(HERE / "bundle.txt", root / "README.txt")
    stdlib = pathlib.Path(sysconfig.get_paths()["stdlib"])
    taken = [*chosen.private.values(), *chosen.fallback.values(), *pythons_files(stdlib)]
    versions = copy_licences(root, taken)
    glibc = max(newest_version(output_of("readelf", "-V", file)) for file in root.rglob("*") if is_elf(file))
    (root / "bundle.json").write_text(json.dumps({
        "glibc": ".".join(map(str, glibc)), "private": sorted(chosen.private), "fallback": sorted(chosen.fallback),
        "left_out": sorted(chosen.left_out), "packages": versions}, indent=1) + "\n")
    if glibc > OLDEST_GLIBC:
        print(f"bundle: it needs glibc {'.'.join(map(str, glibc))} or newer, as it was built on such a system; "
              "`./dev on bookworm bundle` makes one for 2.36 and newer", file=sys.stderr)
    return chosen


def try_pictures(root: pathlib.Path) -> None:
    """Loads OpenImageIO with its stand-ins, which needs no OpenGL."""
    picture = root / "share/tidemark/textures/island.exr"
    output_of(root / "tidemark", "compare", picture, picture)


def archive(root: pathlib.Path) -> pathlib.Path:
    file = root.with_name(root.name + ".tar.zst")
    output_of("tar", "--sort=name", "--owner=0", "--group=0", "--numeric-owner", "-C", root.parent, "-I", "zstd -12 -T0 -q",
              "-cf", file, root.name)
    size = file.stat().st_size
    print(f"bundle: {size / (1 << 20):.1f} MiB", file=sys.stderr)
    if size > MOST_BYTES:
        raise Problem(f"{file} is larger than {MOST_BYTES >> 20} MiB")
    return file


def main() -> int:
    build, output = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    version = output_of(build / "tidemark", "--version").split()[1]
    root, work = output / f"tidemark-{version}-{platform.machine()}", output / "work"
    for folder in (root, work):
        shutil.rmtree(folder, ignore_errors=True)
    work.mkdir(parents=True)
    try:
        make_folder(build, root, work)
        try_pictures(root)
        print(archive(root))
        shutil.rmtree(work)
    except Problem as problem:
        print(f"bundle: {problem}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
