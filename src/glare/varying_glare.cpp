#include "aureole/glare/varying_glare.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/fourier/convolver.h"
#include "aureole/fourier/varying_convolver.h"
#include "glare/kernel_sums.h"

namespace aureole::glare {
namespace {

// Sums of a kernel over rectangles of whole samples.
class KernelSums {
  public:
    KernelSums(const Image& kernel, int channel)
        : width_(kernel.width()),
          height_(kernel.height()),
          table_(static_cast<std::size_t>(width_ + 1) * static_cast<std::size_t>(height_ + 1)) {
        for (int y = 0; y < height_; ++y) {
            double row = 0;
            for (int x = 0; x < width_; ++x) {
                row += static_cast<double>(kernel.at(x, y, channel));
                table_[index(x + 1, y + 1)] = table_[index(x + 1, y)] + row;
            }
        }
    }

    double total() const { return table_.back(); }

    // What a source in pixel (x, y) leaves inside a picture.
    double inside(int x, int y, int width, int height) const {
        const int x0 = std::clamp(width_ / 2 - x, 0, width_);
        const int x1 = std::clamp(width_ / 2 - x + width, 0, width_);
        const int y0 = std::clamp(height_ / 2 - y, 0, height_);
        const int y1 = std::clamp(height_ / 2 - y + height, 0, height_);
        return table_[index(x1, y1)] - table_[index(x0, y1)] - table_[index(x1, y0)] +
               table_[index(x0, y0)];
    }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_ + 1) +
               static_cast<std::size_t>(x);
    }
    int width_;
    int height_;
    std::vector<double> table_;
};

// Adds to `taken` what the part holds for each source pixel, e(s), and to `inside` how much of that
// stays in the picture.
void account(const fourier::KernelNodes& part, int channel, Image& taken, Image& inside) {
    std::vector<KernelSums> sums;
    sums.reserve(static_cast<std::size_t>(part.nodes()));
    for (int n = 0; n < part.nodes(); ++n) {
        sums.emplace_back(fourier::whole_kernel(part.half_of(n)), channel);
    }
    const int width = taken.width();
    const int height = taken.height();
    parallel_for(static_cast<std::size_t>(height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        const fourier::NodeBlend down = fourier::node_blend(y, height, part.rows);
        for (int x = 0; x < width; ++x) {
            const fourier::NodeBlend across = fourier::node_blend(x, width, part.columns);
            double whole = 0;
            double kept = 0;
            for (const int j : {0, 1}) {
                for (const int i : {0, 1}) {
                    const float share = (i == 0 ? 1 - across.second_share : across.second_share) *
                                        (j == 0 ? 1 - down.second_share : down.second_share);
                    if (share == 0) continue;
                    const KernelSums& node = sums[static_cast<std::size_t>(
                        (down.first + j) * part.columns + across.first + i)];
                    whole += static_cast<double>(share) * node.total();
                    kept += static_cast<double>(share) * node.inside(x, y, width, height);
                }
            }
            taken.at(x, y, channel) += static_cast<float>(whole);
            inside.at(x, y, channel) += static_cast<float>(kept);
        }
    });
}

void check(int channels, const wave::VaryingPsf& psf) {
    if (channels != 1 && channels != 3) {
        throw InvalidArgument("channels", std::to_string(channels), "must be 3 (RGB) or 1 (grey)");
    }
    const wave::KernelGrid& grid = psf.base.grid;
    if (grid.projection != psf.view.projection ||
        std::abs(grid.pitch_deg / psf.view.pitch_deg - 1) > 1e-3) {
        throw InvalidArgument("pitch of the PSF (deg)", std::to_string(grid.pitch_deg),
                              "must be that of the picture, " + std::to_string(psf.view.pitch_deg) +
                                  ", in the same projection");
    }
}

std::vector<fourier::KernelNodes> parts_for(int channels, const wave::VaryingPsf& psf) {
    std::vector<fourier::KernelNodes> parts = psf.parts;
    if (channels == 3) return parts;
    for (fourier::KernelNodes& part : parts) {
        for (Image& half : part.halves) half = luminance_kernel(half);
    }
    return parts;
}

}  // namespace

