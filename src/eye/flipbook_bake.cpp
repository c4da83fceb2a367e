#include "aureole/eye/flipbook_bake.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/fourier/byte_spectrum.h"
#include "aureole/fourier/symmetric_fft.h"
#include "eye/flipbook_format.h"
#include "eye/flipbook_terms.h"
#include "eye/kernel_checks.h"

namespace aureole::eye {
namespace {

double energy_of(const Image& relative, const Image& envelope) {
    return std::inner_product(relative.plane(0), relative.plane(0) + relative.pixels(),
                              envelope.plane(0), 0.0, std::plus<>(), [](float value, float e) {
                                  return static_cast<double>(value) * static_cast<double>(e);
                              });
}

}  // namespace

std::vector<std::byte> bake_flipbook(const Eye& eye, const wave::KernelGrid& raster,
                                     const FlipbookRange& range, const EyePsfOptions& options,
                                     Progress* progress) {
    check(eye);
    check_flipbook_grid(raster);
    check_aperture(options.aperture);
    if (eye.scatter == ScatterModel::kNone) {
        throw InvalidArgument("scatter", "none",
                              "must be cie or ijspeert: a flipbook stores what the scatter does "
                              "not say");
    }
    if (options.spectral.by_color) {
        throw InvalidArgument("source spectrum", "rgb",
                              "must be a lamp's: a flipbook stores no matrices");
    }
    const FlipbookText text{raster, options.aperture, range, identity_of(eye, options.spectral)};
    const std::vector<FlipbookFrame> frames = frames_of(range);
    const Image envelope = flipbook_envelope(eye, range, raster);
    fourier::SymmetricFft fft(raster.width + 1);
    const SpectrumShape shape(raster);
    std::vector<float> spectrum(shape.numbers());
    Image stored(raster.width, raster.height, 1);
    UnsealedBook book = open_book(text);
    std::vector<FlipbookEntry> entries(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (progress != nullptr) {
            progress->report("frames", static_cast<double>(i) / static_cast<double>(frames.size()));
            if (progress->cancelled()) throw Cancelled();
        }
        const FlipbookTerm term =
            flipbook_term(frames[i].component, eye_at(eye, frames[i]), envelope, raster, options);
        FlipbookEntry& entry = entries[i];
        entry.weight = term.weight;
        if (term.weight == 0) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            std::byte* bytes =
                book.bytes.data() + book.head_bytes + i * shape.frame_bytes() + c * shape.bytes();
            fft.forward(term.relative.view().channel_range(static_cast<int>(c), 1),
                        spectrum.data());
            entry.scale[c] = fourier::encode_spectrum(spectrum, shape.columns, bytes);
            // The energy of what is stored, not of what was meant, so that none is lost.
            std::fill(spectrum.begin(), spectrum.end(), 0.0F);
            fourier::add_spectrum(bytes, shape.rows, shape.columns, 0, shape.rows, entry.scale[c],
                                  spectrum.data());
            fft.inverse(spectrum.data(), nullptr, stored, {});
            entry.energy[c] = energy_of(stored, envelope);
        }
    }
    if (progress != nullptr) progress->report("frames", 1);
    return seal_book(std::move(book), text, std::move(entries));
}

}  // namespace aureole::eye
