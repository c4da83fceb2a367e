// A lens made ready for light: a prescription at one zoom position, f-number and focus.
//
// Coordinates: z along the axis from the first vertex towards the sensor, x to the right and y up
// for somebody at the camera who looks at the scene: right-handed, z towards that person. A light
// in direction (tan_x, tan_y), right and up, sends rays along (-tan_x, -tan_y, 1); what arrives at
// the sensor at (X, Y) is seen in the picture at (-X, -Y).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "aureole/lens/coating.h"
#include "aureole/lens/prescription.h"

namespace aureole::lens {

struct LensSettings {
    std::string position = {};     // of a zoom; empty: its first
    double f_number = 0;           // 0: as stated, or what the printed stop gives if nothing is
    double focus_distance_m = 0;   // from the sensor to what is in focus; 0: infinity
    std::string coating = "mgf2";  // of the air-glass faces for which the table names none
};

// One row of the table, ready to be traced. Face numbers are from 0.
struct Face {
    double z_mm = 0;  // of the vertex
    double curvature_per_mm = 0;
    double conic = 0;
    std::vector<double> asphere;  // of r^4, r^6, ...
    Profile profile = Profile::kRotational;
    // Clipped to where the surface ends, |radius| of a sphere, |radius| / sqrt(1 + conic) of a
    // conic; of the stop: as solved from the f-number.
    double semi_aperture_mm = 0;
    bool stop = false;
    Coating coating;  // layers from the medium in front to the one behind
};

class Lens {
  public:
    // Validates the prescription. The stop's radius is the height at which an exactly traced ray,
    // entering parallel to the axis at EFL / (2 f_number), crosses the stop. The sensor is put at
    // the computed paraxial back focal distance (d line), not at the printed last gap, and moved
    // back for a finite focus. Throws InvalidArgument: f-number not positive, or so small that the
    // ray misses a surface; focus nearer than the lens can; EFL infinite or negative; a position or
    // coating that does not exist; wavelengths at which a glass is not defined.
    explicit Lens(const Prescription& prescription, const LensSettings& settings = {});

    const Prescription& prescription() const noexcept { return prescription_; }  // of the position
    std::span<const Face> faces() const noexcept { return faces_; }
    int stop() const noexcept { return stop_; }  // the face that is the stop
    double sensor_z_mm() const noexcept { return sensor_z_mm_; }

    // Indices of the media at a wavelength (nm): [k] is in front of face k, [k + 1] behind it.
    // Throw InvalidArgument where the curve of a glass ends. A glass of the catalogue has the curve
    // of its maker, shifted to the index that the table gives at the d line.
    std::vector<double> indices(double wavelength_nm) const;
    // The same for one medium.
    double index(int medium, double wavelength_nm) const;

    // EFL over the width of the beam on the axis that fills the stop, by exact rays: what is asked
    // for, and what the light that passes goes by. The paraxial one (paraxial.h), of the same stop,
    // differs by the spherical aberration of the pupil.
    double f_number() const noexcept { return f_number_; }
    double stop_radius_mm() const noexcept {
        return faces_[static_cast<std::size_t>(stop_)].semi_aperture_mm;
    }
    double efl_mm() const noexcept { return efl_mm_; }  // across the width, for cylinders
    // What was clipped or could not be had, in sentences with surface numbers.
    const std::vector<std::string>& warnings() const noexcept { return warnings_; }

  private:
    Prescription prescription_;
    std::vector<Face> faces_;
    std::vector<std::string> warnings_;
    int stop_ = 0;
    double sensor_z_mm_ = 0;
    double f_number_ = 0;
    double efl_mm_ = 0;
};

// The f-number that the table's printed stop gives, whatever is stated or asked for: by exact rays,
// as f_number() is, nothing if those at its edge do not get through the glass; and paraxially.
std::optional<double> printed_f_number(const Lens& lens);
double paraxial_printed_f_number(const Lens& lens);

}  // namespace aureole::lens
