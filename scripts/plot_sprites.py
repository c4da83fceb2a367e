#!/usr/bin/env python3
"""Tables and plots of docs/sprites.md from what bench/sprites_bench measured.

usage: scripts/plot_sprites.py ROWS.csv

ROWS.csv is what `sprites_bench ... --csv ROWS.csv` appended, one command after the other. Prints the
tables in Markdown and writes docs/images/sprites-crossover.svg and sprites-clusters.svg.
"""
import math
import pathlib
import statistics
import sys

IMAGES = pathlib.Path(__file__).resolve().parent.parent / "docs" / "images"
COLORS = {"33": "#1b6ca8", "129": "#2a9d5c", "513": "#d98a00", "full": "#b5342b"}


def svg(name, width, height, body):
    text = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
            f'font-family="sans-serif" font-size="13">\n<rect width="100%" height="100%" '
            f'fill="white"/>\n' + "\n".join(body) + "\n</svg>\n")
    (IMAGES / name).write_text(text)


def text(x, y, what, anchor="middle"):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{what}</text>'


def swatch(x, y, color, what):
    return [f'<rect x="{x}" y="{y - 10}" width="12" height="12" fill="{color}"/>',
            text(x + 18, y, what, "start")]


def line(x0, y0, x1, y1, color="#ccc", more=""):
    return (f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" stroke="{color}" '
            f'{more}/>')


class Trial:
    """A row of `crossover` or `auto`, in ms."""

    def __init__(self, cells):
        self.height, self.kernel, self.picture, self.sprites = cells[:4]
        numbers = [float(cell) for cell in cells[4:12]]
        self.fft, self.drawn, self.hybrid, self.first, self.next = numbers[:5]
        self.predicted = numbers[5:]
        self.method, self.reason = cells[12:14]
        self.best = min(self.fft, self.drawn, self.hybrid)

    def actual(self):
        return [self.fft, self.drawn, self.hybrid]


def summary(name, trials):
    errors = [abs(p / a - 1) for t in trials for p, a in zip(t.predicted, t.actual()) if p > 0]
    differ = [t for t in trials
              if max(t.fft, t.drawn) >= 1.2 * min(t.fft, t.drawn) and math.isfinite(t.drawn)]
    cost = {"fft": 0, "sprites": 1, "hybrid": 2}
    right = sum(t.actual()[cost[t.method]] <= 1.2 * min(t.fft, t.drawn) for t in differ)
    print(f"\n{name}: auto / best {max(t.first / t.best for t in trials):.2f} (first), "
          f"{max(t.next / t.best for t in trials):.2f} (next); predictions wrong by "
          f"{100 * statistics.median(errors):.0f} % in the median, {100 * max(errors):.0f} % at most; "
          f"right picks {right} of {len(differ)}\n")


def crossover(trials):
    for height in sorted({t.height for t in trials}, key=int):
        print(f"\n{height}p, ms of sprites : fft\n")
        kernels = [k for k in COLORS if any(t.kernel == k for t in trials)]
        print("| lights | " + " | ".join(kernels) + " |\n|---" + "|---" * len(kernels) + "|")
        for picture in dict.fromkeys(t.picture for t in trials):
            row = [picture.split()[0]]
            for kernel in kernels:
                cell = [t for t in trials
                        if (t.height, t.kernel, t.picture) == (height, kernel, picture)]
                row.append(f"{cell[0].drawn:.1f} : {cell[0].fft:.1f}" if cell else "")
            print("| " + " | ".join(row) + " |")
    body = []
    for panel, height in enumerate(("1080", "2160")):
        left, right, top, bottom = 60 + 400 * panel, 400 + 400 * panel, 40, 300
        y = lambda ratio: bottom - (math.log10(ratio) + 1) / 2 * (bottom - top)
        x = lambda count: left + math.log10(count) / 3 * (right - left)
        body.append(text((left + right) / 2, 24, f"{height}p: fft / sprites, by lights"))
        for ratio in (0.1, 0.3, 1, 3, 10):
            more = 'stroke-width="2"' if ratio == 1 else ""
            body += [line(left, y(ratio), right, y(ratio), "#888" if ratio == 1 else "#ddd", more),
                     text(left - 6, y(ratio) + 4, ratio, "end")]
        for count in (1, 10, 100, 1000):
            body += [line(x(count), top, x(count), bottom, "#eee"),
                     text(x(count), bottom + 18, count)]
        for kernel, color in COLORS.items():
            points = [(int(t.picture.split()[0]), t.fft / t.drawn) for t in trials
                      if (t.height, t.kernel) == (height, kernel)]
            path = " ".join(f"{x(c):.1f},{y(min(r, 10)):.1f}" for c, r in sorted(points))
            body.append(f'<polyline points="{path}" fill="none" stroke="{color}" '
                        f'stroke-width="2"/>')
    for i, (kernel, color) in enumerate(COLORS.items()):
        body += swatch(150 + 150 * i, 345, color, f"kernel {kernel}")
    svg("sprites-crossover.svg", 830, 360, body)
    summary("crossover", trials)


def automatic(trials):
    print("\n| picture | kernel | fft | sprites | hybrid | auto, first | next | took | ratio |")
    print("|---|---|---|---|---|---|---|---|---|")
    for t in trials:
        drawn = f"{t.drawn:.1f}" if math.isfinite(t.drawn) else "-"
        print(f"| {t.picture} | {t.kernel} | {t.fft:.1f} | {drawn} | {t.hybrid:.1f} | "
              f"{t.first:.1f} | {t.next:.1f} | {t.method} | {t.first / t.best:.2f}, "
              f"{t.next / t.best:.2f} |")
    summary("auto", trials)


def clusters(rows):
    names = ["no clusters", "2x2 static", "16x16 tree", "bounded, none", "bounded, 16x16"]
    print("\n| picture | " + " | ".join(names) + " | fft |\n|---" + "|---" * 6 + "|")
    body, top, width = [], 40, 420
    most = max(float(row[1 + 2 * i]) for row in rows for i in range(5))
    for row in rows:
        ms = [float(row[1 + 2 * i]) for i in range(5)]
        print(f"| {row[0]} | " + " | ".join(f"{m:.1f} ({n})" for m, n in zip(ms, row[2:11:2])) +
              f" | {float(row[11]):.1f} |")
        body.append(text(130, top + 44, row[0], "end"))
        for i, (m, name) in enumerate(zip(ms, names)):
            color = ["#bbb", "#7fb2d9", "#1b6ca8", "#e3b7a0", "#b5342b"][i]
            y = top + 16 * i
            body += [f'<rect x="140" y="{y}" width="{width * m / most:.1f}" height="13" '
                     f'fill="{color}"/>', text(146 + width * m / most, y + 11, f"{m:.1f} ms", "start")]
            if row is rows[0]:
                body += swatch(20 + 140 * i, 20, color, name)
        top += 96
    svg("sprites-clusters.svg", 740, top, body)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    rows = [entry.rstrip("\n").split(";") for entry in open(sys.argv[1])]
    of_kind = lambda kind: [row[1:] for row in rows if row[0] == kind]
    if of_kind("figure9"):
        clusters(of_kind("figure9"))
    if of_kind("crossover"):
        crossover([Trial(row) for row in of_kind("crossover")])
    if of_kind("auto"):
        automatic([Trial(row) for row in of_kind("auto")])


if __name__ == "__main__":
    main()
