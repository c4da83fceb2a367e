// Streaks over the field, in one run: what they cost over one convolution, how far they are from
// those of each position, and how much memory storing the kernels of all positions would take for
// the same error.
//
//     field_bench [--spacing DEG] [--positions N] [--skip-storage]
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/eye/field_error.h"
#include "aureole/eye/field_needles.h"
#include "aureole/eye/field_psf.h"
#include "aureole/glare/glare.h"
#include "aureole/glare/varying_glare.h"
#include "aureole/wave/field_nodes.h"

namespace aureole::bench {
namespace {

constexpr int kWidth = 1920;
constexpr int kHeight = 1080;

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

Image noise(int width, int height) {
    Image image(width, height, 3);
    Random random(1);
    for (std::size_t i = 0; i < 3 * image.pixels(); ++i) {
        image.plane(0)[i] = static_cast<float>(random.uniform());
    }
    return image;
}

template <class Body>
double timed(const Body& body) {
    const double start = seconds();
    body();
    return seconds() - start;
}

// The best of some runs by turns.
std::pair<double, double> best_of(glare::Glare& one, glare::VaryingGlare& varying) {
    constexpr int kRuns = 12;
    const Image in = noise(kWidth, kHeight);
    Image out(kWidth, kHeight, 3);
    std::pair<double, double> best = {HUGE_VAL, HUGE_VAL};
    for (int run = 0; run < kRuns; ++run) {
        best.first = std::min(best.first, timed([&] { one.apply(in, out); }));
        best.second = std::min(best.second, timed([&] { varying.apply(in, out); }));
    }
    return best;
}

// Kernels of the reach of `options` at nodes `spacing_deg` apart that fit `nearest` or are blended.
class Stored {
  public:
    Stored(const eye::Eye& eye, const View& view, const eye::FieldPsfOptions& options,
           double spacing_deg, bool nearest)
        : eye_(eye),
          view_(view),
          options_(options.psf),
          grid_(wave::grid_within(view, options.reach_deg)),
          nodes_(wave::node_places(view, spacing_deg)),
          nearest_(nearest) {}

    std::size_t count() const { return nodes_.places.size(); }
    // Whole kernels: nothing else is known of them.
    std::size_t bytes() const {
        return count() * 3 * sizeof(float) * static_cast<std::size_t>(grid_.width) *
               static_cast<std::size_t>(grid_.height);
    }
    Image at(int x, int y) const {
        const fourier::NodeBlend across = fourier::node_blend(x, view_.width, nodes_.columns);
        const fourier::NodeBlend down = fourier::node_blend(y, view_.height, nodes_.rows);
        Image sum(grid_.width, grid_.height, 3);
        for (const int j : {0, 1}) {
            for (const int i : {0, 1}) {
                float share = (i == 0 ? 1 - across.second_share : across.second_share) *
                              (j == 0 ? 1 - down.second_share : down.second_share);
                if (nearest_) {
                    share = (i == 1) == (across.second_share > 0.5F) &&
                                    (j == 1) == (down.second_share > 0.5F)
                                ? 1.0F
                                : 0.0F;
                }
                if (share == 0) continue;
                const auto node =
                    static_cast<std::size_t>((down.first + j) * nodes_.columns + across.first + i);
                const auto& place = nodes_.places[node];
                const Image kernel = eye::streaks_at(
                    eye_, eye::field_position(view_, place.x, place.y), grid_, options_);
                for (std::size_t p = 0; p < 3 * sum.pixels(); ++p) {
                    sum.plane(0)[p] += share * kernel.plane(0)[p];
                }
            }
        }
        return fourier::right_half(sum);
    }

