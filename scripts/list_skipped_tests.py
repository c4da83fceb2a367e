#!/usr/bin/env python3
"""Lists the tests that a CTest run skipped, and why.

usage: list_skipped_tests.py RESULTS.xml    (what ctest --output-junit wrote)
"""

import re
import sys
import xml.etree.ElementTree as ElementTree


def reason(output):
    """The message of GTEST_SKIP() in the output of a test, or the line that says "skipped"."""
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    for i, line in enumerate(lines):
        if re.search(r"\.(cpp|h):\d+: Skipped$", line) and i + 1 < len(lines):
            return lines[i + 1]
    return next((line for line in lines if re.match(r"skipped", line, re.IGNORECASE)), "no reason")


def main():
    tests = ElementTree.parse(sys.argv[1]).getroot().iter("testcase")
    skipped = [test for test in tests if test.find("skipped") is not None]
    if skipped:
        print(f"\n{len(skipped)} tests were skipped:")
        for test in skipped:
            print(f"  {test.get('name')}: {reason(test.findtext('system-out') or '')}")


if __name__ == "__main__":
    main()
