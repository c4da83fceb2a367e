#include "aureole/eye/field_error.h"

#include <algorithm>
#include <string>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/base/random.h"
#include "eye/field_streaks.h"

namespace aureole::eye {
namespace {

// Streaks have ended at 11 deg, tan = .2, from their light.
constexpr double kEnd = 0.2;

}  // namespace

wave::FieldError field_error(const Eye& eye, const View& view, const EyePsfOptions& options,
                             int positions,
                             const std::function<Image(int x, int y)>& right_half_at) {
    if (positions < 1 || positions > 10000) {
        throw InvalidArgument("positions", std::to_string(positions), "must be 1 to 10000");
    }
    wave::KernelGrid grid = wave::KernelGrid::full_reach(view);
    const int side = 2 * static_cast<int>(kEnd * view.focal_length_px()) + 1;
    grid.width = std::min(grid.width, side);
    grid.height = std::min(grid.height, side);
    FieldStreaks streaks(eye, grid, options.aperture, options.spectral);
    Random random(1, 0);
    wave::FieldErrorSum error;
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
            error.add(right_half_at(pixels[i].first, pixels[i].second), truths[i].kernel);
        }
    }
    return error.error();
}

wave::FieldError field_error(const Eye& eye, const wave::VaryingPsf& psf,
                             const EyePsfOptions& options, int positions) {
    return field_error(eye, psf.view, options, positions, [&](int x, int y) {
        return fourier::right_half(
            fourier::kernel_at(psf.parts, psf.view.width, psf.view.height, x, y));
    });
}

}  // namespace aureole::eye
