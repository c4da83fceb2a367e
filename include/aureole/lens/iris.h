// The opening of the aperture stop, in units of the radius of a round stop of the same area.
//
// (u, v) = (x, y) / stop radius in the plane of the stop. Whatever its shape, an iris has the area
// of the unit disc times its transmission, so that the f-number tells the light that passes: the
// corners of a hexagon lie at 1.10, the middles of its edges at 0.95.
#pragma once

#include <vector>

#include "aureole/image/image.h"

namespace aureole::lens {

struct IrisShape {
    int blades = 0;           // 0: round; else 3 to 64
    double rotation_deg = 0;  // 0: a corner points along +u
    double curvature = 0;     // of the blades: 0 straight, 1 the circle through the corners; [0, 1]
    double smoothing = 0;     // k of the polynomial smooth maximum that joins two blades at their
                              // corner (the blog: .1); 0 keeps corners sharp;
                              // [0, .5]
};

// Pictures of transmission at 1, 1/2, 1/4, ... of their size, one channel each.
using TransmissionPyramid = std::vector<Image>;

class Iris {
  public:
    // A round one.
    Iris() : Iris(IrisShape{}) {}
    // Throws InvalidArgument for a shape outside its ranges.
    explicit Iris(const IrisShape& shape);
    // From a picture of the opening: 1 (white) lets light through, 0 blocks it; first channel of
    // two or fewer, else the mean of three; values are clamped to [0, 1]. The middle of the picture
    // lies on the axis, its top towards +v, and it is scaled so that its transmitting area is that
    // of the unit disc. Throws InvalidArgument for an empty or a black picture.
    explicit Iris(const ConstImageView& transmission);

    bool is_image() const noexcept { return !pyramid_.empty(); }
    const IrisShape& shape() const noexcept { return shape_; }

    // Distance field: 1 on the edge, below 1 inside, growing by 1 per unit of (u, v) across the
    // edges (by less where the smooth maximum rounds a corner), which is what edges are antialiased
    // and faded by. Of an image: of a disc around all of its opening.
    float distance(float u, float v) const noexcept;
    // Largest distance from the axis of any opening: all of the iris lies within.
    double outer_radius() const noexcept { return outer_radius_; }
    // Radius of the largest centred disc on which nothing is blocked; 0 for an image.
    double inner_radius() const noexcept { return inner_radius_; }

    // Transmission of an image iris averaged over a square of side `footprint` (bilinear, between
    // the levels of a pyramid); 0 outside the picture. Only for is_image().
    float image_transmission(float u, float v, float footprint) const noexcept;
    // Transmission of any iris, sharp: the oracle of the renderers.
    float transmission(float u, float v) const noexcept;

    // For hot loops, which evaluate the distance by themselves. It is the maximum over the blades
    // (the smooth maximum of the two largest) of
    //     1 + dot(normal, p) - apothem                                  straight blades,
    //     1 + |p + (blade_radius - apothem) normal| - blade_radius      curved ones,
    // and |p| of a round iris, which has no blades.
    struct Blade {
        float normal_u = 0, normal_v = 0;
    };
    static constexpr int kMaxBlades = 64;
    const Blade* blades() const noexcept { return blades_; }
    // Distance of the middle of a blade's edge from the axis.
    double apothem() const noexcept { return apothem_; }
    // Radius of a blade's circular edge, 0 for straight ones; its centre lies at
    // -(radius - apothem) * normal.
    double blade_radius() const noexcept { return blade_radius_; }

  private:
    IrisShape shape_;
    Blade blades_[kMaxBlades] = {};
    double apothem_ = 1;
    double blade_radius_ = 0;
    double outer_radius_ = 1;
    double inner_radius_ = 1;
    TransmissionPyramid pyramid_;
    double pixels_per_unit_ = 1;  // of level 0
};

// Dirt, scratches and fibres on the front element: a picture of transmission that spans its clear
// diameter (shorter side), as somebody sees it who looks through the camera: top towards +y, right
// towards +x. Values are clamped to [0, 1]; outside the picture 1.
class Occluder {
  public:
    // Throws InvalidArgument for a picture that is empty or all black and a diameter that is not
    // positive.
    Occluder(const ConstImageView& transmission, double diameter_mm);

    // At (x, y) mm on the front element, averaged over a square of side `footprint_mm`.
    float transmission(float x_mm, float y_mm, float footprint_mm) const noexcept;
    // Level 0 of the pyramid, for reports and for the starburst: one channel, top row first.
    const Image& image() const noexcept { return pyramid_.front(); }
    double width_mm() const noexcept { return image().width() / pixels_per_mm_; }
    double diameter_mm() const noexcept { return diameter_mm_; }

  private:
    TransmissionPyramid pyramid_;
    double diameter_mm_ = 0;
    double pixels_per_mm_ = 0;
};

}  // namespace aureole::lens
