// From the mask of one part of the eye to its texture: diffraction, wavelengths, bend, tone.
#include <algorithm>
#include <cmath>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/base/smoothstep.h"
#include "aureole/base/units.h"
#include "aureole/color/spectrum.h"
#include "aureole/eye/thesis_glare.h"
#include "aureole/fourier/fft.h"
#include "aureole/wave/diffraction.h"
#include "aureole/wave/spectral_psf.h"
#include "eye/thesis_masks.h"

namespace aureole::eye {
namespace {

constexpr double kReferenceNm = 575;  // section 2.3
constexpr int kCentre = kThesisTextureSide / 2;
// Textures end in a circle that fades out instead of a coloured square; from this share of it.
constexpr double kFadeFrom = 0.8;

// Wavelengths from 380 to 770 nm with both ends, each divided by their number (section 3.1, steps 1
// to 5); the three colours balanced, so that white light has white glare.
std::vector<color::SpectralBand> bands(int count) {
    const color::SpectralRange range;
    std::vector<color::SpectralBand> bands(static_cast<std::size_t>(count));
    color::Rgb sums = {};
    for (int i = 0; i < count; ++i) {
        auto& band = bands[static_cast<std::size_t>(i)];
        band.wavelength_nm =
            std::lerp(range.low_nm, range.high_nm, static_cast<double>(i) / (count - 1));
        band.rgb = thesis_wavelength_rgb(band.wavelength_nm);
        for (std::size_t c = 0; c < 3; ++c) sums[c] += band.rgb[c];
    }
    const double mean = (sums[0] + sums[1] + sums[2]) / 3;
    for (auto& band : bands) {
        for (std::size_t c = 0; c < 3; ++c) band.rgb[c] *= mean / sums[c] / count;
    }
    return bands;
}

Image coloured_pattern(Component component, const ThesisLook& look, const ThesisFrames& frames) {
    wave::Field field = wave::field_from(thesis_mask(component, look, frames));
    Image out(kThesisTextureSide, kThesisTextureSide, 3);
    if (std::all_of(field.re.data(), field.re.data() + field.re.size(),
                    [](float value) { return value == 0; })) {
        return out;
    }
    fourier::Fft2d fft(kThesisAperture.samples, kThesisAperture.samples);
    wave::transform(field, fft);
    // "The normalization of the values is done ... once at the end of the row pass, and once at the
    // end of the column pass": F / N^2, whatever N.
    const double scale = std::pow(static_cast<double>(kThesisAperture.samples), -4.0);
    const auto pattern = wave::PatternIntegral::from_transform(field, scale);
    wave::KernelGrid grid;
    grid.width = kThesisTextureSide;
    grid.height = kThesisTextureSide;
    grid.pitch_deg = deg_from_rad(mm_from_nm(kReferenceNm) / kThesisAperture.extent_mm);
    grid.projection = Projection::kConstantPitch;
    wave::add_spectral(pattern, kThesisAperture.extent_mm, wave::PixelRule::kMean,
                       bands(look.wavelengths), grid, {0, kCentre * grid.pitch_deg}, out,
                       wave::Symmetry::kHalfTurn);
    return out;
}

float bilinear(const Image& image, double x, double y, int c) {
    const auto x0 = static_cast<int>(std::floor(x));
    const auto y0 = static_cast<int>(std::floor(y));
    const double fx = x - x0;
    const double fy = y - y0;
    const auto value = [&](int i, int j) {
        const bool inside = i >= 0 && j >= 0 && i < image.width() && j < image.height();
        return inside ? static_cast<double>(image.at(i, j, c)) : 0.0;
    };
    return static_cast<float>(std::lerp(std::lerp(value(x0, y0), value(x0 + 1, y0), fx),
                                        std::lerp(value(x0, y0 + 1), value(x0 + 1, y0 + 1), fx),
                                        fy));
}

Image bent(const Image& straight, double bend, double closure) {
    Image out(kThesisTextureSide, kThesisTextureSide, 3);
    constexpr double kUnit = kThesisSamples / 2.0;
    parallel_for(static_cast<std::size_t>(kThesisTextureSide), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < kThesisTextureSide; ++x) {
            const TexturePoint from =
                thesis_bend({(x - kCentre) / kUnit, (kCentre - y) / kUnit}, bend, closure);
            for (int c = 0; c < 3; ++c) {
                out.at(x, y, c) =
                    bilinear(straight, kCentre + kUnit * from.x, kCentre - kUnit * from.y, c);
            }
        }
    });
    return out;
}

const ThesisTone& tone_of(Component component, const ThesisLook& look) {
    switch (component) {
        case Component::kBloom:
            return look.bloom;
        case Component::kHalo:
            return look.halo;
        case Component::kCorona:
            return look.corona;
        case Component::kStreaks:
            break;
    }
    return look.streaks;
}

}  // namespace

double apply(const ThesisTone& tone, double value) noexcept {
    return tone.factor * std::max(0.0, std::pow(std::max(value, 0.0), tone.power) - tone.threshold);
}

color::Rgb thesis_wavelength_rgb(double wavelength_nm) {
    const color::Rgb linear = color::rgb_from_xyz(color::cie_1931_observer(wavelength_nm));
    color::Rgb rgb;
    std::transform(linear.begin(), linear.end(), rgb.begin(), [](double value) {
        return static_cast<double>(
            color::srgb_encode(static_cast<float>(std::clamp(value, 0.0, 1.0))));
    });
    return rgb;
}

TexturePoint thesis_bend(TexturePoint at, double bend, double closure) noexcept {
    return {at.x, at.y + bend * closure * std::sin(at.x)};
}

Image thesis_texture(Component component, const ThesisLook& look, const ThesisFrames& frames) {
    check(look);
    Image texture = coloured_pattern(component, look, frames);
    const double closure = thesis_lid_closure(frames.lids);
    if (component == Component::kStreaks && look.bend * closure > 0) {
        texture = bent(texture, look.bend, closure);
    }
    const ThesisTone& tone = tone_of(component, look);
    parallel_for(static_cast<std::size_t>(kThesisTextureSide), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < kThesisTextureSide; ++x) {
            const double r = std::hypot(x - kCentre, y - kCentre) / kCentre;
            const double fade = smoothstep(0, 1 - kFadeFrom, 1 - r);
            for (int c = 0; c < 3; ++c) {
                float& value = texture.at(x, y, c);
                value = static_cast<float>(fade * apply(tone, static_cast<double>(value)));
            }
        }
    });
    return texture;
}

}  // namespace aureole::eye
