// aureole lens draw: the cross-section of a lens.
#include <cmath>
#include <memory>
#include <set>

#include "aureole/base/error.h"
#include "aureole/io/write_drawing.h"
#include "aureole/lens/cross_section.h"
#include "lens_choice.h"
#include "lens_commands.h"
#include "option_checks.h"
#include "session.h"

namespace aureole::app {
namespace {

struct LensDraw {
    void add_options(CLI::App& command);
    void run();
    lens::CrossSectionOptions cross_section_options(const lens::Lens& ready) const;
    void check_outputs() const;

    Session session;
    LensOptions lens;
    std::vector<std::string> outputs;
    std::vector<double> angles_deg;
    std::vector<int> ghost;
    int rays = 7;
    int width_px = 1600;
};

void LensDraw::add_options(CLI::App& command) {
    lens.add_argument(command);
    command.add_option("-o,--output", outputs, "SVG, PDF or PNG to write; may be repeated")
        ->required()
        ->type_name("FILE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_angles(command, angles_deg, -89,
               "Of the light above the axis, one colour each (default: three over the field; "
               "with --ghost one)");
    whole_number(
        command.add_option("--rays", rays, "Per angle, across the light that passes; 0: none"), 0,
        1000)
        ->type_name("N")
        ->capture_default_str();
    whole_number(command.add_option("--ghost", ghost,
                                    "The way of one ghost from the first angle: the surfaces that "
                                    "reflect, the farther from the scene first"),
                 1, lens::kMaxSurfaces)
        ->type_name("FAR,NEAR")
        ->delimiter(',')
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    whole_number(command.add_option("--width", width_px, "Of a PNG"), 16, 20000)
        ->type_name("PIXELS")
        ->capture_default_str();
    session.add_options(command);
}

lens::CrossSectionOptions LensDraw::cross_section_options(const lens::Lens& ready) const {
    lens::CrossSectionOptions options;
    options.rays_per_field = rays;
    if (!ghost.empty()) options.ghost = lens::Bounces{ghost[0] - 1, ghost[1] - 1};
    options.field_angles_deg = angles_deg;
    if (angles_deg.empty()) {
        // Whole degrees, as far as the field has them.
        const double half = half_field_deg(ready);
        const double most = half >= 2 ? std::floor(half) : half;
        const double middle = half >= 4 ? std::round(half / 2) : half / 2;
        options.field_angles_deg =
            ghost.empty() ? std::vector<double>{0, middle, most} : std::vector<double>{middle};
    }
    return options;
}

void LensDraw::check_outputs() const {
    std::set<std::string> seen;
    for (const std::string& path : outputs) {
        io::check_drawing_extension(path);
        if (!seen.insert(path).second) {
            throw InvalidArgument("output file", path, "would be written more than once");
        }
    }
}

void LensDraw::run() {
    session.start();
    check_outputs();
    if (!ghost.empty() && ghost.size() != 2) {
        throw InvalidArgument("--ghost", std::to_string(ghost.size()) + " numbers",
                              "must be two surfaces, FAR,NEAR, as in 10,4");
    }
    const lens::Prescription table = lens.prescription(session);
    const lens::Lens ready = lens.lens(session);
    lens::CrossSectionOptions options = cross_section_options(ready);
    options.title = title_of(table, lens.position());
    const Drawing drawing = session.timed("draw", [&] { return cross_section(ready, options); });
    session.timed("write", [&] {
        for (const std::string& path : outputs) {
            session.check_interrupt();
            io::write_drawing(path, drawing, width_px);
        }
    });
    auto& json = session.json();
    json["outputs"] = outputs;
    auto& parameters = json["parameters"];
    parameters = lens.report(ready);
    parameters["position"] = position_in_force(table, lens.position());
    parameters["angles_deg"] = options.field_angles_deg;
    parameters["rays"] = rays;
    parameters["ghost"] = ghost;
    parameters["width"] = width_px;
    std::string summary;
    for (const std::string& path : outputs) summary += path + "\n";
    session.finish(summary);
}

}  // namespace

Run add_lens_draw_command(CLI::App& lens) {
    CLI::App& command = *lens.add_subcommand(
        "draw", "Draw the cross-section of a lens, with rays and the way of a ghost");
    const auto state = std::make_shared<LensDraw>();
    state->add_options(command);
    return [state] { state->run(); };
}

}  // namespace aureole::app
