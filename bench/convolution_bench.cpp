// Convolution of a 1920x1080 RGB picture, interleaved in and out, kernel spectrum cached, against
// the textbook; the transforms themselves against FFTW; and what `aureole glare` does by default.
#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/fourier/convolver.h"
#include "aureole/fourier/fft.h"
#include "aureole/glare/glare.h"
#include "aureole/glare/varying_glare.h"
#include "aureole/image/view.h"
#include "fftw_baseline.h"
#include "simd_option.h"

namespace aureole::bench {
namespace {

constexpr int kWidth = 1920;
constexpr int kHeight = 1080;

Image noise(int width, int height, int channels) {
    Image image(width, height, channels);
    Random random(1);
    for (int c = 0; c < channels; ++c) {
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            image.plane(c)[i] = static_cast<float>(random.uniform());
        }
    }
    return image;
}

struct Pixels {
    std::vector<float> in = std::vector<float>(std::size_t{kWidth} * kHeight * 3, 0.5F);
    std::vector<float> out = std::vector<float>(in.size());
};

void textbook(benchmark::State& state, int kernel_width, int kernel_height) {
    TextbookConvolver convolver(kWidth, kHeight, noise(kernel_width, kernel_height, 1));
    Pixels pixels;
    convolver.run(pixels.in.data(), pixels.out.data());  // memory is there from the second frame on
    for (auto _ : state) convolver.run(pixels.in.data(), pixels.out.data());
}

void aureole(benchmark::State& state, int kernel_width, int kernel_height, int kernel_channels) {
    fourier::Convolver convolver(kWidth, kHeight, 3,
                                 noise(kernel_width, kernel_height, kernel_channels));
    Pixels pixels;
    const ConstImageView in =
        interleaved_view(const_cast<const float*>(pixels.in.data()), kWidth, kHeight, 3);
    const ImageView out = interleaved_view(pixels.out.data(), kWidth, kHeight, 3);
    convolver.run(in, out);
    for (auto _ : state) convolver.run(in, out);
}

// As the command does it: full reach, coloured kernel, perspective, planar picture.
void default_glare(benchmark::State& state) {
    const View view = View::from_fov(kWidth, kHeight, 60, Projection::kPerspective);
    std::unique_ptr<glare::Glare> glare;
    {
        wave::Psf psf;
        psf.grid = wave::KernelGrid::full_reach(view);
        psf.kernel = noise(psf.grid.width, psf.grid.height, 3);
        glare = std::make_unique<glare::Glare>(view, 3, psf);
    }
    const Image in = noise(kWidth, kHeight, 3);
    Image out(kWidth, kHeight, 3);
    glare->apply(in, out);
    for (auto _ : state) glare->apply(in, out);
}

// The same with streaks that vary over the field, as --field-varying on does it.
void varying_glare(benchmark::State& state) {
    wave::VaryingPsf psf;
    psf.view = View::from_fov(kWidth, kHeight, 60, Projection::kPerspective);
    psf.base.grid = wave::KernelGrid::full_reach(psf.view);
    psf.base.kernel = noise(psf.base.grid.width, psf.base.grid.height, 3);
    psf.parts.push_back({57, 32, std::vector<Image>(57 * 32, noise(16, 31, 3)), {}});
    psf.parts.push_back({11, 7, std::vector<Image>(11 * 7, noise(135, 269, 3)), {}});
    glare::VaryingGlare glare(3, psf);
    const Image in = noise(kWidth, kHeight, 3);
    Image out(kWidth, kHeight, 3);
    glare.apply(in, out);
    for (auto _ : state) glare.apply(in, out);
}

void fft_4096(benchmark::State& state) {
    constexpr int kSize = 4096;
    std::vector<float> re(std::size_t{kSize} * kSize);
    std::vector<float> im(re.size());
    fourier::Fft2d fft(kSize, kSize);
    for (auto _ : state) fft.forward(re.data(), im.data());
}

void fftw_4096(benchmark::State& state) {
    FftwSquare fftw(4096);
    for (auto _ : state) fftw.run();
}

void register_all() {
    struct Kernel {
        const char* name;
        int width;
        int height;
    };
    const auto add = [](const std::string& name, auto&&... arguments) {
        benchmark::RegisterBenchmark(name.c_str(), arguments...)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime()
            ->MinTime(0.2);
    };
    for (const Kernel& kernel : {Kernel{"513x513", 513, 513}, Kernel{"1025x1025", 1025, 1025},
                                 Kernel{"1919x1079", 1919, 1079}}) {
        const std::string name = kernel.name;
        add("textbook/" + name, textbook, kernel.width, kernel.height);
        add("aureole/" + name, aureole, kernel.width, kernel.height, 1);
        add("aureole_rgb_kernel/" + name, aureole, kernel.width, kernel.height, 3);
        add("aureole_matrix_kernel/" + name, aureole, kernel.width, kernel.height, 9);
    }
    add("default_glare/apply", default_glare);
    add("varying_glare/apply", varying_glare);
    add("fftw/4096x4096", fftw_4096);
    add("aureole_fft/4096x4096", fft_4096);
}

}  // namespace
}  // namespace aureole::bench

int main(int argc, char** argv) {
    aureole::bench::take_simd_option(argc, argv);
    const aureole::ThreadLimit limit(2);
    aureole::bench::register_all();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
