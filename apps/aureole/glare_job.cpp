#include "glare_job.h"

#include <fmt/core.h>

#include <algorithm>

#include "aureole/base/error.h"
#include "aureole/color/rgb.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/image/finite.h"
#include "kernel_file.h"

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

void assign(const ImageView& to, const ConstImageView& from) {
    for (int c = 0; c < to.channels; ++c) {
        for (int y = 0; y < to.height; ++y) {
            for (int x = 0; x < to.width; ++x) to.at(x, y, c) = from.at(x, y, c);
        }
    }
}

// A picture of the colour only, over the same windows and with the same metadata.
io::Picture with_color(const io::Picture& picture, const ConstImageView& color) {
    io::Picture result = picture;
    assign(result.color(), color);
    return result;
}

}  // namespace

void GlareSettings::add_options(CLI::App& command) {
    view.add_options(command);
    eye.add_options(command);
    CLI::Option_group& group = *command.add_option_group("Applying it");
    group
        .add_option("--psf", psf_file,
                    "Use this kernel (EXR of `aureole psf`, or any odd-sized picture) instead of "
                    "an eye's")
        ->type_name("FILE");
    group
        .add_option("--method", method,
                    "fft; direct: the plain double sum, exact and slow; auto: fft")
        ->check(CLI::IsMember({"auto", "fft", "direct"}))
        ->capture_default_str();
    group
        .add_option("--output-layers", layers,
                    "composite: the picture with glare; glare: what glare added and took away "
                    "(sums with the input to the composite); both: EXR layers")
        ->check(CLI::IsMember({"composite", "glare", "both"}))
        ->capture_default_str();
    group
        .add_option("--matte", matte_file,
                    "Picture of the same size: only where it is 1 (its first channel) do pixels "
                    "make glare")
        ->type_name("FILE");
    group
        .add_option("--threshold", threshold,
                    "Pixel values below make no glare (continuous ramp); 0 is physical")
        ->check(CLI::NonNegativeNumber)
        ->type_name("V")
        ->capture_default_str();
    group.add_option("--gain", gain, "Scales the scattered light; 1 conserves energy")
        ->check(CLI::NonNegativeNumber)
        ->type_name("G")
        ->capture_default_str();
    group
        .add_option("--side-by-side", side_by_side_file,
                    "Also write a PNG or JPEG: the picture without glare, and with it")
        ->type_name("FILE");
    group.add_option("--depth", depth, "Of EXR colour channels; half loses the wings of glare")
        ->check(CLI::IsMember({"float", "half"}))
        ->capture_default_str();
    display.add_options(command);
}

void GlareSettings::prepare(const std::vector<std::string>& outputs) {
    std::vector<std::string> all = outputs;
    if (!side_by_side_file.empty()) {
        if (!is_display_file(side_by_side_file)) {
            throw InvalidArgument("--side-by-side", side_by_side_file, "must be PNG or JPEG");
        }
        all.push_back(side_by_side_file);
    }
    if (layers == "both" && !std::all_of(outputs.begin(), outputs.end(), [](const auto& path) {
            return path.ends_with(".exr") || path.ends_with(".EXR");
        })) {
        throw InvalidArgument("--output-layers", layers, "needs EXR output: others have no layers");
    }
    display.prepare(all);
}

double GlareJob::metered_luminance(const io::Picture& picture) const {
    if (const auto stored = picture.float_attribute("aureole:adaptation_cd_m2")) return *stored;
    const ConstImageView color = picture.color();
    double sum = 0;
    for (int y = 0; y < color.height; ++y) {
        for (int x = 0; x < color.width; ++x) {
            const double value =
                color.channels == 3
                    ? color::luminance({color.at(x, y, 0), color.at(x, y, 1), color.at(x, y, 2)})
                    : color.at(x, y, 0);
            sum += std::max(value, 0.0);
        }
    }
    return sum / static_cast<double>(color.pixels()) * settings_.view.white_luminance(picture);
}

