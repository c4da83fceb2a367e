#include "picture_job.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/color/tone_curve.h"
#include "aureole/eye/thesis_glare.h"
#include "aureole/image/finite.h"
#include "layers.h"
#include "option_checks.h"
#include "view_options.h"

namespace aureole::app {
namespace {

// A look that adds more than this share of a picture's light has whitened it.
constexpr double kMuchAdded = 0.5;

using Reason = glare::MethodReport::Reason;

bool same_view(const View& a, const View& b) {
    return a.width == b.width && a.height == b.height && a.projection == b.projection &&
           a.pitch_deg == b.pitch_deg && a.axis_x == b.axis_x && a.axis_y == b.axis_y;
}

// How the last picture was done; the choice where there was one, or an error.
void report_method(const glare::MethodReport& report, nlohmann::ordered_json& json) {
    json["method"] = glare::name_of(report.method);
    if (report.method == glare::Method::kFft && report.reason == Reason::kAsked) return;
    if (report.method == glare::Method::kDirect) return;
    auto& choice = json["method_choice"];
    choice = {{"reason", glare::name_of(report.reason)},
              {"sprites", report.sprites},
              {"error_bound", report.error_bound},
              {"predicted_seconds", nlohmann::ordered_json::object()},
              {"actual_seconds", nlohmann::ordered_json::object()}};
    for (const auto& candidate : report.candidates) {
        const std::string name(glare::name_of(candidate.method));
        if (candidate.predicted_seconds > 0) {
            choice["predicted_seconds"][name] = candidate.predicted_seconds;
        }
        if (candidate.actual_seconds > 0) choice["actual_seconds"][name] = candidate.actual_seconds;
    }
}

void scale(Image& image, double factor) {
    const auto f = static_cast<float>(factor);
    const std::size_t count = image.pixels() * static_cast<std::size_t>(image.channels());
    std::for_each_n(image.plane(0), count, [&](float& value) { value *= f; });
}

}  // namespace

void PictureSettings::add_options(CLI::App& group, CLI::App& command) {
    layers_option = one_of(
        group.add_option("--output-layers", layers,
                         "composite: the picture with glare; glare: what was added and taken away "
                         "(sums with the input to the composite); both: EXR layers"),
        {"composite", "glare", "both"});
    layers_option->capture_default_str();
    group
        .add_option("--matte", matte_file,
                    "Picture of the same size: only where it is 1 (its first channel) do pixels "
                    "make glare")
        ->type_name("FILE");
    group
        .add_option("--side-by-side", side_by_side_file,
                    "Also write a PNG or JPEG: the picture without glare, and with it; a numbered "
                    "name for a sequence")
        ->type_name("FILE");
    display.add_options(command);
}

void PictureSettings::prepare(const std::vector<FrameFiles>& files) {
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
}

void SpreadSettings::add_options(CLI::App& group) {
    one_of(group.add_option("--method", method,
                            "fft: exact; direct: the plain double sum, exact and slow. To within "
                            "--cluster-error: sprites: the kernel drawn for each light; hybrid: "
                            "near by fft, far by sprites; auto: for each picture the fastest, "
                            "which depends on the machine"),
           {"fft", "direct", "sprites", "hybrid", "auto"})
        ->capture_default_str();
    error_option_ = number(group.add_option(
                               "--cluster-error", cluster_error,
                               "Of sprites, hybrid and auto: largest sum of |difference| from fft, "
                               "over the sum of the light"),
                           1e-6, 0.5)
                        ->type_name("E")
                        ->capture_default_str();
    threshold_option_ =
        number(
            group.add_option("--threshold", threshold,
                             "Pixel values below make no glare (continuous ramp); 0 is physical"),
            0, 1e30)
            ->type_name("V")
            ->capture_default_str();
    gain_option_ =
        number(group.add_option("--gain", gain, "Scales the scattered light; 1 conserves energy"),
               0, 1e6)
            ->type_name("G")
            ->capture_default_str();
    one_of(group.add_option("--surround", surround,
                            "What lies beyond the border. dark: nothing, borders lose light; same: "
                            "for each pixel surroundings as bright as itself"),
           {"dark", "same"})
        ->capture_default_str();
}

void SpreadSettings::check() const {
    if (error_option_->count() > 0 && (method == "fft" || method == "direct")) {
        throw InvalidArgument("--cluster-error", error_option_->results().front(),
                              "needs --method sprites, hybrid or auto: " + method + " is exact");
    }
}

void SpreadSettings::set_thesis_look() {
    if (threshold_option_->count() == 0) threshold = eye::kThesisThreshold;
    if (gain_option_->count() == 0) gain = eye::kThesisFinalGain;
    source_tone_map = "unity";
    source_factor = eye::kThesisSourceFactor;
    added = true;
}

glare::GlareOptions SpreadSettings::options(bool matte, double exposure_ev) const {
    glare::GlareOptions options;
    options.method = glare::method_from_name(method);
    options.cluster_error = cluster_error;
    options.threshold = static_cast<float>(threshold);
    options.gain = static_cast<float>(source_factor * gain);
    options.matte = matte;
    options.surround = glare::surround_from_name(surround);
    options.added = added;
    if (source_tone_map != "none") {
        options.source_curve = color::tone_curve_from_name(source_tone_map);
        options.exposure_scale = static_cast<float>(std::exp2(exposure_ev));
    }
    return options;
}

std::string SpreadSettings::first_selective() const {
    if (method != "fft") return "--method " + method;
    if (threshold != 0) return "--threshold";
    if (gain != 1) return "--gain";
    return surround == "same" ? "--surround same" : "";
}

void PictureJob::prepare(const io::Picture& picture) {
    const View display = observer_.view_of(picture);
    const View view = data_view(display, picture);
    const int channels = picture.color_channels();
    const bool adapted = observer_.adapt(picture);
    if (prepared_ && adapted && same_view(prepared_->view, view) &&
        same_view(prepared_->display, display) && prepared_->channels == channels &&
        (prepared_->exposure_ev == exposure_ev_ || spread_.source_tone_map == "none")) {
        return;
    }
    prepared_.reset();
    std::optional<wave::Psf> psf;
    std::optional<wave::VaryingPsf> varying;
    session_.timed("psf", [&] {
        varying = observer_.varying_psf(display, view);
        if (!varying) psf = observer_.psf(display, view);
    });
    session_.timed("plan", [&] {
        prepared_.emplace(
            Prepared{display, view, channels, exposure_ev_, std::nullopt, std::nullopt});
        if (varying) prepared_->varying.emplace(channels, *varying);
        if (psf) {
            glare::GlareOptions options =
                spread_.options(!settings_.matte_file.empty(), exposure_ev_);
            options.gain *= static_cast<float>(observer_.gain());
            prepared_->glare.emplace(view, channels, *psf, options);
        }
        observer_.plan(view);
    });
    solid_angles_ = relative_solid_angles(view);
    result_ = Image(view.width, view.height, channels);
}

const float* PictureJob::matte_for(const io::Picture& picture) {
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

// Into result_; and what that changed into layer_.
void PictureJob::spread(const ConstImageView& in, const float* matte) {
    const View& view = prepared_->view;
    const double share = observer_.light_share();
    if (prepared_->spreads()) {
        session_.timed("apply", [&] {
            if (prepared_->varying) {
                prepared_->varying->apply(in, result_);
            } else {
                prepared_->glare->apply(in, result_, matte);
            }
        });
        const glare::Energy energy = prepared_->varying
                                         ? prepared_->varying->energy(in, result_)
                                         : prepared_->glare->energy(in, result_, matte);
        energy_.in += energy.in;
        energy_.out += share * energy.out;
        energy_.off_picture += share * energy.off_picture;
        energy_.blocked += (1 - share) * (energy.in + energy.from_surround);
        energy_.from_surround += energy.from_surround;
        energy_.added += energy.added;
    } else {
        session_.timed("apply", [&] { result_ = copy(in); });
        const double energy = energy_of(in, view, solid_angles_);
        energy_.in += energy;
        energy_.out += share * energy;
        energy_.blocked += (1 - share) * energy;
    }
    if (share < 1) scale(result_, share);
    if (settings_.layers == "composite") return;
    layer_ =
        prepared_->spreads() ? difference(result_, in) : Image(in.width, in.height, in.channels);
}

void PictureJob::add_ghosts(const Image& ghosts) {
    has_ghosts_ = true;
    Image grey;  // the luminance, for a grey picture
    const Image* added = &ghosts;
    if (result_.channels() == 1) {
        grey = Image(ghosts.width(), ghosts.height(), 1);
        add_light(ghosts, grey);
        added = &grey;
    }
    const double energy = energy_of(*added, prepared_->view, solid_angles_);
    energy_.ghosts += energy;
    energy_.out += energy;
    if (energy_.in > 0 && energy_.ghosts > energy_.in) {
        session_.note(
            fmt::format("ghosts hold {:.2g} times the light of the picture (--tint "
                        "scales them)",
                        energy_.ghosts / energy_.in));
    }
    add_light(ghosts, result_);
    if (!layer_.empty()) add_light(ghosts, layer_);
}

void PictureJob::process(const FrameFiles& files) {
    observer_.set_time(files.time_s);
    io::Picture picture = session_.timed("read", [&] { return io::read_picture(files.input); });
    const std::size_t nonfinite = replace_nonfinite(picture.color());
    if (nonfinite > 0) {
        session_.note(fmt::format("{}: {} pixels with NaN or infinity replaced by 0", files.input,
                                  nonfinite));
    }
    nonfinite_pixels_ += nonfinite;
    const float* matte = matte_for(picture);
    exposure_ev_ = settings_.display.exposure_ev(picture);
    prepare(picture);
    session_.check_interrupt();
    spread(picture.color(), matte);
    session_.check_interrupt();
    if (const Image* ghosts =
            observer_.ghosts(picture, prepared_->display, prepared_->view, matte)) {
        add_ghosts(*ghosts);
        session_.check_interrupt();
    }
    session_.timed("write", [&] { write(files, picture); });
}

void PictureJob::process(const std::vector<FrameFiles>& list) {
    for (std::size_t i = 0; i < list.size(); ++i) {
        session_.check_interrupt();
        process(list[i]);
        if (list.size() > 1) {
            session_.report("frames",
                            static_cast<double>(i + 1) / static_cast<double>(list.size()));
        }
    }
}

void PictureJob::write(const FrameFiles& files, const io::Picture& picture) {
    const auto encode = [&](const ConstImageView& linear) {
        return settings_.display.encode(linear, exposure_ev_);
    };
    const ConstImageView main = settings_.layers == "glare" ? layer_.view() : result_.view();
    for (const std::string& path : files.outputs) {
        if (is_display_file(path)) {
            io::write_picture(path, display_picture(encode(main), picture));
        } else {
            io::Picture output = with_color(picture, main);
            if (settings_.layers == "both") output.append_layer("glare", layer_);
            settings_.output.write(path, output, session_);
        }
        written_.push_back(path);
    }
    if (!files.side_by_side.empty()) {
        const Image before = encode(over_display_window(picture.color(), picture));
        const Image after = encode(over_display_window(result_, picture));
        io::write_picture(files.side_by_side, io::Picture(side_by_side(before, after)));
        written_.push_back(files.side_by_side);
    }
}

std::string PictureJob::report() {
    auto& json = session_.json();
    if (energy_.added > kMuchAdded * energy_.in) {
        session_.note(
            fmt::format("glare adds {:.2g} times the light of the picture (--gain, now {:g}, or "
                        "--exposure scale it)",
                        energy_.added / energy_.in, spread_.gain));
    }
    const Prepared& last = *prepared_;
    json["outputs"] = written_;
    json["energy"] = {
        {"in", energy_.in}, {"out", energy_.out}, {"off_picture", energy_.off_picture}};
    if (energy_.from_surround != 0) json["energy"]["from_surround"] = energy_.from_surround;
    if (energy_.added != 0) json["energy"]["added"] = energy_.added;
    if (energy_.blocked != 0) json["energy"]["blocked"] = energy_.blocked;
    if (has_ghosts_) json["energy"]["ghosts"] = energy_.ghosts;
    if (last.glare) report_method(last.glare->last(), json);
    if (last.varying) json["method"] = "nodes";
    json["nonfinite_pixels"] = nonfinite_pixels_;
    auto& parameters = json["parameters"];
    parameters = {{"width", last.view.width},
                  {"height", last.view.height},
                  {"fov_deg", last.display.horizontal_field_deg()},
                  {"perspective", last.view.projection == Projection::kPerspective},
                  {"pitch_deg", last.view.pitch_deg},
                  {"output_layers", settings_.layers},
                  {"depth", settings_.output.depth()},
                  {"tone_map", settings_.display.tone_map()},
                  {"antialias", settings_.display.antialias()},
                  {"exposure_ev", exposure_ev_},
                  {"threads", thread_count()}};
    if (last.glare) {
        parameters.update({{"padded_width", last.glare->padded_width()},
                           {"padded_height", last.glare->padded_height()},
                           {"cluster_error", spread_.cluster_error},
                           {"threshold", spread_.threshold},
                           {"gain", spread_.gain},
                           {"surround", spread_.surround},
                           {"source_tone_map", spread_.source_tone_map},
                           {"source_factor", spread_.source_factor},
                           {"composite", spread_.added ? "added" : "conserving"}});
    }
    if (last.varying) {
        parameters.update({{"padded_width", last.varying->padded_width()},
                           {"padded_height", last.varying->padded_height()}});
    }
    if (!settings_.matte_file.empty()) parameters["matte"] = settings_.matte_file;
    observer_.report(json);
    std::string summary;
    for (const std::string& path : written_) summary += path + "\n";
    const auto percent = [&](double energy) {
        return energy_.in > 0 ? 100 * energy / energy_.in : 0.0;
    };
    if (energy_.added != 0) {
        summary += fmt::format("glare added {:.3g} % to the light of the picture;",
                               percent(energy_.added));
    } else if (last.spreads()) {
        summary += fmt::format("glare moved {:.2f} % of the light out of the picture;",
                               percent(energy_.off_picture));
    }
    if (has_ghosts_) {
        summary += fmt::format("{}ghosts added {:.3g} % to the light of the picture;",
                               last.spreads() ? " " : "", percent(energy_.ghosts));
    }
    for (const auto& [stage, seconds] : json["seconds"].items()) {
        summary += fmt::format(" {} {:.3f} s", stage, seconds.get<double>());
    }
    return summary + "\n";
}

}  // namespace aureole::app
