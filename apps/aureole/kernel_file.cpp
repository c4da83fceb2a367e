#include "kernel_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/color/rgb.h"
#include "aureole/image/finite.h"

namespace aureole::app {
namespace {

constexpr const char* kPitch = "aureole:pitch_deg";
constexpr const char* kProjection = "aureole:projection";
constexpr const char* kOffKernel = "aureole:off_kernel_energy";
constexpr std::array<const char*, 3> kOffKernelOf = {
    "aureole:off_kernel_energy_r", "aureole:off_kernel_energy_g", "aureole:off_kernel_energy_b"};

constexpr double kPitchTolerance = 1e-3;

const char* name_of(Projection projection) {
    return projection == Projection::kPerspective ? "perspective" : "constant-pitch";
}

}  // namespace

io::Picture picture_of(const wave::Psf& psf) {
    io::Picture picture(psf.kernel);
    picture.set_attribute(kPitch, static_cast<float>(psf.grid.pitch_deg));
    picture.set_attribute(kProjection, std::string(name_of(psf.grid.projection)));
    const auto& off = psf.off_kernel_energy;
    picture.set_attribute(kOffKernel, static_cast<float>(color::luminance(off)));
    for (std::size_t c = 0; c < 3; ++c) {
        picture.set_attribute(kOffKernelOf[c], static_cast<float>(off[c]));
    }
    return picture;
}

wave::Psf read_kernel(const std::string& path, const View& view) {
    io::Picture picture = io::read_picture(path);
    if (const std::size_t bad = replace_nonfinite(picture.color()); bad > 0) {
        throw FileError(path, fmt::format("a kernel must be finite: {} of its pixels are NaN or "
                                          "infinite",
                                          bad));
    }
    const Image& image = picture.image();
    if (image.width() % 2 == 0 || image.height() % 2 == 0) {
        throw FileError(path, fmt::format("a kernel of {}x{} pixels has no central pixel: both "
                                          "sizes must be odd",
                                          image.width(), image.height()));
    }
    wave::Psf psf;
    psf.kernel = Image(image.width(), image.height(), 3);
    const ConstImageView color = picture.color();
    for (int c = 0; c < 3; ++c) {
        const int from = color.channels == 3 ? c : 0;
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) psf.kernel.at(x, y, c) = color.at(x, y, from);
        }
    }
    psf.grid = {image.width(), image.height(), view.pitch_deg, view.projection};
    if (const auto pitch_deg = picture.float_attribute(kPitch)) {
        const std::string projection =
            picture.string_attribute(kProjection).value_or(name_of(view.projection));
        if (projection != name_of(view.projection) ||
            !(std::abs(*pitch_deg / view.pitch_deg - 1) <= kPitchTolerance)) {
            throw FileError(
                path,
                fmt::format("is a kernel for pixels of {:.6g} deg, {}; those of the "
                            "picture have {:.6g} deg, {}: make it with its --width, "
                            "--fov and --perspective",
                            *pitch_deg, projection, view.pitch_deg, name_of(view.projection)));
        }
        for (std::size_t c = 0; c < 3; ++c) {
            psf.off_kernel_energy[c] = double{picture.float_attribute(kOffKernelOf[c]).value_or(0)};
        }
    }
    return psf;
}

Image logarithmic_picture(const wave::Psf& psf) {
    constexpr double kBlack = -2;  // log10 of the density shown as black, sr^-1
    constexpr double kWhite = 4;
    const Image& kernel = psf.kernel;
    const View view = psf.grid.view();
    Image picture(kernel.width(), kernel.height(), 3);
    parallel_for(static_cast<std::size_t>(kernel.height()), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < kernel.width(); ++x) {
            const color::Rgb rgb = {kernel.at(x, y, 0), kernel.at(x, y, 1), kernel.at(x, y, 2)};
            const double luminance = std::max(color::luminance(rgb), 1e-30);
            const double density = luminance / view.pixel_solid_angle_sr(x, y);
            const double level =
                std::clamp((std::log10(density) - kBlack) / (kWhite - kBlack), 0.0, 1.0);
            color::Rgb shown;
            for (std::size_t c = 0; c < 3; ++c) {
                shown[c] = level * std::max(rgb[c] / luminance, 0.0);
            }
            const double peak = std::max({shown[0], shown[1], shown[2], 1.0});
            for (int c = 0; c < 3; ++c) {
                picture.at(x, y, c) = static_cast<float>(shown[static_cast<std::size_t>(c)] / peak);
            }
        }
    });
    return picture;
}

}  // namespace aureole::app
