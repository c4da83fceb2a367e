#include "glare_job.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/color/rgb.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/image/finite.h"
#include "kernel_file.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

bool same_view(const View& a, const View& b) {
    return a.width == b.width && a.height == b.height && a.projection == b.projection &&
           a.pitch_deg == b.pitch_deg && a.axis_x == b.axis_x && a.axis_y == b.axis_y;
}

// after - before: what glare added and took away. Sums with the picture to the composite.
Image difference(const ConstImageView& after, const ConstImageView& before) {
    Image result(after.width, after.height, after.channels);
    for (int c = 0; c < after.channels; ++c) {
        for (int y = 0; y < after.height; ++y) {
            float* out = result.row(y, c);
            for (int x = 0; x < after.width; ++x) {
                out[x] = after.at(x, y, c) - before.at(x, y, c);
            }
        }
    }
    return result;
}

// The picture with other colour: same windows, metadata and further channels.
io::Picture with_color(const io::Picture& picture, const ConstImageView& color) {
    io::Picture result = picture;
    const ImageView to = result.color();
    for (int c = 0; c < to.channels; ++c) {
        for (int y = 0; y < to.height; ++y) {
            for (int x = 0; x < to.width; ++x) to.at(x, y, c) = color.at(x, y, c);
        }
    }
    return result;
}

// The mean luminance of what is meant to be seen, in units of the picture.
double mean_luminance(const io::Picture& picture) {
    const Image seen = over_display_window(picture.color(), picture);
    double sum = 0;
    for (int y = 0; y < seen.height(); ++y) {
        for (int x = 0; x < seen.width(); ++x) {
            const double value =
                seen.channels() == 3
                    ? color::luminance({seen.at(x, y, 0), seen.at(x, y, 1), seen.at(x, y, 2)})
                    : seen.at(x, y, 0);
            sum += std::max(value, 0.0);
        }
    }
    return sum / static_cast<double>(seen.pixels());
}

}  // namespace

void GlareSettings::add_options(CLI::App& command) {
    view.add_options(command);
    view.add_white_luminance_option(command);
    eye.add_options(command);
    CLI::Option_group& group = *command.add_option_group("Applying it");
    group
        .add_option("--psf", psf_file,
                    "Use this kernel (EXR of `aureole psf`, or any odd-sized picture) instead of "
                    "an eye's")
        ->type_name("FILE");
    one_of(group.add_option("--method", method,
                            "fft; direct: the plain double sum, exact and slow; auto: fft"),
           {"auto", "fft", "direct"})
        ->capture_default_str();
    one_of(group.add_option("--output-layers", layers,
                            "composite: the picture with glare; glare: what glare added and took "
                            "away (sums with the input to the composite); both: EXR layers"),
           {"composite", "glare", "both"})
        ->capture_default_str();
    group
        .add_option("--matte", matte_file,
                    "Picture of the same size: only where it is 1 (its first channel) do pixels "
                    "make glare")
        ->type_name("FILE");
    number(group.add_option("--threshold", threshold,
                            "Pixel values below make no glare (continuous ramp); 0 is physical"),
           0, 1e30)
        ->type_name("V")
        ->capture_default_str();
    number(group.add_option("--gain", gain, "Scales the scattered light; 1 conserves energy"), 0,
           1e6)
        ->type_name("G")
        ->capture_default_str();
    one_of(group.add_option("--surround", surround,
                            "What lies beyond the border. dark: nothing, borders lose light; same: "
                            "for each pixel surroundings as bright as itself"),
           {"dark", "same"})
        ->capture_default_str();
    group
        .add_option("--side-by-side", side_by_side_file,
                    "Also write a PNG or JPEG: the picture without glare, and with it; a numbered "
                    "name for a sequence")
        ->type_name("FILE");
    display.add_options(command);
}