void GlareJob::prepare(const View& view, const io::Picture& picture) {
    const int channels = picture.color_channels();
    if (prepared_ && same_view(prepared_->view, view) && prepared_->channels == channels) return;
    prepared_.reset();
    if (!adaptation_cd_m2_) {
        adaptation_cd_m2_ = settings_.eye.needs_adaptation() ? metered_luminance(picture) : 0.0;
    }
    const eye::Eye eye = settings_.eye.eye(*adaptation_cd_m2_, view);
    wave::Psf psf = session_.timed("psf", [&] {
        return settings_.psf_file.empty()
                   ? eye::eye_psf(eye, wave::KernelGrid::full_reach(view), {}, &session_)
                   : read_kernel(settings_.psf_file, view);
    });
    glare::GlareOptions options;
    options.method = settings_.method == "auto" ? glare::Method::kFft
                                                : glare::method_from_name(settings_.method);
    options.threshold = settings_.threshold;
    options.gain = settings_.gain;
    options.matte = !settings_.matte_file.empty();
    session_.timed("plan", [&] {
        prepared_.emplace(
            Prepared{view, channels, eye, glare::Glare(view, channels, psf, options)});
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
    prepare(settings_.view.view_of(picture, session_), picture);
    const ConstImageView in = picture.color();
    session_.timed("apply", [&] { prepared_->glare.apply(in, result_, matte); });
    const glare::Energy energy = prepared_->glare.energy(in, result_, matte);
    energy_.in += energy.in;
    energy_.out += energy.out;
    energy_.off_picture += energy.off_picture;
    session_.timed("write", [&] { write(files, picture, result_); });
}

void GlareJob::write(const FrameFiles& files, const io::Picture& picture, const Image& result) {
    const double ev = settings_.display.exposure_ev(picture);
    io::WriteOptions options;
    options.depth = settings_.depth == "half" ? io::Depth::kHalf : io::Depth::kFloat;
    const bool glare_only = settings_.layers == "glare";
    const Image glare_layer =
        settings_.layers == "composite" ? Image() : difference(result, picture.color());
    const ConstImageView main = glare_only ? glare_layer.view() : result.view();
    for (const std::string& path : files.outputs) {
        if (is_display_file(path)) {
            io::write_picture(path, with_color(picture, settings_.display.encode(main, ev)));
        } else {
            io::Picture output = with_color(picture, main);
            if (settings_.layers == "both") output.append_layer("glare", glare_layer);
            const io::WriteReport report = io::write_picture(path, output, options);
            if (report.clipped_samples > 0) {
                session_.note(fmt::format("{}: {} samples do not fit its format and were clipped",
                                          path, report.clipped_samples));
            }
        }
        written_.push_back(path);
    }
    if (!settings_.side_by_side_file.empty()) {
        const Image both = side_by_side(settings_.display.encode(picture.color(), ev),
                                        settings_.display.encode(result, ev));
        io::write_picture(settings_.side_by_side_file, io::Picture(both));
        written_.push_back(settings_.side_by_side_file);
    }
}

std::string GlareJob::report() {
    auto& json = session_.json();
    const View& view = prepared_->view;
    json["outputs"] = written_;
    json["energy"] = {
        {"in", energy_.in}, {"out", energy_.out}, {"off_picture", energy_.off_picture}};
    json["method"] = settings_.method == "direct" ? "direct" : "fft";
    json["nonfinite_pixels"] = nonfinite_pixels_;
    auto& parameters = json["parameters"];
    parameters = {{"width", view.width},
                  {"height", view.height},
                  {"fov_deg", view.horizontal_field_deg()},
                  {"perspective", view.projection == Projection::kPerspective},
                  {"pitch_deg", view.pitch_deg},
                  {"padded_width", prepared_->glare.padded_width()},
                  {"padded_height", prepared_->glare.padded_height()},
                  {"threshold", settings_.threshold},
                  {"gain", settings_.gain},
                  {"output_layers", settings_.layers},
                  {"tone_map", settings_.display.tone_map()},
                  {"depth", settings_.depth}};
    if (settings_.psf_file.empty()) {
        parameters.update(to_json(prepared_->eye));
        if (settings_.eye.needs_adaptation()) {
            parameters["adaptation_cd_m2"] = *adaptation_cd_m2_;
        }
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
