#include "scene/night_render.h"

#include <cmath>

#include "aureole/base/parallel.h"
#include "scene/adaptive.h"

namespace aureole::scene::night {
namespace {

// Brightness as an eye adapted to the street would rank it, for deciding where edges are.
float tone(Vec3 radiance) {
    const float v = luminance(radiance);
    return v / (v + 0.6F);
}

}  // namespace

Tiles::Tiles(const std::vector<Object>& objects, const Camera& camera, bool mirrored) {
    const View& view = camera.view();
    columns_ = static_cast<std::size_t>((view.width + kSize - 1) / kSize);
    const auto rows = static_cast<std::size_t>((view.height + kSize - 1) / kSize);
    lists_.resize(columns_ * rows);
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const Object& object = objects[i];
        double left = 1e9;
        double right = -1e9;
        double top = 1e9;
        double bottom = -1e9;
        for (int corner = 0; corner < 8; ++corner) {
            Vec3 p = {(corner & 1) != 0 ? object.low.x : object.high.x,
                      (corner & 2) != 0 ? object.low.y : object.high.y,
                      (corner & 4) != 0 ? object.low.z : object.high.z};
            if (mirrored) p.y = -p.y;
            const auto pixel = camera.depth(p) > 0.05F ? camera.project(p) : std::nullopt;
            if (!pixel) {  // partly behind the eye: anywhere
                left = top = -1e9;
                right = bottom = 1e9;
                break;
            }
            left = std::min(left, pixel->x);
            right = std::max(right, pixel->x);
            top = std::min(top, pixel->y);
            bottom = std::max(bottom, pixel->y);
        }
        if (object.high.z < camera.position().z) continue;  // wholly behind
        const auto tile = [](double v, std::size_t count) {
            return std::clamp(std::floor(v / kSize), 0.0, static_cast<double>(count) - 1);
        };
        if (right < 0 || bottom < 0 || left > view.width || top > view.height) continue;
        for (auto y = static_cast<std::size_t>(tile(top - 1, rows));
             y <= static_cast<std::size_t>(tile(bottom + 1, rows)); ++y) {
            for (auto x = static_cast<std::size_t>(tile(left - 1, columns_));
                 x <= static_cast<std::size_t>(tile(right + 1, columns_)); ++x) {
                lists_[y * columns_ + x].push_back(static_cast<int>(i));
            }
        }
    }
}

Seen look(const Street& street, const std::vector<Object>& objects, const std::vector<int>& which,
          const Ray& ray, float pixel_size, IrradianceCache& cache) {
    const float to_ground = ray.direction.y < 0 ? -ray.origin.y / ray.direction.y : 1e9F;
    const Hit hit = trace(street, objects, which, ray, to_ground);
    const Vec3 direction = normalize(ray.direction);
    if (hit.kind == Kind::kSky) {
        if (ray.direction.y < 0) return {Kind::kGround, {}};
        return {Kind::kSky, sky_radiance(direction)};
    }
    const SurfacePoint at{ray.at(hit.t), hit.normal, direction, hit.t * pixel_size, &cache};
    const auto index = static_cast<std::size_t>(hit.index);
    switch (hit.kind) {
        case Kind::kBuilding:
            return {hit.kind, shade_building(street, street.buildings[index], at, hit.part)};
        case Kind::kCar:
            return {hit.kind, shade_car(street, street.cars[index], at)};
        case Kind::kChimney:
            return {hit.kind, shade_matte(street, at, {0.09F, 0.065F, 0.05F}, 0)};
        case Kind::kPerson:
            return {hit.kind, shade_matte(street, at, {0.035F, 0.034F, 0.04F}, 0.05F)};
        default:
            return {hit.kind, shade_matte(street, at, {0.06F, 0.065F, 0.06F}, 0.5F)};
    }
}

void render_street(const Street& street, const std::vector<Object>& objects, const Camera& camera,
                   Image& picture, Image& sky_share) {
    const Tiles tiles(objects, camera, false);
    const MirrorPicture mirror(street, objects, camera);
    const GroundLight light(street);
    constexpr int kSky = 0;
    constexpr int kGround = 1;
    Image shares(picture.width(), picture.height(), 2);
    render_adaptive<IrradianceCache>(
        [&](double x, double y, IrradianceCache& cache) {
            const Seen seen =
                look(street, objects, tiles.at(static_cast<int>(x), static_cast<int>(y)),
                     camera.ray(x, y), camera.pixel_size(), cache);
            if (seen.kind == Kind::kSky) return Sample{seen.radiance, tone(seen.radiance), kSky};
            // A brightness of its own, so that the edges of the ground are found.
            if (seen.kind == Kind::kGround) return Sample{{}, -0.3F, kGround};
            return Sample{seen.radiance, tone(seen.radiance), -1};
        },
        picture, shares);
    parallel_for(static_cast<std::size_t>(picture.height()), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < picture.width(); ++x) {
            sky_share.at(x, y) = shares.at(x, y, kSky);
            const float ground = shares.at(x, y, kGround);
            if (ground <= 0) continue;
            const Vec3 add =
                ground_radiance(street, light, mirror, camera, x + 0.5, y + 0.5) * ground;
            picture.at(x, y, 0) += add.x;
            picture.at(x, y, 1) += add.y;
            picture.at(x, y, 2) += add.z;
        }
    });
}

}  // namespace aureole::scene::night
