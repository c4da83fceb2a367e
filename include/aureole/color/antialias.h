// Edges of a finished picture made smooth, for pictures that were rendered with one sample per
// pixel: the adaptive blur at the end of the pipeline of Sikachev, Tisevich & Ignatenko 2008
// ("Quad-trees for glare", section 3.2), which touches only places where surfaces adjoin.
#pragma once

#include "aureole/image/image.h"

namespace aureole::color {

// Blurs along edges, never across: each pixel becomes the mean of five samples on the tangent of
// the edge it lies on, one pixel apart with binomial weights. How much of it is taken rises
// continuously with the edge's contrast, from 0 at 1/16 to all at 1/4 of the display's range, so
// that nothing flickers as an edge fades. A straight edge along rows or columns, a smooth shading
// and a lone bright pixel stay as they are.
//
// `display` holds display values (after tone curve and encoding), in [0, 1], 1 or 3 channels;
// `out` has the same size and does not overlap it. Allocates nothing.
// Throws InvalidArgument for other shapes.
void antialias_edges(const ConstImageView& display, const ImageView& out);

}  // namespace aureole::color
