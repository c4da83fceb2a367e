#include "glare/raster_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "aureole/base/parallel.h"
#include "glare/raster.h"

namespace aureole::glare {
namespace {

// sum over a row of |interpolated - truth|, with nodes[m] left of the first pixel but `skipped`.
template <int kScale>
double row_difference(const float* nodes, int skipped, const float* truth, int count,
                      std::vector<float>& line) {
    const int spans = (skipped + count + kScale - 1) / kScale;
    for (int m = 0; m < spans; ++m) {
        const float step = nodes[m + 1] - nodes[m];
        for (int i = 0; i < kScale; ++i) {
            constexpr float kPixel = 1.0F / kScale;
            line[static_cast<std::size_t>(m * kScale + i)] =
                nodes[m] + (static_cast<float>(i) + 0.5F) * kPixel * step;
        }
    }
    const float* drawn = line.data() + skipped;
    constexpr int kLanes = 8;  // sums side by side become vectors
    std::array<float, kLanes> sums = {};
    int x = 0;
    for (; x + kLanes <= count; x += kLanes) {
        for (int l = 0; l < kLanes; ++l) {
            sums[static_cast<std::size_t>(l)] += std::abs(drawn[x + l] - truth[x + l]);
        }
    }
    double sum = 0;
    for (const float lane : sums) sum += static_cast<double>(lane);
    for (; x < count; ++x) sum += static_cast<double>(std::abs(drawn[x] - truth[x]));
    return sum;
}

// The sum of |drawn - far| over one channel with the source at pixel (phase_x, phase_y), which
// belong to node 0.
class ErrorAt {
  public:
    ErrorAt(const Image& far, const Image& kernel, int scale)
        : far_(far),
          kernel_(kernel),
          scale_(scale),
          rows_(static_cast<std::size_t>(far.height())) {}

    double operator()(int c, int phase_x, int phase_y) {
        parallel_for(rows_.size(), [&](std::size_t row, int) {
            rows_[row] = row_error(static_cast<int>(row), c, phase_x, phase_y);
        });
        double sum = 0;
        for (const double row : rows_) sum += row;
        return sum;
    }

  private:
    // Adds weight * kernel(first + n, v) to nodes[n].
    void add(int c, int v, int first, double weight, std::vector<float>& nodes) const {
        const float* from = kernel_.row(v + kernel_.height() / 2, c) + kernel_.width() / 2 + first;
        const auto factor = static_cast<float>(weight);
        for (std::size_t n = 0; n < nodes.size(); ++n) nodes[n] += factor * from[n];
    }

    double row_error(int row, int c, int phase_x, int phase_y) const {
        // Nodes left of, and above, source and pixel, and the shares of those after them.
        const Between source_x = raster_place(phase_x, scale_);
        const Between source_y = raster_place(phase_y, scale_);
        const Between pixel_y = raster_place(phase_y + row - far_.height() / 2, scale_);
        const int first_pixel = phase_x - far_.width() / 2;
        const int first_node = raster_place(first_pixel, scale_).node;
        const int skipped = first_pixel - (first_node * scale_ + scale_ / 2);
        const auto spans = static_cast<std::size_t>((skipped + far_.width()) / scale_ + 1);
        std::vector<float> nodes(spans + 1, 0.0F);
        for (const int down : {0, 1}) {
            for (const int up : {0, 1}) {
                for (const int across : {0, 1}) {
                    const auto share = [](const Between& place, int second) {
                        const auto right = static_cast<double>(place.right);
                        return second == 1 ? right : 1 - right;
                    };
                    add(c, pixel_y.node + down - source_y.node - up,
                        first_node - source_x.node - across,
                        share(pixel_y, down) * share(source_y, up) * share(source_x, across),
                        nodes);
                }
            }
        }
        std::vector<float> line(spans * static_cast<std::size_t>(scale_));
        const float* truth = far_.row(row, c);
        switch (scale_) {
            case 2:
                return row_difference<2>(nodes.data(), skipped, truth, far_.width(), line);
            case 4:
                return row_difference<4>(nodes.data(), skipped, truth, far_.width(), line);
            default:
                return row_difference<8>(nodes.data(), skipped, truth, far_.width(), line);
        }
    }

    const Image& far_;
    const Image& kernel_;
    int scale_;
    std::vector<double> rows_;
};

}  // namespace

double raster_error(const Image& far, const Image& kernel, int scale, double enough) {
    ErrorAt error_at(far, kernel, scale);
    double worst = 0;
    for (int c = 0; c < far.channels(); ++c) {
        for (const int y : {0, scale / 2}) {
            for (const int x : {0, scale / 2}) {
                worst = std::max(worst, error_at(c, x, y));
                if (worst > enough) return worst;
            }
        }
    }
    return worst;
}

}  // namespace aureole::glare