struct VaryingGlare::Impl {
    Impl(int channel_count, const wave::VaryingPsf& psf)
        : view(psf.view),
          channels(channel_count),
          base(view.width, view.height, channels,
               channels == 1 ? luminance_kernel(psf.base.kernel) : psf.base.kernel),
          varying(view.width, view.height, channels, parts_for(channels, psf)),
          rest(view.width, view.height, channels),
          share(view.width, view.height, channels),
          light(view.width, view.height, channels),
          spread(view.width, view.height, channels) {
        if (view.projection == Projection::kPerspective) weights = relative_solid_angles(view);
        for (int c = 0; c < channels; ++c) {
            for (const fourier::KernelNodes& part : varying.parts()) account(part, c, rest, share);
        }
        const Image base_share =
            share_inside(view.width, view.height,
                         channels == 1 ? luminance_kernel(psf.base.kernel) : psf.base.kernel);
        for_each_row([&](int y, int c) {
            for (int x = 0; x < view.width; ++x) {
                float& left = rest.at(x, y, c);
                left = 1.0F - left;
                share.at(x, y, c) += left * base_share.at(x, y, c);
            }
        });
    }

    template <class Body>
    void for_each_row(const Body& body) const {
        parallel_for(static_cast<std::size_t>(view.height), [&](std::size_t row, int) {
            for (int c = 0; c < channels; ++c) body(static_cast<int>(row), c);
        });
    }

    const float* weight_plane() const { return weights.empty() ? nullptr : weights.plane(0); }

    void apply(const ConstImageView& in, const ImageView& out) noexcept {
        varying.run(in, spread, weight_plane());
        for_each_row([&](int y, int c) {
            for (int x = 0; x < view.width; ++x) {
                light.at(x, y, c) = rest.at(x, y, c) * in.at(x, y, c);
            }
        });
        base.run(light, out, weight_plane());
        for_each_row([&](int y, int c) {
            for (int x = 0; x < view.width; ++x) out.at(x, y, c) += spread.at(x, y, c);
        });
    }

    Energy energy(const ConstImageView& in, const ConstImageView& out) const {
        const double f = view.focal_length_px();
        std::vector<Energy> rows(static_cast<std::size_t>(view.height));
        parallel_for(rows.size(), [&](std::size_t row, int) {
            const int y = static_cast<int>(row);
            Energy& sum = rows[row];
            for (int c = 0; c < channels; ++c) {
                for (int x = 0; x < view.width; ++x) {
                    const double weight =
                        weights.empty() ? 1.0 : static_cast<double>(weights.at(x, y)) / (f * f);
                    const double energy = weight * static_cast<double>(in.at(x, y, c));
                    sum.in += energy;
                    sum.out += weight * static_cast<double>(out.at(x, y, c));
                    sum.off_picture += energy * (1 - static_cast<double>(share.at(x, y, c)));
                }
            }
        });
        Energy total;
        for (const Energy& row : rows) {
            total.in += row.in;
            total.out += row.out;
            total.off_picture += row.off_picture;
        }
        return total;
    }

    View view;
    int channels;
    fourier::Convolver base;
    fourier::VaryingConvolver varying;
    Image rest;     // 1 - e(s)
    Image share;    // of a source's light that stays inside the picture
    Image weights;  // relative solid angles, perspective only
    Image light;
    Image spread;
};

VaryingGlare::VaryingGlare(int channels, const wave::VaryingPsf& psf) {
    check(channels, psf);
    impl_ = std::make_unique<Impl>(channels, psf);
}
VaryingGlare::~VaryingGlare() = default;
VaryingGlare::VaryingGlare(VaryingGlare&&) noexcept = default;
VaryingGlare& VaryingGlare::operator=(VaryingGlare&&) noexcept = default;

void VaryingGlare::apply(const ConstImageView& in, const ImageView& out) noexcept {
    impl_->apply(in, out);
}
Energy VaryingGlare::energy(const ConstImageView& in, const ConstImageView& out) const {
    return impl_->energy(in, out);
}
int VaryingGlare::padded_width() const noexcept { return impl_->base.padded_width(); }
int VaryingGlare::padded_height() const noexcept { return impl_->base.padded_height(); }

}  // namespace aureole::glare