  private:
    const eye::Eye& eye_;
    const View& view_;
    const eye::EyePsfOptions& options_;
    wave::KernelGrid grid_;
    wave::NodePlaces nodes_;
    bool nearest_;
};

// Spacings are halved until the error is no larger than `error`; in between it is taken as a power
// of the spacing.
void report_storage(const eye::Eye& eye, const View& view, const eye::FieldPsfOptions& options,
                    int positions, double error, std::size_t held, bool nearest) {
    double coarse_deg = 0;
    double coarse_error = 0;
    for (double spacing_deg = 4.8;; spacing_deg /= 2) {
        const Stored stored(eye, view, options, spacing_deg, nearest);
        const double own = eye::field_error(eye, view, options.psf, positions, [&](int x, int y) {
                               return stored.at(x, y);
                           }).l1;
        if (own > error) {
            coarse_deg = spacing_deg;
            coarse_error = own;
            continue;
        }
        double needed_deg = spacing_deg;
        if (coarse_deg > 0) {
            const double power = std::log(coarse_error / own) / std::log(coarse_deg / spacing_deg);
            needed_deg *= std::pow(error / own, 1 / power);
        }
        const Stored needed(eye, view, options, needed_deg, nearest);
        fmt::print(
            "every kernel, {}: {:.2f} deg apart for {:.2f} %: {} kernels, {:.0f} MB; "
            "held are 1/{:.0f}\n",
            nearest ? "the nearest taken" : "the nearest four blended", needed_deg, 100 * error,
            needed.count(), static_cast<double>(needed.bytes()) * 1e-6,
            static_cast<double>(needed.bytes()) / static_cast<double>(held));
        return;
    }
}

void report_needles(const eye::Eye& eye, const View& view) {
    wave::VaryingPsf psf{eye::eye_psf(eye, wave::KernelGrid::full_reach(view)), {}, view};
    glare::Glare one(view, 3, psf.base);
    const double prepared = timed([&] { eye::vary_needles(psf, eye); });
    glare::VaryingGlare glare(3, psf);
    const auto [single, all] = best_of(one, glare);
    fmt::print("needles    cost {:5.2f} convolutions, {} regions in {:.1f} s, {:.1f} MB\n",
               all / single, psf.parts.front().halves.size(), prepared,
               static_cast<double>(fourier::bytes(psf.parts)) * 1e-6);
}

void run(double spacing_deg, int positions, bool with_storage) {
    const View view = View::from_fov(kWidth, kHeight, 60, Projection::kPerspective);
    const eye::Eye eye;
    eye::FieldPsfOptions options;
    if (spacing_deg > 0) options.spacing_deg = spacing_deg;
    wave::VaryingPsf psf;
    const double prepared = timed([&] { psf = eye::eye_field_psf(eye, view, options); });
    std::size_t kernels = 0;
    for (const auto& part : psf.parts) kernels += part.halves.size();
    fmt::print("{}x{}, 60 deg, nodes every {} deg: {} kernels, prepared in {:.1f} s\n", kWidth,
               kHeight, options.spacing_deg, kernels, prepared);

    const auto measure = [&](const char* name, const wave::VaryingPsf& varying) {
        glare::Glare one(view, 3, varying.base);
        glare::VaryingGlare glare(3, varying);
        const auto [single, all] = best_of(one, glare);
        const wave::FieldError error = eye::field_error(eye, varying, options.psf, positions);
        fmt::print(
            "{:10} cost {:5.2f} convolutions ({:.1f} of {:.1f} ms), error {:.2f} % "
            "(mean of ratios {:.2f} %, worst {:.1f} %; {} positions), {:.1f} MB\n",
            name, all / single, 1e3 * all, 1e3 * single, 100 * error.l1, 100 * error.mean,
            100 * error.worst, error.positions,
            static_cast<double>(fourier::bytes(varying.parts)) * 1e-6);
        return error.l1;
    };
    const double error = measure("on", psf);
    for (const int rank : {12, 24, 48}) {
        wave::VaryingPsf low = psf;
        for (auto& part : low.parts) part = principal_components(part, rank);
        measure(fmt::format("rank={}", rank).c_str(), low);
    }
    report_needles(eye, view);
    if (!with_storage) return;
    for (const bool nearest : {true, false}) {
        report_storage(eye, view, options, std::min(positions, 12), error,
                       fourier::bytes(psf.parts), nearest);
    }
}

}  // namespace
}  // namespace aureole::bench

int main(int argc, char** argv) {
    const aureole::ThreadLimit limit(2);
    double spacing_deg = 0;
    int positions = 24;
    bool with_storage = true;
    for (int i = 1; i < argc; ++i) {
        const std::string_view option = argv[i];
        if (option == "--skip-storage") {
            with_storage = false;
        } else if (option == "--spacing" && i + 1 < argc) {
            spacing_deg = std::atof(argv[++i]);
        } else if (option == "--positions" && i + 1 < argc) {
            positions = std::atoi(argv[++i]);
        } else {
            fmt::print(stderr, "field_bench [--spacing DEG] [--positions N] [--skip-storage]\n");
            return 2;
        }
    }
    aureole::bench::run(spacing_deg, positions, with_storage);
    return 0;
}
