"""Writes the C++ examples of the documentation that promise to compile as files of their own.

usage: extract_examples.py ROOT OUTPUT_FOLDER

An example is a ```cpp block after a line "<!-- compile -->" in any page. It becomes
PAGE_LINE.cpp, a whole translation unit; errors of the compiler name the page and its line.
"""

import re
import sys
from pathlib import Path

from pages import pages

EXAMPLE = re.compile(r"^<!-- compile -->\n+```cpp\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def main():
    root, output = Path(sys.argv[1]), Path(sys.argv[2])
    output.mkdir(parents=True, exist_ok=True)
    count = 0
    for page in pages(root):
        text = page.read_text()
        marks = len(re.findall(r"^<!-- compile -->", text, re.MULTILINE))
        examples = list(EXAMPLE.finditer(text))
        if len(examples) != marks:
            sys.exit(f"{page}: {marks} marks <!-- compile -->, but {len(examples)} ```cpp blocks "
                     "right after one")
        for example in examples:
            line = text.count("\n", 0, example.start(1)) + 1
            name = "_".join(page.relative_to(root).with_suffix("").parts)
            target = output / f"{name}_{line}.cpp"
            target.write_text(f'#line {line} "{page}"\n{example[1]}')
            count += 1
    if count == 0:
        sys.exit("no example in any page: the mark is a line <!-- compile --> before ```cpp")
    print(f"{count} examples")


if __name__ == "__main__":
    main()
