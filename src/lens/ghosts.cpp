#include "aureole/lens/ghosts.h"

#include <fmt/format.h>

#include "aureole/base/error.h"
#include "aureole/lens/glass.h"
#include "lens/steps.h"

namespace aureole::lens {

std::vector<Bounces> enumerate_ghosts(const Lens& lens, GhostSet set) {
    const std::vector<double> index = lens.indices(kLineDNm);
    const int faces = static_cast<int>(lens.faces().size());
    const auto reflects = [&](int face) {
        const auto k = static_cast<std::size_t>(face);
        return face != lens.stop() && index[k] != index[k + 1];
    };
    std::vector<Bounces> ghosts;
    for (int near = 0; near < faces; ++near) {
        if (!reflects(near)) continue;
        for (int far = near + 1; far < faces; ++far) {
            if (!reflects(far)) continue;
            const bool same_side = (near < lens.stop()) == (far < lens.stop());
            if (set == GhostSet::kAll || same_side) ghosts.push_back({far, near});
        }
    }
    return ghosts;
}

std::vector<Step> steps_of(const Lens& lens, const Bounces& bounces) {
    const int faces = static_cast<int>(lens.faces().size());
    validate_bounces(faces, bounces);
    std::vector<Step> steps;
    visit_steps(faces, bounces, [&](const Step& step) {
        steps.push_back(step);
        return true;
    });
    return steps;
}

void validate_bounces(int faces, const Bounces& bounces) {
    if (bounces.direct()) return;
    if (bounces.near >= 0 && bounces.near < bounces.far && bounces.far < faces) return;
    throw InvalidArgument(
        "ghost", fmt::format("({}, {})", bounces.far + 1, bounces.near + 1),
        fmt::format("must be two surfaces from 1 to {}, the farther from the scene first", faces));
}

}  // namespace aureole::lens
