// Arithmetic of whole pictures: what was added to one, and how much light that is.
#pragma once

#include "aureole/image/image.h"
#include "aureole/image/view.h"
#include "aureole/io/picture.h"

namespace aureole::app {

// after - before: what glare added and took away. Sums with the picture to the composite.
Image difference(const ConstImageView& after, const ConstImageView& before);

// Adds light of three colours to a picture of three, or its luminance to a grey one.
void add_light(const Image& light, Image& to);

// The picture with other colour: same windows, metadata and further channels.
io::Picture with_color(const io::Picture& picture, const ConstImageView& color);

// Sum over pixels and channels of value * weight, as glare/energy.h counts: the weight is the
// pixel's solid angle in a perspective picture, else 1. `solid_angles`: of
// relative_solid_angles(view).
double energy_of(const ConstImageView& image, const View& view, const Image& solid_angles);

}  // namespace aureole::app
