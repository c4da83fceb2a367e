// Sprites, hybrid and the choice of method against transforms: tables whose rows are measured in
// turns, so that the machine's other work hits all methods.
//
//   figure9      the pictures of figure 9 of Sikachev et al. 2008: without clusters, in a static
//                grid of 2 x 2, in the paper's quad-tree of 16 x 16, in ours of bounded error
//   crossover    1 to 1000 lights: where sprites win, and what the cost model makes of it
//   auto         twelve pictures: the choice against the best single method, for the first picture
//                of its kind ("first") and for the next frame of a sequence ("next")
//   hybrid       8 dominant lights over a dim picture: hybrid against transforms, and its error
//
// With --csv FILE the rows are added to a file, for bench/sprites_report.py.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/fourier/convolver.h"
#include "aureole/glare/glare.h"
#include "aureole/glare/sprites.h"
#include "sprites_pictures.h"
#include "sprites_trial.h"

namespace aureole::bench {
namespace {

// Rows of a table: in milliseconds, by name of the column.
class Table {
  public:
    explicit Table(std::string csv) : csv_(std::move(csv)) {}
    void add(const std::string& kind, const std::vector<std::string>& cells) const {
        if (csv_.empty()) return;
        std::FILE* file = std::fopen(csv_.c_str(), "a");
        if (file == nullptr) return;
        std::string line = kind;
        for (const std::string& cell : cells) line += ";" + cell;
        fmt::print(file, "{}\n", line);
        std::fclose(file);
    }

