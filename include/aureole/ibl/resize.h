// Environments that are cube maps already: another size, turned, mirrored, cleaned.
#pragma once

#include "aureole/ibl/cube_map.h"
#include "aureole/ibl/environment_transform.h"

namespace aureole::ibl {

// `map` with `transform`, as a map of `size`.
// - Turned by multiples of 90 deg, or mirrored: texels change places, bit for bit, before anything
//   else is done.
// - Smaller: the mean over each texel weighted by solid angle, which keeps energy. Larger: linear,
//   across edges of faces too (CubeSampler).
// - Turned by other angles: the mean over each texel of the map interpolated linearly, by samples a
//   quarter of a texel apart.
// Constants stay constant. The energy of a single bright texel changes by less than .1 % when
// 256 x 256 texels are doubled, 1.3 % when 16 x 16 are, up to 4 % when the ratio of the sizes lies
// in between, and by .6 % (root mean square; 3 % at most) when the map is turned; that of anything
// larger by much less.
// Throws InvalidArgument for an empty map, a size outside [1, 16384] and a transform out of range.
CubeMap transformed(const CubeMap& map, int size, const EnvironmentTransform& transform = {},
                    EnvironmentReport* report = nullptr);

}  // namespace aureole::ibl
