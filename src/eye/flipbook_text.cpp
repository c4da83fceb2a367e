// The parameters of a flipbook as lines of text, "name value".
#include <fmt/format.h>

#include <charconv>
#include <map>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/color/illuminant.h"
#include "aureole/fourier/sizes.h"
#include "eye/flipbook_format.h"
#include "eye/kernel_checks.h"

namespace aureole::eye {
namespace {

constexpr std::string_view kEyePrefix = "eye.";

// Numbers as text that reads back as the same number.
class Values {
  public:
    template <class T>
    void add(std::string name, const T& value) {
        values_.push_back({std::move(name), fmt::format("{}", value)});
    }
    void add(const std::string& name, const Particles& particles) {
        add(name + ".count", particles.count);
        add(name + ".min_radius_um", particles.min_radius_um);
        add(name + ".max_radius_um", particles.max_radius_um);
    }
    std::vector<NamedValue> take() { return std::move(values_); }

  private:
    std::vector<NamedValue> values_;
};

const char* name_of(Projection projection) {
    return projection == Projection::kPerspective ? "perspective" : "constant-pitch";
}

const char* name_of(PupilShape shape) {
    switch (shape) {
        case PupilShape::kSlit:
            return "slit";
        case PupilShape::kEllipse:
            return "ellipse";
        case PupilShape::kRound:
            break;
    }
    return "round";
}

// Calls visit(name, field) for each field of the text that is a number, in the order of the file.
template <class Text, class Visit>
void for_each_number(Text& text, const Visit& visit) {
    auto& range = text.range;
    visit("pitch_deg", text.grid.pitch_deg);
    visit("aperture_samples", text.aperture.samples);
    visit("aperture_extent_mm", text.aperture.extent_mm);
    visit("pupil_from_mm", range.pupil_from_mm);
    visit("pupil_to_mm", range.pupil_to_mm);
    visit("texture_pupils", range.texture_pupils);
    visit("lens_states", range.lens_states);
    visit("lens_scale_span", range.lens_scale_span);
    visit("vitreous_phases", range.vitreous_phases);
    visit("vitreous_step_deg", range.vitreous_step_deg);
    visit("covered_phases", range.covered_phases);
    visit("halo_pupils", range.halo_pupils);
    visit("streak_pupils", range.streak_pupils);
    visit("lid_states", range.lid_states);
    visit("largest_closure", range.largest_closure);
}

// Takes lines one by one, as they were written.
class Lines {
  public:
    explicit Lines(std::string_view text) : rest_(text) {}

    bool done() const { return rest_.empty(); }

    NamedValue next() {
        const std::size_t end = rest_.find('\n');
        const std::size_t space = rest_.find(' ');
        if (end == std::string_view::npos || space >= end) {
            throw InvalidArgument("its parameters break off");
        }
        NamedValue line{std::string(rest_.substr(0, space)),
                        std::string(rest_.substr(space + 1, end - space - 1))};
        rest_.remove_prefix(end + 1);
        return line;
    }

    std::string next_value(std::string_view name) {
        NamedValue line = next();
        if (line.name == name) return line.value;
        throw InvalidArgument(fmt::format("its parameter {} is missing", name));
    }

    template <class T>
    T next_number(std::string_view name) {
        const std::string value = next_value(name);
        T number{};
        const char* const end = value.data() + value.size();
        const auto [stop, error] = std::from_chars(value.data(), end, number);
        if (error != std::errc() || stop != end) {
            throw InvalidArgument(std::string(name), value, "must be a number");
        }
        return number;
    }

