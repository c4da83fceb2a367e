#include "aureole/lens/field_starburst.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/base/random.h"
#include "aureole/wave/field_nodes.h"
#include "lens/starburst_behind.h"

namespace aureole::lens {
namespace {

void check(const FieldStarburstOptions& options) {
    const auto require = [](const char* what, double value, double low, double high) {
        if (value >= low && value <= high) return;
        throw InvalidArgument(what, fmt::format("{}", value),
                              fmt::format("must be {} to {} deg", low, high));
    };
    require("spacing of the nodes", options.spacing_deg, 0.5, 30);
    require("reach of varying stars", options.reach_deg, 0.2, 45);
    if (options.rank < 0) {
        throw InvalidArgument("rank of stars", fmt::format("{}", options.rank),
                              "must be at least 1, or 0 for the kernels themselves");
    }
}

// Tangents, to the right and up, of the direction of a pixel position.
std::array<double, 2> direction(const View& view, double x, double y) {
    const double u = (x - view.axis_x) / view.focal_length_px();
    const double v = (view.axis_y - y) / view.focal_length_px();
    const double angle = std::hypot(u, v);
    const double stretch =
        view.projection == Projection::kPerspective || angle == 0 ? 1 : std::tan(angle) / angle;
    return {stretch * u, stretch * v};
}

// Stars within the reach, as lights at pixel positions make them.
class NearStars {
  public:
    NearStars(const Lens& lens, const Iris& iris, double pupil_diameter_mm, const View& view,
              const FieldStarburstOptions& options)
        : lens_(lens),
          iris_(iris),
          pupil_diameter_mm_(pupil_diameter_mm),
          view_(view),
          options_(options),
          grid_(wave::grid_within(view, options.reach_deg)),
          window_(wave::radial_window(grid_, options.reach_deg)) {}

    const Image& window() const { return window_; }

    Image at(double x, double y) const {
        const auto [tan_x, tan_y] = direction(view_, x, y);
        const std::optional<wave::Shape> outline = pupil_outline(lens_, iris_, tan_x, tan_y);
        const wave::Psf star = starburst_behind(iris_, pupil_diameter_mm_, grid_, options_.psf,
                                                {nullptr, outline ? &*outline : nullptr});
        return wave::windowed(star.kernel, window_);
    }

  private:
    const Lens& lens_;
    const Iris& iris_;
    double pupil_diameter_mm_;
    const View& view_;
    const FieldStarburstOptions& options_;
    wave::KernelGrid grid_;
    Image window_;
};

}  // namespace

wave::VaryingPsf field_starburst(const Lens& lens, const Iris& iris, double pupil_diameter_mm,
                                 const View& view, const FieldStarburstOptions& options,
                                 Progress* progress) {
    check(options);
    const NearStars stars(lens, iris, pupil_diameter_mm, view, options);
    wave::VaryingPsf result;
    result.view = view;
    result.base =
        starburst_psf(iris, pupil_diameter_mm, wave::KernelGrid::full_reach(view), options.psf);
    // Beyond the reach, the star of the axis.
    wave::take_out(result.base, wave::windowed(result.base.kernel, stars.window()));

    const wave::NodePlaces nodes = wave::node_places(view, options.spacing_deg);
    fourier::KernelNodes part{nodes.columns, nodes.rows, {}, {}};
    for (const auto& place : nodes.places) {
        part.halves.push_back(fourier::right_half(stars.at(place.x, place.y)));
        if (progress == nullptr) continue;
        progress->report("stars over the field", static_cast<double>(part.halves.size()) /
                                                     static_cast<double>(nodes.places.size()));
        if (progress->cancelled()) throw Cancelled();
    }
    result.parts.push_back(options.rank == 0 ? std::move(part)
                                             : principal_components(part, options.rank));
    return result;
}

wave::FieldError field_starburst_error(const Lens& lens, const Iris& iris, double pupil_diameter_mm,
                                       const wave::VaryingPsf& psf,
                                       const FieldStarburstOptions& options, int positions) {
    check(options);
    if (positions < 1 || positions > 10000) {
        throw InvalidArgument("positions", fmt::format("{}", positions), "must be 1 to 10000");
    }
    const View& view = psf.view;
    const NearStars stars(lens, iris, pupil_diameter_mm, view, options);
    Random random(1, 0);
    wave::FieldErrorSum error;
    for (int i = 0; i < positions; ++i) {
        const int x = static_cast<int>(random.uniform() * view.width);
        const int y = static_cast<int>(random.uniform() * view.height);
        error.add(fourier::right_half(fourier::kernel_at(psf.parts, view.width, view.height, x, y)),
                  stars.at(x + 0.5, y + 0.5), false);
    }
    return error.error();
}

}  // namespace aureole::lens
