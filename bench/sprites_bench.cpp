// Sprites, hybrid and the choice of method against transforms. Prints tables, all figures of one
// run: `sprites_bench figure9|crossover|auto|hybrid`.
//
// figure9: the three kinds of pictures of figure 9 of Sikachev et al. 2008, drawn without clusters,
// in a static grid of 2 x 2, in the paper's quad-tree of 16 x 16, and in ours of bounded error.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/fourier/convolver.h"
#include "aureole/glare/glare.h"
#include "aureole/glare/sprites.h"
#include "aureole/image/view.h"
#include "medians.h"

namespace aureole::bench {
namespace {

// A peak, wings of r^-2.4, and six streaks; of sum 1.
Image star_kernel(int width, int height) {
    Image kernel(width, height, 3);
    for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const double dx = x - width / 2;
                const double dy = y - height / 2;
                const double r2 = dx * dx + dy * dy;
                const double streak = std::pow(std::abs(std::cos(3 * std::atan2(dy, dx))), 40);
                const double k = (1 + 2 * streak) / std::pow(0.3 + r2 / (1 + 0.1 * c), 1.2);
                kernel.at(x, y, c) = static_cast<float>(k);
                sum += k;
            }
        }
        const auto scale = static_cast<float>(1 / sum);
        for (std::size_t i = 0; i < kernel.pixels(); ++i) kernel.plane(c)[i] *= scale;
    }
    return kernel;
}

// An even disc, of whole pixels: antialiasing of a picture comes after its glare in the paper.
void add_disc(Image& image, double cx, double cy, double radius, float value) {
    const int top = std::max(0, static_cast<int>(cy - radius) - 1);
    const int bottom = std::min(image.height(), static_cast<int>(cy + radius) + 2);
    const int left = std::max(0, static_cast<int>(cx - radius) - 1);
    const int right = std::min(image.width(), static_cast<int>(cx + radius) + 2);
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
            const double r = std::hypot(x + 0.5 - cx, y + 0.5 - cy);
            if (r > radius) continue;
            for (int c = 0; c < 3; ++c) image.at(x, y, c) += value;
        }
    }
}

void add_polygon(Image& image, int side) {
    const int x0 = image.width() / 4;
    const int y0 = image.height() / 4;
    for (int y = y0; y < y0 + side; ++y) {
        for (int x = x0; x < x0 + side + (y - y0) / 3; ++x) {
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = 10;
        }
    }
}

void add_lights(Image& image, int count, double radius, float value, std::uint64_t seed = 1) {
    Random random(seed);
    for (int i = 0; i < count; ++i) {
        add_disc(image, random.uniform(0, image.width()), random.uniform(0, image.height()), radius,
                 value);
    }
}

void add_ground(Image& image, double level) {
    Random random(5);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            image.plane(c)[i] += static_cast<float>(level * random.uniform(0.5, 1.5));
        }
    }
}

glare::SpriteOptions sprite_options(sources::ClusterOptions::Criterion criterion, int side,
                                    bool tree) {
    glare::SpriteOptions options;
    options.clusters.criterion = criterion;
    options.clusters.max_side = side;
    options.clusters.tree = tree;
    options.clusters.dim_limit = 1;  // the paper's threshold: the same pixels for all
    return options;
}

void figure9() {
    using Criterion = sources::ClusterOptions::Criterion;
    constexpr int kWidth = 1024;
    constexpr int kHeight = 768;
    const Image kernel = star_kernel(129, 129);
    Image polygon(kWidth, kHeight, 3);
    add_polygon(polygon, 100);
    Image lights(kWidth, kHeight, 3);
    add_lights(lights, 300, 2.5, 10);
    Image mixed(kWidth, kHeight, 3);
    add_polygon(mixed, 60);
    add_lights(mixed, 150, 2.5, 10);
    fmt::print("1024x768 RGB, kernel 129x129, ms (clusters)\n");
    fmt::print("{:<10} {:>16} {:>16} {:>16} {:>16} {:>8}\n", "picture", "none", "2x2 static",
               "16x16 tree", "16x16 bounded", "fft");
    for (const auto& [name, picture] : {std::pair<const char*, Image*>{"polygon", &polygon},
                                        {"lights", &lights},
                                        {"mixed", &mixed}}) {
        const Image& light = *picture;
        std::vector<glare::Sprites> sprites;
        sprites.emplace_back(kWidth, kHeight, 3, kernel,
                             sprite_options(Criterion::kSimilarColor, 1, true));
        sprites.emplace_back(kWidth, kHeight, 3, kernel,
                             sprite_options(Criterion::kSimilarColor, 2, false));
        sprites.emplace_back(kWidth, kHeight, 3, kernel,
                             sprite_options(Criterion::kSimilarColor, 16, true));
        sprites.emplace_back(kWidth, kHeight, 3, kernel,
                             sprite_options(Criterion::kBoundedError, 16, true));
        fourier::Convolver fft(kWidth, kHeight, 3, kernel);
        Image out(kWidth, kHeight, 3);
        std::vector<std::function<void()>> cases;
        std::vector<std::size_t> counts(sprites.size());
        for (std::size_t i = 0; i < sprites.size(); ++i) {
            cases.emplace_back([&, i] { counts[i] = sprites[i].apply(light, out).sprites; });
        }
        cases.emplace_back([&] { fft.run(light, out); });
        const std::vector<double> ms = medians_ms(cases);
        fmt::print("{:<10}", name);
        for (std::size_t i = 0; i < sprites.size(); ++i) {
            fmt::print(" {:>8.1f} ({:>5})", ms[i], counts[i]);
        }
        fmt::print(" {:>8.1f}\n", ms.back());
        std::fflush(stdout);
    }
}

