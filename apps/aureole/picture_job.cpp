#include "picture_job.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/color/tone_curve.h"
#include "aureole/eye/thesis_glare.h"
#include "aureole/image/finite.h"
#include "aureole/image/resample.h"
#include "aureole/io/supersampling.h"
#include "input_picture.h"
#include "layers.h"
#include "option_checks.h"
#include "view_options.h"

namespace aureole::app {
namespace {

// A look that adds more than this share of a picture's light has whitened it.
constexpr double kMuchAdded = 0.5;

using Reason = glare::MethodReport::Reason;

constexpr int kMostSamples = 16;  // in either direction

// How the last picture was done; the choice where there was one, or an error.
void report_method(const glare::MethodReport& report, nlohmann::ordered_json& json) {
    json["method"] = glare::name_of(report.method);
    if (report.raster.scale > 1) {
        json["raster"] = {{"scale", report.raster.scale},
                          {"near_radius", report.raster.near_radius},
                          {"error_bound", report.raster.error}};
    }
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
    whole_number(group.add_option("--supersampling", supersampling,
                                  "The input has N x N samples for each pixel of the result: their "
                                  "mean is taken first of all"),
                 1, kMostSamples)
        ->type_name("N")
        ->capture_default_str();
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

void PictureJob::prepare(const io::Picture& picture) {
    const View display = observer_.view_of(picture);
    const View view = data_view(display, picture);
    const int channels = picture.color_channels();
    const bool adapted = observer_.adapt(picture);
    if (prepared_ && adapted && prepared_->view == view && prepared_->display == display &&
        prepared_->channels == channels &&
        (prepared_->exposure_ev == exposure_ev_ || spread_.source_tone_map == "none")) {
        return;
    }
    prepared_.reset();
    Spreading spreading;
    std::optional<wave::VaryingPsf> varying;
    session_.timed("psf", [&] {
        varying = observer_.varying_psf(display, view);
        if (!varying) spreading = observer_.spreading(display, view);
        ++psfs_made_;
    });
    const bool matte = !settings_.matte_file.empty();
    const bool one_pass = spread_.passes() == Passes::kOne;
    session_.timed("plan", [&] {
        Prepared& now =
            prepared_.emplace(Prepared{display, view, channels, exposure_ev_, {}, {}, {}});
        if (varying) now.varying.emplace(channels, *varying);
        glare::GlareOptions options = spread_.options(matte, exposure_ev_);
        options.gain *= static_cast<float>(observer_.gain());
        if (spreading.streaks) now.streaks.emplace(view, channels, *spreading.streaks, options);
        if (spreading.rest) {
            now.rest.emplace(view, channels, *spreading.rest,
                             one_pass ? options : spread_.bloom_options(matte));
        }
        observer_.plan(view);
    });
    const std::optional<glare::Glare>& by_fft =
        prepared_->rest ? prepared_->rest : prepared_->streaks;
    if (by_fft && spread_.resolution != "full" && by_fft->last().raster.scale == 1) {
        session_.note(
            "--resolution " + spread_.resolution +
            ": all at full resolution: the kernel is too small or too rough for a raster");
    }
    solid_angles_ = relative_solid_angles(view);
    result_ = Image(view.width, view.height, channels);
    if (spreading.streaks && spreading.rest) {
        with_streaks_ = Image(view.width, view.height, channels);
    }
}

void PictureJob::read_matte(const io::Picture& picture) {
    if (settings_.matte_file.empty()) return;
    if (matte_.empty()) {
        const io::Picture file = io::read_picture(settings_.matte_file);
        matte_ = copy(file.image().view().channel_range(0, 1));
        replace_nonfinite(matte_);
    }
    const Image& image = picture.image();
    if (matte_.width() != image.width() || matte_.height() != image.height()) {
        throw FileError(
            settings_.matte_file,
            fmt::format("is {}x{} pixels; a matte must have the size of the picture, "
                        "{}x{}",
                        matte_.width(), matte_.height(), image.width(), image.height()));
    }
}

void PictureJob::average_samples(io::Picture& picture, const std::string& file) {
    if (settings_.supersampling == 1) return;
    try {
        io::average_samples(picture, settings_.supersampling);
    } catch (const InvalidArgument& error) {
        throw FileError(file, error.what());
    }
    if (!matte_.empty()) small_matte_ = area_average(matte_, settings_.supersampling);
}

// One pass or two into result_. What leaves the picture in either is off it: each pass conserves,
// so both do.
glare::Energy PictureJob::apply(const ConstImageView& in, const float* matte) {
    const auto pass = [&](auto& glare, const ConstImageView& from, const ImageView& to) {
        session_.timed("apply", [&] { glare.apply(from, to, matte); });
        return glare.energy(from, to, matte);
    };
    Prepared& now = *prepared_;
    if (now.varying) {
        session_.timed("apply", [&] { now.varying->apply(in, result_); });
        return now.varying->energy(in, result_);
    }
    if (!now.streaks) return pass(*now.rest, in, result_);
    if (!now.rest) return pass(*now.streaks, in, result_);
    glare::Energy total = pass(*now.streaks, in, with_streaks_);
    const glare::Energy bloom = pass(*now.rest, with_streaks_, result_);
    total.out = bloom.out;
    total.off_picture += bloom.off_picture;
    total.from_surround += bloom.from_surround;
    return total;
}

// Into result_; and what that changed into layer_.
void PictureJob::spread(const ConstImageView& in, const float* matte) {
    const View& view = prepared_->view;
    const double share = observer_.light_share();
    if (prepared_->spreads()) {
        const glare::Energy energy = apply(in, matte);
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
    InputPicture input = read_input(files.input, session_);
    io::Picture& picture = input.picture;
    nonfinite_pixels_ += input.nonfinite_pixels;
    read_matte(picture);
    average_samples(picture, files.input);
    const float* const matte = matte_.empty()                 ? nullptr
                               : settings_.supersampling == 1 ? matte_.plane(0)
                                                              : small_matte_.plane(0);
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
    if (last.chosen() != nullptr) report_method(last.chosen()->last(), json);
    if (last.varying) json["method"] = "nodes";
    json["nonfinite_pixels"] = nonfinite_pixels_;
    json["psfs_made"] = psfs_made_;
    auto& parameters = json["parameters"];
    parameters = {{"width", last.view.width},
                  {"height", last.view.height},
                  {"fov_deg", last.display.horizontal_field_deg()},
                  {"perspective", last.view.projection == Projection::kPerspective},
                  {"pitch_deg", last.view.pitch_deg},
                  {"supersampling", settings_.supersampling},
                  {"output_layers", settings_.layers},
                  {"depth", settings_.output.depth()},
                  {"tone_map", settings_.display.tone_map()},
                  {"antialias", settings_.display.antialias()},
                  {"exposure_ev", exposure_ev_},
                  {"threads", thread_count()}};
    if (last.chosen() != nullptr) {
        const glare::Glare& glare = last.rest ? *last.rest : *last.streaks;
        parameters.update(
            {{"padded_width", glare.padded_width()}, {"padded_height", glare.padded_height()}});
        parameters.update(spread_.report());
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