void GlareSettings::prepare(const std::vector<FrameFiles>& files) {
    std::vector<std::string> outputs;
    for (const FrameFiles& frame : files) {
        outputs.insert(outputs.end(), frame.outputs.begin(), frame.outputs.end());
    }
    if (layers == "both" && !std::all_of(outputs.begin(), outputs.end(), is_exr_file)) {
        throw InvalidArgument("--output-layers", layers, "needs EXR output: others have no layers");
    }
    output.check_depth(outputs);
    if (!side_by_side_file.empty()) outputs.push_back(side_by_side_file);
    display.prepare(outputs);
    view.check();
    eye.check();
    if (const std::string option = eye.first_given(); !psf_file.empty() && !option.empty()) {
        throw InvalidArgument("--psf", psf_file, "replaces the eye: leave out " + option);
    }
}

double GlareJob::adaptation_for(const io::Picture& picture) {
    if (!settings_.psf_file.empty() || !settings_.eye.needs_adaptation()) return 0;
    if (metering_ == Metering::kFirst && first_metered_cd_m2_) return *first_metered_cd_m2_;
    const double stored{picture.float_attribute("aureole:adaptation_cd_m2").value_or(-1.0F)};
    const double metered = std::isfinite(stored) && stored >= 0
                               ? stored
                               : mean_luminance(picture) * settings_.view.white_luminance(picture);
    first_metered_cd_m2_ = metered;
    return metered;
}

void GlareJob::prepare(const io::Picture& picture) {
    const View display = settings_.view.view_of(picture, session_);
    const View view = data_view(display, picture);
    const int channels = picture.color_channels();
    const double metered = adaptation_for(picture);
    if (prepared_ && same_view(prepared_->view, view) && same_view(prepared_->display, display) &&
        prepared_->channels == channels && prepared_->metered_cd_m2 == metered) {
        return;
    }
    prepared_.reset();
    const bool own_kernel = !settings_.psf_file.empty();
    const eye::Eye eye = own_kernel ? eye::Eye{} : settings_.eye.eye(metered, display);
    wave::Psf psf = session_.timed("psf", [&] {
        return own_kernel ? read_kernel(settings_.psf_file, view)
                          : eye::eye_psf(eye, wave::KernelGrid::full_reach(view), {}, &session_);
    });
    glare::GlareOptions options;
    options.method = settings_.method == "auto" ? glare::Method::kFft
                                                : glare::method_from_name(settings_.method);
    options.threshold = settings_.threshold;
    options.gain = settings_.gain;
    options.matte = !settings_.matte_file.empty();
    options.surround = glare::surround_from_name(settings_.surround);
    session_.timed("plan", [&] {
        prepared_.emplace(Prepared{display, view, channels, metered, eye,
                                   glare::Glare(view, channels, psf, options)});
    });
    result_ = Image(view.width, view.height, channels);
}

const float* GlareJob::matte_for(const io::Picture& picture) {
    if (settings_.matte_file.empty()) return nullptr;
    if (matte_.empty()) {
        const io::Picture file = io::read_picture(settings_.matte_file);
        matte_ = copy(file.image().view().channel_range(0, 1));
        replace_nonfinite(matte_);
    }
    if (matte_.width() != picture.image().width() || matte_.height() != picture.image().height()) {
        throw FileError(settings_.matte_file,
                        fmt::format("is {}x{} pixels; a matte must have the size of the picture, "
                                    "{}x{}",
                                    matte_.width(), matte_.height(), picture.image().width(),
                                    picture.image().height()));
    }
    return matte_.plane(0);
}

