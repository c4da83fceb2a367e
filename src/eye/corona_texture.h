// The texture of the ciliary corona as a factor of unit ring means.
#pragma once

#include "aureole/image/image.h"

namespace aureole::eye {

// T' from T: max(T, small)^contrast divided, per colour, by its mean over each ring of pixels
// weighted by the scatter energy there, so that S T' has exactly the energy of S in every ring.
// 1 within 1.5 pixels of the source and blended in by 3.5: nearer, a pixel holds whole decades of
// S, and the texture there would only move energy between a handful of pixels.
// `corona` has 3 channels, `scatter` 1, both the same odd size centred on the source.
Image corona_texture(const Image& corona, const Image& scatter, double contrast);

// Which part of the texture of white the light of each primary has, from the 9 channels of its
// corona: a matrix whose sum over the primaries is `texture` and whose ring means are 1 where light
// keeps its colour, 0 else. `white` is the sum of `corona` over the primaries.
Image texture_of_primaries(const Image& texture, const Image& corona, const Image& white,
                           const Image& scatter);

}  // namespace aureole::eye
