#include "aureole/glare/glare.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/fourier/convolver.h"
#include "aureole/sources/clusters.h"
#include "glare/kernel_sums.h"
#include "glare/light_rule.h"
#include "glare/spreading.h"

namespace aureole::glare {
namespace {

void check(const View& view, int channels, const wave::Psf& psf, const GlareOptions& options) {
    if (channels != 1 && channels != 3) {
        throw InvalidArgument("channels", std::to_string(channels), "must be 3 (RGB) or 1 (grey)");
    }
    if (psf.kernel.channels() != 3 && psf.kernel.channels() != 9) {
        throw InvalidArgument("channels of the PSF", std::to_string(psf.kernel.channels()),
                              "must be 3, or 9 for a matrix");
    }
    if (psf.kernel.channels() == 9 && channels == 3) {
        if (options.method != Method::kFft && options.method != Method::kDirect) {
            throw InvalidArgument("method", std::string(name_of(options.method)),
                                  "must be fft or direct: the PSF is a matrix");
        }
        if (options.resolution != Resolution::kFull) {
            throw InvalidArgument("resolution", std::string(name_of(options.resolution)),
                                  "must be full: the PSF is a matrix");
        }
        if (options.surround != Surround::kDark) {
            throw InvalidArgument("surround", "same", "must be dark: the PSF is a matrix");
        }
    }
    if (!(options.threshold >= 0)) {
        throw InvalidArgument("threshold", std::to_string(options.threshold), "must be >= 0");
    }
    if (!(options.gain >= 0)) {
        throw InvalidArgument("gain", std::to_string(options.gain), "must be >= 0");
    }
    if (!(options.exposure_scale > 0)) {
        throw InvalidArgument("exposure scale", std::to_string(options.exposure_scale),
                              "must be > 0");
    }
    if (options.added && options.surround != Surround::kDark) {
        throw InvalidArgument("surround", "same",
                              "must be dark where glare is added and borders lose nothing");
    }
    if (!(options.cluster_error > 0 && options.cluster_error < 1)) {
        throw InvalidArgument("cluster error", std::to_string(options.cluster_error),
                              "must be in (0, 1)");
    }
    if (options.cluster_side < 1 || options.cluster_side > sources::kMaxClusterSide ||
        !std::has_single_bit(static_cast<unsigned>(options.cluster_side))) {
        throw InvalidArgument(
            "cluster side", std::to_string(options.cluster_side),
            "must be a power of two up to " + std::to_string(sources::kMaxClusterSide));
    }
    if (options.resolution != Resolution::kFull && options.method != Method::kFft) {
        throw InvalidArgument("resolution", std::string(name_of(options.resolution)),
                              "must be full with the method " +
                                  std::string(name_of(options.method)) +
                                  ": it is for what fft does");
    }
    if (psf.grid.projection != view.projection ||
        std::abs(psf.grid.pitch_deg / view.pitch_deg - 1) > 1e-3) {
        throw InvalidArgument("pitch of the PSF (deg)", std::to_string(psf.grid.pitch_deg),
                              "must be that of the picture, " + std::to_string(view.pitch_deg) +
                                  ", in the same projection");
    }
}

}  // namespace

Method method_from_name(std::string_view name) {
    if (name == "fft") return Method::kFft;
    if (name == "direct") return Method::kDirect;
    if (name == "sprites") return Method::kSprites;
    if (name == "hybrid") return Method::kHybrid;
    if (name == "auto") return Method::kAuto;
    throw InvalidArgument("method", std::string(name),
                          "must be fft, direct, sprites, hybrid or auto");
}

std::string_view name_of(Method method) noexcept {
    switch (method) {
        case Method::kFft:
            return "fft";
        case Method::kDirect:
            return "direct";
        case Method::kSprites:
            return "sprites";
        case Method::kHybrid:
            return "hybrid";
        case Method::kAuto:
            break;
    }
    return "auto";
}

Resolution resolution_from_name(std::string_view name) {
    if (name == "full") return Resolution::kFull;
    if (name == "half") return Resolution::kHalf;
    if (name == "quarter") return Resolution::kQuarter;
    throw InvalidArgument("resolution", std::string(name), "must be full, half or quarter");
}

std::string_view name_of(Resolution resolution) noexcept {
    switch (resolution) {
        case Resolution::kFull:
            return "full";
        case Resolution::kHalf:
            return "half";
        case Resolution::kQuarter:
            break;
    }
    return "quarter";
}

std::string_view name_of(MethodReport::Reason reason) noexcept {
    switch (reason) {
        case MethodReport::Reason::kAsked:
            return "asked";
        case MethodReport::Reason::kNoGain:
            return "no-gain";
        case MethodReport::Reason::kBlocks:
            return "blocks";
        case MethodReport::Reason::kSample:
            return "sample";
        case MethodReport::Reason::kHistogram:
            return "histogram";
        case MethodReport::Reason::kPredicted:
            break;
    }
    return "predicted";
}

Surround surround_from_name(std::string_view name) {
    if (name == "dark") return Surround::kDark;
    if (name == "same") return Surround::kSame;
    throw InvalidArgument("surround", std::string(name), "must be dark or same");
}

struct Glare::Impl {
    Impl(const View& v, int c, const wave::Psf& psf, const GlareOptions& o)
        : view(v), channels(c), options(o), rule(o) {
        Image grey;
        if (channels == 1) grey = luminance_kernel(psf.kernel);
        const Image& kernel = channels == 1 ? grey : psf.kernel;
        spreading.emplace(view.width, view.height, channels, kernel, options);
        if (view.projection == Projection::kPerspective) weights = relative_solid_angles(view);
        if (selective()) light = Image(view.width, view.height, channels);
        // For those that cannot work in place.
        if (selective() || spreading->needs_other_memory()) {
            spread = Image(view.width, view.height, channels);
        }
        if (options.surround == Surround::kSame) measure_surround(kernel);
    }