  private:
    std::string csv_;
};

glare::SpriteOptions sprite_options(sources::ClusterOptions::Criterion criterion, int side,
                                    bool tree) {
    glare::SpriteOptions options;
    options.clusters.criterion = criterion;
    options.clusters.max_side = side;
    options.clusters.tree = tree;
    options.clusters.dim_limit = 1;  // the paper's threshold: the same pixels for all
    return options;
}

void figure9(const Table& table) {
    using Criterion = sources::ClusterOptions::Criterion;
    constexpr int kWidth = 1024;
    constexpr int kHeight = 768;
    const Image kernel = star_kernel(129, 129);
    const std::vector<Picture> pictures = {
        {"polygon", [](Image& i) { add_polygon(i, 100); }},
        {"300 lights", [](Image& i) { add_lights(i, 300, 2.5, 10); }},
        {"300 soft lights", [](Image& i) { add_lights(i, 300, 2.5, 10, true); }},
        {"mixed", [](Image& i) { add_polygon(i, 60), add_lights(i, 150, 2.5, 10); }},
        {"single pixels", [](Image& i) { add_lights(i, 1000, 0.5, 10); }},
    };
    std::vector<std::unique_ptr<glare::Sprites>> sprites;
    for (const auto& options : {sprite_options(Criterion::kSimilarColor, 1, true),
                                sprite_options(Criterion::kSimilarColor, 2, false),
                                sprite_options(Criterion::kSimilarColor, 16, true),
                                sprite_options(Criterion::kBoundedError, 1, true),
                                sprite_options(Criterion::kBoundedError, 16, true)}) {
        sprites.push_back(std::make_unique<glare::Sprites>(kWidth, kHeight, 3, kernel, options));
    }
    fourier::Convolver fft(kWidth, kHeight, 3, kernel);
    fmt::print("1024x768 RGB, kernel 129x129, ms (clusters); the last two before fft: error 1 %\n");
    fmt::print("{:<16} {:>15} {:>15} {:>15} {:>15} {:>15} {:>7}\n", "picture", "none", "2x2 static",
               "16x16 tree", "none, bounded", "16x16 bounded", "fft");
    for (const Picture& picture : pictures) {
        Image light(kWidth, kHeight, 3);
        picture.draw(light);
        Image out(kWidth, kHeight, 3);
        std::vector<std::vector<double>> times(sprites.size() + 1);
        std::vector<std::size_t> counts(sprites.size());
        for (int round = 0; round <= 2 * kRounds; ++round) {
            for (std::size_t i = 0; i < times.size(); ++i) {
                const double ms = timed_ms([&] {
                    if (i == sprites.size()) {
                        fft.run(light, out);
                    } else {
                        counts[i] = sprites[i]->apply(light, out).sprites;
                    }
                });
                if (round > 0) times[i].push_back(ms);  // the first one warms up
            }
        }
        fmt::print("{:<16}", picture.name);
        std::vector<std::string> cells = {picture.name};
        for (std::size_t i = 0; i < times.size(); ++i) {
            const double ms = median(times[i]);
            cells.push_back(fmt::format("{:.2f}", ms));
            if (i < sprites.size()) {
                fmt::print(" {:>7.1f} ({:>5})", ms, counts[i]);
                cells.push_back(fmt::format("{}", counts[i]));
            } else {
                fmt::print(" {:>7.1f}\n", ms);
            }
        }
        table.add("figure9", cells);
        std::fflush(stdout);
    }
}

void print_header() {
    fmt::print(
        "{:<21} {:>4} {:>7} | {:>6} {:>7} {:>6} | {:>6} {:>7} {:>6} | {:>6} {:>6} {:<7} {:<9} "
        "{:>5} {:>5}\n",
        "picture", "kern", "sprites", "fft", "sprites", "hybrid", "p.fft", "p.spr", "p.hyb",
        "first", "next", "chose", "reason", "first", "next");
}

void print_row(const Table& table, const std::string& kind, const std::string& picture,
               const std::string& kernel, int height, const Trial::Result& r) {
    fmt::print(
        "{:<21} {:>4} {:>7} | {:>6.1f} {:>7.1f} {:>6.1f} | {:>6.1f} {:>7.1f} {:>6.1f} | {:>6.1f} "
        "{:>6.1f} {:<7} {:<9} {:>5.2f} {:>5.2f}\n",
        picture, kernel, r.sprites, r.ms(0), r.ms(1), r.ms(2), r.predicted_ms(0), r.predicted_ms(1),
        r.predicted_ms(2), r.ms(3), r.ms(4), glare::name_of(r.choice.method),
        glare::name_of(r.choice.reason), r.ms(3) / r.best(), r.ms(4) / r.best());
    std::fflush(stdout);
    std::vector<std::string> cells = {fmt::format("{}", height), kernel, picture,
                                      fmt::format("{}", r.sprites)};
    for (int c = 0; c < Trial::kCases; ++c) cells.push_back(fmt::format("{:.2f}", r.ms(c)));
    for (int m = 0; m < 3; ++m) cells.push_back(fmt::format("{:.2f}", r.predicted_ms(m)));
    cells.emplace_back(glare::name_of(r.choice.method));
    cells.emplace_back(glare::name_of(r.choice.reason));
    table.add(kind, cells);
}

// How good predictions are: of each method that was predicted, and of the choice.
void summarize(const std::vector<Trial::Result>& results) {
    std::vector<double> errors;
    int differ = 0;
    int right = 0;
    double first = 0;
    double next = 0;
    for (const Trial::Result& r : results) {
        for (int m = 0; m < 3; ++m) {
            if (r.predicted_ms(m) > 0) errors.push_back(std::abs(r.predicted_ms(m) / r.ms(m) - 1));
        }
        first = std::max(first, r.ms(3) / r.best());
        next = std::max(next, r.ms(4) / r.best());
        const double least = std::min(r.ms(Trial::kFft), r.ms(Trial::kSprites));
        if (std::max(r.ms(Trial::kFft), r.ms(Trial::kSprites)) < 1.2 * least) continue;
        ++differ;
        for (int m = 0; m < 3; ++m) {
            const bool chosen =
                r.choice.candidates[static_cast<std::size_t>(m)].method == r.choice.method;
            if (chosen && r.ms(m) <= 1.2 * least) ++right;
        }
    }
    if (errors.empty()) return;
    fmt::print(
        "auto / best at most {:.2f} (first), {:.2f} (next); median error of predictions {:.0f} %; "
        "right picks where fft and sprites differ by 20 %: {} of {}\n",
        first, next, 100 * median(errors), right, differ);
}

// Pictures times kernels.
void compare(const Table& table, const std::string& kind, int width, int height,
             const std::string& only, const std::vector<Picture>& pictures) {
    const View view = view_of(width, height);
    fmt::print("{}x{} RGB, error 1 %, ms\n", width, height);
    print_header();
    std::vector<Image> lights;
    for (const Picture& picture : pictures) {
        lights.emplace_back(width, height, 3);
        picture.draw(lights.back());
    }
    std::vector<Trial::Result> all;
    for (const Kernel& kernel : kernels_for(width, height)) {
        if (!only.empty() && kernel.name != only) continue;
        Trial trial(view, psf_of(view, kernel.width, kernel.height));
        const std::vector<Trial::Result> results = trial.run(pictures, lights, kRounds);
        for (std::size_t i = 0; i < lights.size(); ++i) {
            print_row(table, kind, pictures[i].name, kernel.name, height, results[i]);
        }
        all.insert(all.end(), results.begin(), results.end());
    }
    summarize(all);
}

std::vector<Picture> lights_of_one_pixel() {
    std::vector<Picture> pictures;
    for (const int count : {1, 3, 10, 30, 100, 300, 1000}) {
        pictures.push_back({fmt::format("{} lights", count), [count](Image& light) {
                                Random random(3);
                                for (int i = 0; i < count; ++i) {
                                    const auto x =
                                        static_cast<int>(random.uniform(0, light.width()));
                                    const auto y =
                                        static_cast<int>(random.uniform(0, light.height()));
                                    for (int c = 0; c < 3; ++c) light.at(x, y, c) = 100;
                                }
                            }});
    }
    return pictures;
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

void hybrid(const Table& table, int width, int height) {
    const View view = view_of(width, height);
    const wave::Psf psf = psf_of(view, 2 * width - 1, 2 * height - 1);
    glare::Glare fft(view, 3, psf);
    glare::Glare both(view, 3, psf, by(glare::Method::kHybrid));
    Image light(width, height, 3);
    add_lights(light, 8, 4, 1e6F);
    add_ground(light, 2);
    Image exact(width, height, 3);
    Image out(width, height, 3);
    std::vector<double> fft_ms;
    std::vector<double> hybrid_ms;
    for (int round = 0; round <= kRounds; ++round) {
        const double a = timed_ms([&] { fft.apply(light, exact); });
        const double b = timed_ms([&] { both.apply(light, out); });
        if (round == 0) continue;
        fft_ms.push_back(a);
        hybrid_ms.push_back(b);
    }
    const double a = median(fft_ms);
    const double b = median(hybrid_ms);
    const double error = relative_error(out, exact, light);
    table.add("hybrid", {fmt::format("{}", height), fmt::format("{:.2f}", a),
                         fmt::format("{:.2f}", b), fmt::format("{:.6f}", error)});
    fmt::print(
        "{}x{}, full-screen kernel, 8 lights: fft {:.1f} ms, hybrid {:.1f} ms ({:.2f} x), "
        "error {:.5f}, bound {:.5f}, {} sprites\n",
        width, height, a, b, a / b, error, both.last().error_bound, both.last().sprites);
}

}  // namespace
}  // namespace aureole::bench

int main(int argc, char** argv) {
    using namespace aureole::bench;
    const aureole::ThreadLimit limit(2);
    std::vector<std::string> words(argv + 1, argv + argc);
    std::string csv;
    const auto option = std::find(words.begin(), words.end(), "--csv");
    if (option != words.end() && option + 1 != words.end()) {
        csv = option[1];
        words.erase(option, option + 2);
    }
    words.resize(3);
    const Table table(csv);
    const int height = words[1] == "2160" ? 2160 : 1080;
    const int width = height * 16 / 9;
    if (words[0] == "figure9") {
        figure9(table);
    } else if (words[0] == "crossover") {
        compare(table, "crossover", width, height, words[2], lights_of_one_pixel());
    } else if (words[0] == "auto") {
        compare(table, "auto", width, height, words[2], twelve_pictures());
    } else if (words[0] == "hybrid") {
        hybrid(table, width, height);
    } else {
        fmt::print(stderr,
                   "usage: sprites_bench figure9 | crossover|auto|hybrid [1080|2160] "
                   "[33|129|513|full] [--csv FILE]\n");
        return 2;
    }
    return 0;
}
