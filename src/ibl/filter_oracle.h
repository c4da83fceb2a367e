// The truth that filters are tested against: the weight of prefilter.h summed over every texel of
// an environment in double precision, each texel being a square of constant radiance. Far from the
// lobe a texel counts with its middle, near it with Gauss points in up to 32 x 32 parts.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "aureole/base/units.h"
#include "aureole/ibl/cube_map.h"

namespace aureole::ibl {

class FilterOracle {
  public:
    explicit FilterOracle(const CubeMap& environment)
        : environment_(&environment), size_(environment.size()) {
        for (int face = 0; face < kFaces; ++face) {
            for (int y = 0; y < size_; y += kPatchSide) {
                for (int x = 0; x < size_; x += kPatchSide) add_patch(face, x, y);
            }
        }
    }

    // P(N, alpha) of prefilter.h.
    std::array<double, 3> filtered(const Direction& n, double alpha) const {
        const double a2 = alpha * alpha;
        const auto weight = [&](double cosine) {
            const double q = 1 - (1 - a2) * (1 + cosine) / 2;
            return std::max(cosine, 0.0) / (q * q);
        };
        std::array<FaceAxes, kFaces> in_face;
        for (int face = 0; face < kFaces; ++face) {
            const double along = dot(n, direction_of({face, 0, 0}));
            in_face[static_cast<std::size_t>(face)] = {
                along, std::sqrt(2.0) * dot(n, direction_of({face, 1, 0})) - along,
                std::sqrt(2.0) * dot(n, direction_of({face, 0, 1})) - along};
        }
        std::array<double, 3> sum = {};
        for (const Patch& patch : patches_) {
            const double texel = 4.0 / (size_ * static_cast<double>(size_)) / 6;  // its spread
            const double gap =
                std::max(0.0, std::sqrt(2 - 2 * dot(n, patch.middle)) - patch.radius);
            if (gap > std::sqrt(2.0) + 1.5 / size_) continue;  // below the horizon to its corners
            if (texel < kFar * (a2 + (1 - a2) * gap * gap / 4)) {
                // Weights first: a loop that compilers take several texels of at a time.
                std::array<double, kPatchSide * kPatchSide> weights;
                const std::size_t count = patch.end - patch.first;
                for (std::size_t k = 0; k < count; ++k) {
                    const std::size_t i = patch.first + k;
                    weights[k] = solid_angle_[i] * weight(n.x * x_[i] + n.y * y_[i] + n.z * z_[i]);
                }
                for (std::size_t c = 0; c < 3; ++c) {
                    const double* const radiance = radiance_[c].data() + patch.first;
                    for (std::size_t k = 0; k < count; ++k) sum[c] += weights[k] * radiance[k];
                }
                continue;
            }
            for (std::size_t i = patch.first; i < patch.end; ++i) {
                if (radiance_[0][i] == 0 && radiance_[1][i] == 0 && radiance_[2][i] == 0) continue;
                const double cosine = n.x * x_[i] + n.y * y_[i] + n.z * z_[i];
                const double relative = texel / (1 - (1 - a2) * (1 + cosine) / 2);
                const int parts = relative < 2e-3   ? 1
                                  : relative < 1e-2 ? 2
                                  : relative < .2   ? 6
                                                    : 16;
                const double w = near_weight(patch, static_cast<int>(i - patch.first), parts,
                                             in_face[static_cast<std::size_t>(patch.face)], weight);
                for (std::size_t c = 0; c < 3; ++c) sum[c] += w * radiance_[c][i];
            }
        }
        const double total = total_weight(weight);
        return {sum[0] / total, sum[1] / total, sum[2] / total};
    }

  private:
    static constexpr int kPatchSide = 8;
    // Largest spread of a texel, relative to the lobe, at which its middle stands for all of it:
    // the neglected part of its weight is about as large.
    static constexpr double kFar = 4e-5;

    struct Patch {
        int face, x, y, width;
        std::size_t first, end;
        Direction middle;
        double radius;
    };

    // The components of a direction along the axes of a face.
    struct FaceAxes {
        double along, right, down;
    };

    // Over the hemisphere, in x with 1 - N.L = x^4, dense where the lobe is.
    template <class Weight>
    static double total_weight(const Weight& weight) {
        constexpr int kSteps = 4000;
        double sum = 0;
        for (int i = 0; i < kSteps; ++i) {
            const double x = (i + 0.5) / kSteps;
            sum += 4 * x * x * x * weight(1 - x * x * x * x);
        }
        return 2 * kPi * sum / kSteps;
    }

    void add_patch(int face, int x0, int y0) {
        Patch patch{face, x0, y0, std::min(kPatchSide, size_ - x0), x_.size(), 0, {}, 0};
        const int height = std::min(kPatchSide, size_ - y0);
        patch.middle =
            texel_direction(face, x0 + 0.5 * (patch.width - 1), y0 + 0.5 * (height - 1), size_);
        for (int y = y0; y < y0 + height; ++y) {
            for (int x = x0; x < x0 + patch.width; ++x) {
                const Direction d = texel_direction(face, x, y, size_);
                x_.push_back(d.x);
                y_.push_back(d.y);
                z_.push_back(d.z);
                solid_angle_.push_back(texel_solid_angle_sr(x, y, size_));
                for (int c = 0; c < 3; ++c) {
                    radiance_[static_cast<std::size_t>(c)].push_back(
                        environment_->at(face, x, y, c));
                }
                patch.radius =
                    std::max(patch.radius, std::sqrt(2 - 2 * std::min(1.0, dot(d, patch.middle))));
            }
        }
        patch.end = x_.size();
        patches_.push_back(patch);
    }

    template <class Weight>
    double near_weight(const Patch& patch, int index, int parts, const FaceAxes& n,
                       const Weight& weight) const {
        const int x = patch.x + index % patch.width;
        const int y = patch.y + index / patch.width;
        const double step = 2.0 / (size_ * parts);
        const auto gauss = [&](int texel, int k) {  // two points per part
            return 2.0 * texel / size_ - 1 +
                   step * (k / 2 + 0.5 + (k % 2 == 0 ? -0.5 : 0.5) / std::sqrt(3.0));
        };
        double sum = 0;
        for (int v = 0; v < 2 * parts; ++v) {
            const double t = gauss(y, v);
            for (int u = 0; u < 2 * parts; ++u) {
                const double s = gauss(x, u);
                const double h = 1 + s * s + t * t;
                const double root = std::sqrt(h);
                sum += step * step / 4 / (h * root) *
                       weight((n.along + s * n.right + t * n.down) / root);
            }
        }
        return sum;
    }

    const CubeMap* environment_;
    int size_;
    std::vector<Patch> patches_;
    std::vector<double> x_, y_, z_, solid_angle_;
    std::array<std::vector<double>, 3> radiance_;
};

}  // namespace aureole::ibl
