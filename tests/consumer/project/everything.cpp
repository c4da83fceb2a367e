#include <aureole/fourier/convolver.h>
#include <aureole/glare/energy.h>
#include <aureole/image/image.h>
#include <aureole/io/sequence.h>
#include <aureole/scene/scene.h>

#include <cmath>
#include <cstdio>

// A point of light under a cross-shaped kernel, through the library as it was installed.
int main() {
    aureole::scene::SceneOptions options;
    options.width = 64;
    options.height = 36;
    const aureole::Image point = aureole::scene::make_scene("point", options).rgb;
    aureole::Image kernel(5, 5, 1);
    for (int i = 0; i < 5; ++i) kernel.at(i, 2) = kernel.at(2, i) = 1.0F / 9;
    aureole::Image out(64, 36, 3);
    aureole::fourier::Convolver(64, 36, 3, kernel).run(point, out);
    const double share = aureole::glare::share_inside(64, 36, kernel).at(32, 18);
    const double ratio = out.at(34, 18, 1) / point.at(32, 18, 1);
    std::printf("%s: %g of the light, %g inside\n",
                aureole::io::frame_path("point.%04d.exr", 7).c_str(), ratio, share);
    return std::abs(ratio - 1.0 / 9) < 1e-6 && std::abs(share - 1) < 1e-6 ? 0 : 1;
}
