#include "aureole/eye/field_error.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/base/random.h"
#include "eye/field_streaks.h"

namespace aureole::eye {
namespace {

// Streaks have ended at 11 deg, tan = .2, from their light.
constexpr double kEnd = 0.2;

struct Difference {
    double l1 = 0;
    double energy = 0;
};

// Of half a kernel from a whole one.
Difference difference(const Image& half, const Image& truth) {
    const Image blend = fourier::whole_kernel(half);
    const int dx = (truth.width() - blend.width()) / 2;
    const int dy = (truth.height() - blend.height()) / 2;
    Difference sum;
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < truth.height(); ++y) {
            for (int x = 0; x < truth.width(); ++x) {
                const int bx = x - dx;
                const int by = y - dy;
                const bool held = bx >= 0 && by >= 0 && bx < blend.width() && by < blend.height();
                const auto value = static_cast<double>(truth.at(x, y, c));
                sum.l1 += std::abs((held ? static_cast<double>(blend.at(bx, by, c)) : 0.0) - value);
                sum.energy += value;
            }
        }
    }
    return sum;
}

}  // namespace

FieldError field_error(const Eye& eye, const View& view, const EyePsfOptions& options,
                       int positions, const std::function<Image(int x, int y)>& right_half_at) {
    if (positions < 1 || positions > 10000) {
        throw InvalidArgument("positions", std::to_string(positions), "must be 1 to 10000");
    }
    wave::KernelGrid grid = wave::KernelGrid::full_reach(view);
    const int side = 2 * static_cast<int>(kEnd * view.focal_length_px()) + 1;
    grid.width = std::min(grid.width, side);
    grid.height = std::min(grid.height, side);
    FieldStreaks streaks(eye, grid, options.aperture, options.spectral);
    Random random(1, 0);
    FieldError error{positions};
    Difference total;
    int lit = 0;
    for (int first = 0; first < positions; first += 2) {
        std::vector<std::pair<int, int>> pixels;
        std::vector<FieldPosition> fields;
        for (int i = first; i < std::min(first + 2, positions); ++i) {
            const int x = static_cast<int>(random.uniform() * view.width);
            const int y = static_cast<int>(random.uniform() * view.height);
            pixels.emplace_back(x, y);
            fields.push_back(field_position(view, x + 0.5, y + 0.5));
        }
        const auto truths = streaks.at(fields);
        for (std::size_t i = 0; i < truths.size(); ++i) {
            const Difference own =
                difference(right_half_at(pixels[i].first, pixels[i].second), truths[i].kernel);
            total.l1 += own.l1;
            total.energy += own.energy;
            if (own.energy == 0) continue;
            ++lit;
            error.mean += own.l1 / own.energy;
            error.worst = std::max(error.worst, own.l1 / own.energy);
        }
    }
    if (lit > 0) {
        error.l1 = total.l1 / total.energy;
        error.mean /= lit;
    }
    return error;
}

FieldError field_error(const Eye& eye, const wave::VaryingPsf& psf, const EyePsfOptions& options,
                       int positions) {
    return field_error(eye, psf.view, options, positions, [&](int x, int y) {
        return fourier::right_half(
            fourier::kernel_at(psf.parts, psf.view.width, psf.view.height, x, y));
    });
}

}  // namespace aureole::eye
