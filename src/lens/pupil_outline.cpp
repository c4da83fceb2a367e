// Where the beam of a light ends, ray by ray.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/lens/field_starburst.h"
#include "aureole/lens/glass.h"
#include "aureole/lens/trace.h"

namespace aureole::lens {
namespace {

constexpr double kBlocked = std::numeric_limits<double>::infinity();
constexpr int kPoints = 1440;
constexpr int kBisections = 30;

class Beam {
  public:
    Beam(const Lens& lens, const Iris& iris, double tan_x, double tan_y)
        : tracer_(lens, kLineDNm),
          iris_(iris),
          stop_radius_mm_(lens.stop_radius_mm()),
          tan_x_(tan_x),
          tan_y_(tan_y) {}

    // How far out the ray through (x, y) of the entrance plane is at the worst aperture; 1: at its
    // edge.
    double clip(double x_mm, double y_mm) const {
        const TracedRay ray = tracer_.trace(Bounces{}, ray_from_light(tan_x_, tan_y_, x_mm, y_mm));
        if (ray.fate != Fate::kArrived) return kBlocked;
        const double stop = static_cast<double>(
            iris_.distance(static_cast<float>(ray.stop_x_mm / stop_radius_mm_),
                           static_cast<float>(ray.stop_y_mm / stop_radius_mm_)));
        return std::max(ray.housing_clip, stop);
    }

  private:
    Tracer tracer_;
    const Iris& iris_;
    double stop_radius_mm_;
    double tan_x_;
    double tan_y_;
};

struct Box {
    double x = 0, y = 0;  // middle
    double half_x = 0, half_y = 0;
};

// All of the entrance plane through which the front element may be reached.
Box front_element(const Lens& lens, double tan_x, double tan_y) {
    const double a = lens.faces().front().semi_aperture_mm;
    // The front is no deeper than it is wide.
    return {0, 0, a * (1 + std::abs(tan_x)), a * (1 + std::abs(tan_y))};
}

// Narrows a box down to the light that passes; nullopt if none does. Stopped down, the beam may be
// narrower than the distance of the first rays: then the one that passes best leads on.
std::optional<Box> beam_box(const Beam& beam, Box box) {
    constexpr int kSide = 48;
    constexpr int kRounds = 12;
    for (int round = 0; round < kRounds; ++round) {
        const double dx = 2 * box.half_x / kSide;
        const double dy = 2 * box.half_y / kSide;
        double low_x = HUGE_VAL, high_x = -HUGE_VAL, low_y = HUGE_VAL, high_y = -HUGE_VAL;
        double best = kBlocked;
        Box lead{0, 0, 2 * dx, 2 * dy};
        for (int j = 0; j <= kSide; ++j) {
            for (int i = 0; i <= kSide; ++i) {
                const double x = box.x - box.half_x + i * dx;
                const double y = box.y - box.half_y + j * dy;
                const double out = beam.clip(x, y);
                if (out < best) {
                    best = out;
                    lead.x = x;
                    lead.y = y;
                }
                if (out > 1) continue;
                low_x = std::min(low_x, x);
                high_x = std::max(high_x, x);
                low_y = std::min(low_y, y);
                high_y = std::max(high_y, y);
            }
        }
        if (best == kBlocked) return std::nullopt;
        if (best > 1) {
            box = lead;
            continue;
        }
        const Box next{(low_x + high_x) / 2, (low_y + high_y) / 2, (high_x - low_x) / 2 + dx,
                       (high_y - low_y) / 2 + dy};
        const bool settled = next.half_x > 0.5 * box.half_x && next.half_y > 0.5 * box.half_y;
        box = next;
        if (settled) return box;
    }
    return std::nullopt;
}

}  // namespace

std::optional<wave::Shape> pupil_outline(const Lens& lens, const Iris& iris, double tan_x,
                                         double tan_y) {
    if (iris.is_image()) {
        throw InvalidArgument("iris", "a picture", "has no outline to be seen from off the axis");
    }
    const Beam beam(lens, iris, tan_x, tan_y);
    const std::optional<Box> box = beam_box(beam, front_element(lens, tan_x, tan_y));
    if (!box || !(beam.clip(box->x, box->y) <= 1)) return std::nullopt;
    // From the plane of the first vertex to across the light: shorter along its direction.
    const double r = std::hypot(tan_x, tan_y);
    const double shortening = 1 - 1 / std::hypot(1, r);
    const double along_x = r > 0 ? tan_x / r : 0;
    const double along_y = r > 0 ? tan_y / r : 0;
    std::vector<wave::Point> points(kPoints);
    parallel_for(points.size(), [&](std::size_t i, int) {
        const double angle = 2 * kPi * static_cast<double>(i) / kPoints;
        const double dx = std::cos(angle);
        const double dy = std::sin(angle);
        double inside = 0;
        double outside = 2 * std::hypot(box->half_x, box->half_y);
        for (int step = 0; step < kBisections; ++step) {
            const double middle = 0.5 * (inside + outside);
            (beam.clip(box->x + middle * dx, box->y + middle * dy) <= 1 ? inside : outside) =
                middle;
        }
        const double along = inside * (dx * along_x + dy * along_y);
        points[i] = {inside * dx - shortening * along * along_x,
                     inside * dy - shortening * along * along_y};
    });
    double low_x = HUGE_VAL, high_x = -HUGE_VAL, low_y = HUGE_VAL, high_y = -HUGE_VAL;
    for (const wave::Point& point : points) {
        low_x = std::min(low_x, point.x_mm);
        high_x = std::max(high_x, point.x_mm);
        low_y = std::min(low_y, point.y_mm);
        high_y = std::max(high_y, point.y_mm);
    }
    for (wave::Point& point : points) {
        point.x_mm -= (low_x + high_x) / 2;
        point.y_mm -= (low_y + high_y) / 2;
    }
    const double pupil_mm = lens.efl_mm() / lens.f_number();
    if (std::min(high_x - low_x, high_y - low_y) < 0.01 * pupil_mm) return std::nullopt;
    return wave::Shape{{std::move(points)}};
}

}  // namespace aureole::lens
