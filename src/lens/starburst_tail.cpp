#include "lens/starburst_tail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/base/units.h"

namespace aureole::lens {
namespace {

constexpr double kGreenMm = mm_from_nm(550);

// Energy per squared direction cosine at a distance s from the axis is T(s) p(phi) / s^3. A sample
// of wavelength l covers (l / L)^2 and lies at rho = s L / l: so a band adds l / L, as far as the
// raster does not hold it.
class Colour {
  public:
    Colour(const StarburstPattern& pattern, std::span<const color::SpectralBand> bands) {
        double shortest = bands.front().wavelength_nm;
        double longest = shortest;
        for (const color::SpectralBand& band : bands) {
            shortest = std::min(shortest, band.wavelength_nm);
            longest = std::max(longest, band.wavelength_nm);
        }
        first_ = pattern.crossover.full * mm_from_nm(shortest) / pattern.wide.extent_mm;
        const double last = pattern.crossover.end * mm_from_nm(longest) / pattern.wide.extent_mm;
        steps_per_log_ = (kEntries - 1) / std::log(last / first_);
        for (std::size_t i = 0; i < kEntries; ++i) {
            const double sine = first_ * std::exp(static_cast<double>(i) / steps_per_log_);
            for (const color::SpectralBand& band : bands) {
                const double step = mm_from_nm(band.wavelength_nm) / pattern.wide.extent_mm;
                const double share = 1 - pattern.crossover.before(sine / step);
                for (std::size_t c = 0; c < 3; ++c) table_[i][c] += band.rgb[c] * step * share;
            }
        }
    }

    double first() const { return first_; }
    color::Rgb at(double sine) const {
        const double position = std::log(sine / first_) * steps_per_log_;
        if (!(position > 0)) return {};
        if (position >= kEntries - 1) return table_.back();
        const auto i = static_cast<std::size_t>(position);
        const double t = position - static_cast<double>(i);
        color::Rgb rgb;
        for (std::size_t c = 0; c < 3; ++c) {
            rgb[c] = table_[i][c] + t * (table_[i + 1][c] - table_[i][c]);
        }
        return rgb;
    }

  private:
    static constexpr std::size_t kEntries = 512;
    std::array<color::Rgb, kEntries> table_ = {};
    double first_ = 0;
    double steps_per_log_ = 0;
};

struct Direction {
    double sine = 0;
    double area = 0;  // squared direction cosines per squared pixel; 0: behind the lens
};

Direction direction(Projection projection, double focal_px, double radius_px) {
    const double r = radius_px / focal_px;
    if (projection == Projection::kPerspective) {
        const double cosine2 = 1 / (1 + r * r);
        return {r * std::sqrt(cosine2), cosine2 * cosine2 / (focal_px * focal_px)};
    }
    if (r >= kPi / 2) return {};
    const double sine = std::sin(r);
    return {sine, std::cos(r) * sine / (r * focal_px * focal_px)};
}

// The pixels (dx, dy), dx, dy >= 0, and (-dx, dy) around the axis; dy upwards.
struct Pair {
    color::Rgb right = {};
    color::Rgb left = {};
};

class Pixels {
  public:
    Pixels(const StarburstPattern& pattern, std::span<const color::SpectralBand> bands,
           const wave::KernelGrid& grid)
        : pattern_(pattern),
          colour_(pattern, bands),
          projection_(grid.projection),
          focal_px_(grid.view().focal_length_px()),
          fitted_sine_(fitted_at(pattern.crossover.end) * kGreenMm / pattern.wide.extent_mm) {}

    Pair energy(int dx, int dy) const {
        // The law is read at the middle of a pixel: right to .5 / r^2 of it at r pixels. Near the
        // axis pixels are cut so that 32 of their parts lie between them and it.
        const double radius = std::hypot(dx, dy);
        const int parts = static_cast<int>(std::clamp(std::ceil(32 / (radius + 0.5)), 1.0, 32.0));
        const double side = 1.0 / parts;
        Pair sum;
        for (int j = 0; j < parts; ++j) {
            for (int i = 0; i < parts; ++i) {
                const double x = dx + (i + 0.5) * side - 0.5;
                const double y = dy + (j + 0.5) * side - 0.5;
                add(x, y, side, sum);
            }
        }
        return sum;
    }

  private:
    void add(double x, double y, double side, Pair& sum) const {
        const double radius = std::sqrt(x * x + y * y);
        const Direction d = direction(projection_, focal_px_, radius);
        if (!(d.area > 0) || d.sine <= colour_.first()) return;
        const color::Rgb rgb = colour_.at(d.sine);
        const double density = d.area * side * side / (d.sine * d.sine * d.sine);
        const double phi = std::atan2(y, x);
        const double stretch = d.sine / fitted_sine_;
        const double wide = side * std::abs(y) / (radius * radius);
        const double high = side * std::abs(x) / (radius * radius);
        const auto profile = [&](double direction_rad) {
            double p = 0;
            if (!pattern_.spikes.empty()) {
                p += pattern_.spikes.over(direction_rad, wide, high, stretch);
            }
            if (!pattern_.beyond.empty()) p += pattern_.beyond.over(direction_rad, wide, high);
            return p;
        };
        const double right = density * profile(phi);
        const double left = density * profile(kPi - phi);
        for (std::size_t c = 0; c < 3; ++c) {
            sum.right[c] += right * rgb[c];
            sum.left[c] += left * rgb[c];
        }
    }

    const StarburstPattern& pattern_;
    Colour colour_;
    Projection projection_;
    double focal_px_;
    double fitted_sine_;  // of green light: the width of spikes has one colour
};

}  // namespace

void add_beyond(const StarburstPattern& pattern, std::span<const color::SpectralBand> bands,
                const wave::KernelGrid& grid, Image& out) {
    const Pixels pixels(pattern, bands, grid);
    const int half_width = grid.width / 2;
    const int half_height = grid.height / 2;
    parallel_for(static_cast<std::size_t>(half_height) + 1, [&](std::size_t row, int) {
        const int dy = static_cast<int>(row);
        for (int dx = 0; dx <= half_width; ++dx) {
            const Pair pair = pixels.energy(dx, dy);
            for (int c = 0; c < 3; ++c) {
                const auto right = static_cast<float>(pair.right[static_cast<std::size_t>(c)]);
                const auto left = static_cast<float>(pair.left[static_cast<std::size_t>(c)]);
                float* above = out.row(half_height - dy, c) + half_width;
                float* below = out.row(half_height + dy, c) + half_width;
                above[dx] += right;
                if (dx > 0) above[-dx] += left;
                if (dy > 0) {
                    below[-dx] += right;
                    if (dx > 0) below[dx] += left;
                }
            }
        }
    });
}

}  // namespace aureole::lens
