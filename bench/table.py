#!/usr/bin/env python3
"""Runs the benchmarks and prints the table of bars: every speed as a ratio measured in one run.

usage: bench/table.py [BUILD_DIR] [--simd avx2|avx512|ssse3] [--rounds N]

scipy is compared when it can be imported (it is not needed to build or run anything else).
"""
import argparse
import importlib.util
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
KERNELS = ["513x513", "1025x1025", "1919x1079"]


def medians(program, simd, rounds, only="."):
    """Median milliseconds by name; rounds of all cases interleaved at random."""
    command = [
        str(program),
        "--benchmark_format=json",
        "--benchmark_enable_random_interleaving=true",
        f"--benchmark_repetitions={rounds}",
        "--benchmark_report_aggregates_only=true",
        f"--benchmark_filter={only}",
    ]
    if simd:
        command.append(f"--simd={simd}")
    run = subprocess.run(command, check=True, capture_output=True, text=True)
    result = {}
    for case in json.loads(run.stdout)["benchmarks"]:
        if case.get("aggregate_name") == "median":
            name = case["run_name"].replace("/real_time", "").split("/min_time")[0]
            result[name] = case["real_time"]
            if "rays" in case:
                result[name + "/rays"] = case["rays"] / 1e6
    return result


def against_scipy(kernel, programs, options):
    """Median milliseconds of ours and scipy's, in turns: the machine's other work hits both."""
    script = [sys.executable, str(ROOT / "bench" / "scipy_convolution.py"), *kernel.split("x"), "3"]
    ours, theirs = [], []
    for _ in range(options.rounds):
        name = f"aureole/{kernel}"
        ours.append(medians(programs / "convolution_bench", options.simd, 3, f"^{name}/")[name])
        run = subprocess.run(script, check=True, capture_output=True, text=True)
        theirs.append(float(run.stdout))
    return statistics.median(ours), statistics.median(theirs)


