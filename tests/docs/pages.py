"""The Markdown pages of the project."""

PATTERNS = ["*.md", "docs/**/*.md", "data/**/*.md", "examples/**/*.md", "bench/**/*.md"]


def pages(root):
    return sorted({page for pattern in PATTERNS for page in root.glob(pattern)})
