// Which roughness each level of a prefiltered environment is for: there are as many conventions as
// engines, and a map filtered for one looks wrong in another.
//
// "Perceptual roughness" r is what artists set; GGX has alpha = r^2 (Burley 2012,
// "Physically-Based Shading at Disney").
#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace aureole::ibl {

enum class RoughnessMapping {
    // Google Filament, cmgen: with l = level / (levels - 1), r = 1 - sqrt(1 - l).
    kFilament,
    // glTF sample viewer: r = l.
    kGltf,
    // Unreal Engine 4 (Karis 2013, "Real Shading in Unreal Engine 4"): counts from the 1 x 1 level
    // of
    // the full chain, whose index is m = ceil(log2(size)): r = 2^((1 - (m - 1 - level)) / 1.2), at
    // most 1, which is reached at 4 x 4 texels. The only mapping that depends on the size.
    kUe4,
    // Unity: the level l shows the r with l = r (1.7 - 0.7 r).
    kUnity,
    // r = l, under the name that says so.
    kLinear,
};

// The names of the command line, in the order of the enumeration.
inline constexpr std::array<std::string_view, 5> kRoughnessMappingNames = {
    "filament", "gltf", "ue4", "unity", "linear"};

// Perceptual roughness of every level of a chain that begins with `size` texels per side, in [0,
// 1], never falling. Level 0 is the environment itself, 0, in every mapping. Throws InvalidArgument
// unless size is in [1, 16384] and levels in [1, most_levels(size)].
std::vector<double> level_roughness(RoughnessMapping mapping, int levels, int size);

// Where a surface of `roughness` looks up a chain whose levels are for `level_roughness`, as a
// fraction of levels: linear between the two levels around it, the first or the last level beyond
// them. level_roughness never falls and is not empty; of equal levels the first counts.
double level_of_roughness(const std::vector<double>& level_roughness, double roughness);

// GGX alpha of a perceptual roughness in [0, 1].
constexpr double alpha_from_roughness(double perceptual_roughness) {
    return perceptual_roughness * perceptual_roughness;
}

// Levels of the full chain of `size`, down to 1 x 1 texel: 9 for 256, 8 for 255.
int most_levels(int size);

// What a chain has unless asked otherwise: it ends at 16 x 16 texels, below which a prefiltered
// environment has nothing left to say (5 levels for 256); the full chain for kUe4.
int default_levels(RoughnessMapping mapping, int size);

}  // namespace aureole::ibl
