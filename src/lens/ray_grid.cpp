#include "lens/ray_grid.h"

#include <algorithm>
#include <cmath>

namespace aureole::lens {
namespace {

constexpr int kMaxRounds = 10;

// A face's sag at the edge of its aperture, sampled: only its range matters.
struct SagRange {
    double low = 0, high = 0;
};

SagRange sag_range(const Face& face, double radius) {
    constexpr int kSamples = 64;
    SagRange range;
    for (int k = 1; k <= kSamples; ++k) {
        const double r2 = std::pow(radius * k / kSamples, 2);
        const double c = face.curvature_per_mm;
        double sag = c * r2 / (1 + std::sqrt(std::max(0.0, 1 - (1 + face.conic) * c * c * r2)));
        double power = r2 * r2;
        for (const double coefficient : face.asphere) {
            sag += coefficient * power;
            power *= r2;
        }
        range.low = std::min(range.low, sag);
        range.high = std::max(range.high, sag);
    }
    return range;
}

// Bounds of a quantity; lost rays are left out.
struct Range {
    float low = kLostRay, high = -kLostRay;
    void include(float value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    float size() const { return high - low; }
};

// The bounds of a field over each cell of a grid: of its corners, and of its neighbours' too.
class CellRanges {
  public:
    CellRanges(const float* field, const float* clip) {
        // Along rows, then across.
        float corner_low[kSide][kSide];
        float corner_high[kSide][kSide];
        float around_low[kSide][kSide];
        float around_high[kSide][kSide];
        for (int row = 0; row < kSide; ++row) {
            // With one more at the begin and two at the end.
            float low[kSide + 3];
            float high[kSide + 3];
            low[0] = low[kSide + 1] = low[kSide + 2] = kLostRay;
            high[0] = high[kSide + 1] = high[kSide + 2] = -kLostRay;
            for (int k = 0; k < kSide; ++k) {
                const bool lost = clip[row * kSide + k] >= kLostRay;
                low[k + 1] = lost ? kLostRay : field[row * kSide + k];
                high[k + 1] = lost ? -kLostRay : field[row * kSide + k];
            }
            for (int k = 0; k < kSide; ++k) {
                corner_low[row][k] = std::min(low[k + 1], low[k + 2]);
                corner_high[row][k] = std::max(high[k + 1], high[k + 2]);
                around_low[row][k] = std::min(corner_low[row][k], std::min(low[k], low[k + 3]));
                around_high[row][k] = std::max(corner_high[row][k], std::max(high[k], high[k + 3]));
            }
        }
        for (int row = 0; row + 1 < kSide; ++row) {
            const int before = std::max(row - 1, 0);
            const int behind = std::min(row + 2, kSide - 1);
            for (int k = 0; k < kSide; ++k) {
                corners_low_[row][k] = std::min(corner_low[row][k], corner_low[row + 1][k]);
                corners_high_[row][k] = std::max(corner_high[row][k], corner_high[row + 1][k]);
                around_low_[row][k] =
                    std::min(std::min(around_low[before][k], around_low[row][k]),
                             std::min(around_low[row + 1][k], around_low[behind][k]));
                around_high_[row][k] =
                    std::max(std::max(around_high[before][k], around_high[row][k]),
                             std::max(around_high[row + 1][k], around_high[behind][k]));
            }
        }
    }

    Range corners(int row, int column) const {
        return {corners_low_[row][column], corners_high_[row][column]};
    }
    // What the cell may hold: with few and large cells the quantity may turn within one, and its
    // neighbours tell how steeply.
    Range possible(int row, int column, bool last) const {
        const Range c = corners(row, column);
        const Range around = {around_low_[row][column], around_high_[row][column]};
        const float more = last ? 0.5F * c.size() : 0.75F * around.size();
        return {c.low - more, c.high + more};
    }

  private:
    static constexpr int kSide = EntranceSearch::kSide;

