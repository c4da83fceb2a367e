// Who looks at a picture: an eye, a camera, or a kernel that somebody else made.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "aureole/image/image.h"
#include "aureole/image/view.h"
#include "aureole/io/picture.h"
#include "aureole/wave/psf.h"
#include "aureole/wave/varying_psf.h"

namespace aureole::app {

// An observer may keep a PSF and write the next one over it.
using SharedPsf = std::shared_ptr<const wave::Psf>;
inline SharedPsf shared(wave::Psf psf) { return std::make_shared<const wave::Psf>(std::move(psf)); }

// How light spreads, in the order in which it meets what spreads it. Either may be missing.
struct Spreading {
    SharedPsf streaks;  // of what lies before the eye or the film, in a pass of its own
                        // (Passes::kBoth, kStreaks)
    SharedPsf rest;     // all the rest: everything (kOne), or bloom
};

// Made for one run; then asked for each picture in the order of these functions.
class Observer {
  public:
    virtual ~Observer() = default;

    // When the next picture is seen, for observers that move.
    virtual void set_time(double /*time_s*/) {}
    // How the display window of a picture sees the world.
    virtual View view_of(const io::Picture& picture) = 0;
    // Gets used to the picture; false if the PSF made before does not serve for it.
    virtual bool adapt(const io::Picture& /*picture*/) { return true; }
    // How light spreads in pictures whose display window is seen as `display` and data window as
    // `data`; valid until the next call. Asked again only when the views change or adapt() says so.
    virtual Spreading spreading(const View& display, const View& data) = 0;
    // The same where it depends on the position in the picture, in place of spreading(); nothing if
    // it does not.
    virtual std::optional<wave::VaryingPsf> varying_psf(const View& /*display*/,
                                                        const View& /*data*/) {
        return std::nullopt;
    }
    // How much of the picture's light gets in, 0 to 1: the picture that spreads dims by it.
    virtual double light_share() const { return 1; }
    // What the scattered light is to be multiplied by, of looks whose glare is brighter than light:
    // asked after spreading().
    virtual double gain() const { return 1; }
    // Gets ready for ghosts() in pictures whose data window is seen as `data`.
    virtual void plan(const View& /*data*/) {}
    // The light that does not spread but comes by other ways, to be added to the picture: 3
    // channels over the data window, valid until the next call. nullptr: none. `matte`: a factor
    // for each pixel of the picture, or nullptr.
    virtual const Image* ghosts(const io::Picture& /*picture*/, const View& /*display*/,
                                const View& /*data*/, const float* /*matte*/) {
        return nullptr;
    }
    // Every value in force goes to "parameters"; what else is to be told, beside it.
    virtual void report(nlohmann::ordered_json& json) const = 0;
};

}  // namespace aureole::app
