#include "aureole/eye/flipbook_bake.h"

#include <cstddef>
#include <cstdint>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/fourier/half_spectrum.h"
#include "aureole/fourier/symmetric_fft.h"
#include "eye/flipbook_format.h"
#include "eye/flipbook_terms.h"
#include "eye/kernel_checks.h"

namespace aureole::eye {

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
    const FlipbookText text{raster, options.aperture, range,
                            identity_of(eye, options.spectral)};
    const std::vector<FlipbookFrame> frames = frames_of(range);
    const Image envelope = flipbook_envelope(eye, range, raster);
    fourier::SymmetricFft fft(raster.width + 1);
    const std::size_t count = spectrum_size(raster);
    std::vector<float> spectrum(count);
    UnsealedBook book = open_book(text);
    std::vector<FlipbookEntry> entries(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (progress != nullptr) {
            progress->report("frames",
                             static_cast<double>(i) / static_cast<double>(frames.size()));
            if (progress->cancelled()) throw Cancelled();
        }
        const FlipbookTerm term = flipbook_term(frames[i].component, eye_at(eye, frames[i]),
                                                envelope, raster, options);
        FlipbookEntry& entry = entries[i];
        entry.weight = term.weight;
        if (term.weight == 0) continue;
        entry.energy = term.energy;
        auto* halves = reinterpret_cast<std::uint16_t*>(book.bytes.data() + book.head_bytes +
                                                        i * frame_bytes(raster));
        for (std::size_t c = 0; c < 3; ++c) {
            fft.forward(term.relative.view().channel_range(static_cast<int>(c), 1),
                        spectrum.data());
            entry.scale[c] = fourier::encode_spectrum(spectrum, halves + c * count);
        }
    }
    if (progress != nullptr) progress->report("frames", 1);
    return seal_book(std::move(book), text, std::move(entries));
}

}  // namespace aureole::eye
