#include "aureole/eye/eye_psf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/eye/scatter.h"
#include "eye/components.h"
#include "eye/corona_texture.h"
#include "eye/diffracted_share.h"
#include "eye/kernel_checks.h"
#include "eye/pupil_outline.h"
#include "eye/scatter_pixels.h"
#include "eye/stopwatch.h"

namespace aureole::eye {
namespace {

// energy[c] S over the whole kernel; the four quadrants are mirror images.
void fill_scatter(const ScatterPixels& scatter, const std::vector<double>& energy, Image& kernel) {
    const int half_width = kernel.width() / 2;
    const int half_height = kernel.height() / 2;
    std::vector<std::vector<float>> quadrant_rows(static_cast<std::size_t>(max_workers()));
    parallel_for(static_cast<std::size_t>(half_height) + 1, [&](std::size_t row, int worker) {
        auto& quadrant = quadrant_rows[static_cast<std::size_t>(worker)];
        quadrant.resize(static_cast<std::size_t>(half_width) + 1);
        const int dy = static_cast<int>(row);
        scatter.row(dy, half_width + 1, quadrant.data());
        for (int c = 0; c < kernel.channels(); ++c) {
            const auto scale = static_cast<float>(energy[static_cast<std::size_t>(c)]);
            float* below = kernel.row(half_height + dy, c) + half_width;
            for (int dx = 0; dx <= half_width; ++dx) {
                below[dx] = scale * quadrant[static_cast<std::size_t>(dx)];
            }
            for (int dx = 1; dx <= half_width; ++dx) below[-dx] = below[dx];
            if (dy > 0) {
                std::copy_n(below - half_width, kernel.width(), kernel.row(half_height - dy, c));
            }
        }
    });
}

// The three channels that white light sees.
Image sum_of_lights(const Image& image) {
    Image white(image.width(), image.height(), 3);
    parallel_for(static_cast<std::size_t>(image.height()), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int channel = 0; channel < image.channels(); ++channel) {
            const float* from = image.row(y, channel);
            float* to = white.row(y, channel % 3);
            for (int x = 0; x < image.width(); ++x) to[x] += from[x];
        }
    });
    return white;
}

// Calls visit(kernel row segment, patch row, y, c) for every row of the patch.
template <class Visit>
void over_patch(Image& kernel, const wave::KernelGrid& patch, const Visit& visit) {
    const int x0 = (kernel.width() - patch.width) / 2;
    const int y0 = (kernel.height() - patch.height) / 2;
    parallel_for(static_cast<std::size_t>(patch.height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int c = 0; c < kernel.channels(); ++c) visit(kernel.row(y0 + y, c) + x0, y, c);
    });
}

void multiply_patch(Image& kernel, const wave::KernelGrid& patch, const Image& factor) {
    over_patch(kernel, patch, [&](float* k, int y, int c) {
        const float* f = factor.row(y, c);
        for (int x = 0; x < patch.width; ++x) k[x] *= f[x];
    });
}

// `weight`: of each of three colours.
void add_patch(Image& kernel, const wave::KernelGrid& patch, const Image& term,
               const std::array<double, 3>& weight) {
    over_patch(kernel, patch, [&](float* k, int y, int c) {
        const float* t = term.row(y, c);
        const auto w = static_cast<float>(weight[static_cast<std::size_t>(c % 3)]);
        for (int x = 0; x < patch.width; ++x) k[x] += w * t[x];
    });
}

// Gives S, which fills the kernel with the energy of white, the texture of the corona.
void apply_texture(const Image& corona, const Image& scatter, double contrast,
                   const std::array<double, 3>& energy, const wave::KernelGrid& patch,
                   Image& kernel) {
    if (kernel.channels() == 3) {
        multiply_patch(kernel, patch, corona_texture(corona, scatter, contrast));
        return;
    }
    // S itself has no colour; what the texture adds to it and takes from it has.
    const Image white = sum_of_lights(corona);
    const Image matrix =
        texture_of_primaries(corona_texture(white, scatter, contrast), corona, white, scatter);
    over_patch(kernel, patch, [&](float* k, int y, int channel) {
        const auto e = static_cast<float>(energy[static_cast<std::size_t>(channel % 3)]);
        const float own = is_own_colour(channel, kernel.channels()) ? 1.0F : 0.0F;
        const float* s = scatter.row(y, 0);
        const float* t = matrix.row(y, channel);
        for (int x = 0; x < patch.width; ++x) k[x] += e * s[x] * (t[x] - own);
    });
}

