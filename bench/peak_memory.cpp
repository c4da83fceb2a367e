// Peak resident memory of one job in a process of its own: peak_memory convolution|eye-psf
// prints megabytes (1e6 bytes).
#include <fmt/core.h>
#include <sys/resource.h>

#include <memory>
#include <string_view>

#include "aureole/eye/eye_psf.h"
#include "aureole/glare/glare.h"
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

}  // namespace

int main(int argc, char** argv) {
    const std::string_view job = argc == 2 ? argv[1] : "";
    const View view = View::from_fov(1920, 1080, 60, Projection::kPerspective);
    if (job == "convolution") {
        convolution(view);
    } else if (job == "eye-psf") {
        eye_psf(view);
    } else {
        fmt::print(stderr, "usage: peak_memory convolution|eye-psf\n");
        return 2;
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    fmt::print("{:.0f}\n", static_cast<double>(usage.ru_maxrss) * 1024 / 1e6);
    return 0;
}
