#include "aureole/lens/starburst.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/fourier/sizes.h"
#include "aureole/wave/spectral_psf.h"
#include "lens/starburst_aperture.h"
#include "lens/starburst_behind.h"
#include "lens/starburst_pattern.h"
#include "lens/starburst_tail.h"

namespace aureole::lens {
namespace {

void check(double pupil_diameter_mm, const wave::KernelGrid& grid,
           const StarburstOptions& options) {
    if (!(pupil_diameter_mm > 0) || !std::isfinite(pupil_diameter_mm)) {
        throw InvalidArgument("pupil diameter (mm)", fmt::format("{}", pupil_diameter_mm),
                              "must be positive and finite");
    }
    if (grid.width < 1 || grid.height < 1 || grid.width % 2 == 0 || grid.height % 2 == 0) {
        throw InvalidArgument("kernel", fmt::format("{}x{}", grid.width, grid.height),
                              "must have an odd width and height");
    }
    if (!(grid.pitch_deg > 0) || !std::isfinite(grid.pitch_deg) ||
        (grid.projection == Projection::kPerspective && grid.pitch_deg >= 90)) {
        throw InvalidArgument("pitch of the kernel (deg)", fmt::format("{}", grid.pitch_deg),
                              "must be positive, and below 90 in perspective");
    }
    if (options.samples < 256 || options.samples > 16384 || options.samples % 2 != 0 ||
        !fourier::is_smooth(options.samples)) {
        throw InvalidArgument("samples of the aperture", fmt::format("{}", options.samples),
                              "must be 256 to 16384, even and without prime factors above 7");
    }
    if (options.bands < 0 || options.bands > 4096) {
        throw InvalidArgument("wavelengths", fmt::format("{}", options.bands),
                              "must be 1 to 4096, or 0 for automatic");
    }
}

double angle_deg(const wave::KernelGrid& grid, double radius_px) {
    const double ratio = radius_px / grid.view().focal_length_px();
    return deg_from_rad(grid.projection == Projection::kPerspective ? std::atan(ratio) : ratio);
}

// A ring moves by r d(ln lambda) pixels from one band to the next: the further out, the more bands.
void add_raster(const PatternRaster& raster, const StarburstOptions& options,
                const wave::KernelGrid& grid, Image& out) {
    const auto add = [&](int bands, wave::AngleRange range) {
        wave::add_spectral(raster.energy, raster.extent_mm, wave::PixelRule::kEnergy,
                           color::sample_spectrum(bands, color::WavelengthSpacing::kLogarithmic,
                                                  options.illuminant),
                           grid, range, out, wave::Symmetry::kHalfTurn);
    };
    if (options.bands > 0) {
        add(options.bands, {});
        return;
    }
    constexpr int kFewest = 32;
    constexpr int kMost = 1024;
    const color::SpectralRange visible;
    const double log_range = std::log(visible.high_nm / visible.low_nm);
    const double sine =
        std::min(0.999, raster.end * mm_from_nm(visible.high_nm) / raster.extent_mm);
    const double end_deg = deg_from_rad(std::asin(sine)) + angle_deg(grid, 1);
    double from_deg = 0;
    for (int bands = kFewest; from_deg < end_deg; bands *= 2) {
        const double to_deg =
            bands == kMost ? wave::AngleRange{}.max_deg : angle_deg(grid, bands / log_range);
        add(bands, {from_deg, to_deg});
        from_deg = to_deg;
    }
}

std::array<double, 3> energy_outside(const Image& kernel) {
    std::array<double, 3> outside = {};
    std::vector<double> rows(static_cast<std::size_t>(kernel.height()));
    for (int c = 0; c < 3; ++c) {
        parallel_for(rows.size(), [&](std::size_t y, int) {
            const float* row = kernel.row(static_cast<int>(y), c);
            rows[y] = std::accumulate(row, row + kernel.width(), 0.0);
        });
        outside[static_cast<std::size_t>(c)] = 1 - std::accumulate(rows.begin(), rows.end(), 0.0);
    }
    return outside;
}

}  // namespace

wave::Psf starburst_behind(const Iris& iris, double pupil_diameter_mm, const wave::KernelGrid& grid,
                           const StarburstOptions& options, const Obstacles& obstacles,
                           Progress* progress) {
    check(pupil_diameter_mm, grid, options);
    const auto done = [progress](double fraction) {
        if (progress == nullptr) return;
        progress->report("starburst", fraction);
        if (progress->cancelled()) throw Cancelled();
    };
    done(0);
    const StarburstPattern pattern =
        starburst_pattern(iris, pupil_diameter_mm,
                          plan_raster(iris, pupil_diameter_mm, options.samples, grid), obstacles);
    done(0.4);
    wave::Psf psf;
    psf.grid = grid;
    psf.kernel = Image(grid.width, grid.height, 3);
    if (pattern.core) add_raster(*pattern.core, options, grid, psf.kernel);
    add_raster(pattern.wide, options, grid, psf.kernel);
    done(0.8);
    constexpr int kTailBands = 256;
    add_beyond(pattern,
               color::sample_spectrum(options.bands > 0 ? options.bands : kTailBands,
                                      color::WavelengthSpacing::kLogarithmic, options.illuminant),
               grid, psf.kernel);
    psf.off_kernel_energy = energy_outside(psf.kernel);
    done(1);
    return psf;
}

wave::Psf starburst_psf(const Iris& iris, double pupil_diameter_mm, const wave::KernelGrid& grid,
                        const StarburstOptions& options, const Occluder* occluder,
                        Progress* progress) {
    return starburst_behind(iris, pupil_diameter_mm, grid, options, {occluder, nullptr}, progress);
}

}  // namespace aureole::lens
