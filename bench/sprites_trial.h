// All ways of applying glare on pictures in turn, for sprites_bench.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "aureole/glare/glare.h"
#include "medians.h"
#include "sprites_pictures.h"

namespace aureole::bench {

inline constexpr int kRounds = 5;
// A case that takes that many times the fastest one is measured once.
inline constexpr double kHopeless = 8;

inline double timed_ms(const std::function<void()>& body) {
    const double start = now_ms();
    body();
    return now_ms() - start;
}

inline double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

inline glare::GlareOptions by(glare::Method method) {
    glare::GlareOptions options;
    options.method = method;
    options.cluster_error = 0.01;
    return options;
}

// All methods on pictures in turn.
class Trial {
  public:
    Trial(const View& view, const wave::Psf& psf)
        : fft_(view, 3, psf, by(glare::Method::kFft)),
          sprites_(view, 3, psf, by(glare::Method::kSprites)),
          hybrid_(view, 3, psf, by(glare::Method::kHybrid)),
          automatic_(view, 3, psf, by(glare::Method::kAuto)),
          out_(view.width, view.height, 3) {}

    enum Case { kFft, kSprites, kHybrid, kFirst, kNext, kCases };
    struct Result {
        std::vector<std::vector<double>> times = std::vector<std::vector<double>>(kCases);
        // Of `first`, in ms; those of 0 are not there.
        std::vector<std::vector<double>> predicted = std::vector<std::vector<double>>(3);
        glare::MethodReport choice;
        std::size_t sprites = 0;

        double ms(int c) const { return median(times[static_cast<std::size_t>(c)]); }
        double predicted_ms(int c) const {
            const auto& list = predicted[static_cast<std::size_t>(c)];
            return list.empty() ? 0 : median(list);
        }
        double best() const { return std::min({ms(kFft), ms(kSprites), ms(kHybrid)}); }
    };

    std::vector<Result> run(const std::vector<Picture>& pictures, const std::vector<Image>& lights,
                            int rounds) {
        std::vector<Result> results(lights.size());
        for (int round = 0; round <= rounds; ++round) {
            for (std::size_t i = 0; i < lights.size(); ++i) {
                for (int c = 0; c < kCases; ++c) {
                    measure(lights[i], pictures[i].everywhere, c, round, results[i]);
                }
            }
        }
        return results;
    }

  private:
    void measure(const Image& light, bool everywhere, int c, int round, Result& result) {
        auto& times = result.times[static_cast<std::size_t>(c)];
        // Light everywhere: a minute for nothing.
        if (c == kSprites && everywhere) {
            times = {std::numeric_limits<double>::infinity()};
            return;
        }
        if (c == kSprites && !times.empty() && times[0] > kHopeless * result.times[kFft].back()) {
            return;
        }
        glare::Glare* const glares[] = {&fft_, &sprites_, &hybrid_, &automatic_, &automatic_};
        const double ms = timed_ms([&] { glares[c]->apply(light, out_); });
        if (round == 0 && c == kSprites && ms > kHopeless * result.times[kFft].back()) {
            times = {ms};
            result.sprites = sprites_.last().sprites;
            return;
        }
        // The first round warms up: one value to be replaced.
        if (round <= 1) times.clear();
        times.push_back(ms);
        if (c == kSprites) result.sprites = sprites_.last().sprites;
        if (c != kFirst || round == 0) return;
        result.choice = automatic_.last();
        for (std::size_t m = 0; m < 3; ++m) {
            const double predicted = 1e3 * result.choice.candidates[m].predicted_seconds;
            if (predicted > 0) result.predicted[m].push_back(predicted);
        }
    }

    glare::Glare fft_;
    glare::Glare sprites_;
    glare::Glare hybrid_;
    glare::Glare automatic_;
    Image out_;
};

}  // namespace aureole::bench
