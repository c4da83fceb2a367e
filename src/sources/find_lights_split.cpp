#include "sources/find_lights_split.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "aureole/base/parallel.h"

namespace aureole::sources {
namespace {

// A pixel's own square has a trace of 1/6 px^2: a radius of one pixel is six times that.
constexpr double kSmallestOverExtent = 6;

struct Piece {
    int x = 0;
    int y = 0;
    double share = 1;
};

struct Part {
    std::vector<Piece> pieces;
    LightSums sums;
};

bool too_wide(const LightSums& sums, double widest) {
    if (!(sums.luminous > 0)) return false;
    const double trace = sums.central().trace();
    return trace > widest * widest && trace > kSmallestOverExtent * sums.extent / sums.luminous;
}

// Shared among pieces: both halves of `whole`.
std::pair<Part, Part> cut(const BrightPixels& pixels, const Part& whole) {
    const Moments m = whole.sums.central();
    // Longer principal axis: eigenvector of the larger eigenvalue.
    const double angle = 0.5 * std::atan2(2 * m.xy, m.xx - m.yy);
    const double axis_x = std::cos(angle) / pixels.geometry().pixel_tangent();
    const double axis_y = std::sin(angle) / pixels.geometry().pixel_tangent();
    const double centre = (whole.sums.x * axis_x + whole.sums.y * axis_y) / whole.sums.luminous;
    std::pair<Part, Part> halves;
    const auto give = [&](Part& part, const Piece& piece, double share) {
        if (!(share > 0)) return;
        part.pieces.push_back({piece.x, piece.y, share});
        pixels.add(piece.x, piece.y, share, part.sums);
    };
    for (const Piece& piece : whole.pieces) {
        PixelRay ray;
        if (!pixels.geometry().ray(piece.x + 0.5, piece.y + 0.5, ray)) continue;
        const double distance_px = ray.tan_x * axis_x + ray.tan_y * axis_y - centre;
        const double share = piece.share * std::clamp(distance_px + 0.5, 0.0, 1.0);
        give(halves.first, piece, share);
        give(halves.second, piece, piece.share - share);
    }
    return halves;
}

}  // namespace

std::vector<LightSums> split_regions(const BrightPixels& pixels, const Regions& regions,
                                     double widest) {
    std::vector<LightSums> done;
    std::vector<Part> wide;
    std::vector<int> part_of(regions.sums.size(), -1);
    for (std::size_t r = 0; r < regions.sums.size(); ++r) {
        if (too_wide(regions.sums[r], widest)) {
            part_of[r] = static_cast<int>(wide.size());
            wide.push_back({{}, regions.sums[r]});
        } else if (regions.sums[r].luminous > 0) {
            done.push_back(regions.sums[r]);
        }
    }
    for (const Run& run : regions.runs) {
        const int part = part_of[static_cast<std::size_t>(run.region)];
        if (part < 0) continue;
        for (int x = run.begin; x < run.end; ++x) {
            wide[static_cast<std::size_t>(part)].pieces.push_back({x, run.y, 1});
        }
    }
    // Generation after generation: all parts of one are cut side by side.
    while (!wide.empty()) {
        std::vector<std::pair<Part, Part>> halves(wide.size());
        parallel_for(wide.size(), [&](std::size_t i, int) {
            halves[i] = cut(pixels, wide[i]);
            wide[i] = {};
        });
        wide.clear();
        for (auto& [first, second] : halves) {
            for (Part* part : {&first, &second}) {
                if (too_wide(part->sums, widest)) {
                    wide.push_back(std::move(*part));
                } else if (part->sums.luminous > 0) {
                    done.push_back(part->sums);
                }
            }
        }
    }
    return done;
}

}  // namespace aureole::sources