View view_of(int width, int height) {
    return View::from_fov(width, height, 40, Projection::kConstantPitch);
}

wave::Psf psf_of(const View& view, int width, int height) {
    wave::Psf psf;
    psf.grid = wave::KernelGrid::full_reach(view);
    psf.grid.width = width;
    psf.grid.height = height;
    psf.kernel = star_kernel(width, height);
    return psf;
}

glare::GlareOptions by(glare::Method method, double error = 0.01) {
    glare::GlareOptions options;
    options.method = method;
    options.cluster_error = error;
    return options;
}

double relative_error(const Image& a, const Image& b, const Image& light) {
    double difference = 0;
    double energy = 0;
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < a.pixels(); ++i) {
            difference += std::abs(static_cast<double>(a.plane(c)[i]) - b.plane(c)[i]);
            energy += std::abs(static_cast<double>(light.plane(c)[i]));
        }
    }
    return difference / energy;
}

struct Kernel {
    std::string name;
    int width;
    int height;
};

std::vector<Kernel> kernels_for(int width, int height) {
    return {{"33", 33, 33},
            {"129", 129, 129},
            {"513", 513, 513},
            {"full", 2 * width - 1, 2 * height - 1}};
}

// All methods on one picture; error against fft, and what auto said.
struct Trial {
    explicit Trial(const View& view, const wave::Psf& psf, double error)
        : fft(view, 3, psf, by(glare::Method::kFft, error)),
          sprites(view, 3, psf, by(glare::Method::kSprites, error)),
          hybrid(view, 3, psf, by(glare::Method::kHybrid, error)),
          automatic(view, 3, psf, by(glare::Method::kAuto, error)) {}

    struct Result {
        std::vector<double> ms;  // fft, sprites, hybrid, auto
        glare::MethodReport choice;
        std::size_t count = 0;  // of sprites
    };
    Result run(const Image& light, int rounds) {
        Image out(light.width(), light.height(), 3);
        Result result;
        result.ms =
            medians_ms({[&] { fft.apply(light, out); }, [&] { sprites.apply(light, out); },
                        [&] { hybrid.apply(light, out); }, [&] { automatic.apply(light, out); }},
                       rounds);
        result.choice = automatic.last();
        result.count = sprites.last().sprites;
        return result;
    }

    glare::Glare fft;
    glare::Glare sprites;
    glare::Glare hybrid;
    glare::Glare automatic;
};

void print_header() {
    fmt::print(
        "{:<22} {:>5} {:>8} {:>7} | {:>7} {:>7} {:>7} | {:>7} {:>7} {:>7} | {:>7} {:<8} "
        "{:<10} {:>5}\n",
        "picture", "kern", "sprites", "", "fft", "sprites", "hybrid", "p.fft", "p.spr", "p.hyb",
        "auto", "chose", "reason", "ratio");
}

void print_row(const std::string& picture, const std::string& kernel, const Trial::Result& r) {
    const auto predicted = [&](int i) {
        return 1e3 * r.choice.candidates[static_cast<std::size_t>(i)].predicted_seconds;
    };
    const double best = std::min({r.ms[0], r.ms[1], r.ms[2]});
    fmt::print(
        "{:<22} {:>5} {:>8} {:>7} | {:>7.1f} {:>7.1f} {:>7.1f} | {:>7.1f} {:>7.1f} {:>7.1f} "
        "| {:>7.1f} {:<8} {:<10} {:>5.2f}\n",
        picture, kernel, r.count, "", r.ms[0], r.ms[1], r.ms[2], predicted(0), predicted(1),
        predicted(2), r.ms[3], glare::name_of(r.choice.method), glare::name_of(r.choice.reason),
        r.ms[3] / best);
    std::fflush(stdout);
}

