#include "scene/night_render.h"

#include <cmath>

#include "aureole/base/parallel.h"
#include "scene/noise.h"

namespace aureole::scene::night {
namespace {

constexpr int kFirstSamples = 4;
// Where brightness varies within a pixel by more than the first figure, more samples are taken.
struct Refinement {
    float contrast;
    int samples;
};
constexpr Refinement kRefinements[] = {{0.05F, 4}, {0.15F, 8}};

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

void render_solids(const Street& street, const std::vector<Object>& objects, const Camera& camera,
                   const MirrorPicture& mirror, Image& picture, Image& sky_share) {
    const Tiles tiles(objects, camera, false);
    parallel_for(static_cast<std::size_t>(picture.height()), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < picture.width(); ++x) {
            Vec3 sum;
            IrradianceCache cache;
            int ground = 0;
            int sky = 0;
            int count = 0;
            float low = 1e9F;
            float high = -1e9F;
            const auto sample = [&](int samples) {
                for (int i = 0; i < samples; ++i, ++count) {
                    const auto offset = pixel_sample(x, y, count);
                    const Seen seen =
                        look(street, objects, tiles.at(x, y),
                             camera.ray(x + offset[0], y + offset[1]), camera.pixel_size(), cache);
                    // The ground counts as a brightness of its own, so that its edges are found.
                    const float brightness =
                        seen.kind == Kind::kGround ? -0.2F : tone(seen.radiance);
                    low = std::min(low, brightness);
                    high = std::max(high, brightness);
                    sum += seen.radiance;
                    ground += seen.kind == Kind::kGround ? 1 : 0;
                    sky += seen.kind == Kind::kSky ? 1 : 0;
                }
            };
            sample(kFirstSamples);
            for (const Refinement& more : kRefinements) {
                if (high - low > more.contrast) sample(more.samples);
            }
            const float share = 1 / static_cast<float>(count);
            Vec3 out = sum * share;
            if (ground > 0) {
                out += ground_radiance(street, mirror, camera, x + 0.5, y + 0.5) *
                       (static_cast<float>(ground) * share);
            }
            picture.at(x, y, 0) = out.x;
            picture.at(x, y, 1) = out.y;
            picture.at(x, y, 2) = out.z;
            sky_share.at(x, y) = static_cast<float>(sky) * share;
        }
    });
}

}  // namespace aureole::scene::night
