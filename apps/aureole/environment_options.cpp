#include "environment_options.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "aureole/base/error.h"
#include "aureole/ibl/lat_long.h"
#include "aureole/ibl/layout.h"
#include "aureole/ibl/resize.h"
#include "aureole/io/picture_rows.h"
#include "aureole/io/texture.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

constexpr int kLargestSize = 8192;
constexpr int kRowsAtOnce = 64;

// Yaw, pitch and roll in degrees; those that are missing are 0.
std::optional<std::array<double, 3>> rotation_of(const std::string& text) {
    if (text.empty()) return std::array{0.0, 0.0, 0.0};
    const auto numbers = given_numbers(text, ',');
    if (!numbers || numbers->size() > 3) return std::nullopt;
    std::array<double, 3> angles = {};
    std::copy(numbers->begin(), numbers->end(), angles.begin());
    return angles;
}

// What the library says of a picture, with the name of its file.
template <class Make>
auto made_from(const std::string& file, const Make& make) {
    try {
        return make();
    } catch (const InvalidArgument& error) {
        throw FileError(file, error.what());
    }
}

Image whole_picture(io::PictureRows& rows) {
    Image image(rows.width(), rows.height(), 3);
    rows.read(0, rows.height(), image);
    return image;
}

}  // namespace

void EnvironmentOptions::add_options(CLI::App& command) {
    command
        .add_option("INPUT", inputs_,
                    "Environment: a lat-long picture, a cross or a strip of cube faces, a cube map "
                    "(DDS, KTX, KTX2), or six pictures in the order +X -X +Y -Y +Z -Z")
        ->required()
        ->type_name("FILE");
    CLI::Option_group& group = *command.add_option_group("The environment");
    whole_number(group.add_option("--size", size_, "Texels along the side of a cube face"), 1,
                 kLargestSize)
        ->type_name("TEXELS")
        ->capture_default_str();
    std::vector<std::string> layouts = {"auto"};
    layouts.insert(layouts.end(), ibl::kLayoutNames.begin(), ibl::kLayoutNames.end() - 1);
    one_of(group.add_option("--layout", layout_, "Of the picture; auto: by its shape"), layouts)
        ->capture_default_str();
    one_of(group.add_option("--mirror", mirror_, "The axis whose sign changes; before --rotate"),
           {ibl::kMirrorNames.begin(), ibl::kMirrorNames.end()})
        ->capture_default_str();
    group
        .add_option("--rotate", rotation_text_,
                    "Turns about +Y, +X and +Z: yaw 90 takes what is at +Z to +X")
        ->type_name("YAW[,PITCH[,ROLL]]");
    number(group.add_option("--exposure", exposure_ev_, "Stops by which it becomes brighter"), -64,
           64)
        ->type_name("EV")
        ->capture_default_str();
    positive_number(group.add_option("--clamp", max_luminance_,
                                     "Largest luminance (pixel values, after --exposure); what it "
                                     "takes is reported (default: off)"))
        ->type_name("LUMINANCE");
}

void EnvironmentOptions::check() const {
    if (inputs_.size() != 1 && inputs_.size() != ibl::kFaces) {
        throw InvalidArgument("INPUT", fmt::format("{} files", inputs_.size()),
                              "must be one file, or 6: +X -X +Y -Y +Z -Z");
    }
    if (inputs_.size() > 1 && layout_ != "auto") {
        throw InvalidArgument("--layout", layout_, "applies to one picture, not to six faces");
    }
    if (!rotation_of(rotation_text_)) {
        throw InvalidArgument("--rotate", rotation_text_,
                              "must be one to three numbers: YAW,PITCH,ROLL in degrees");
    }
}

ibl::EnvironmentTransform EnvironmentOptions::transform() const {
    ibl::EnvironmentTransform transform;
    for (std::size_t i = 0; i < ibl::kMirrorNames.size(); ++i) {
        if (ibl::kMirrorNames[i] == mirror_) transform.mirror = static_cast<ibl::Mirror>(i);
    }
    const auto angles = *rotation_of(rotation_text_);
    transform.yaw_deg = angles[0];
    transform.pitch_deg = angles[1];
    transform.roll_deg = angles[2];
    transform.exposure_ev = exposure_ev_;
    transform.max_luminance = max_luminance_;
    return transform;
}

ibl::CubeMap EnvironmentOptions::read(Session& session) {
    ibl::EnvironmentReport report;
    ibl::CubeMap environment = session.timed("read", [&] {
        return inputs_.size() == 1 ? read_one(inputs_.front(), session, report)
                                   : read_six(session, report);
    });
    if (report.nonfinite_texels > 0) {
        session.note(fmt::format("{}: {} texels with NaN or infinity were taken as 0",
                                 inputs_.front(), report.nonfinite_texels));
    }
    if (report.clamped_texels > 0) {
        session.note(fmt::format("--clamp took {:.3g} % of the energy, from {} texels",
                                 100 * report.clamped_share, report.clamped_texels));
    }
    auto& json = session.json();
    json["nonfinite_texels"] = report.nonfinite_texels;
    json["clamped_texels"] = report.clamped_texels;
    json["clamped_share"] = report.clamped_share;
    return environment;
}

