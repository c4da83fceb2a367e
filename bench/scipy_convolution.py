#!/usr/bin/env python3
"""Convolution of a 1920x1080 RGB picture by scipy.fft.rfft2 with two workers, the kernel's spectrum
excluded: prints the median milliseconds for one kernel size.

usage: scipy_convolution.py KERNEL_WIDTH KERNEL_HEIGHT [ROUNDS]
"""
import statistics
import sys
import time

import numpy as np
import scipy.fft

WIDTH, HEIGHT = 1920, 1080


def main():
    kernel_width, kernel_height = int(sys.argv[1]), int(sys.argv[2])
    rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 9
    shape = (
        scipy.fft.next_fast_len(HEIGHT + kernel_height - 1, True),
        scipy.fft.next_fast_len(WIDTH + kernel_width - 1, True),
    )
    random = np.random.default_rng(1)
    picture = random.random((HEIGHT, WIDTH, 3), np.float32)
    out = np.empty_like(picture)
    kernel = random.random((kernel_height, kernel_width), np.float32)
    spectrum = scipy.fft.rfft2(kernel, shape, workers=2)
    top, left = kernel_height // 2, kernel_width // 2

    times = []
    for _ in range(rounds):
        start = time.perf_counter()
        for c in range(3):
            product = scipy.fft.rfft2(picture[..., c], shape, workers=2) * spectrum
            full = scipy.fft.irfft2(product, shape, workers=2)
            out[..., c] = full[top : top + HEIGHT, left : left + WIDTH]
        times.append(1e3 * (time.perf_counter() - start))
    print(f"{statistics.median(times):.2f}")


if __name__ == "__main__":
    main()
