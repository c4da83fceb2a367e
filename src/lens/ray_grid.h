// Where on the entrance plane the rays of a ghost are worth tracing.
#pragma once

#include <span>
#include <utility>

#include "aureole/base/buffer.h"
#include "aureole/lens/lens.h"
#include "aureole/sources/light.h"
#include "lens/ray_kernels.h"

namespace aureole::lens {

// On the plane of the first vertex, or on the sensor, mm.
struct PlaneBox {
    double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
    bool empty() const { return !(x1 > x0 && y1 > y0); }
    // The smallest box around both.
    PlaneBox around(const PlaneBox& other) const;
};

// Unit direction of a light's rays.
struct RayDirection {
    double x = 0, y = 0, z = 1;
    explicit RayDirection(const sources::Light& light);
};

// Where rays of this direction can meet the first face within its aperture; `widest` scales the
// aperture (irises reach beyond the stop's radius).
PlaneBox entrance_of_first_face(const Face& face, const RayDirection& direction, double widest);

// What a search looks for.
struct EntranceQuery {
    // Of one ghost at one or more wavelengths, the first of which steers the search.
    std::span<const std::span<const RayStep>> ways;
    float sensor_distance_mm = 0;
    IrisField iris;
    double widest = 1;  // outer radius of the iris
    RayDirection direction;
    PlaneBox start;   // on the entrance
    PlaneBox sensor;  // where rays matter
};

struct EntranceFound {
    PlaneBox entrance;  // empty if no ray matters
    PlaneBox sensor;    // where those from there land
};

// Finds the part of the entrance whose rays may pass and land on the sensor.
class EntranceSearch {
  public:
    EntranceSearch();

    // Shrinks the box around the rays that matter until that no longer makes it much smaller. Empty
    // if there are none.
    EntranceFound find(const EntranceQuery& query) noexcept;
    // Traced since the last call.
    std::size_t take_rays() noexcept { return std::exchange(rays_, 0); }

    static constexpr int kSide = 32;  // rays

  private:
    EntranceFound possible(const EntranceQuery& query, std::span<const RayStep> way,
                           const PlaneBox& box, bool last) noexcept;

    Buffer memory_;
    RayFields fields_;
    std::size_t rays_ = 0;
};

}  // namespace aureole::lens
