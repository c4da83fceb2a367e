// Flipbooks: the range of motion of an eye's glare, computed once, so that the PSF of any moment
// costs a sum of spectra and one transform instead of three diffraction patterns.
//
//     const std::vector<std::byte> bytes = bake_flipbook(eye, raster);       (flipbook_bake.h)
//     const Flipbook book(bytes);
//     FlipbookPlayer player(book, eye, sampling, grid);         (flipbook_player.h)
//     player.write(living.at(time_s).eye, psf);                              (each frame)
//
// Stored are the terms of the PSF (eye_psf.h) relative to an envelope e, the scatter of the book's
// middle pupil (flat within 2 pixels of the source), each as the spectrum of
//
//     texture  S (T' - 1) / e        halo  H / e        streaks  w_e E / e
//
// and played is, with eq. 3.4 of the thesis in its second line,
//
//     K = (1 - c) S + e D,     D = inverse transform of
//         (1 - c) texture + w_h halo + streaks,     all frames selected by the eye's pose
//
// The bloom S is exact: it is not stored. The envelope takes the decades out of what is, so that
// rounding to bytes is a fixed share of the veil at every angle. docs/flipbooks.md has the
// equations, the file format and the errors.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "aureole/eye/anatomy.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/wave/psf.h"

namespace aureole::eye {

// Which poses a book holds. Nodes of an axis are evenly spaced from its first to its last value; an
// axis of one node has the first.
struct FlipbookRange {
    double pupil_from_mm = 2;  // 1 to 9
    double pupil_to_mm = 8;    // pupil_from_mm to 9
    // Texture: every pupil with every particle state. With open lids these are the states of the
    // lens with the vitreous at rest, then the phases of a turning vitreous with the lens at rest.
    int texture_pupils = 7;           // 1 to 100
    int lens_states = 3;              // 1 to 99, odd: the one in the middle is at rest
    double lens_scale_span = 0.0018;  // largest deviation of Pose::lens_scale from 1 that has a
                                      // state: accommodation by a quarter dioptre. 0 to .05
    int vitreous_phases = 4;          // 1 (at rest) to 100
    double vitreous_step_deg = 0.2;   // of yaw from one phase to the next, enough to renew most
                                      // needles beyond 2 deg; above 0 to 10
    int covered_phases = 2;  // as many of them behind each closure of lids; 1 (at rest) to 100
    // Halo: pupils from kHaloFromMm on (none if all are smaller) with every closure of lids that
    // cover the pupil, with the lens at rest.
    int halo_pupils = 9;  // 1 to 100
    // Streaks: every pupil with every closure, of lashes alone (Pose::lash_closure) and of lids
    // that cover the pupil with them (Eye::eyelid); the open state is common to both.
    int streak_pupils = 4;  // 1 to 100
    // Closures, of all three.
    int lid_states = 4;            // 1 (open) to 100
    double largest_closure = 0.9;  // of the last state, above 0 to .95
};

// Narrower pupils have no halo worth storing: their iris covers nearly all fibres.
inline constexpr double kHaloFromMm = 4;

// Throws InvalidArgument that names the first value outside the ranges above.
void check(const FlipbookRange& range);

// The frames of a range. Texture first: pupils (slowest), particle states with open lids, then
// closures with their phases; then halo: pupils (slowest), closures; then streaks: pupils
// (slowest), lids open, lashes alone, covering lids.
struct FlipbookFrame {
    Component component;  // kCorona, kHalo, kStreaks
    double pupil_mm = 0;
    double eyelid = 0;
    Pose pose;
};
std::vector<FlipbookFrame> frames_of(const FlipbookRange& range);

// What a book knows about the eye it was baked from, as names and values: all parameters but those
// that a pose or a moment gives (pupil, eyelid, pose, and the looks halo and streaks, which are
// weights of whole terms).
struct NamedValue {
    std::string name;
    std::string value;
    bool operator==(const NamedValue&) const = default;
};
std::vector<NamedValue> identity_of(const Eye& eye, const SpectralSampling& sampling);

// Whether pixels of two grids have the same size, to a ten-thousandth.
bool same_pitch(const wave::KernelGrid& a, const wave::KernelGrid& b) noexcept;

// The bytes of a book, checked once and then only looked at.
class Flipbook {
  public:
    // `bytes` must stay as they are as long as the book and its players live, and begin at a
    // multiple of 8. Throws InvalidArgument that says what is wrong: no book at all, of the other
    // byte order, of a newer version, too short or too long, or damaged, and where.
    explicit Flipbook(std::span<const std::byte> bytes);

    // The raster: an odd square kernel, one less than transform_size().
    const wave::KernelGrid& grid() const { return grid_; }
    int transform_size() const { return grid_.width + 1; }
    const wave::ApertureGrid& aperture() const { return aperture_; }
    const FlipbookRange& range() const { return range_; }
    const std::vector<NamedValue>& identity() const { return identity_; }
    std::size_t bytes() const { return bytes_.size(); }

    struct Frame {
        double weight = 0;                  // w_e of streaks, else 1; 0: an empty frame
        std::array<double, 3> energy = {};  // of e times the frame over the raster, per colour;
                                            // 0 but for rounding in the texture
        std::array<float, 3> scale = {};    // per colour, of its spectrum (byte_spectrum.h)
        std::array<const std::byte*, 3> spectra = {};
    };
    // In the order of frames_of().
    const std::vector<Frame>& frames() const { return frames_; }

    // The first value in which an eye differs from the one that was baked; empty texts where one of
    // them has no such value.
    struct Difference {
        std::string name;
        std::string here;
        std::string in_book;
    };
    std::optional<Difference> difference(const Eye& eye, const SpectralSampling& sampling) const;

  private:
    std::span<const std::byte> bytes_;
    wave::KernelGrid grid_;
    wave::ApertureGrid aperture_;
    FlipbookRange range_;
    std::vector<NamedValue> identity_;
    std::vector<Frame> frames_;
};

}  // namespace aureole::eye
