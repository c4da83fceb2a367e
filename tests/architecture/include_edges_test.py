"""Every kind of offence that scripts/check_include_edges.py is there for, in a house of its own."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CHECK = Path(__file__).resolve().parents[2] / "scripts" / "check_include_edges.py"

HOUSE = {
    "CMakeLists.txt": (
        "aureole_module(base PRIVATE_LIBS TBB::tbb)  # a comment (with brackets)\n"
        "aureole_module(wave DEPENDS base)\n"
        "aureole_module(glare DEPENDS base TEST_LIBS PkgConfig::FFTW)\n"
    ),
    "docs/architecture.md": (
        "| floor | module | what | may include |\n|---|---|---|---|\n"
        "| 0 | `base` | a | |\n| 1 | `wave` | b | `base` |\n| 1 | `glare` | c | `base` |\n"
    ),
    "include/aureole/base/error.h": "#include <string>\n",
    "include/aureole/wave/psf.h": '#include "aureole/base/error.h"\n',
    "src/base/loop.cpp": "#include <oneapi/tbb/parallel_for.h>\n#include <sys/mman.h>\n",
    "src/wave/mask.h": '#include "aureole/wave/psf.h"\n',
    "src/wave/mask.cpp": '#include "wave/mask.h"\n',
    "src/glare/apply_test.cpp": "#include <fftw3.h>\n#include <gtest/gtest.h>\n",
    "apps/aureole/main.cpp": '#include <CLI/CLI.hpp>\n#include "aureole/wave/psf.h"\n',
}


def offences(changes):
    """What the check prints for the house with some files replaced or added."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (HOUSE | changes).items():
            path = Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        run = subprocess.run([sys.executable, CHECK, "--root", folder], check=False,
                             capture_output=True, text=True)
    lines = run.stdout.splitlines()
    assert run.returncode == (1 if lines else 0), run.stderr
    return lines


class IncludeEdges(unittest.TestCase):
    def expect(self, changes, start):
        lines = offences(changes)
        self.assertEqual(len(lines), 1, lines)
        self.assertTrue(lines[0].startswith(start), lines[0])

    def test_a_clean_house_passes(self):
        self.assertEqual(offences({}), [])

    def test_public_edge_that_is_not_declared(self):
        self.expect({"src/glare/apply.cpp": '\n#include "aureole/wave/psf.h"\n'},
                    "src/glare/apply.cpp:2: glare may not include aureole/wave/psf.h")

    def test_edge_upwards(self):
        self.expect({"include/aureole/base/error.h": '#include "aureole/wave/psf.h"\n'},
                    "include/aureole/base/error.h:1: base may not include")

    def test_private_header_of_another_module(self):
        self.expect({"src/glare/apply.cpp": '#include "wave/mask.h"\n'},
                    "src/glare/apply.cpp:1: glare may not include wave/mask.h: it is private")

    def test_private_header_of_another_module_by_way_of_parent_folder(self):
        self.expect({"src/glare/apply.cpp": '#include "../wave/mask.h"\n'},
                    "src/glare/apply.cpp:1: ../wave/mask.h")

    def test_private_header_in_a_public_one(self):
        self.expect({"include/aureole/wave/psf.h": '#include "wave/mask.h"\n'},
                    "include/aureole/wave/psf.h:1: a public header may not include the private")

    def test_third_party_header_in_a_public_one(self):
        self.expect({"include/aureole/base/error.h": "#include <tbb/tbb.h>\n"},
                    "include/aureole/base/error.h:1: a public header may not include tbb/tbb.h")

    def test_library_that_the_module_does_not_name(self):
        self.expect({"src/wave/mask.cpp": "#include <fmt/format.h>\n"},
                    "src/wave/mask.cpp:1: wave may not include fmt/format.h")

    def test_library_of_the_tests_in_the_implementation(self):
        self.expect({"src/glare/apply.cpp": "#  include <fftw3.h>\n"},
                    "src/glare/apply.cpp:1: glare may not include fftw3.h")

    def test_unknown_library(self):
        self.expect({"src/wave/mask.cpp": "#include <boost/any.hpp>\n"},
                    "src/wave/mask.cpp:1: boost/any.hpp: unknown library")

    def test_private_header_in_an_app(self):
        self.expect({"apps/aureole/main.cpp": '#include "wave/mask.h"\n'},
                    "apps/aureole/main.cpp:1: wave/mask.h is neither public")

    def test_folder_that_is_no_module(self):
        self.expect({"src/lens/trace.cpp": ""}, "src/lens/trace.cpp: no module lens")

    def test_dependency_on_a_module_declared_later(self):
        lines = offences({"CMakeLists.txt": HOUSE["CMakeLists.txt"].replace(
            "wave DEPENDS base", "wave DEPENDS base glare")})
        self.assertIn("CMakeLists.txt: wave depends on glare, which is not declared above it", lines)

    def test_page_that_says_something_else(self):
        self.expect({"docs/architecture.md": HOUSE["docs/architecture.md"].replace(
            "| c | `base` |", "| c | `base`, `wave` |")}, "docs/architecture.md: module glare")


if __name__ == "__main__":
    unittest.main()
