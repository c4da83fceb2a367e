#include "eye_book.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "aureole/base/error.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

eye::Flipbook checked_book(const std::string& path, const io::MappedFile& file) {
    try {
        return eye::Flipbook(file.bytes());
    } catch (const InvalidArgument& error) {
        throw FileError(path, error.what());
    }
}

// The option that gives a parameter of an eye.
struct OptionOf {
    const char* parameter;
    const char* option;
    const char* before_value = "";
    const char* note = "";  // after the value
};
OptionOf option_of(const std::string& parameter) {
    static constexpr std::array<OptionOf, 10> kOptions = {{
        {"age_years", "--age"},
        {"pigmentation", "--pigmentation"},
        {"scatter", "--scatter"},
        {"corona_contrast", "--corona-contrast", "", " (by --preset or the option itself)"},
        {"eyelashes", "--eyelashes"},
        {"seed", "--seed"},
        {"pupil.shape", "--pupil-shape"},
        {"pupil.axis_ratio", "--pupil-shape", "ellipse:"},
        {"pupil.rotation_deg", "--pupil-rotation"},
        {"source_spectrum", "--source-spectrum"},
    }};
    const auto* const found = std::find_if(kOptions.begin(), kOptions.end(), [&](const auto& one) {
        return parameter == one.parameter;
    });
    return found == kOptions.end() ? OptionOf{parameter.c_str(), parameter.c_str()} : *found;
}

// Numbers to six digits, if these tell the two values apart.
std::array<std::string, 2> in_few_digits(const std::string& one, const std::string& other) {
    const auto short_form = [](const std::string& value) {
        const auto number = given_number(value);
        return number ? fmt::format("{:.6g}", *number) : value;
    };
    std::array<std::string, 2> both = {short_form(one), short_form(other)};
    if (both[0] == both[1]) both = {one, other};
    return both;
}

bool same(const wave::KernelGrid& a, const wave::KernelGrid& b) {
    return a.width == b.width && a.height == b.height && a.pitch_deg == b.pitch_deg &&
           a.projection == b.projection;
}

}  // namespace

EyeBook::EyeBook(const std::string& path)
    : path_(path), file_(path), book_(checked_book(path, file_)) {}

void EyeBook::open_for(const eye::Eye& eye, const eye::SpectralSampling& sampling,
                       const wave::KernelGrid& grid) {
    if (player_ && same(player_->grid(), grid)) return;
    const auto refuse = [this](const std::string& what, const std::string& here,
                               const std::string& baked) {
        throw InvalidArgument(fmt::format("--book {}: was baked with {} {}, and here it is {}",
                                          path_, what, baked, here));
    };
    if (const auto difference = book_.difference(eye, sampling)) {
        const OptionOf option = option_of(difference->name);
        const auto [here, baked] = in_few_digits(difference->here, difference->in_book);
        refuse(option.option, option.before_value + here + option.note,
               option.before_value + baked);
    }
    const wave::KernelGrid& raster = book_.grid();
    const auto name = [](Projection projection) {
        return projection == Projection::kPerspective ? "on" : "off";
    };
    if (raster.projection != grid.projection) {
        refuse("--perspective", name(grid.projection), name(raster.projection));
    }
    if (!eye::same_pitch(raster, grid)) {
        refuse("pixels (--fov, --width) of", fmt::format("{:.6g} deg", grid.pitch_deg),
               fmt::format("{:.6g} deg", raster.pitch_deg));
    }
    player_.emplace(book_, eye, sampling, grid);
    psf_ = std::make_shared<wave::Psf>();
    psf_->kernel = Image(grid.width, grid.height, 3);
}

SharedPsf EyeBook::psf(const eye::Eye& now, const eye::SpectralSampling& sampling,
                       const wave::KernelGrid& grid, Session& session) {
    open_for(now, sampling, grid);
    const eye::FlipbookRange& range = book_.range();
    if (now.pupil_diameter_mm < range.pupil_from_mm || now.pupil_diameter_mm > range.pupil_to_mm) {
        session.note(fmt::format("{}: pupils beyond its {} to {} mm are shown by its nearest frame",
                                 path_, range.pupil_from_mm, range.pupil_to_mm));
    }
    player_->write(now, *psf_);
    return psf_;
}

}  // namespace aureole::app
