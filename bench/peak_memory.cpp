// Peak resident memory of one job in a process of its own: peak_memory convolution|eye-psf|ibl
// prints megabytes (1e6 bytes).
#include <fmt/core.h>
#include <sys/resource.h>

#include <memory>
#include <string_view>

#include "aureole/eye/eye_psf.h"
#include "aureole/glare/glare.h"
#include "aureole/ibl/brdf_table.h"
#include "aureole/ibl/irradiance.h"
#include "aureole/ibl/lat_long.h"
#include "aureole/ibl/prefilter.h"
#include "aureole/ibl/roughness.h"
#include "aureole/ibl/spherical_harmonics.h"
#include "aureole/image/view.h"

namespace {

using namespace aureole;

// A 1080p RGB picture with a kernel that reaches across all of it, energy accounting included.
void convolution(const View& view) {
    std::unique_ptr<glare::Glare> glare;
    {
        wave::Psf psf;
        psf.grid = wave::KernelGrid::full_reach(view);
        psf.kernel = Image(psf.grid.width, psf.grid.height, 3);
        glare = std::make_unique<glare::Glare>(view, 3, psf);
    }
    Image in(view.width, view.height, 3);
    Image out(view.width, view.height, 3);
    glare->apply(in, out);
}

void eye_psf(const View& view) {
    eye::Eye eye;
    eye.pupil_diameter_mm = 6;
    (void)eye::eye_psf(eye, wave::KernelGrid::square(view, 1025));
}

// All that `aureole ibl` makes of a lat-long picture of 2048x1024 pixels, which is held whole.
void environment_maps() {
    const Image lat_long(2048, 1024, 3);
    const ibl::CubeMap environment = ibl::cube_from_lat_long(lat_long, 256);
    ibl::PrefilterOptions options;
    options.roughness = ibl::level_roughness(ibl::RoughnessMapping::kFilament, 5, 256);
    ibl::Prefilter prefilter(256, options);
    ibl::CubeChain chain = prefilter.make_chain();
    prefilter.run(environment, chain);
    (void)ibl::irradiance_map(environment);
    (void)ibl::project_to_sh(environment, 3);
    const ibl::BrdfTable table(ibl::BrdfTableKind::kGgx);
}

}  // namespace

int main(int argc, char** argv) {
    const std::string_view job = argc == 2 ? argv[1] : "";
    const View view = View::from_fov(1920, 1080, 60, Projection::kPerspective);
    if (job == "convolution") {
        convolution(view);
    } else if (job == "eye-psf") {
        eye_psf(view);
    } else if (job == "ibl") {
        environment_maps();
    } else {
        fmt::print(stderr, "usage: peak_memory convolution|eye-psf|ibl\n");
        return 2;
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    fmt::print("{:.0f}\n", static_cast<double>(usage.ru_maxrss) * 1024 / 1e6);
    return 0;
}
