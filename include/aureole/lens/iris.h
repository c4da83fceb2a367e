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
    double smoothing = 0;     // k of the polynomial smooth maximum that joins the blades
                              // (the second seed document: .1); 0 keeps corners sharp; [0, .5]
};

class Iris {
  public:
    // A round one.
    Iris() : Iris(IrisShape{}) {}
    // Throws InvalidArgument for a shape outside its ranges.
    explicit Iris(const IrisShape& shape);
    // From a picture of the opening: 1 (white) lets light through, 0 blocks it; first channel of
    // two or fewer, else the mean of three; values are clamped to [0, 1]. The picture is centred
    // and its *shorter side* spans the widest stop; it is then scaled so that its transmitting
    // area is that of the unit disc. Throws InvalidArgument for an empty or a black picture.
    explicit Iris(const ConstImageView& transmission);

    bool is_image() const noexcept { return !image_.empty(); }
    const IrisShape& shape() const noexcept { return shape_; }

    // Distance field, 1 on the edge, below 1 inside, growing by about 1 per unit of (u, v) along
    // its gradient, which is what edges are antialiased and faded by. Of an image: the distance to
    // a disc around all of its opening.
    float distance(float u, float v) const noexcept;
    // Largest distance from the axis of any opening: all of the iris lies within.
    double outer_radius() const noexcept { return outer_radius_; }
    // Radius of the largest centred disc on which nothing is blocked; 0 for an image.
    double inner_radius() const noexcept { return inner_radius_; }

    // Transmission of an image iris averaged over a square of side `footprint` (bilinear between
    // the levels of a pyramid); 0 outside the picture. Only for is_image().
    float image_transmission(float u, float v, float footprint) const noexcept;
    // Transmission of any iris, sharp: the oracle of the renderers.
    float transmission(float u, float v) const noexcept;

    // For hot loops, which evaluate the distance by themselves: max over blades of
    // dot(normal, p) * scale for straight blades.
    struct Blade {
        float normal_u = 0, normal_v = 0;
    };
    static constexpr int kMaxBlades = 64;
    const Blade* blades() const noexcept { return blades_; }
    // Distance of a blade's straight edge from the axis (the apothem).
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
    Image image_;                 // transmission, level 0
    std::vector<Image> pyramid_;  // halves of it
    double image_scale_ = 1;      // pixels of level 0 per unit of (u, v)
};

// Dirt, scratches and fibres on the front element: a picture of transmission that spans its clear
// diameter (shorter side). Values are clamped to [0, 1]; outside the picture 1.
class Occluder {
  public:
    // Throws InvalidArgument for an empty picture or a diameter that is not positive.
    Occluder(const ConstImageView& transmission, double diameter_mm);

    // At (x, y) mm on the front element, averaged over a square of side `footprint_mm`.
    float transmission(float x_mm, float y_mm, float footprint_mm) const noexcept;
    // Level 0 of the pyramid, for reports and for the starburst: one channel, top row first.
    const Image& image() const noexcept { return pyramid_.front(); }
    double width_mm() const noexcept { return width_mm_; }
    double diameter_mm() const noexcept { return diameter_mm_; }

  private:
    std::vector<Image> pyramid_;
    double diameter_mm_ = 0;
    double width_mm_ = 0;  // of the whole picture
    double pixels_per_mm_ = 0;
};

}  // namespace aureole::lens
