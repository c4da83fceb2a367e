#include "glare/sprite_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "aureole/base/parallel.h"
#include "aureole/base/smoothstep.h"

namespace aureole::glare {
namespace {

constexpr int kVectorSlack = 16;  // floats that a vector may read beyond its row

double distance(int x, int y, int width, int height) {
    return std::hypot(x - width / 2, y - height / 2);
}

// The mean of one channel over the ring of pixels that are `radius` from the centre, +- half a
// pixel.
double ring_mean(const ConstImageView& kernel, int c, int radius) {
    double sum = 0;
    int count = 0;
    for (int y = -radius - 1; y <= radius + 1; ++y) {
        for (int x = -radius - 1; x <= radius + 1; ++x) {
            const int u = kernel.width / 2 + x;
            const int v = kernel.height / 2 + y;
            if (u < 0 || v < 0 || u >= kernel.width || v >= kernel.height) continue;
            if (std::abs(std::hypot(x, y) - radius) > 0.5) continue;
            sum += static_cast<double>(kernel.at(u, v, c));
            ++count;
        }
    }
    return count > 0 ? sum / count : 0;
}

// A parabola that continues the ring means inwards, with their slope at the radius and none in the
// middle: the top of the smooth part.
struct Cap {
    double value = 0;
    double slope = 0;  // at the radius
    double radius = 1;
    double at(double r) const { return value + 0.5 * slope * (r * r - radius * radius) / radius; }
};

Cap cap_of(const ConstImageView& kernel, int c, int radius) {
    const double inner = ring_mean(kernel, c, radius - 1);
    const double outer = ring_mean(kernel, c, radius + 1);
    return {ring_mean(kernel, c, radius), std::min(0.0, 0.5 * (outer - inner)),
            static_cast<double>(radius)};
}

}  // namespace

PaddedKernel::PaddedKernel(const ConstImageView& kernel)
    : width_(kernel.width),
      height_(kernel.height),
      stride_(kernel.width + 2 * kMargin + kVectorSlack),
      plane_size_(static_cast<std::size_t>(stride_) *
                  (static_cast<std::size_t>(kernel.height) + 2 * kMargin)),
      data_(plane_size_ * static_cast<std::size_t>(kernel.channels)) {
    std::memset(data_.data(), 0, data_.size() * sizeof(float));
    for (int c = 0; c < kernel.channels; ++c) {
        for (int y = 0; y < height_; ++y) {
            float* row = data_.data() + static_cast<std::size_t>(c) * plane_size_ +
                         (y + kMargin) * stride_ + kMargin;
            for (int x = 0; x < width_; ++x) row[x] = kernel.at(x, y, c);
        }
    }
}

const float* PaddedKernel::plane(int c) const {
    return data_.data() + static_cast<std::size_t>(c) * plane_size_ + kMargin * stride_ + kMargin;
}

KernelProfile::KernelProfile(const ConstImageView& kernel) {
    const auto bins = static_cast<std::size_t>(
        std::ceil(std::hypot(kernel.width - kernel.width / 2, kernel.height - kernel.height / 2)) +
        1);
    largest_.assign(bins, 0.0);
    lost_.assign(bins, 0.0);
    for (int c = 0; c < kernel.channels; ++c) {
        std::vector<double> sums(bins, 0.0);
        for (int y = 0; y < kernel.height; ++y) {
            for (int x = 0; x < kernel.width; ++x) {
                const double k = std::abs(static_cast<double>(kernel.at(x, y, c)));
                const auto bin =
                    static_cast<std::size_t>(distance(x, y, kernel.width, kernel.height));
                sums[bin] += k;
                largest_[bin] = std::max(largest_[bin], k);
            }
        }
        std::vector<double> beyond(bins + 1, 0.0);
        for (std::size_t i = bins; i-- > 0;) beyond[i] = beyond[i + 1] + sums[i];
        parallel_for(bins, [&](std::size_t radius, int) {
            double lost = beyond[radius];
            const auto end = static_cast<double>(radius);
            // Pixels of bin i are less than i + 1 away.
            for (auto i = static_cast<std::size_t>(kFadeFrom * end); i < radius; ++i) {
                const double left =
                    (end - static_cast<double>(i) - 1) / ((1 - kFadeFrom) * std::max(end, 1.0));
                lost += sums[i] * (1 - smoothstep(0, 1, left));
            }
            lost_[radius] = std::max(lost_[radius], lost);
        });
    }
    for (std::size_t i = bins - 1; i-- > 0;) largest_[i] = std::max(largest_[i], largest_[i + 1]);
    while (largest_.size() > 1 && largest_.back() == 0) largest_.pop_back();
    lost_.resize(largest_.size());
}

double KernelProfile::lost(int radius) const {
    if (radius >= end()) return 0;
    return lost_[static_cast<std::size_t>(std::max(radius, 0))];
}

int KernelProfile::radius_below(double value) const {
    const auto first = std::partition_point(largest_.begin(), largest_.end(),
                                            [value](double k) { return k > value; });
    return static_cast<int>(first - largest_.begin());
}

int KernelProfile::radius_losing(double sum) const {
    const auto first =
        std::partition_point(lost_.begin(), lost_.end(), [sum](double lost) { return lost > sum; });
    return static_cast<int>(first - lost_.begin());
}

SplitKernel split_kernel(const ConstImageView& kernel, int core_radius) {
    SplitKernel split;
    split.smooth = copy(kernel);
    if (core_radius == 0) return split;
    const int side = 2 * core_radius + 1;
    split.core = Image(side, side, kernel.channels);
    for (int c = 0; c < kernel.channels; ++c) {
        const Cap cap = cap_of(kernel, c, core_radius);
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const double r = std::hypot(x - core_radius, y - core_radius);
                if (r >= core_radius) continue;
                float& smooth = split.smooth.at(kernel.width / 2 + x - core_radius,
                                                kernel.height / 2 + y - core_radius, c);
                // The cap alone in the inner half, then over to the kernel with its needles.
                const double share = smoothstep(0.5, 1, r / core_radius);
                const double k = static_cast<double>(smooth);
                const auto rounded = static_cast<float>(share * k + (1 - share) * cap.at(r));
                split.core.at(x, y, c) = smooth - rounded;
                smooth = rounded;
            }
        }
    }
    return split;
}

Image cell_kernel(const ConstImageView& kernel, int side) {
    Image mean(kernel.width + side - 1, kernel.height + side - 1, kernel.channels);
    parallel_for(static_cast<std::size_t>(kernel.channels), [&](std::size_t channel, int) {
        const int c = static_cast<int>(channel);
        Image rows(mean.width(), kernel.height, 1);  // means along rows
        for (int y = 0; y < kernel.height; ++y) {
            double sum = 0;
            for (int x = 0; x < rows.width(); ++x) {
                if (x < kernel.width) sum += static_cast<double>(kernel.at(x, y, c));
                if (x >= side) sum -= static_cast<double>(kernel.at(x - side, y, c));
                rows.at(x, y) = static_cast<float>(sum / side);
            }
        }
        std::vector<double> sums(static_cast<std::size_t>(mean.width()), 0.0);
        for (int y = 0; y < mean.height(); ++y) {
            for (int x = 0; x < mean.width(); ++x) {
                double& sum = sums[static_cast<std::size_t>(x)];
                if (y < kernel.height) sum += static_cast<double>(rows.at(x, y));
                if (y >= side) sum -= static_cast<double>(rows.at(x, y - side));
                mean.at(x, y, c) = static_cast<float>(sum / side);
            }
        }
    });
    return mean;
}

}  // namespace aureole::glare