  private:
    std::string_view rest_;
};

}  // namespace

std::vector<NamedValue> identity_of(const Eye& eye, const SpectralSampling& sampling) {
    Values values;
    values.add("age_years", eye.age_years);
    values.add("pigmentation", name_of(eye.pigmentation));
    values.add("scatter", name_of(eye.scatter));
    values.add("corona_contrast", eye.corona_contrast);
    values.add("eyelashes", eye.eyelashes);
    values.add("seed", eye.seed);
    const Anatomy& anatomy = eye.anatomy;
    values.add("lens_small", anatomy.lens_small);
    values.add("lens_large", anatomy.lens_large);
    values.add("vitreous", anatomy.vitreous);
    values.add("cornea", anatomy.cornea);
    values.add("particle_disc_radius_mm", anatomy.particle_disc_radius_mm);
    values.add("gratings.fibres", anatomy.gratings.fibres);
    values.add("gratings.phase_rad", anatomy.gratings.phase_rad);
    values.add("gratings.inner_radius_mm", anatomy.gratings.inner_radius_mm);
    values.add("gratings.full_radius_mm", anatomy.gratings.full_radius_mm);
    values.add("gratings.jitter_fibres", anatomy.gratings.jitter_fibres);
    values.add("lashes.width_um", anatomy.lashes.width_um);
    values.add("lashes.angle_sd_deg", anatomy.lashes.angle_sd_deg);
    values.add("lashes.reach", anatomy.lashes.reach);
    values.add("lashes.reach_sd", anatomy.lashes.reach_sd);
    values.add("lashes.curvature_per_mm", anatomy.lashes.curvature_per_mm);
    values.add("lashes.distance_mm", anatomy.lashes.distance_mm);
    values.add("lashes.curled_per_mm", anatomy.lashes.curled_per_mm);
    values.add("lashes.curl_deg", anatomy.lashes.curl_deg);
    values.add("pupil.shape", name_of(anatomy.pupil.shape));
    values.add("pupil.axis_ratio", anatomy.pupil.axis_ratio);
    values.add("pupil.iris_mm", anatomy.pupil.iris_mm);
    values.add("pupil.rotation_deg", anatomy.pupil.rotation_deg);
    values.add("lower_lid_share", anatomy.lower_lid_share);
    values.add("pupil_irregularity", anatomy.pupil_irregularity);
    values.add("bands", sampling.bands);
    values.add("band_spacing", sampling.spacing == color::WavelengthSpacing::kLogarithmic
                                   ? "logarithmic"
                                   : "linear");
    values.add("source_spectrum", sampling.by_color ? "rgb" : color::name_of(sampling.illuminant));
    values.add("single_wavelength_nm", sampling.single_wavelength_nm);
    return values.take();
}

std::string write_flipbook_text(const FlipbookText& text) {
    std::string out = fmt::format("transform_size {}\nprojection {}\n", text.grid.width + 1,
                                  name_of(text.grid.projection));
    for_each_number(text, [&](const char* name, const auto& value) {
        out += fmt::format("{} {}\n", name, value);
    });
    for (const NamedValue& value : text.identity) {
        out += fmt::format("{}{} {}\n", kEyePrefix, value.name, value.value);
    }
    return out;
}

FlipbookText read_flipbook_text(std::string_view bytes) {
    FlipbookText text;
    Lines lines(bytes);
    const int size = lines.next_number<int>("transform_size");
    if (size < 2 || size > fourier::kMaxTransformSize) {
        throw InvalidArgument("transform_size", fmt::format("{}", size), "is impossible");
    }
    text.grid.width = size - 1;
    text.grid.height = size - 1;
    const std::string projection = lines.next_value("projection");
    text.grid.projection = Projection::kPerspective;
    if (projection != name_of(text.grid.projection)) {
        text.grid.projection = Projection::kConstantPitch;
        if (projection != name_of(text.grid.projection)) {
            throw InvalidArgument("projection", projection, "is unknown");
        }
    }
    for_each_number(text, [&](const char* name, auto& value) {
        value = lines.next_number<std::remove_reference_t<decltype(value)>>(name);
    });
    check_flipbook_grid(text.grid);
    check_aperture(text.aperture);
    check(text.range);
    while (!lines.done()) {
        NamedValue value = lines.next();
        if (!value.name.starts_with(kEyePrefix)) {
            throw InvalidArgument("its parameter " + value.name + " is unknown");
        }
        value.name.erase(0, kEyePrefix.size());
        text.identity.push_back(std::move(value));
    }
    return text;
}

}  // namespace aureole::eye
