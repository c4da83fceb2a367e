// Time in the look of the thesis (Delavennat 2021, "Physically-based Real-time Glare", section
// 3.3): every part of the eye has a book of 60 frames, from one end of its range of motion to the
// other, and time only turns pages.
#pragma once

#include <cstdint>

namespace aureole::eye {

inline constexpr int kThesisFrames = 60;
// How many pages are turned in a second. The thesis says "a constant rate" and no more: assumed.
inline constexpr double kThesisFramesPerSecond = 30;
// "With a fixed offset in time of 5 frames": of the gratings, before the pupil.
inline constexpr int kThesisGratingsOffset = 5;
// Lids move as the pupil does, "but at a different frequency": this many times slower, assumed.
inline constexpr int kThesisLidsSlowness = 2;
// Frames until all books are open at the same pages again.
inline constexpr int kThesisRepeat = 7080;

// Which page of each book is open, 0 to 59. The default is an eye at rest: lids open, the rest in
// the middle of its range.
struct ThesisFrames {
    int pupil = 30;     // 0 narrow to 59 wide
    int gratings = 35;  // 0 lens contracted to 59 expanded
    int particles = 0;  // a place in their loop
    int lids = 0;       // 0 open to 59 closed
    bool operator==(const ThesisFrames&) const = default;
};

// 0, 1 ... 59, 58 ... 1, 0, 1 ... for step = 0, 1 ...; any step, negative ones too.
int thesis_ping_pong(std::int64_t step) noexcept;

// The pages at a moment counted in frames. Pupil, gratings and lids go back and forth, particles
// begin again: the whole repeats after kThesisRepeat frames.
ThesisFrames thesis_frames(std::int64_t frame) noexcept;
// The frame at a time: floor(30 t), so that frame n is there at n / 30 s. Times beyond
// kFarthestTimeS of 0 (ranges.h) are taken as that.
std::int64_t thesis_frame_at(double time_s) noexcept;

// What the pages show. From page to page the pupil follows the rising half of a sine between the
// two ends of eq. 2.14, 4.9 -+ 3 mm.
double thesis_pupil_mm(int page) noexcept;
// The page whose pupil is nearest.
int thesis_pupil_page(double diameter_mm) noexcept;
// Radius of the lens over that in the middle of its range, by the same sine: .95 to 1.05, assumed.
double thesis_lens_scale(int page) noexcept;
// How far the lids are closed, 0 to 1, by the same sine.
double thesis_lid_closure(int page) noexcept;
int thesis_lid_page(double closure) noexcept;

}  // namespace aureole::eye