void GlareJob::process(const FrameFiles& files) {
    io::Picture picture = session_.timed("read", [&] { return io::read_picture(files.input); });
    const std::size_t nonfinite = replace_nonfinite(picture.color());
    if (nonfinite > 0) {
        session_.note(fmt::format("{}: {} pixels with NaN or infinity replaced by 0", files.input,
                                  nonfinite));
    }
    nonfinite_pixels_ += nonfinite;
    const float* matte = matte_for(picture);
    exposure_ev_ = settings_.display.exposure_ev(picture);
    white_luminance_cd_m2_ = settings_.view.white_luminance(picture);
    prepare(picture);
    session_.check_interrupt();
    const ConstImageView in = picture.color();
    session_.timed("apply", [&] { prepared_->glare.apply(in, result_, matte); });
    const glare::Energy energy = prepared_->glare.energy(in, result_, matte);
    energy_.in += energy.in;
    energy_.out += energy.out;
    energy_.off_picture += energy.off_picture;
    session_.check_interrupt();
    session_.timed("write", [&] { write(files, picture, result_); });
}

void GlareJob::write(const FrameFiles& files, const io::Picture& picture, const Image& result) {
    const auto encode = [&](const ConstImageView& linear) {
        return settings_.display.encode(linear, exposure_ev_);
    };
    const Image glare_layer =
        settings_.layers == "composite" ? Image() : difference(result, picture.color());
    const ConstImageView main = settings_.layers == "glare" ? glare_layer.view() : result.view();
    for (const std::string& path : files.outputs) {
        if (is_display_file(path)) {
            io::write_picture(path, display_picture(encode(main), picture));
        } else {
            io::Picture output = with_color(picture, main);
            if (settings_.layers == "both") output.append_layer("glare", glare_layer);
            settings_.output.write(path, output, session_);
        }
        written_.push_back(path);
    }
    if (!files.side_by_side.empty()) {
        const Image before = encode(over_display_window(picture.color(), picture));
        const Image after = encode(over_display_window(result, picture));
        io::write_picture(files.side_by_side, io::Picture(side_by_side(before, after)));
        written_.push_back(files.side_by_side);
    }
}

std::string GlareJob::report() {
    auto& json = session_.json();
    const Prepared& last = *prepared_;
    json["outputs"] = written_;
    json["energy"] = {
        {"in", energy_.in}, {"out", energy_.out}, {"off_picture", energy_.off_picture}};
    if (energy_.from_surround != 0) json["energy"]["from_surround"] = energy_.from_surround;
    json["method"] = settings_.method == "direct" ? "direct" : "fft";
    json["nonfinite_pixels"] = nonfinite_pixels_;
    auto& parameters = json["parameters"];
    parameters = {{"width", last.view.width},
                  {"height", last.view.height},
                  {"fov_deg", last.display.horizontal_field_deg()},
                  {"perspective", last.view.projection == Projection::kPerspective},
                  {"pitch_deg", last.view.pitch_deg},
                  {"white_luminance_cd_m2", white_luminance_cd_m2_},
                  {"padded_width", last.glare.padded_width()},
                  {"padded_height", last.glare.padded_height()},
                  {"threshold", settings_.threshold},
                  {"gain", settings_.gain},
                  {"surround", settings_.surround},
                  {"output_layers", settings_.layers},
                  {"depth", settings_.output.depth()},
                  {"tone_map", settings_.display.tone_map()},
                  {"exposure_ev", exposure_ev_},
                  {"threads", thread_count()}};
    if (!settings_.matte_file.empty()) parameters["matte"] = settings_.matte_file;
    if (settings_.psf_file.empty()) {
        parameters.update(settings_.eye.report(last.eye, last.metered_cd_m2));
    } else {
        parameters["psf"] = settings_.psf_file;
    }
    std::string summary;
    for (const std::string& path : written_) summary += path + "\n";
    summary += fmt::format("glare moved {:.2f} % of the light out of the picture;",
                           energy_.in > 0 ? 100 * energy_.off_picture / energy_.in : 0.0);
    for (const auto& [stage, seconds] : json["seconds"].items()) {
        summary += fmt::format(" {} {:.3f} s", stage, seconds.get<double>());
    }
    return summary + "\n";
}

}  // namespace aureole::app
