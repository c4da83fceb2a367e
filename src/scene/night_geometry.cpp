// Rays against the houses, cars, people and posts of the street.
#include <cmath>
#include <limits>

#include "scene/night_street.h"

namespace aureole::scene::night {
namespace {

constexpr float kFar = std::numeric_limits<float>::max();

// Where a ray enters and leaves a box; enter > leave: it misses.
struct Span {
    float enter;
    float leave;
    int axis;  // of the face by which it enters
};

struct BoxRay {
    explicit BoxRay(const Ray& ray)
        : origin(ray.origin),
          inverse{reciprocal(ray.direction.x), reciprocal(ray.direction.y),
                  reciprocal(ray.direction.z)} {}
    static float reciprocal(float v) { return 1 / (v == 0 ? 1e-20F : v); }
    Vec3 origin;
    Vec3 inverse;  // of the direction
};

inline Span box_span(const BoxRay& ray, Vec3 low, Vec3 high) {
    const Vec3 a = (low - ray.origin) * ray.inverse;
    const Vec3 b = (high - ray.origin) * ray.inverse;
    const Vec3 near = {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
    const Vec3 far = {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
    Span span{std::max(std::max(near.x, near.y), near.z), std::min(std::min(far.x, far.y), far.z),
              2};
    if (span.enter == near.x) span.axis = 0;
    if (span.enter == near.y) span.axis = 1;
    if (span.enter <= 0) {  // starts inside
        span.enter = 0;
        span.axis = -1;
    }
    return span;
}

Vec3 axis_normal(int axis, Vec3 direction) {
    const auto against = [](float d) { return d > 0 ? -1.0F : 1.0F; };
    return {axis == 0 ? against(direction.x) : 0, axis == 1 ? against(direction.y) : 0,
            axis == 2 ? against(direction.z) : 0};
}

// A house in its own frame: u along the facade, v up, n out of the facade.
void hit_building(const Building& b, const Ray& ray, Hit& hit) {
    const Vec3 offset = ray.origin - b.origin;
    const Ray local{{dot(offset, b.along), offset.y, dot(offset, b.normal)},
                    {dot(ray.direction, b.along), ray.direction.y, dot(ray.direction, b.normal)}};
    const auto world = [&](Vec3 v) { return b.along * v.x + Vec3{0, v.y, 0} + b.normal * v.z; };
    const BoxRay box(local);
    const Span body = box_span(box, {0, 0, -b.depth}, {b.width, b.height, 0});
    if (body.axis >= 0 && body.enter < body.leave && body.enter < hit.t) {
        hit.t = body.enter;
        hit.part = body.axis == 2 ? 0 : (body.axis == 1 ? 1 : 2);
        hit.normal = world(axis_normal(body.axis, local.direction));
        hit.kind = Kind::kBuilding;
    }
    if (b.roof_height <= 0) return;
    // The roof: a box of which a plane that rises inwards from the eaves cuts the front.
    constexpr float kEaves = 0.35F;
    constexpr float kSlope = 1.15F;
    Span roof = box_span(box, {0, b.height, -b.depth}, {b.width, b.height + b.roof_height, kEaves});
    const Vec3 plane = {0, 1, kSlope};
    const float limit = b.height + 0.12F + kSlope * kEaves;
    const float start = limit - dot(plane, local.origin);
    const float rate = dot(plane, local.direction);
    bool by_slope = false;
    if (rate < 0 && start / rate > roof.enter) {
        roof.enter = start / rate;
        by_slope = true;
    } else if (rate > 0) {
        roof.leave = std::min(roof.leave, start / rate);
    } else if (start < 0) {
        return;
    }
    if ((roof.axis >= 0 || by_slope) && roof.enter < roof.leave && roof.enter < hit.t) {
        hit.t = roof.enter;
        hit.part = 1;
        hit.normal = by_slope ? normalize(world(plane))
                              : world(axis_normal(std::max(roof.axis, 0), local.direction));
        hit.kind = Kind::kBuilding;
    }
}

float person_distance(const Person& person, Vec3 p) {
    const float s = 1 / person.height;
    p = p * s;
    const auto segment = [&](Vec3 a, Vec3 b, float radius_a, float radius_b) {
        const Vec3 pa = p - a;
        const Vec3 ba = b - a;
        const float h = clamp01(dot(pa, ba) / dot(ba, ba));
        return length(pa - ba * h) - mix(radius_a, radius_b, h);
    };
    const float stride = person.stride;
    float d = length(p - Vec3{0, 0.93F, 0}) - 0.060F;
    d = std::min(d, segment({0, 0.90F, 0}, {0, 0.80F, 0}, 0.034F, 0.040F));
    d = std::min(d, segment({-0.085F, 0.785F, 0}, {0.085F, 0.785F, 0}, 0.048F, 0.048F));
    d = std::min(d, segment({0, 0.76F, 0}, {0, 0.47F, 0}, 0.092F, 0.102F));
    d = std::min(d, segment({0.045F, 0.46F, 0}, {0.05F, 0.03F, stride}, 0.062F, 0.032F));
    d = std::min(d, segment({-0.045F, 0.46F, 0}, {-0.05F, 0.03F, -stride}, 0.062F, 0.032F));
    d = std::min(d, segment({0.115F, 0.775F, 0}, {0.132F, 0.47F, -stride}, 0.036F, 0.024F));
    d = std::min(d, segment({-0.115F, 0.775F, 0}, {-0.132F, 0.47F, stride}, 0.036F, 0.024F));
    return d * person.height;
}

// Sphere tracing (Hart 1996) of a distance function between two depths.
template <class Distance>
void march(const Ray& ray, Span span, float scale, const Distance& distance, Kind kind, Hit& hit) {
    if (span.enter >= span.leave || span.enter >= hit.t) return;
    const float end = std::min(span.leave, hit.t);
    float t = span.enter;
    for (int step = 0; step < 64 && t < end; ++step) {
        const Vec3 p = ray.at(t);
        const float d = distance(p);
        if (d < 1e-3F + 3e-4F * t * scale) {
            // Gradient by a tetrahedron of differences.
            constexpr float kStep = 4e-3F;
            constexpr Vec3 kCorners[] = {{1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, 1, 1}};
            Vec3 gradient;
            for (const Vec3& corner : kCorners) {
                gradient += corner * distance(p + corner * kStep);
            }
            hit.t = t;
            hit.kind = kind;
            hit.normal = normalize(gradient);
            return;
        }
        t += d / scale;
    }
}

// Where a ray can meet a car: in the box of its body or in that of its cabin.
Span car_span(const BoxRay& ray, const Car& car) {
    const Vec3 p = car.position;
    const float tail = car.heading * -2.12F;
    const float nose = car.heading * 1.2F;
    const Span body = box_span(ray, p + Vec3{-0.95F, 0, -2.2F}, p + Vec3{0.95F, 1.0F, 2.2F});
    const Span cabin = box_span(ray, p + Vec3{-0.84F, 0.95F, std::min(tail, nose)},
                                p + Vec3{0.84F, 1.5F, std::max(tail, nose)});
    if (body.enter >= body.leave) return cabin;
    if (cabin.enter >= cabin.leave) return body;
    return {std::min(body.enter, cabin.enter), std::max(body.leave, cabin.leave), 0};
}

// Nearest point of a ray to a bar, as a cylinder with round ends (after Quilez, "Capsule").
float hit_bar(const Ray& ray, const Bar& bar, Vec3& normal) {
    const Vec3 ba = bar.to - bar.from;
    const Vec3 oa = ray.origin - bar.from;
    const float baba = dot(ba, ba);
    const float bard = dot(ba, ray.direction);
    const float baoa = dot(ba, oa);
    const float a = baba * dot(ray.direction, ray.direction) - bard * bard;
    const float b = baba * dot(ray.direction, oa) - baoa * bard;
    const float c = baba * dot(oa, oa) - baoa * baoa - bar.radius * bar.radius * baba;
    const float discriminant = b * b - a * c;
    if (discriminant < 0 || a <= 0) return kFar;
    const float t = (-b - std::sqrt(discriminant)) / a;
    const float along = (baoa + t * bard) / baba;
    if (t <= 0 || along < -0.02F || along > 1.02F) return kFar;
    normal = normalize(oa + ray.direction * t - ba * along);
    return t;
}

struct Bounds {
    Vec3 low{1e9F, 1e9F, 1e9F};
    Vec3 high{-1e9F, -1e9F, -1e9F};
    void add(Vec3 p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
};

}  // namespace

std::vector<Object> list_objects(const Street& street) {
    std::vector<Object> objects;
    const auto add = [&](Kind kind, std::size_t index, const Bounds& bounds) {
        objects.push_back({kind, static_cast<int>(index), bounds.low, bounds.high});
    };
    for (std::size_t i = 0; i < street.buildings.size(); ++i) {
        const Building& b = street.buildings[i];
        Bounds bounds;
        for (const float u : {0.0F, b.width}) {
            for (const float n : {-b.depth, 0.4F}) {
                bounds.add(b.origin + b.along * u + b.normal * n);
                bounds.add(b.origin + b.along * u + b.normal * n +
                           Vec3{0, b.height + b.roof_height, 0});
            }
        }
        add(Kind::kBuilding, i, bounds);
    }
    for (std::size_t i = 0; i < street.chimneys.size(); ++i) {
        add(Kind::kChimney, i, {street.chimneys[i].low, street.chimneys[i].high});
    }
    for (std::size_t i = 0; i < street.cars.size(); ++i) {
        const Vec3 p = street.cars[i].position;
        add(Kind::kCar, i, {p + Vec3{-0.98F, 0, -2.3F}, p + Vec3{0.98F, 1.56F, 2.3F}});
    }
    for (std::size_t i = 0; i < street.people.size(); ++i) {
        const Vec3 p = street.people[i].position;
        add(Kind::kPerson, i, {p + Vec3{-0.5F, 0, -0.5F}, p + Vec3{0.5F, 2, 0.5F}});
    }
    for (std::size_t i = 0; i < street.posts.size(); ++i) {
        Bounds bounds;
        for (const Bar& bar : street.posts[i].bars) {
            const Vec3 r = {bar.radius, bar.radius, bar.radius};
            for (const Vec3 end : {bar.from, bar.to}) {
                bounds.add(end - r);
                bounds.add(end + r);
            }
        }
        add(Kind::kPost, i, bounds);
    }
    std::stable_sort(objects.begin(), objects.end(),
                     [](const Object& a, const Object& b) { return a.low.z < b.low.z; });
    return objects;
}

Hit trace(const Street& street, const std::vector<Object>& objects, const std::vector<int>& which,
          const Ray& ray, float t_max) {
    Hit hit;
    hit.t = t_max;
    const float scale = length(ray.direction);
    const BoxRay box(ray);
    for (const int candidate : which) {
        const Object& object = objects[static_cast<std::size_t>(candidate)];
        // Sorted by depth: nothing behind the nearest hit can be nearer.
        if (object.low.z - ray.origin.z > hit.t * ray.direction.z) break;
        const Span span = box_span(box, object.low, object.high);
        if (span.enter > span.leave || span.enter > hit.t) continue;
        const auto index = static_cast<std::size_t>(object.index);
        const float before = hit.t;
        switch (object.kind) {
            case Kind::kBuilding:
                hit_building(street.buildings[index], ray, hit);
                break;
            case Kind::kChimney:
                if (span.axis >= 0) {
                    hit.t = span.enter;
                    hit.kind = Kind::kChimney;
                    hit.normal = axis_normal(span.axis, ray.direction);
                }
                break;
            case Kind::kCar: {
                const Car& car = street.cars[index];
                march(
                    ray, car_span(box, car), scale,
                    [&](Vec3 p) { return car_distance(car, to_car(car, p)); }, Kind::kCar, hit);
                break;
            }
            case Kind::kPerson: {
                const Person& person = street.people[index];
                march(
                    ray, span, scale,
                    [&](Vec3 p) { return person_distance(person, p - person.position); },
                    Kind::kPerson, hit);
                break;
            }
            case Kind::kPost: {
                const Post& post = street.posts[index];
                for (std::size_t i = 0; i < post.bars.size(); ++i) {
                    Vec3 normal;
                    const float t = hit_bar(ray, post.bars[i], normal);
                    if (t >= hit.t) continue;
                    hit.t = t;
                    hit.kind = Kind::kPost;
                    hit.normal = normal;
                    hit.part = static_cast<int>(i);
                }
                break;
            }
            case Kind::kSky:
            case Kind::kGround:
                break;
        }
        if (hit.t < before) hit.index = object.index;
    }
    return hit;
}

}  // namespace aureole::scene::night
