#include "aureole/eye/flipbook_player.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include "aureole/base/buffer.h"
#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/eye/scatter.h"
#include "aureole/fourier/symmetric_fft.h"
#include "eye/diffracted_share.h"
#include "eye/flipbook_format.h"
#include "eye/flipbook_selection.h"
#include "eye/flipbook_terms.h"
#include "eye/kernel_checks.h"
#include "eye/scatter_pixels.h"

namespace aureole::eye {
namespace {

using Parts = FlipbookParts;

// Spectra are summed in pieces of this many rows.
constexpr int kPieceRows = 32;

void check_use(const Flipbook& book, const Eye& eye, const SpectralSampling& sampling,
               const wave::KernelGrid& grid) {
    check_kernel(grid);
    if (const auto difference = book.difference(eye, sampling)) {
        throw InvalidArgument(difference->name, difference->here,
                              "the flipbook was baked with " + difference->in_book);
    }
    if (!same_pitch(grid, book.grid())) {
        throw InvalidArgument(
            "pitch_deg", fmt::format("{:.6g}", grid.pitch_deg),
            fmt::format("the flipbook was baked for {:.6g}", book.grid().pitch_deg));
    }
    if (grid.projection != book.grid().projection) {
        const bool on = grid.projection == Projection::kPerspective;
        throw InvalidArgument("perspective", on ? "on" : "off",
                              std::string("the flipbook was baked for ") + (on ? "off" : "on"));
    }
}

// The scatter of one pupil: a quarter of a kernel, from its centre on.
struct Quadrant {
    Image energy;
    double off_kernel_energy;
};

}  // namespace

struct FlipbookPlayer::Impl {
    Impl(const Flipbook& flipbook, const Eye& eye, const SpectralSampling& sampling,
         const wave::KernelGrid& kernel_grid);

    void add(std::size_t frame, const std::array<double, 3>& factors) noexcept {
        terms[term_count++] = {frame, factors};
    }
    // The sum of the terms over the raster, relative to the envelope.
    void play() noexcept;
    void fill(const std::array<double, 3>& rest, double pupil_mm, wave::Psf& psf) noexcept;

    struct Term {
        std::size_t frame;
        std::array<double, 3> factors;
    };