wave::Psf single_pattern(const wave::KernelGrid& grid, const wave::KernelGrid& patch,
                         const Image& pattern) {
    wave::Psf psf;
    psf.grid = grid;
    psf.kernel = Image(grid.width, grid.height, pattern.channels());
    add_patch(psf.kernel, patch, pattern, {1, 1, 1});
    psf.off_kernel_energy = energy_outside(pattern);
    return psf;
}

// Energy of the halo behind a round pupil: w_h of the header.
double round_halo_weight(double pupil_mm) {
    constexpr struct {
        double pupil_mm;
        double weight;
    } kNodes[] = {{3, 0}, {5, 0.0005}, {6, 0.0030}, {7, 0.0062}};
    if (pupil_mm <= kNodes[0].pupil_mm) return 0;
    for (std::size_t i = 1; i < std::size(kNodes); ++i) {
        if (pupil_mm > kNodes[i].pupil_mm) continue;
        const double t =
            (pupil_mm - kNodes[i - 1].pupil_mm) / (kNodes[i].pupil_mm - kNodes[i - 1].pupil_mm);
        return kNodes[i - 1].weight + t * (kNodes[i].weight - kNodes[i - 1].weight);
    }
    return kNodes[std::size(kNodes) - 1].weight;
}

}  // namespace

double halo_weight(const Eye& eye) {
    const PupilOutline pupil(eye);
    if (pupil.round()) return eye.halo * round_halo_weight(eye.pupil_diameter_mm);
    // Sector by sector, as many as a narrow slit needs.
    constexpr int kSectors = 4096;
    double energy = 0;
    double area = 0;
    for (int i = 0; i < kSectors; ++i) {
        const double radius_mm = pupil.radius_mm(2 * kPi * (i + 0.5) / kSectors);
        energy += round_halo_weight(2 * radius_mm) * radius_mm * radius_mm;
        area += radius_mm * radius_mm;
    }
    return eye.halo * energy / area;
}

wave::Psf eye_psf(const Eye& eye, const wave::KernelGrid& grid, const EyePsfOptions& options,
                  Progress* progress, EyePsfTimings* timings) {
    check(eye);
    check_kernel(grid);
    check_aperture(options.aperture);
    Components components(eye, grid, options, progress, timings);
    const wave::KernelGrid& patch = components.patch();
    const bool scatters = eye.scatter != ScatterModel::kNone;

    std::optional<Image> airy;
    if (!scatters) airy = components.bloom();
    double halo_share = halo_weight(eye);
    std::optional<Image> halo;
    if (halo_share > 0) halo = components.halo();
    if (!halo) halo_share = 0;
    const auto [corona, streaks, blocked_share] = components.corona_and_streaks(
        scatters && eye.corona_contrast > 0, eye.streaks > 0 && eye.eyelashes > 0);
    double streak_share = streaks ? blocked_share * eye.streaks : 0;
    const double limit = diffracted_limit(halo_share + streak_share);
    halo_share *= limit;
    streak_share *= limit;

    const double start = seconds();
    const int channels = components.channels();
    std::vector<double> rest;  // 1 - c. Of light in other colours than its own: -c
    for (int channel = 0; channel < channels; ++channel) {
        rest.push_back(is_own_colour(channel, channels) ? 1 : 0);
    }
    std::array<double, 3> rest_of_white = {1, 1, 1};
    const auto take = [&](const std::optional<Image>& pattern, double share) {
        if (!pattern) return;
        const auto sums = plane_sums(*pattern);
        for (std::size_t c = 0; c < rest.size(); ++c) {
            rest[c] -= share * sums[c];
            rest_of_white[c % 3] -= share * sums[c];
        }
    };
    take(halo, halo_share);
    take(streaks, streak_share);

    wave::Psf psf;
    psf.grid = grid;
    psf.kernel = Image(grid.width, grid.height, channels);
    if (scatters) {
        const ScatterPixels scatter(
            ScatterPsf(eye.scatter, eye.age_years, eye.pigmentation, eye.pupil_diameter_mm), grid);
        fill_scatter(scatter, rest, psf.kernel);
        if (corona) {
            apply_texture(*corona, scatter.image(patch.width, patch.height), eye.corona_contrast,
                          rest_of_white, patch, psf.kernel);
        }
        psf.off_kernel_energy.fill(scatter.off_kernel_energy());
    } else {
        add_patch(psf.kernel, patch, *airy, rest_of_white);
        psf.off_kernel_energy = energy_outside(*airy);
    }
    for (std::size_t c = 0; c < 3; ++c) psf.off_kernel_energy[c] *= rest_of_white[c];
    if (halo) add_patch(psf.kernel, patch, *halo, {halo_share, halo_share, halo_share});
    if (streaks) add_patch(psf.kernel, patch, *streaks, {streak_share, streak_share, streak_share});
    if (timings != nullptr) timings->scatter += seconds() - start;
    if (progress != nullptr) progress->report("eye psf", 1);
    return psf;
}