    // The result is something else than in * PSF.
    bool selective() const {
        return !rule.everything() || options.gain != 1 || options.added ||
               options.surround != Surround::kDark;
    }

    // What a flat field lacks after glare is what its surroundings would have sent.
    void measure_surround(const Image& kernel) {
        for_each_row([&](int y, int c) { std::fill_n(light.row(y, c), view.width, 1.0F); });
        surround = Image(view.width, view.height, channels);
        // Without the errors of methods that depend on the light, whatever the one for pictures is.
        if (options.method == Method::kFft) {
            spreading->run(light, surround, weight_plane());
        } else {
            fourier::Convolver(view.width, view.height, channels, kernel)
                .run(light, surround, weight_plane());
        }
        for_each_row([&](int y, int c) {
            float* row = surround.row(y, c);
            for (int x = 0; x < view.width; ++x) row[x] = 1.0F - row[x];
        });
    }

    float from_surround(int x, int y, int c) const {
        return surround.empty() ? 0.0F : surround.at(x, y, c);
    }

    const float* weight_plane() const { return weights.empty() ? nullptr : weights.plane(0); }

    // `in` and `out` may be the same.
    void convolve(const ConstImageView& in, const ImageView& out) noexcept {
        if (in.data != out.data || !spreading->needs_other_memory()) {
            spreading->run(in, out, weight_plane());
            return;
        }
        spreading->run(in, spread, weight_plane());
        for_each_row([&](int y, int c) {
            for (int x = 0; x < view.width; ++x) out.at(x, y, c) = spread.at(x, y, c);
        });
    }

    template <class Body>
    void for_each_row(const Body& body) const {
        parallel_for(static_cast<std::size_t>(view.height), [&](std::size_t row, int) {
            for (int c = 0; c < channels; ++c) body(static_cast<int>(row), c);
        });
    }

    void apply(const ConstImageView& in, const ImageView& out, const float* matte) noexcept {
        if (!selective()) {
            convolve(in, out);
            return;
        }
        parallel_for(static_cast<std::size_t>(view.height), [&](std::size_t row, int) {
            const int y = static_cast<int>(row);
            rule.row(in, y, matte, light, y);
        });
        convolve(light, spread);
        for_each_row([&](int y, int c) {
            for (int x = 0; x < view.width; ++x) {
                const float taken =
                    options.added ? 0.0F : (1.0F - from_surround(x, y, c)) * light.at(x, y, c);
                const float change = spread.at(x, y, c) - taken;
                out.at(x, y, c) = in.at(x, y, c) + options.gain * change;
            }
        });
    }

    std::size_t row_start(int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(view.width);
    }

    Energy energy(const ConstImageView& in, const ConstImageView& out, const float* matte) const {
        const double f = view.focal_length_px();
        const bool perspective = !weights.empty();
        std::vector<Energy> rows(static_cast<std::size_t>(view.height));
        parallel_for(rows.size(), [&](std::size_t row, int) {
            const int y = static_cast<int>(row);
            Energy& sum = rows[row];
            Image source(view.width, 1, channels);
            rule.row(in, y, matte, source, 0);
            for (int c = 0; c < channels; ++c) {
                for (int x = 0; x < view.width; ++x) {
                    const std::size_t pixel = row_start(y) + static_cast<std::size_t>(x);
                    const double weight = perspective ? weights.plane(0)[pixel] / (f * f) : 1.0;
                    sum.in += weight * in.at(x, y, c);
                    sum.out += weight * out.at(x, y, c);
                    const double spreading_light = weight * options.gain * source.at(x, 0, c);
                    if (options.added) sum.added += spreading_light;
                    sum.off_picture +=
                        spreading_light * (1.0 - spreading->share_inside().at(x, y, c));
                    // What was cut off, as its bound.
                    sum.off_picture += std::abs(spreading_light) * spreading->last().energy_cut;
                    sum.from_surround += spreading_light * from_surround(x, y, c);
                }
            }
        });
        Energy total;
        for (const Energy& row : rows) {
            total.in += row.in;
            total.out += row.out;
            total.off_picture += row.off_picture;
            total.from_surround += row.from_surround;
            total.added += row.added;
        }
        return total;
    }

    View view;
    int channels;
    GlareOptions options;
    LightRule rule;
    std::optional<Spreading> spreading;
    Image weights;   // relative solid angles, perspective only
    Image light;     // what makes glare, if not everything does
    Image spread;    // and what becomes of it
    Image surround;  // what a flat field receives from beyond the border; empty for kDark
};

Glare::Glare(const View& view, int channels, const wave::Psf& psf, const GlareOptions& options) {
    check(view, channels, psf, options);
    impl_ = std::make_unique<Impl>(view, channels, psf, options);
}
Glare::~Glare() = default;
Glare::Glare(Glare&&) noexcept = default;
Glare& Glare::operator=(Glare&&) noexcept = default;

void Glare::apply(const ConstImageView& in, const ImageView& out, const float* matte) noexcept {
    impl_->apply(in, out, matte);
}
Energy Glare::energy(const ConstImageView& in, const ConstImageView& out,
                     const float* matte) const {
    return impl_->energy(in, out, matte);
}
const MethodReport& Glare::last() const noexcept { return impl_->spreading->last(); }
int Glare::padded_width() const noexcept { return impl_->spreading->padded_width(); }
int Glare::padded_height() const noexcept { return impl_->spreading->padded_height(); }

}  // namespace aureole::glare