void crossover(int width, int height, const std::string& only) {
    const View view = view_of(width, height);
    fmt::print("{}x{} RGB, error 1 %, lights of one pixel, ms\n", width, height);
    print_header();
    for (const Kernel& kernel : kernels_for(width, height)) {
        if (!only.empty() && kernel.name != only) continue;
        Trial trial(view, psf_of(view, kernel.width, kernel.height), 0.01);
        for (const int count : {1, 10, 100, 1000}) {
            Image light(width, height, 3);
            Random random(3);
            for (int i = 0; i < count; ++i) {
                const int x = static_cast<int>(random.uniform(0, width));
                const int y = static_cast<int>(random.uniform(0, height));
                for (int c = 0; c < 3; ++c) light.at(x, y, c) = 100;
            }
            print_row(fmt::format("{} lights", count), kernel.name, trial.run(light, 3));
        }
    }
}

// The best of single methods against the choice.
void automatic(int width, int height, const std::string& only) {
    const View view = view_of(width, height);
    struct Picture {
        const char* name;
        std::function<void(Image&)> draw;
    };
    const std::vector<Picture> pictures = {
        {"black", [](Image&) {}},
        {"one light", [](Image& i) { add_lights(i, 1, 1.5, 100); }},
        {"8 lights", [](Image& i) { add_lights(i, 8, 2.5, 100); }},
        {"8 lights, dim ground",
         [](Image& i) { add_lights(i, 8, 2.5, 1e5F), add_ground(i, 0.01); }},
        {"8 suns, ground", [](Image& i) { add_lights(i, 8, 4, 1e6F), add_ground(i, 2); }},
        {"300 small lights", [](Image& i) { add_lights(i, 300, 2.5, 10); }},
        {"1000 lights", [](Image& i) { add_lights(i, 1000, 1, 10); }},
        {"polygon", [](Image& i) { add_polygon(i, 200); }},
        {"polygon, lights", [](Image& i) { add_polygon(i, 100), add_lights(i, 100, 2.5, 50); }},
        {"large discs", [](Image& i) { add_lights(i, 5, 60, 5); }},
        {"noise", [](Image& i) { add_ground(i, 1); }},
        {"noise, lights", [](Image& i) { add_ground(i, 1), add_lights(i, 20, 2.5, 1e3F); }},
    };
    fmt::print("{}x{} RGB, error 1 %, ms\n", width, height);
    print_header();
    for (const Kernel& kernel : kernels_for(width, height)) {
        if (!only.empty() ? kernel.name != only : kernel.name == "33") continue;
        Trial trial(view, psf_of(view, kernel.width, kernel.height), 0.01);
        for (const Picture& picture : pictures) {
            Image light(width, height, 3);
            picture.draw(light);
            print_row(picture.name, kernel.name, trial.run(light, 3));
        }
    }
}

// 8 dominant lights over a dim picture: equal error, and how large it is.
void hybrid(int width, int height) {
    const View view = view_of(width, height);
    const wave::Psf psf = psf_of(view, 2 * width - 1, 2 * height - 1);
    glare::Glare fft(view, 3, psf);
    glare::Glare both(view, 3, psf, by(glare::Method::kHybrid));
    Image light(width, height, 3);
    add_lights(light, 8, 4, 1e6F);
    add_ground(light, 2);
    Image exact(width, height, 3);
    Image out(width, height, 3);
    const auto ms = medians_ms({[&] { fft.apply(light, exact); }, [&] { both.apply(light, out); }});
    fmt::print(
        "{}x{}, full-screen kernel, 8 lights: fft {:.1f} ms, hybrid {:.1f} ms ({:.2f} x), "
        "error {:.5f}, bound {:.5f}, {} sprites\n",
        width, height, ms[0], ms[1], ms[0] / ms[1], relative_error(out, exact, light),
        both.last().error_bound, both.last().sprites);
}

}  // namespace
}  // namespace aureole::bench

int main(int argc, char** argv) {
    using namespace aureole::bench;
    const aureole::ThreadLimit limit(2);
    const std::string what = argc > 1 ? argv[1] : "";
    const bool large = argc > 2 && std::string(argv[2]) == "2160";
    const std::string kernel = argc > 3 ? argv[3] : "";
    const int width = large ? 3840 : 1920;
    const int height = large ? 2160 : 1080;
    if (what == "figure9") {
        figure9();
    } else if (what == "crossover") {
        crossover(width, height, kernel);
    } else if (what == "auto") {
        automatic(width, height, kernel);
    } else if (what == "hybrid") {
        hybrid(width, height);
    } else {
        fmt::print(stderr,
                   "usage: sprites_bench figure9 | crossover|auto|hybrid [1080|2160] [KERNEL]\n");
        return 2;
    }
    return 0;
}