ibl::CubeMap EnvironmentOptions::read_one(const std::string& file, Session& session,
                                          ibl::EnvironmentReport& report) {
    if (io::is_texture_file(file)) {
        const io::Texture texture = io::read_texture(file);
        if (texture.faces == ibl::kFaces) {
            layout_used_ = "cube";
            return made_from(file, [&] {
                return ibl::transformed(
                    ibl::cube_from_layout(texture.levels.front(), ibl::Layout::kVerticalStrip),
                    size_, transform(), &report);
            });
        }
        return from_picture(file, texture.levels.front(), report);
    }
    io::PictureRows rows(file);
    const ibl::Layout layout = layout_of(file, rows.width(), rows.height());
    if (layout == ibl::Layout::kLatLong) return read_lat_long(file, rows, session, report);
    return from_picture(file, whole_picture(rows), report);
}

ibl::Layout EnvironmentOptions::layout_of(const std::string& file, int width, int height) {
    const ibl::Layout layout = made_from(file, [&] {
        if (layout_ == "auto") return ibl::layout_from_size(width, height);
        const auto* const name =
            std::find(ibl::kLayoutNames.begin(), ibl::kLayoutNames.end(), layout_);
        const auto asked = static_cast<ibl::Layout>(name - ibl::kLayoutNames.begin());
        ibl::check_layout(asked, width, height);
        return asked;
    });
    layout_used_ = ibl::kLayoutNames[static_cast<std::size_t>(layout)];
    return layout;
}

ibl::CubeMap EnvironmentOptions::from_picture(const std::string& file, const Image& picture,
                                              ibl::EnvironmentReport& report) {
    const ibl::Layout layout = layout_of(file, picture.width(), picture.height());
    return made_from(file, [&] {
        if (layout == ibl::Layout::kLatLong) {
            return ibl::cube_from_lat_long(picture, size_, transform(), &report);
        }
        return ibl::transformed(ibl::cube_from_layout(picture, layout), size_, transform(),
                                &report);
    });
}

// A few rows at a time: pictures of 16384 x 8192 pixels need no more memory than small ones.
ibl::CubeMap EnvironmentOptions::read_lat_long(const std::string& file, io::PictureRows& rows,
                                               Session& session, ibl::EnvironmentReport& report) {
    return made_from(file, [&] {
        ibl::LatLongToCube resampler(rows.width(), rows.height(), size_, transform());
        Image band(rows.width(), std::min(kRowsAtOnce, rows.height()), 3);
        for (int y = 0; y < rows.height(); y += kRowsAtOnce) {
            ImageView part = band.view();
            part.height = std::min(kRowsAtOnce, rows.height() - y);
            rows.read(y, part.height, part);
            resampler.add_rows(y, part);
            session.report("read", static_cast<double>(y + part.height) / rows.height());
            session.check_interrupt();
        }
        ibl::CubeMap cube = resampler.finish();
        report = resampler.report();
        return cube;
    });
}

ibl::CubeMap EnvironmentOptions::read_six(Session& session, ibl::EnvironmentReport& report) {
    layout_used_ = "faces";
    ibl::CubeMap cube;
    for (std::size_t face = 0; face < inputs_.size(); ++face) {
        const std::string& file = inputs_[face];
        io::PictureRows rows(file);
        if (rows.width() != rows.height()) {
            throw FileError(file, fmt::format("has {}x{} pixels: faces of a cube are square",
                                              rows.width(), rows.height()));
        }
        if (face == 0) cube = made_from(file, [&] { return ibl::CubeMap(rows.width()); });
        if (rows.width() != cube.size()) {
            throw FileError(file, fmt::format("has {0}x{0} pixels, and {1} has {2}x{2}: the faces "
                                              "of a cube are of one size",
                                              rows.width(), inputs_.front(), cube.size()));
        }
        rows.read(0, rows.height(), cube.face(static_cast<int>(face)));
        session.check_interrupt();
    }
    return ibl::transformed(cube, size_, transform(), &report);
}

nlohmann::ordered_json EnvironmentOptions::parameters() const {
    const ibl::EnvironmentTransform t = transform();
    nlohmann::ordered_json json = {{"inputs", inputs_},
                                   {"size", size_},
                                   {"layout", layout_used_},
                                   {"mirror", mirror_},
                                   {"rotate_deg", {t.yaw_deg, t.pitch_deg, t.roll_deg}},
                                   {"exposure_ev", exposure_ev_}};
    if (max_luminance_) json["clamp"] = *max_luminance_;
    return json;
}

}  // namespace aureole::app
