// The faces of houses: masonry, mouldings, recessed windows, doors and shop fronts.
#include <cmath>

#include "scene/night_street.h"
#include "scene/noise.h"

namespace aureole::scene::night {
namespace {

constexpr float kInversePi = 0.31830989F;
constexpr float kMargin = 0.45F;  // wall left of the first and right of the last bay, m
constexpr float kReveal = 0.16F;  // depth of a window behind the wall
constexpr float kFascia = 0.62F;  // height of a shop's sign board

// Reflectance of masonry relative to its mean.
float masonry(const Building& b, float u, float v, float footprint) {
    const int seed = b.seed;
    // Weather: large soft patches, dirt running down.
    float tone = 1 + 0.22F * fractal_noise(u, v, 3.1F, 3, footprint, seed) +
                 0.10F * survives(0.5F, footprint) * value_noise(u * 2.3F, v * 0.22F, seed + 7);
    if (b.wall == Wall::kStucco) {
        tone += 0.10F * fractal_noise(u, v, 0.35F, 3, footprint, seed + 11);
        return tone;
    }
    const float course = b.wall == Wall::kBrick ? 0.085F : 0.46F;
    const float block = b.wall == Wall::kBrick ? 0.25F : 0.95F;
    const float joint = b.wall == Wall::kBrick ? 0.014F : 0.02F;
    const int row = floor_int(v / course);
    const float shift = (row & 1) != 0 ? 0.5F * block : 0;
    const int column = floor_int((u + shift) / block);
    const float keep = survives(course, footprint);
    const float variation = b.wall == Wall::kBrick ? 0.55F : 0.26F;
    tone *= 1 + keep * variation * (hash_uniform(column, row, seed) - 0.5F);
    const float bed = 1 - stripe_coverage(v, course, course - joint, footprint);
    const float head = 1 - stripe_coverage(u + shift, block, block - joint, footprint);
    const float mortar = std::min(bed + head * (keep > 0 ? 1.0F : 0.6F), 1.0F);
    return tone * mix(1.0F, b.wall == Wall::kBrick ? 1.5F : 0.55F, mortar);
}

// Where a ray of view that enters an opening at (u, v) ends: on the glass, or on the sides.
struct Recess {
    float u, v;
    Vec3 side;  // normal of the reveal in the frame of the facade; zero: the glass
};

Recess enter(float u, float v, Vec3 direction, float left, float bottom, float right, float top) {
    const float t = kReveal / std::max(-direction.z, 0.02F);
    const float to_u = direction.x > 0 ? (right - u) / std::max(direction.x, 1e-6F)
                                       : (left - u) / std::min(direction.x, -1e-6F);
    const float to_v = direction.y > 0 ? (top - v) / std::max(direction.y, 1e-6F)
                                       : (bottom - v) / std::min(direction.y, -1e-6F);
    if (to_u < t && to_u <= to_v) return {u, v, {direction.x > 0 ? -1.0F : 1.0F, 0, 0}};
    if (to_v < t) return {u, v, {0, direction.y > 0 ? -1.0F : 1.0F, 0}};
    return {u + direction.x * t, v + direction.y * t, {}};
}

struct Frame {
    const Street& street;
    const Building& building;
    const SurfacePoint& at;
    Vec3 direction;  // of view in the frame of the facade: u, v, n
    float u, v;
    float width_u, width_v;  // the pixel's footprint along the facade

