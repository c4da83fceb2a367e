// The wet ground of the night street.
#pragma once

#include "scene/night_street.h"

namespace aureole::scene::night {

// The street upside down, as a flat mirror in place of the road would show it: a picture from the
// mirrored eye, without lights (they are reflected one by one), blurred on demand. Roughness
// stretches reflections along the view and much less across it (the reason for the vertical
// streaks of wet roads), so one picture is kept sharp, one blurred across, and both are stored as
// sums down their columns: a mean over any length costs two look-ups.
class MirrorPicture {
  public:
    MirrorPicture(const Street& street, const std::vector<Object>& objects, const Camera& camera);

    // Mean around a position given in fractions of the picture's width from its optical axis,
    // over `half_height` up and down; `across` blends from the sharp to the blurred picture.
    Vec3 mean(float u, float v, float half_height, float across) const;

  private:
    static constexpr int kColumns = 720;
    const double* sums(int blurred, int row) const;
    Vec3 box(float column, float low, float high, float across) const;

    int rows_ = 0;
    double axis_row_ = 0;
    double axis_column_ = kColumns / 2.0;
    double first_row_ = 0;  // rows above the horizon are not stored
    std::vector<double> sums_[2];
};

// Irradiance of the ground, tabulated: it changes slowly.
class GroundLight {
  public:
    struct Value {
        Vec3 irradiance;
        float open;  // share of light and sky that cars above leave
    };
    explicit GroundLight(const Street& street);
    Value at(float x, float z) const;

  private:
    static constexpr float kStep = 0.25F;  // m
    static constexpr float kHalfWidth = 12;
    static constexpr int kColumns = static_cast<int>(2 * kHalfWidth / kStep) + 2;
    static constexpr int kRows = static_cast<int>(kStreetEndZ / kStep) + 2;
    std::vector<Value> values_;
};

// Radiance of the ground at a continuous pixel position below the horizon.
Vec3 ground_radiance(const Street& street, const GroundLight& light, const MirrorPicture& mirror,
                     const Camera& camera, double x, double y);

}  // namespace aureole::scene::night
