// The bright pixels of a picture, joined into regions.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "aureole/image/image.h"
#include "sources/light_geometry.h"

namespace aureole::sources {

// What makes a light, as sums over pixels: adding sums joins lights, exactly.
struct LightSums {
    std::array<double, 3> energy = {};  // sum of w L_c dW
    double luminous = 0;                // sum of w L dW, the weight of all that follows
    double luminous_squared = 0;        // sum of (w L)^2 dW
    double x = 0, y = 0;                // sums of luminous times tangents
    double xx = 0, xy = 0, yy = 0;      // and of their products, extent of pixels included
    double extent = 0;                  // sum of luminous times the trace of a pixel's own extent

    void add(const LightSums& other);
    // Moments about the centroid.
    Moments central() const;
};

// A picture as its bright pixels: NaN, infinities and negative values are 0.
class BrightPixels {
  public:
    // threshold > 0.
    BrightPixels(const ConstImageView& picture, const PixelGeometry& geometry, float threshold)
        : picture_(picture), geometry_(geometry), threshold_(threshold) {}

    const ConstImageView& picture() const { return picture_; }
    const PixelGeometry& geometry() const { return geometry_; }
    float threshold() const { return threshold_; }
    // Adds `share` of pixel (x, y). False, and nothing added, if it is behind the camera.
    bool add(int x, int y, double share, LightSums& sums) const;

  private:
    ConstImageView picture_;
    PixelGeometry geometry_;
    float threshold_;
};

// Luminance of a row (Rec. 709), width floats.
void luminance_row(const ConstImageView& picture, int y, float* out);

// Bright pixels [begin, end) of row y.
struct Run {
    int y = 0;
    int begin = 0;
    int end = 0;
    int region = 0;
};

struct Regions {
    std::vector<Run> runs;        // in the order of rows
    std::vector<LightSums> sums;  // of each region, in the order of their first pixels
};

// Connected by any of 8 neighbours. The same for any number of threads.
Regions find_regions(const BrightPixels& pixels);

}  // namespace aureole::sources