    float corners_low_[kSide][kSide];
    float corners_high_[kSide][kSide];
    float around_low_[kSide][kSide];
    float around_high_[kSide][kSide];
};

}  // namespace

PlaneBox PlaneBox::around(const PlaneBox& other) const {
    if (empty()) return other;
    if (other.empty()) return *this;
    return {std::min(x0, other.x0), std::max(x1, other.x1), std::min(y0, other.y0),
            std::max(y1, other.y1)};
}

RayDirection::RayDirection(const sources::Light& light) {
    const double scale = 1 / std::sqrt(1 + light.tan_x * light.tan_x + light.tan_y * light.tan_y);
    x = -light.tan_x * scale;
    y = -light.tan_y * scale;
    z = scale;
}

PlaneBox entrance_of_first_face(const Face& face, const RayDirection& direction, double widest) {
    const double radius = face.semi_aperture_mm * (face.stop ? widest : 1);
    const SagRange sag = sag_range(face, radius);
    const auto shifted = [&](double slope, double& low, double& high) {
        const double a = -slope * sag.low;
        const double b = -slope * sag.high;
        low = -radius + std::min({a, b, 0.0});
        high = radius + std::max({a, b, 0.0});
    };
    PlaneBox box;
    shifted(direction.x / direction.z, box.x0, box.x1);
    shifted(direction.y / direction.z, box.y0, box.y1);
    return box;
}

EntranceSearch::EntranceSearch() : memory_(5 * kSide * kSide) {
    float** const all[] = {&fields_.x, &fields_.y, &fields_.u, &fields_.v, &fields_.clip};
    for (std::size_t k = 0; k < 5; ++k) *all[k] = memory_.data() + k * kSide * kSide;
}

EntranceFound EntranceSearch::possible(const EntranceQuery& query, std::span<const RayStep> way,
                                       const PlaneBox& box, bool last) noexcept {
    static_assert(ray_stride(kSide) == kSide);
    RayBundle rays;
    rays.direction[0] = static_cast<float>(query.direction.x);
    rays.direction[1] = static_cast<float>(query.direction.y);
    rays.direction[2] = static_cast<float>(query.direction.z);
    rays.columns = rays.rows = kSide;
    const double step_x = (box.x1 - box.x0) / (kSide - 1);
    const double step_y = (box.y1 - box.y0) / (kSide - 1);
    rays.x_mm = static_cast<float>(box.x0);
    rays.y_mm = static_cast<float>(box.y0);
    rays.step_x_mm = static_cast<float>(step_x);
    rays.step_y_mm = static_cast<float>(step_y);
    ray_kernels().trace(way, query.sensor_distance_mm, rays, query.iris, fields_);
    rays_ += kSide * kSide;

    // The aperture that is hardest to pass, 1 at its edge: housings, and the stop as a circle.
    float* hardest = fields_.u;
    const auto widest = static_cast<float>(query.widest);
    for (int k = 0; k < kSide * kSide; ++k) {
        const float r =
            std::sqrt(fields_.u[k] * fields_.u[k] + fields_.v[k] * fields_.v[k]) / widest;
        hardest[k] = std::max(fields_.clip[k], r);
    }
    const CellRanges pass(hardest, fields_.clip);
    const CellRanges x(fields_.x, fields_.clip);
    const CellRanges y(fields_.y, fields_.clip);
    const PlaneBox& sensor = query.sensor;
    int first_column = kSide;
    int last_column = -1;
    int first_row = kSide;
    int last_row = -1;
    Range lands_x;
    Range lands_y;
    for (int row = 0; row + 1 < kSide; ++row) {
        for (int column = 0; column + 1 < kSide; ++column) {
            if (pass.corners(row, column).low >= kLostRay ||
                pass.possible(row, column, last).low > 1) {
                continue;
            }
            const Range in_x = x.possible(row, column, last);
            const Range in_y = y.possible(row, column, last);
            if (in_x.high < sensor.x0 || in_x.low > sensor.x1 || in_y.high < sensor.y0 ||
                in_y.low > sensor.y1) {
                continue;
            }
            first_column = std::min(first_column, column);
            last_column = std::max(last_column, column + 1);
            first_row = std::min(first_row, row);
            last_row = std::max(last_row, row + 1);
            lands_x.include(in_x.low);
            lands_x.include(in_x.high);
            lands_y.include(in_y.low);
            lands_y.include(in_y.high);
        }
    }
    if (last_column < 0) return {};
    return {{box.x0 + first_column * step_x, box.x0 + last_column * step_x,
             box.y0 + first_row * step_y, box.y0 + last_row * step_y},
            {lands_x.low, lands_x.high, lands_y.low, lands_y.high}};
}

EntranceFound EntranceSearch::find(const EntranceQuery& query) noexcept {
    PlaneBox box = query.start;
    for (int round = 0; round < kMaxRounds; ++round) {
        const PlaneBox smaller = possible(query, query.ways.front(), box, false).entrance;
        if (smaller.empty()) return {};
        const bool done = smaller.x1 - smaller.x0 > 0.8 * (box.x1 - box.x0) &&
                          smaller.y1 - smaller.y0 > 0.8 * (box.y1 - box.y0);
        box = smaller;
        if (done) break;
    }
    EntranceFound all;
    for (const auto way : query.ways) {
        const EntranceFound one = possible(query, way, box, true);
        all = {all.entrance.around(one.entrance), all.sensor.around(one.sensor)};
    }
    return all;
}

}  // namespace aureole::lens
