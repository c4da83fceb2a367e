// Kernels and pictures for sprites_bench: from a single light to light everywhere.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/image/image.h"
#include "aureole/image/view.h"
#include "aureole/wave/psf.h"

namespace aureole::bench {

// A peak, wings of r^-2.4, and six streaks; of sum 1.
inline Image star_kernel(int width, int height) {
    Image kernel(width, height, 3);
    parallel_for(static_cast<std::size_t>(height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < width; ++x) {
            const double dx = x - width / 2;
            const double dy = y - height / 2;
            const double r2 = dx * dx + dy * dy;
            const double streak = std::pow(std::abs(std::cos(3 * std::atan2(dy, dx))), 40);
            for (int c = 0; c < 3; ++c) {
                kernel.at(x, y, c) =
                    static_cast<float>((1 + 2 * streak) / std::pow(0.3 + r2 / (1 + 0.1 * c), 1.2));
            }
        }
    });
    for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (std::size_t i = 0; i < kernel.pixels(); ++i) {
            sum += static_cast<double>(kernel.plane(c)[i]);
        }
        const auto scale = static_cast<float>(1 / sum);
        for (std::size_t i = 0; i < kernel.pixels(); ++i) kernel.plane(c)[i] *= scale;
    }
    return kernel;
}

// An even disc: of whole pixels, since antialiasing of a picture comes after its glare in the
// paper; or with a `soft` rim one pixel wide.
inline void add_disc(Image& image, double cx, double cy, double radius, float value,
                     bool soft = false) {
    const int top = std::max(0, static_cast<int>(cy - radius) - 1);
    const int bottom = std::min(image.height(), static_cast<int>(cy + radius) + 2);
    const int left = std::max(0, static_cast<int>(cx - radius) - 1);
    const int right = std::min(image.width(), static_cast<int>(cx + radius) + 2);
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
            const double r = std::hypot(x + 0.5 - cx, y + 0.5 - cy);
            const double cover = soft ? std::clamp(radius - r + 0.5, 0.0, 1.0) : r <= radius;
            for (int c = 0; c < 3; ++c) image.at(x, y, c) += static_cast<float>(cover) * value;
        }
    }
}

inline void add_polygon(Image& image, int side) {
    const int x0 = image.width() / 4;
    const int y0 = image.height() / 4;
    for (int y = y0; y < y0 + side; ++y) {
        for (int x = x0; x < x0 + side + (y - y0) / 3; ++x) {
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = 10;
        }
    }
}

inline void add_lights(Image& image, int count, double radius, float value, bool soft = false) {
    Random random(1);
    for (int i = 0; i < count; ++i) {
        add_disc(image, random.uniform(0, image.width()), random.uniform(0, image.height()), radius,
                 value, soft);
    }
}

inline void add_ground(Image& image, double level) {
    Random random(5);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            image.plane(c)[i] += static_cast<float>(level * random.uniform(0.5, 1.5));
        }
    }
}

inline View view_of(int width, int height) {
    return View::from_fov(width, height, 40, Projection::kConstantPitch);
}

inline wave::Psf psf_of(const View& view, int width, int height) {
    wave::Psf psf;
    psf.grid = wave::KernelGrid::full_reach(view);
    psf.grid.width = width;
    psf.grid.height = height;
    psf.kernel = star_kernel(width, height);
    return psf;
}

struct Kernel {
    std::string name;
    int width;
    int height;
};

inline std::vector<Kernel> kernels_for(int width, int height) {
    return {{"33", 33, 33},
            {"129", 129, 129},
            {"513", 513, 513},
            {"full", 2 * width - 1, 2 * height - 1}};
}

struct Picture {
    std::string name;
    std::function<void(Image&)> draw;
    bool everywhere = false;  // there is light: sprites would take minutes
};

// From nothing to light everywhere.
inline std::vector<Picture> twelve_pictures() {
    return {
        {"black", [](Image&) {}},
        {"one light", [](Image& i) { add_lights(i, 1, 1.5, 100); }},
        {"8 lights", [](Image& i) { add_lights(i, 8, 2.5, 100); }},
        {"8 lights, dim ground",
         [](Image& i) { add_lights(i, 8, 2.5, 1e5F), add_ground(i, 0.01); }},
        {"8 suns, ground", [](Image& i) { add_lights(i, 8, 4, 1e6F), add_ground(i, 2); }},
        {"300 lights", [](Image& i) { add_lights(i, 300, 2.5, 10); }},
        {"1000 lights", [](Image& i) { add_lights(i, 1000, 1, 10); }},
        {"polygon", [](Image& i) { add_polygon(i, 200); }},
        {"polygon, lights", [](Image& i) { add_polygon(i, 100), add_lights(i, 100, 2.5, 50); }},
        {"large discs", [](Image& i) { add_lights(i, 5, 60, 5); }},
        {"noise", [](Image& i) { add_ground(i, 1); }, true},
        {"noise, lights", [](Image& i) { add_ground(i, 1), add_lights(i, 20, 2.5, 1e3F); }, true},
    };
}

}  // namespace aureole::bench