    const Flipbook& book;
    FlipbookAxes axes;
    wave::KernelGrid grid;
    std::vector<Quadrant> scatter;  // of each texture pupil, or one if the pupil does not matter
    Image envelope;
    fourier::SymmetricFft fft;
    std::array<Buffer, 3> spectra;
    Image relative;  // D
    std::array<Term, 1 + 2 * 8> terms = {};
    std::size_t term_count = 0;
    std::vector<Buffer> rows;  // of each worker: half a row of scatter
};

FlipbookPlayer::Impl::Impl(const Flipbook& flipbook, const Eye& eye,
                           const SpectralSampling& sampling, const wave::KernelGrid& kernel_grid)
    : book(flipbook),
      axes(flipbook.range()),
      grid(kernel_grid),
      fft(flipbook.transform_size()),
      relative(flipbook.grid().width, flipbook.grid().height, 3) {
    check_use(book, eye, sampling, grid);
    envelope = flipbook_envelope(eye, book.range(), book.grid());
    const int nodes = eye.scatter == ScatterModel::kIjspeert ? axes.texture_pupils.nodes : 1;
    for (int i = 0; i < nodes; ++i) {
        const ScatterPixels pixels(
            ScatterPsf(eye.scatter, eye.age_years, eye.pigmentation, axes.texture_pupils.at(i)),
            grid);
        Quadrant quadrant{Image(grid.width / 2 + 1, grid.height / 2 + 1, 1),
                          pixels.off_kernel_energy()};
        parallel_for(static_cast<std::size_t>(quadrant.energy.height()), [&](std::size_t y, int) {
            const int row = static_cast<int>(y);
            pixels.row(row, quadrant.energy.width(), quadrant.energy.row(row, 0));
        });
        scatter.push_back(std::move(quadrant));
    }
    for (Buffer& spectrum : spectra) spectrum = Buffer(SpectrumShape(book.grid()).numbers());
    for (int i = 0; i < max_workers(); ++i) {
        rows.emplace_back(static_cast<std::size_t>(grid.width / 2) + 1);
    }
}

void FlipbookPlayer::Impl::play() noexcept {
    const SpectrumShape shape(book.grid());
    const auto columns = static_cast<std::size_t>(shape.columns);
    const auto pieces = static_cast<std::size_t>((shape.rows + kPieceRows - 1) / kPieceRows);
    parallel_for(3 * pieces, [&](std::size_t item, int) {
        const std::size_t c = item / pieces;
        const int first_row = static_cast<int>(item % pieces) * kPieceRows;
        const int end_row = std::min(first_row + kPieceRows, shape.rows);
        float* sum = spectra[c].data() + static_cast<std::size_t>(first_row) * columns;
        std::fill_n(sum, static_cast<std::size_t>(end_row - first_row) * columns, 0.0F);
        for (std::size_t i = 0; i < term_count; ++i) {
            const Flipbook::Frame& frame = book.frames()[terms[i].frame];
            const auto factor = static_cast<float>(terms[i].factors[c]) * frame.scale[c];
            fourier::add_spectrum(frame.spectra[c], shape.rows, shape.columns, first_row, end_row,
                                  factor, sum);
        }
    });
    const ImageView out = relative;
    fft.inverse(spectra[0].data(), spectra[1].data(), out.channel_range(0, 1),
                out.channel_range(1, 1));
    fft.inverse(spectra[2].data(), nullptr, out.channel_range(2, 1), {});
    term_count = 0;
}

// (1 - c) S + e D, row by row; the rows above the centre have the scatter of those below.
void FlipbookPlayer::Impl::fill(const std::array<double, 3>& rest, double pupil_mm,
                                wave::Psf& psf) noexcept {
    const int half_width = grid.width / 2;
    const int half_height = grid.height / 2;
    const int raster = book.grid().width / 2;
    const int reach = std::min(raster, half_width);
    const FlipbookAxis::Place place =
        scatter.size() == 1 ? FlipbookAxis::Place{0, 0} : axes.texture_pupils.place(pupil_mm);
    const Quadrant& low = scatter[static_cast<std::size_t>(place.low)];
    const double share = place.share;
    const Quadrant& high = share > 0 ? scatter[static_cast<std::size_t>(place.low) + 1] : low;
    const auto second = static_cast<float>(share);
    parallel_for(static_cast<std::size_t>(half_height) + 1, [&](std::size_t y, int worker) {
        const int dy = static_cast<int>(y);
        const float* line = low.energy.row(dy, 0);
        if (share > 0) {
            float* mixed = rows[static_cast<std::size_t>(worker)].data();
            const float* other = high.energy.row(dy, 0);
            for (int x = 0; x <= half_width; ++x)
                mixed[x] = line[x] + second * (other[x] - line[x]);
            line = mixed;
        }
        for (int c = 0; c < 3; ++c) {
            const auto factor = static_cast<float>(rest[static_cast<std::size_t>(c)]);
            for (int side = dy == 0 ? 1 : 0; side < 2; ++side) {
                const int offset = side == 0 ? -dy : dy;
                float* out = psf.kernel.row(half_height + offset, c) + half_width;
                for (int x = 0; x <= half_width; ++x) out[x] = factor * line[x];
                for (int x = 1; x <= half_width; ++x) out[-x] = factor * line[x];
                if (dy > raster) continue;
                const float* term = relative.row(raster + offset, c) + raster;
                const float* e = envelope.row(raster + offset, 0) + raster;
                for (int x = -reach; x <= reach; ++x) out[x] += e[x] * term[x];
            }
        }
    });
    for (std::size_t c = 0; c < 3; ++c) {
        psf.off_kernel_energy[c] =
            rest[c] *
            (low.off_kernel_energy + share * (high.off_kernel_energy - low.off_kernel_energy));
    }
    if (raster <= half_width && raster <= half_height) return;
    // Small pictures: what the raster holds beyond the kernel leaves it too.
    for (int c = 0; c < 3; ++c) {
        double outside = 0;
        for (int y = -raster; y <= raster; ++y) {
            const float* term = relative.row(raster + y, c) + raster;
            const float* e = envelope.row(raster + y, 0) + raster;
            for (int x = -raster; x <= raster; ++x) {
                if (std::abs(x) <= half_width && std::abs(y) <= half_height) continue;
                outside += static_cast<double>(e[x]) * static_cast<double>(term[x]);
            }
        }
        psf.off_kernel_energy[static_cast<std::size_t>(c)] += outside;
    }
}

FlipbookPlayer::FlipbookPlayer(const Flipbook& book, const Eye& eye,
                               const SpectralSampling& sampling, const wave::KernelGrid& grid)
    : impl_(std::make_unique<Impl>(book, eye, sampling, grid)) {}
FlipbookPlayer::~FlipbookPlayer() = default;
FlipbookPlayer::FlipbookPlayer(FlipbookPlayer&&) noexcept = default;
FlipbookPlayer& FlipbookPlayer::operator=(FlipbookPlayer&&) noexcept = default;

const wave::KernelGrid& FlipbookPlayer::grid() const noexcept { return impl_->grid; }
const Image& FlipbookPlayer::envelope() const noexcept { return impl_->envelope; }

void FlipbookPlayer::write(const Eye& now, wave::Psf& psf) noexcept {
    Impl& own = *impl_;
    assert(psf.kernel.width() == own.grid.width && psf.kernel.height() == own.grid.height &&
           psf.kernel.channels() == 3);
    const auto& frames = own.book.frames();
    const Parts halo = halo_parts(own.axes, now);
    const Parts streaks = streak_parts(own.axes, now);
    const auto weight_of = [&](const Parts& parts) {
        double weight = 0;
        for (const auto& [frame, factor] : parts) weight += factor * frames[frame].weight;
        return weight;
    };
    const double streak_share = now.streaks * weight_of(streaks);
    const double of_halo = visible_halo_weight(now);
    const double limit = diffracted_limit(of_halo * weight_of(halo) + streak_share);
    const double halo_scale = of_halo * limit;
    const double streak_scale = now.streaks * limit;

    std::array<double, 3> rest = {1, 1, 1};  // 1 - c
    const auto add = [&](std::size_t frame, double factor) {
        if (factor == 0 || frames[frame].weight == 0) return;
        for (std::size_t c = 0; c < 3; ++c) rest[c] -= factor * frames[frame].energy[c];
        own.add(frame, {factor, factor, factor});
    };
    for (const auto& [frame, factor] : halo) add(frame, factor * halo_scale);
    for (const auto& [frame, factor] : streaks) add(frame, factor * streak_scale);
    // Rounding leaves the texture a little energy, which must not add to the bloom's.
    const std::size_t texture = texture_frame(own.axes, now);
    for (std::size_t c = 0; c < 3; ++c) rest[c] /= 1 + frames[texture].energy[c];
    if (frames[texture].weight != 0) own.add(texture, rest);
    own.play();
    psf.grid = own.grid;
    own.fill(rest, now.pupil_diameter_mm, psf);
}

void FlipbookPlayer::write_term(Component component, const Eye& now,
                                const ImageView& out) noexcept {
    Impl& own = *impl_;
    const auto add = [&](std::size_t frame, double factor) {
        own.add(frame, {factor, factor, factor});
    };
    if (component == Component::kCorona) add(texture_frame(own.axes, now), 1);
    if (component == Component::kHalo) {
        for (const auto& [frame, factor] : halo_parts(own.axes, now)) add(frame, factor);
    }
    if (component == Component::kStreaks) {
        for (const auto& [frame, factor] : streak_parts(own.axes, now)) add(frame, factor);
    }
    own.play();
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < out.height; ++y) {
            for (int x = 0; x < out.width; ++x) out.at(x, y, c) = own.relative.at(x, y, c);
        }
    }
}

}  // namespace aureole::eye