wave::Psf streaks_psf(const Eye& eye, const wave::KernelGrid& grid, const EyePsfOptions& options,
                      Progress* progress) {
    check(eye);
    check_kernel(grid);
    check_aperture(options.aperture);
    Components components(eye, grid, options, progress, nullptr);
    const auto parts = components.corona_and_streaks(false, eye.streaks > 0 && eye.eyelashes > 0);
    double share = parts.streaks ? parts.blocked_share * eye.streaks : 0;
    share *= diffracted_limit(share);
    wave::Psf psf;
    psf.grid = grid;
    const int channels = components.channels();
    psf.kernel = Image(grid.width, grid.height, channels);
    if (parts.streaks) {
        add_patch(psf.kernel, components.patch(), *parts.streaks, {share, share, share});
        psf.off_kernel_energy = energy_outside(*parts.streaks);
        for (double& energy : psf.off_kernel_energy) energy *= share;
    }
    for (int channel = 0; channel < channels; ++channel) {
        if (!is_own_colour(channel, channels)) continue;
        psf.kernel.at(grid.width / 2, grid.height / 2, channel) += static_cast<float>(1 - share);
    }
    if (progress != nullptr) progress->report("eye psf", 1);
    return psf;
}

wave::Psf eye_component(Component component, const Eye& eye, const wave::KernelGrid& grid,
                        const EyePsfOptions& options, Progress* progress) {
    check(eye);
    check_kernel(grid);
    check_aperture(options.aperture);
    if (component == Component::kCorona) {
        Eye without = eye;
        without.halo = 0;
        without.streaks = 0;
        return eye_psf(without, grid, options, progress);
    }
    Components components(eye, grid, options, progress, nullptr);
    if (component == Component::kBloom) {
        return single_pattern(grid, components.patch(), components.bloom());
    }
    if (component == Component::kHalo) {
        const auto halo = components.halo();
        if (!halo) {
            throw InvalidArgument("pupil", fmt::format("{}", eye.pupil_diameter_mm),
                                  "hides the fibres of the lens; the halo needs a wider one");
        }
        return single_pattern(grid, components.patch(), *halo);
    }
    const auto streaks = components.corona_and_streaks(false, true).streaks;
    if (!streaks) {
        throw InvalidArgument("eyelashes", fmt::format("{}", eye.eyelashes),
                              "none lies before the pupil; streaks need at least one");
    }
    return single_pattern(grid, components.patch(), *streaks);
}

}  // namespace aureole::eye
