// The world of the `night-street` scene. Metres; the road runs along +z, y = 0 is its surface, the
// observer sits in a car at the origin's lane and traffic keeps to the right.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/camera.h"
#include "scene/vec.h"

namespace aureole::scene::night {

inline constexpr float kKerbX = 5.5F;      // half width of the carriageway
inline constexpr float kStreetEndZ = 190;  // a house closes the street
inline constexpr Vec3 kEye = {1.75F, 1.35F, 0};
inline constexpr double kEyePitchDeg = 3.2;

// How a light distributes its intensity over directions.
enum class Lobe {
    kLamp,      // downwards, nothing above the horizontal
    kHeadlamp,  // dipped beam along `axis`, with a cut-off at the horizontal
    kCosine,    // Lambert's law about `axis`
};

struct Light {
    Vec3 position;
    Vec3 intensity_cd;  // rgb whose luminance is the intensity along the brightest direction
    Vec3 axis;
    Lobe lobe = Lobe::kCosine;
    float radius_m = 0.1F;      // softens reflections and the near field
    bool in_reflection = true;  // false: the mirrored picture of the street already shows it
    // Set by sort_lights():
    float reach_m = 0;  // beyond it the light is left out
    float candela = 0;  // luminance of intensity_cd
};

// A visible light source: an ellipse across the line of sight, or a rectangle.
struct Luminaire {
    Vec3 centre;
    Vec3 half_axis_1;
    Vec3 half_axis_2;
    Vec3 radiance;
    bool rectangle = false;
};

enum class Wall { kBrick, kStucco, kStone };

struct Building {
    Vec3 origin;  // left lower corner of the facade as seen from the street
    Vec3 along;   // unit, along the facade
    Vec3 normal;  // unit, towards the street
    float width, height, depth, roof_height;
    float ground_floor, storey, bay, window_width, window_height, sill;
    int storeys;
    Wall wall;
    Vec3 albedo, trim;  // of the wall, and of frames, cornices and sills
    bool shop;
    float lit_share;  // of the windows
    int seed;
};

struct Chimney {
    Vec3 low, high;  // corners of a box
};

struct Car {
    Vec3 position;  // on the road, below the centre
    float heading;  // +1: seen from behind, -1: seen from the front
    Vec3 paint;     // albedo
    int seed;
    bool estate;  // tall tail
};

struct Person {
    Vec3 position;
    float height, stride;
};

// A round bar between two points.
struct Bar {
    Vec3 from, to;
    float radius;
};

struct Post {  // a street lamp: bars that share a bounding box
    std::vector<Bar> bars;
};

inline constexpr float kBinLength = 4;

struct Street {
    std::vector<Building> buildings;
    std::vector<Chimney> chimneys;
    std::vector<Car> cars;
    std::vector<Person> people;
    std::vector<Post> posts;
    std::vector<Light> lights;  // what illuminates
    // The lights that matter to surfaces at a depth: kBinLength metres of z per list.
    std::vector<std::vector<Light>> lights_near;
    std::vector<Light> lights_mirrored;  // those that the road reflects as points
    const std::vector<Light>& lights_at(float z) const;
    std::vector<Luminaire> luminaires;  // what is seen shining
};

Street build_street(std::uint64_t seed);

// Fills the other lists of lights from Street::lights.
void sort_lights(Street& street);

// --- Geometry -------------------------------------------------------------------------------

enum class Kind : unsigned char { kSky, kGround, kBuilding, kChimney, kCar, kPerson, kPost };

struct Object {
    Kind kind;
    int index;
    Vec3 low, high;  // bounding box
};
// Sorted by the near end of the boxes.
std::vector<Object> list_objects(const Street& street);

struct Hit {
    Kind kind = Kind::kSky;
    int index = 0;
    float t = 1e9F;
    Vec3 normal;
    int part = 0;  // of a building: 0 facade, 1 roof, 2 side; of a post: the bar
};

// The nearest of the given objects (ascending indices into `objects`) before t_max, or the sky. The
// ground is not among them. Rays run away from the camera: direction.z > 0.
Hit trace(const Street& street, const std::vector<Object>& objects, const std::vector<int>& which,
          const Ray& ray, float t_max);

float car_distance(const Car& car, Vec3 local);
Vec3 to_car(const Car& car, Vec3 world);

// --- Light ----------------------------------------------------------------------------------

// Irradiance (lx as rgb) at a point with a normal, from all lights and the glow of the sky.
Vec3 irradiance(const Street& street, Vec3 position, Vec3 normal);

// Radiance that lights make by reflection in a rough dielectric (GGX, Walter et al. 2007) of
// roughness alpha and reflectance f0 at normal incidence, towards `to_eye`.
Vec3 glints(const Street& street, Vec3 position, Vec3 normal, Vec3 to_eye, float alpha, float f0,
            bool on_road);

Vec3 sky_radiance(Vec3 direction);

// --- Surfaces -------------------------------------------------------------------------------

// Irradiances found for the samples of one pixel: those that fall on one plane of one house are
// centimetres apart and share them.
class IrradianceCache {
  public:
    Vec3 at(const Street& street, const Building& building, Vec3 position, Vec3 normal);

  private:
    struct Entry {
        const Building* building = nullptr;
        Vec3 normal;
        Vec3 irradiance;
    };
    static constexpr int kEntries = 6;
    Entry entries_[kEntries];
    int next_ = 0;
};

struct SurfacePoint {
    Vec3 position;
    Vec3 normal;
    Vec3 direction;   // of view, unit
    float footprint;  // of a pixel, across the line of sight, m
    IrradianceCache* cache;
};

Vec3 shade_building(const Street& street, const Building& building, const SurfacePoint& at,
                    int part);
Vec3 window_light(const Building& building, int column, int row, float u, float v, float width,
                  float height, Vec3 local_direction, float footprint);
Vec3 shop_light(const Building& building, int column, float u, float v, float width, float height,
                Vec3 local_direction, float footprint);
Vec3 shade_car(const Street& street, const Car& car, const SurfacePoint& at);
Vec3 shade_matte(const Street& street, const SurfacePoint& at, Vec3 albedo, float gloss);

}  // namespace aureole::scene::night
