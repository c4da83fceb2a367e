// Look::kBlog: ghosts as the blog makes them.
//
// In its own units: angles of the light as slopes, heights on the sensor over the radius of the
// image circle of 35 mm film, and a ghost as a square around the projected iris, texture
// coordinates from -1 to 1, axes along those of the screen.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lens/film.h"
#include "lens/matrix_ghosts.h"
#include "lens/matrix_outline.h"

namespace aureole::lens {

// The distance field of the iris and the mask that the document makes of it.
class BlogField {
  public:
    static constexpr int kSide = 64;
    static constexpr double kSmoothing = 0.1;

    // The largest of dot(axis, coordinate) over the blades, joined one after another by the
    // document's smooth maximum; 0 in the middle and 1 on the edges. An iris from a picture counts
    // as round.
    explicit BlogField(const Iris& iris);

    // Bilinear; (u, v) in [-1, 1]^2, v upwards.
    float distance(float u, float v) const noexcept;
    // smoothstep(.95, .80) of the field joined with the entrance, clips[0] of the ghost; 0 outside
    // the square.
    float mask(const MatrixGhost& ghost, float x, float y) const noexcept;
    // The integral of the mask over the square, by midpoints.
    double area(const MatrixGhost& ghost) const noexcept;

  private:
    float mask_at(const MatrixGhost& ghost, float u, float v) const noexcept;
    std::array<float, kSide* kSide> distance_ = {};
};

class BlogLook {
  public:
    // What the document calls the random angle of a ghost, in radians, for its reflectances: below
    // the critical angle of every face of the lens.
    static double random_angle(const Lens& lens, const Bounces& bounces);
    static constexpr std::array<double, 3> kWavelengthsNm = {650, 550, 450};

    BlogLook(const Lens& lens, const Iris& iris, const Film& film, std::span<const Bounces> ghosts);

    // Ghosts that cross the stop three times are blocked.
    void place(const sources::Light& light, std::span<MatrixGhost> placements) const noexcept;
    // Its rows; the rest is drawn from the ghost.
    MatrixDrawing outline(const MatrixGhost& ghost, int level) const noexcept;
    void draw_rows(const MatrixDrawing& drawing, const CanvasLevel& level, int begin,
                   int end) const noexcept;

  private:
    struct Ghost {
        bool same_side = false;
        double stop_a = 1, stop_b = 0;      // M_a: height at the stop
        double sensor_a = 1, sensor_b = 0;  // M_s M_a: height on the sensor
        std::array<double, 3> color = {};
    };
    void place_one(const Ghost& blog, const sources::Light& light, MatrixGhost& ghost) const;

    BlogField field_;
    Film film_;
    std::vector<Ghost> ghosts_;
    double stop_height_mm_ = 0;       // H_a
    double entrance_height_mm_ = 0;   // H_e
    double entrance_pupil_mm_ = 0;    // H_a / M_a00 of the image
    double unit_solid_angle_sr_ = 0;  // whose image in focus has the unit of area of the intensity
};

}  // namespace aureole::lens
