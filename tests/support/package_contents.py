"""What a Debian package declares, held against what is in it: the shared libraries that its programs load against its
Depends, and what its build took in from packages without a shared library against its copyright."""
from __future__ import annotations

import os
import pathlib
import re
import subprocess

# The kernel's own interface, which is in every program.
NOT_TAKEN_IN = {"linux-libc-dev"}


def output_of(*words) -> str:
    return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True).stdout


def packages_of(files: set[str]) -> dict[str, str]:
    """Who installed each, by the name of the file; /usr/lib/x and /lib/x may be one file."""
    names = {name: file for file in files for name in (file, file.removeprefix("/usr"), "/usr" + file)}
    found = subprocess.run(["dpkg-query", "-S", *sorted(names)], capture_output=True, text=True).stdout  # 1: some are not known
    owners = {}
    for line in found.splitlines():
        packages, _, name = line.rpartition(": ")
        if name in names:
            owners[names[name]] = packages.split(",")[0].split(":")[0]
    return owners


def alternatives(field: str) -> list[list[str]]:
    """`a (>= 1) | b, c:any` as [[a, b], [c]]."""
    return [[re.match(r"[^\s:(\[]+", each.strip())[0] for each in one.split("|")] for one in field.split(",") if one.strip()]


def closure(depends: str) -> set[str]:
    """All that is installed with these, of what is installed here: of alternatives the first that is."""
    needs: dict[str, str] = {}
    providers: dict[str, str] = {}
    for line in output_of("dpkg-query", "-W", "-f", "${Package}\t${Depends}, ${Pre-Depends}\t${Provides}\n").splitlines():
        package, field, provided = line.split("\t")
        needs[package] = field
        for [name] in alternatives(provided):
            providers.setdefault(name, package)
    wanted, seen = alternatives(depends), set()
    while wanted:
        names = wanted.pop()
        package = next((each for name in names for each in (name, providers.get(name)) if each in needs), None)
        assert package, f"'{' | '.join(names)}' is not installed, and what it brings is not known"
        if package not in seen:
            seen.add(package)
            wanted += alternatives(needs[package])
    return seen


def libraries_loaded(programs: list[pathlib.Path]) -> set[str]:
    """Those that they are linked with, and those that they name to load them later."""
    known = dict(re.findall(r"^\t(\S+) .*=> (\S+)$", output_of("/sbin/ldconfig", "-p"), re.MULTILINE))
    loaded = set()
    for program in programs:
        linked = output_of("ldd", program)
        assert "not found" not in linked, linked
        loaded |= set(re.findall(r"=> (/\S+)", linked))
        names = {name.decode() for name in re.findall(rb"(?<![\w/.-])lib[\w+-]+\.so\.\d+(?=\0)", program.read_bytes())}
        loaded |= {known[name] for name in names - set(re.findall(r"^\t(\S+) =>", linked, re.MULTILINE)) if name in known}
    return {file for file in loaded if not pathlib.Path(file).is_relative_to(programs[0].parents[2])}


def undeclared(depends: str, programs: list[pathlib.Path]) -> list[str]:
    """The packages of libraries that do not come with those, and the libraries of none."""
    there = closure(depends)
    files = {os.path.realpath(file) for file in libraries_loaded(programs)}
    owners = packages_of(files)
    return sorted({owners.get(file, file) for file in files} - there)


def taken_in(build: pathlib.Path) -> set[str]:
    """Packages whose headers were compiled, or whose archives were linked, and that have no shared library."""
    headers, ours = set(), False
    for line in output_of("ninja", "-C", build, "-t", "deps").splitlines():
        if line and not line.startswith(" "):
            ours = line.startswith("CMakeFiles/") or line.startswith("runner/")
        elif ours and (header := os.path.normpath(build / line.strip())).startswith("/usr/include/"):
            headers.add(os.path.realpath(header))  # a compiler cache may name it relative to the build folder
    packages = set(packages_of(headers).values())
    shared = {each for each in packages if re.search(r"\.so$", output_of("dpkg-query", "-L", each), re.MULTILINE)}
    return packages - shared - NOT_TAKEN_IN


def unnamed(copyright_text: str, build: pathlib.Path) -> list[str]:
    """Those that the page does not name, and the licences that it names without their words."""
    packages = taken_in(build)
    assert packages, "the build folder does not say what was compiled"
    missing = [package for package in sorted(packages) if not re.search(rf"\b{re.escape(package)}\b", copyright_text)]
    with_words = set(re.findall(r"^License: (.*)\n ", copyright_text, re.MULTILINE))
    named = {each for field in re.findall(r"^License: (.*)\n(?! )", copyright_text, re.MULTILINE)
             for each in field.split(" or ")}
    return missing + [f"the words of {name}" for name in sorted(named - with_words)]