def whole_process(program):
    """CPU time and memory of `aureole ibl` itself, for a lat-long picture of 2048x1024."""
    def used(arguments):
        process = subprocess.Popen([program, *arguments], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        if status != 0:
            sys.exit(f"{program} {' '.join(arguments)} failed")
        return usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024 / 1e6

    with tempfile.TemporaryDirectory() as folder:
        picture = f"{folder}/sunny.exr"
        used(["scene", "sunny", "-o", picture])
        runs = [used(["ibl", picture, "-o", f"{folder}/sunny", "--texel", "float"])
                for _ in range(5)]
        idle = used(["--version"])
    row("aureole ibl, 2048x1024, all files in floats: CPU (s)",
        statistics.median(run[0] for run in runs), "<= 0.8", f"{idle[0]:.2f} to load libraries")
    print(f"{'  its peak memory (MB)':<58} {max(run[1] for run in runs):8.2f}{'':23}"
          f"{idle[1]:.0f} to load libraries")


def sprites(program):
    """Light by light against transforms: sprites_bench's rows, by kind."""
    with tempfile.TemporaryDirectory() as folder:
        csv = pathlib.Path(folder) / "rows.csv"
        for arguments in (["figure9"], ["auto", "1080", "129"], ["auto", "1080", "513"],
                          ["auto", "1080", "full"], ["hybrid", "2160"]):
            subprocess.run([program, *arguments, "--csv", csv], check=True, capture_output=True)
        rows = [entry.split(";") for entry in csv.read_text().splitlines()]
    of_kind = {kind: [cells for name, *cells in rows if name == kind]
               for kind in ("figure9", "auto", "hybrid")}
    times = {cells[0]: [float(ms) for ms in cells[1:11:2]] for cells in of_kind["figure9"]}
    for picture, bar in (("polygon", ">= 4"), ("300 lights", ">= 1.5"), ("mixed", ">= 1.5")):
        none, _, tree, bounded_none, bounded = times[picture]
        row(f"figure 9, {picture}: tree, times faster than no clusters", none / tree, bar,
            f"{none:.1f} / {tree:.1f} ms, {bounded_none / bounded:.1f} x with bounded error")
    row("  any picture: tree, times the time without clusters",
        max(max(tree / none, bounded / bounded_none)
            for none, _, tree, bounded_none, bounded in times.values()), "<= 1.05")
    # fft, sprites, hybrid, auto (first), auto (next)
    costs = {f"{cells[2]}, {cells[1]}": [float(ms) for ms in cells[4:9]]
             for cells in of_kind["auto"]}
    worst = max(costs, key=lambda name: costs[name][3] / min(costs[name][:3]))
    row("auto, 12 pictures x 3 kernels: times the best method, at most",
        costs[worst][3] / min(costs[worst][:3]), "<= 1.1", worst)
    _, fft, hybrid, error = (float(cell) for cell in of_kind["hybrid"][0])
    row("hybrid, 2160p, 8 lights: times faster than transforms", fft / hybrid, ">= 1",
        f"{fft:.1f} / {hybrid:.1f} ms, error {100 * error:.2f} %")


def row(what, value, bar, detail=""):
    """One line; `bar` is like '>= 3' or '<= 2'."""
    sign, limit = bar.split()
    met = value >= float(limit) if sign == ">=" else value <= float(limit)
    print(f"{what:<58} {value:8.2f}   {bar:<8} {'met' if met else 'NOT MET':<8} {detail}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", nargs="?", default=ROOT / "build" / "release")
    parser.add_argument("--simd", default="avx2")
    parser.add_argument("--rounds", type=int, default=9)
    options = parser.parse_args()
    programs = pathlib.Path(options.build) / "bin"

    times = medians(programs / "convolution_bench", options.simd, options.rounds)
    print(f"1920x1080 RGB, interleaved, kernel spectrum cached, 2 threads, {options.simd}")
    print(f"{'measure':<58} {'figure':>8}   {'bar':<8}")
    ms = "{:.1f} / {:.1f} ms".format
    for kernel, bar in zip(KERNELS, ["3", "6", "7"]):
        ours, theirs = times[f"aureole/{kernel}"], times[f"textbook/{kernel}"]
        row(f"{kernel}: times faster than the textbook", theirs / ours, f">= {bar}",
            ms(theirs, ours))
        coloured = times[f"aureole_rgb_kernel/{kernel}"]
        print(f"{'  the same with a coloured kernel':<58} {theirs / coloured:8.2f}"
              f"{'':23}{ms(theirs, coloured)}")
    if importlib.util.find_spec("scipy"):
        for kernel, bar in zip(KERNELS, ["4", "6", "6.5"]):
            ours, theirs = against_scipy(kernel, programs, options)
            row(f"{kernel}: times faster than scipy.fft", theirs / ours, f">= {bar}",
                ms(theirs, ours))
    else:
        print("scipy is not installed: comparison left out")
    ours, reference = times["default_glare/apply"], times["aureole/1919x1079"]
    row("default glare, full reach: times the 1919x1079 case", ours / reference, "<= 2",
        ms(ours, reference))
    ours, theirs = times["aureole_fft/4096x4096"], times["fftw/4096x4096"]
    print(f"{'4096x4096 complex: times faster than FFTW':<58} {theirs / ours:8.2f}"
          f"{'':23}{ms(theirs, ours)}")

    times = medians(programs / "eye_psf_bench", options.simd, max(3, options.rounds // 3))
    fftw = times["fftw_4096"]
    for bands, name in (("64", "64 bands"), ("0", "default bands")):
        row(f"eye PSF 1025x1025, {name}: times one FFTW transform",
            times[f"eye_psf/{bands}"] / fftw, "<= 6", ms(times[f"eye_psf/{bands}"], fftw))

    times = medians(programs / "flipbook_bench", options.simd, max(3, options.rounds // 3))
    row("eye PSF 511x511 from a flipbook: times faster than direct",
        times["direct"] / times["play/raster"], ">= 20", ms(times["direct"], times["play/raster"]))
    print(f"{'  the same, 3839x2159':<58} {times['direct'] / times['play/full_reach']:8.2f}"
          f"{'':23}{ms(times['direct'], times['play/full_reach'])}")
    sprites(programs / "sprites_bench")

    flares = programs / "flare_bench"
    times = medians(flares, options.simd, max(3, options.rounds // 3))
    row("ghosts, traced: Biotar, 45 x 3 bands x 128^2 rays (ms)", times["traced/biotar"], "<= 200",
        f"{times['traced/biotar/rays']:.0f} M rays/s, "
        f"{times['traced/biotar/rays'] / times['plain_rays/rays']:.0f} x the plain tracer's")
    row("ghosts, matrix: Nikon 28-75, 351 (ms)", times["matrix/nikon-28-75"], "<= 20")
    row("  placement alone, round iris (us)", times["place/round"], "<= 30",
        f"{times['place/blades']:.0f} us with 8 blades")

    times = medians(programs / "ibl_bench", options.simd, max(3, options.rounds // 3))
    row("environment filtered, gather, 256^2, 5 levels, 1 thread (ms)", times["gather/normal"],
        "<= 60", f"{times['gather/normal'] / times['precomputed/32']:.1f} x precomputed with 32 "
        f"samples, {times['gather/normal'] / times['precomputed/128']:.2f} x with 128")
    times = medians(programs / "ibl_sampling_bench", options.simd, max(3, options.rounds // 3),
                    "reference|fis_32|precomputed_32")
    for size in ("256", "128"):
        reference, fis, fast = (times[f"{name}/{size}"] for name in
                                ("reference_1024", "fis_32", "precomputed_32"))
        row(f"filtering {size}^2: FIS 32, times faster than the reference", reference / fis,
            ">= 12", ms(reference, fis))
        row(f"  precomputed 32, times faster than FIS 32", fis / fast, ">= 1.2", ms(fis, fast))

    whole_process(programs / "aureole")

    for job, bar in (("convolution", "250"), ("eye-psf", "600"), ("ibl", "150")):
        run = subprocess.run([programs / "peak_memory", job], check=True, capture_output=True,
                             text=True)
        row(f"peak memory (MB), {job}", float(run.stdout), f"<= {bar}")


if __name__ == "__main__":
    main()
