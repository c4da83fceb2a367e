"""Every relative link of the documentation leads to a file, and every #anchor to a heading.

usage: check_links.py ROOT
"""

import re
import sys
from pathlib import Path

from pages import pages

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)[^)]*\)|<(?:img|a)\s[^>]*(?:src|href)=\"([^\"]+)\"")
CODE = re.compile(r"^```.*?^```$|`[^`\n]*`", re.MULTILINE | re.DOTALL)


def anchors(page):
    """The anchors of a page's headings, by GitHub's rule."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
    headings = re.findall(r"^#+ +(.+)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_links(root):
    for page in pages(root):
        # Code is blanked, not removed, so that the numbers of the lines stay right.
        text = CODE.sub(lambda code: re.sub(r"[^\n]", " ", code[0]), page.read_text())
        for link in LINK.finditer(text):
            target = link[1] or link[2]
            if re.match(r"[a-z]+:", target):
                continue
            name, _, anchor = target.partition("#")
            path = page.parent / name if name else page
            line = text.count("\n", 0, link.start()) + 1
            if not path.exists():
                yield f"{page.relative_to(root)}:{line}: {target} does not exist"
            elif anchor and path.suffix == ".md" and anchor not in anchors(path):
                yield f"{page.relative_to(root)}:{line}: no heading #{anchor} in {path.name}"


def main():
    broken = list(broken_links(Path(sys.argv[1])))
    for line in broken:
        print(line)
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
