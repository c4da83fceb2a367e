// Tracing pictures of the night street.
#pragma once

#include "scene/night_road.h"
#include "scene/night_street.h"

namespace aureole::scene::night {

// Objects by the square tiles of a picture in which they can appear.
class Tiles {
  public:
    // `mirrored`: seen in the plane of the road.
    Tiles(const std::vector<Object>& objects, const Camera& camera, bool mirrored);
    const std::vector<int>& at(int x, int y) const {
        return lists_[static_cast<std::size_t>(y / kSize) * columns_ +
                      static_cast<std::size_t>(x / kSize)];
    }

  private:
    static constexpr int kSize = 32;
    std::size_t columns_;
    std::vector<std::vector<int>> lists_;
};

// What a ray sees; kGround where it meets nothing above the road, its radiance is then 0.
struct Seen {
    Kind kind;
    Vec3 radiance;
};
Seen look(const Street& street, const std::vector<Object>& objects, const std::vector<int>& which,
          const Ray& ray, float pixel_size, IrradianceCache& cache);

// Everything but lights and stars. `sky_share` receives the part of each pixel that is sky.
void render_street(const Street& street, const std::vector<Object>& objects, const Camera& camera,
                   Image& picture, Image& sky_share);

// The visible luminaires, each with exactly the energy that its solid angle gives it. One behind
// something else is left out whole.
void add_luminaires(const Street& street, const std::vector<Object>& objects, const Camera& camera,
                    Image& picture);

}  // namespace aureole::scene::night
