#!/usr/bin/env python3
"""Holds every #include to the floors of the house (docs/architecture.md).

usage: check_include_edges.py [--root FOLDER]

The allowed edges are the aureole_module() calls of CMakeLists.txt, which the build uses too:
  - a file of module M (include/aureole/M, src/M) includes public headers of M and of the modules
    in its DEPENDS (named themselves, not only reached through others), private headers of M alone;
  - a module may depend only on those declared above it;
  - a public header includes no third-party header; a .cpp those of M's PRIVATE_LIBS, a test
    those of its TEST_LIBS as well, and shaders, which it compiles as C++;
  - apps/, bench/, examples/ and tests/ include public headers only, and files beside them;
  - the table in docs/architecture.md says the same as CMakeLists.txt.
Prints one line per offence, "FILE:LINE: reason", and exits with 1 if there is any.
"""

import argparse
import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

# What the headers of a CMake target look like in an #include.
THIRD_PARTY = {
    "TBB::tbb": r"(tbb|oneapi)/",
    "fmt::fmt": r"fmt/",
    "hwy::hwy": r"hwy/",
    "PkgConfig::OpenImageIO": r"OpenImageIO/",
    "PkgConfig::OpenColorIO": r"OpenColorIO/",
    "PkgConfig::cairo": r"cairo(-\w+)?\.h$",
    "tomlplusplus::tomlplusplus": r"toml\+\+/",
    "PkgConfig::FFTW": r"fftw3\.h$",
    "GTest": r"g(test|mock)/",
    "CLI11::CLI11": r"CLI/",
    "nlohmann_json::nlohmann_json": r"nlohmann/",
    "benchmark::benchmark": r"benchmark/",
}
# What any file may include in angle brackets: the standard library and POSIX.
SYSTEM = re.compile(r"(sys/)?\w+(\.h)?$")
INCLUDE = re.compile(r'\s*#\s*include\s*([<"])([^>"]+)[>"]')
SOURCE_SUFFIXES = {".h", ".cpp", ".inc"}


@dataclass
class Module:
    depends: list = field(default_factory=list)
    private_libs: list = field(default_factory=list)
    test_libs: list = field(default_factory=list)


def read_modules(cmake_lists):
    """The aureole_module() calls, in order of declaration."""
    text = re.sub(r"#.*", "", cmake_lists.read_text())
    keywords = {"DEPENDS": "depends", "PRIVATE_LIBS": "private_libs", "TEST_LIBS": "test_libs"}
    modules = {}
    for call in re.findall(r"aureole_module\(([^)]*)\)", text):
        name, *words = call.split()
        modules[name] = Module()
        target = None
        for word in words:
            if word in keywords:
                target = getattr(modules[name], keywords[word])
            else:
                target.append(word)
    return modules


def check_declarations(modules):
    names = list(modules)
    for position, (name, module) in enumerate(modules.items()):
        for dependency in module.depends:
            if dependency not in names[:position]:
                yield (f"CMakeLists.txt: {name} depends on {dependency}, "
                       "which is not declared above it")


def check_documentation(modules, page):
    """The rows "| floor | `module` | ... | `a`, `b` |" of the page against the declarations."""
    if not page.exists():
        yield f"{page.name}: missing"
        return
    documented = {}
    for line in page.read_text().splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if len(cells) == 4 and cells[0].isdigit():
            documented[cells[1].strip("`")] = sorted(re.findall(r"`(\w+)`", cells[3]))
    for name in sorted(documented.keys() | modules.keys()):
        declared = sorted(modules[name].depends) if name in modules else None
        if documented.get(name) != declared:
            yield (f"docs/{page.name}: module {name} may include {documented.get(name)} here, "
                   f"{declared} in CMakeLists.txt")


def includes(path):
    for number, line in enumerate(path.read_text().splitlines(), start=1):
        match = INCLUDE.match(line)
        if match:
            yield number, match[1] == "<", match[2]


def third_party(header):
    return next((lib for lib, pattern in THIRD_PARTY.items() if re.match(pattern, header)), None)


def is_neighbour(path, header, folders):
    """True for a file found below the folder of `path` or one of the include folders."""
    return ".." not in Path(header).parts and any((folder / header).is_file() for folder in [path.parent, *folders])


def check_module_file(root, path, name, modules):
    module = modules[name]
    public = (root / "include") in path.parents
    is_test = path.stem.endswith("_test")
    folders = [root / "src"] + [root / "tests", root / "shaders"] * is_test
    libs = module.private_libs + (module.test_libs + ["GTest"] if is_test else [])
    for number, angled, header in includes(path):
        owner = re.match(r"aureole/(\w+)/", header) or re.match(r"(\w+)/", header)
        lib = third_party(header)
        reason = None
        if header.startswith("aureole/"):
            if not owner or owner[1] not in [name, *module.depends]:
                reason = f"{name} may not include {header}: allowed are {module.depends}"
            elif not (root / "include" / header).is_file():
                reason = f"{header} does not exist"
        elif lib:
            if public:
                reason = f"a public header may not include {header} ({lib})"
            elif lib not in libs:
                reason = f"{name} may not include {header}: its libraries are {libs}"
        elif angled:
            if not SYSTEM.match(header):
                reason = f"{header}: unknown library; see THIRD_PARTY in {Path(__file__).name}"
        elif public:
            reason = f"a public header may not include the private {header}"
        elif owner and owner[1] in modules and owner[1] != name:
            reason = f"{name} may not include {header}: it is private to {owner[1]}"
        elif not is_neighbour(path, header, folders):
            reason = f"{header} is neither in src/ nor beside this file"
        if reason:
            yield f"{path.relative_to(root)}:{number}: {reason}"


def check_outer_file(root, path):
    top = root / path.relative_to(root).parts[0]
    for number, angled, header in includes(path):
        reason = None
        if third_party(header):
            continue
        if angled and not header.startswith("aureole/"):
            if not SYSTEM.match(header):
                reason = f"{header}: unknown library; see THIRD_PARTY in {Path(__file__).name}"
        elif not is_neighbour(path, header, [root / "include", top]):
            reason = f"{header} is neither public nor beside this file"
        if reason:
            yield f"{path.relative_to(root)}:{number}: {reason}"


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in SOURCE_SUFFIXES)


def check(root):
    modules = read_modules(root / "CMakeLists.txt")
    yield from check_declarations(modules)
    yield from check_documentation(modules, root / "docs" / "architecture.md")
    for top in [root / "include" / "aureole", root / "src"]:
        for path in sources(top):
            name = path.relative_to(top).parts[0]
            if name in modules:
                yield from check_module_file(root, path, name, modules)
            else:
                yield f"{path.relative_to(root)}: no module {name} in CMakeLists.txt"
    for top in ["apps", "bench", "examples", "tests"]:
        for path in sources(root / top):
            yield from check_outer_file(root, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent)
    root = parser.parse_args().root.resolve()
    offences = list(check(root))
    for offence in offences:
        print(offence)
    return 1 if offences else 0


if __name__ == "__main__":
    sys.exit(main())
