// Where eye and head turn, and how the vitreous lags behind.
#pragma once

#include <cstdint>
#include <vector>

namespace aureole::eye {

// Of head and eye together, against the world. Yaw > 0 to the right, pitch > 0 upwards, roll > 0
// counter-clockwise as the eye sees it.
struct Rotation {
    double yaw_deg = 0;
    double pitch_deg = 0;
    double roll_deg = 0;
};

// The vitreous as a rigid body on a spring in a fluid:
//     lag'' + 2 damping (2 pi f) lag' + (2 pi f)^2 lag = -gaze''
// Zimmerman 1980 ("In vivo measurements of the viscoelasticity of the human vitreous humor",
// Biophysical Journal 29:539) saw in the very rays of the ciliary corona that it is overdamped; the
// two numbers are assumed: f is near the first torsional mode of a gel ball, 4.493 / (2 pi R)
// sqrt(G / rho), .42 to .59 Hz for R = 12 mm and G = .05 to .1 Pa.
struct VitreousMechanics {
    double frequency_hz = 0.5;  // 0.05 to 20
    double damping = 1.2;       // ratio to critical damping, 0.1 to 10
};

class Gaze {
  public:
    // A gaze that rests.
    Gaze() = default;
    // Through given rotations, straight between them, at rest before and after. Times ascend,
    // within kFarthestTimeS of 0 (ranges.h); as many rotations as times, one at least, angles
    // within 1e6 deg. Throws InvalidArgument.
    static Gaze through(std::vector<double> times_s, std::vector<Rotation> rotations);
    // Looking around a picture: three fixations a second, their directions normally distributed
    // with 5.3 deg in yaw and pitch each, so that 86 % of the saccades are shorter than 15 deg
    // (Bahill, Adler & Stark 1975, "Most naturally occurring human saccades have magnitudes of 15
    // degrees or less"). A saccade of A deg lasts 21 ms + 2.2 ms A (Carpenter 1988, "Movements of
    // the Eyes").
    static Gaze saccades(std::uint64_t seed);

    // The moments that through() was given; otherwise none.
    const std::vector<double>& times_s() const noexcept { return times_s_; }

    Rotation at(double time_s) const noexcept;
    // Rotation of the vitreous against the eye. The gaze is made of straight lines, so gaze'' of
    // impulses, and the lag is a sum of impulse responses: known at any time.
    Rotation vitreous_lag(double time_s, const VitreousMechanics& mechanics = {}) const noexcept;

  private:
    struct Saccade {
        double start_s;
        double end_s;
        Rotation from;
        Rotation to;
    };
    Saccade saccade(std::int64_t fixation) const noexcept;

    std::vector<double> times_s_;  // empty: at rest, or saccades
    std::vector<Rotation> rotations_;
    bool saccades_ = false;
    std::uint64_t seed_ = 0;
};

// Throws InvalidArgument that names the first value outside the ranges above.
void check(const VitreousMechanics& mechanics);

}  // namespace aureole::eye