    Vec3 world(Vec3 v3) const {
        return building.along * v3.x + Vec3{0, v3.y, 0} + building.normal * v3.z;
    }
    Vec3 lit(Vec3 albedo, Vec3 normal) const {
        return albedo * at.cache->at(street, building, at.position, normal) * kInversePi;
    }
    // Moulding: a profile that leans out of the wall by `lean` (up positive) catches other light.
    Vec3 moulding(Vec3 albedo, float lean) const {
        return lit(albedo, normalize(building.normal + Vec3{0, lean, 0}));
    }
};

Vec3 reveal(const Frame& f, const Recess& recess) {
    return f.lit(f.building.trim * 0.75F,
                 normalize(f.world(recess.side) + f.building.normal * 0.25F));
}

// Sashes and glazing bars over the light from within.
Vec3 glazing(const Frame& f, Vec3 inside, float u, float v, float width, float height, int style,
             Vec3 paint) {
    const float fu = f.width_u;
    const float fv = f.width_v;
    float bars = 1 - interval_coverage(u, 0.06F, width - 0.06F, fu) *
                         interval_coverage(v, 0.07F, height - 0.06F, fv);
    const auto upright = [&](float at, float size) {
        bars = std::max(bars, interval_coverage(u, at - size, at + size, fu));
    };
    const auto level = [&](float at, float size) {
        bars = std::max(bars, interval_coverage(v, at - size, at + size, fv));
    };
    if (style == 0) {  // sash
        level(0.5F * height, 0.03F);
        upright(0.5F * width, 0.014F);
    } else if (style == 1) {  // two casements and a transom light
        upright(0.5F * width, 0.045F);
        level(0.70F * height, 0.032F);
    } else if (style == 2) {  // small panes
        for (const float i : {1.0F, 2.0F}) upright(i / 3 * width, 0.014F);
        for (const float i : {1.0F, 2.0F, 3.0F}) level(i / 4 * height, 0.014F);
    } else {  // shop front
        upright(0.5F * width, 0.025F);
        level(0.80F * height, 0.03F);
    }
    if (bars <= 0) return inside;
    return mix(inside, f.lit(paint, f.building.normal), bars);
}

Vec3 wall(const Frame& f) {
    const Building& b = f.building;
    Vec3 albedo = b.albedo * std::max(masonry(b, f.u, f.v, 0.5F * (f.width_u + f.width_v)), 0.1F);
    if (f.v < 0.5F) albedo = albedo * 0.62F;  // plinth, wet and dirty
    return f.lit(albedo, b.normal);
}

// Cornice, string courses and rain pipes; true if the point is on one.
bool mouldings(const Frame& f, Vec3& out) {
    const Building& b = f.building;
    const float from_top = b.height - f.v;
    const auto banded = [&](float y, float top, float shadow) {
        if (y < 0 || y > top + shadow) return false;
        if (y > top) {  // below the projection, in its shade
            out = f.lit(b.albedo * 0.35F, b.normal);
        } else {
            const float t = y / top;
            out = f.moulding(b.trim, t < 0.35F ? 0.8F : (t < 0.6F ? -0.2F : -1.1F));
        }
        return true;
    };
    if (banded(from_top, 0.42F, 0.16F)) return true;
    if (banded(b.ground_floor + 0.28F - f.v, 0.24F, 0.07F)) return true;
    const float pipe = std::min(f.u, b.width - f.u) - 0.16F;
    if (b.seed % 3 != 0 && std::abs(pipe) < 0.055F) {
        const float across = pipe / 0.055F;
        out = f.lit({0.07F, 0.07F, 0.07F}, normalize(b.normal + b.along * (0.9F * across)));
        return true;
    }
    return false;
}

Vec3 upper_floor(const Frame& f) {
    const Building& b = f.building;
    const int row = floor_int((f.v - b.ground_floor) / b.storey);
    const float y = f.v - b.ground_floor - static_cast<float>(row) * b.storey;
    const int column = floor_int((f.u - kMargin) / b.bay);
    const float x = f.u - kMargin - (static_cast<float>(column) + 0.5F) * b.bay;
    const int columns = floor_int((b.width - 2 * kMargin) / b.bay + 0.5F);
    if (column < 0 || column >= columns || row >= b.storeys) return wall(f);
    const float half = 0.5F * b.window_width;
    const float top = b.sill + b.window_height;
    if (std::abs(x) < half && y > b.sill && y < top) {
        const Recess recess = enter(x, y, f.direction, -half, b.sill, half, top);
        if (dot(recess.side, recess.side) > 0) return reveal(f, recess);
        const float u = recess.u + half;
        const float v = recess.v - b.sill;
        const Vec3 inside = window_light(b, column, row, u, v, b.window_width, b.window_height,
                                         f.direction, std::max(f.width_u, f.width_v));
        return glazing(f, inside, u, v, b.window_width, b.window_height, b.seed % 3,
                       b.trim * 1.15F);
    }
    // Surround, sill, and a keystone or pediment above on some houses.
    const float ledge = b.sill - y;
    if (ledge > 0 && ledge < 0.20F && std::abs(x) < half + 0.14F) {
        return ledge < 0.10F ? f.moulding(b.trim, ledge < 0.05F ? 0.9F : -0.3F)
                             : f.lit(b.albedo * 0.4F, b.normal);
    }
    const float border = b.wall == Wall::kBrick ? 0.05F : 0.17F;
    if (std::abs(x) < half + border && y > b.sill && y < top + border) {
        return f.moulding(b.trim * 0.9F, y > top ? 0.25F : 0.0F);
    }
    const float lintel = y - top - border;
    if (b.seed % 2 == 0 && lintel > 0 && lintel < 0.20F && std::abs(x) < half + 0.24F) {
        return f.moulding(b.trim, lintel > 0.12F ? 0.8F : -0.6F);
    }
    return wall(f);
}

Vec3 door(const Frame& f, float x, float y, float half, float top) {
    const Building& b = f.building;
    const Recess recess = enter(x, y, f.direction, -half, 0, half, top);
    if (dot(recess.side, recess.side) > 0) return reveal(f, recess);
    if (recess.v > 2.15F) {  // fanlight
        const Vec3 inside = window_light(b, 77, 0, recess.u + half, recess.v - 2.15F, 2 * half,
                                         top - 2.15F, f.direction, f.width_u);
        return glazing(f, inside, recess.u + half, recess.v - 2.15F, 2 * half, top - 2.15F, 1,
                       b.trim);
    }
    const Vec3 paints[] = {{0.05F, 0.09F, 0.06F},
                           {0.14F, 0.03F, 0.025F},
                           {0.04F, 0.05F, 0.09F},
                           {0.09F, 0.05F, 0.03F}};
    const Vec3 paint = paints[b.seed & 3];
    const float px = std::abs(std::abs(recess.u) - 0.27F);
    const float py = std::abs(std::abs(recess.v - 1.05F) - 0.47F);
    const bool panel = px < 0.17F && py < 0.36F;
    const bool edge = panel && (px > 0.14F || py > 0.33F);
    return f.lit(paint * (edge ? 0.5F : (panel ? 0.85F : 1.0F)), b.normal);
}

Vec3 ground_floor(const Frame& f) {
    const Building& b = f.building;
    const float x0 = f.u - kMargin;
    const int columns = std::max(1, floor_int((b.width - 2 * kMargin) / b.bay + 0.5F));
    const float span = (b.width - 2 * kMargin) / static_cast<float>(columns);
    const int column = floor_int(x0 / span);
    const float x = x0 - (static_cast<float>(column) + 0.5F) * span;
    const bool inside = column >= 0 && column < columns;
    const int door_column = b.seed % columns;
    if (b.shop) {
        const float board = b.ground_floor - 0.18F - f.v;
        if (board > 0 && board < kFascia && x0 > -0.2F && f.u < b.width - kMargin + 0.2F) {
            const Vec3 tints[] = {{0.10F, 0.02F, 0.02F},
                                  {0.02F, 0.05F, 0.04F},
                                  {0.03F, 0.03F, 0.07F},
                                  {0.10F, 0.08F, 0.05F}};
            const float wash = 0.35F + 0.65F * std::exp(-square((x) / (0.35F * span)));
            const Vec3 lit =
                tints[b.seed & 3] * Vec3{26, 22, 15} * (wash * std::exp(-1.6F * board));
            return lit + f.moulding(tints[b.seed & 3], 0.1F);
        }
        const float top = b.ground_floor - 0.18F - kFascia;
        if (inside && f.v < top) {
            const bool is_door = column == door_column;
            const float half = is_door ? 0.52F : 0.5F * span - 0.13F;
            const float bottom = is_door ? 0.05F : 0.52F;
            const float head = is_door ? 2.35F : top - 0.06F;
            if (std::abs(x) < half && f.v > bottom && f.v < head) {
                const Recess recess = enter(x, f.v, f.direction, -half, bottom, half, head);
                if (dot(recess.side, recess.side) > 0) return reveal(f, recess);
                const Vec3 goods =
                    shop_light(b, column, recess.u + half, recess.v - bottom, 2 * half,
                               head - bottom, f.direction, std::max(f.width_u, f.width_v));
                return glazing(f, goods, recess.u + half, recess.v - bottom, 2 * half,
                               head - bottom, 3, {0.04F, 0.04F, 0.04F});
            }
        }
        return f.lit(b.trim * 0.35F, b.normal);  // pilasters and stall risers
    }
    if (inside && column == door_column) {
        constexpr float kHalf = 0.55F;
        const float top = 2.65F;
        if (std::abs(x) < kHalf && f.v < top) return door(f, x, f.v, kHalf, top);
        if (std::abs(x) < kHalf + 0.2F && f.v < top + 0.22F)
            return f.moulding(b.trim, f.v > top ? 0.4F : 0);
    } else if (inside) {
        const float half = 0.5F * b.window_width;
        const float bottom = 1.05F;
        const float top = bottom + b.window_height;
        if (std::abs(x) < half && f.v > bottom && f.v < top) {
            const Recess recess = enter(x, f.v, f.direction, -half, bottom, half, top);
            if (dot(recess.side, recess.side) > 0) return reveal(f, recess);
            const float u = recess.u + half;
            const float v = recess.v - bottom;
            return glazing(f,
                           window_light(b, column, -1, u, v, b.window_width, b.window_height,
                                        f.direction, std::max(f.width_u, f.width_v)),
                           u, v, b.window_width, b.window_height, b.seed % 3, b.trim * 1.15F);
        }
        if (std::abs(x) < half + 0.12F && f.v > bottom - 0.12F && f.v < top + 0.12F) {
            return f.moulding(b.trim * 0.9F, f.v < bottom ? 0.7F : 0.0F);
        }
    }
    // Rusticated: deep horizontal joints.
    if (b.wall != Wall::kBrick) {
        const float joint = 1 - stripe_coverage(f.v, 0.5F, 0.46F, f.width_v);
        return mix(wall(f), f.lit(b.albedo * 0.25F, b.normal), joint);
    }
    return wall(f);
}

}  // namespace

Vec3 shade_building(const Street& street, const Building& b, const SurfacePoint& at, int part) {
    if (part == 1) {  // slates, wet
        const float courses = stripe_coverage(at.position.y, 0.22F, 0.19F, at.footprint);
        return shade_matte(street, at, Vec3{0.045F, 0.045F, 0.05F} * (0.7F + 0.3F * courses), 0.5F);
    }
    const Vec3 offset = at.position - b.origin;
    if (part == 2) {
        const float tone = masonry(b, dot(offset, b.normal), offset.y, at.footprint);
        return shade_matte(street, at, b.albedo * (0.75F * std::max(tone, 0.1F)), 0);
    }
    const Vec3 direction = {dot(at.direction, b.along), at.direction.y,
                            dot(at.direction, b.normal)};
    const float stretch = 1 / std::max(-direction.z, 0.03F);
    const Frame frame{street,
                      b,
                      at,
                      direction,
                      dot(offset, b.along),
                      offset.y,
                      at.footprint * std::sqrt(1 + square(direction.x * stretch)),
                      at.footprint * std::sqrt(1 + square(direction.y * stretch))};
    Vec3 out;
    if (mouldings(frame, out)) return out;
    return frame.v < b.ground_floor ? ground_floor(frame) : upper_floor(frame);
}

}  // namespace aureole::scene::night
