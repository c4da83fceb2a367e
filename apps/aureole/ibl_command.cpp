// aureole ibl: environment maps, filtered for lighting.
#include <fmt/core.h>

#include <memory>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/ibl/brdf_table.h"
#include "aureole/ibl/filter_error.h"
#include "aureole/ibl/irradiance.h"
#include "aureole/ibl/roughness.h"
#include "aureole/ibl/spherical_harmonics.h"
#include "aureole/io/write_drawing.h"
#include "commands.h"
#include "environment_options.h"
#include "filter_options.h"
#include "ibl_files.h"
#include "ibl_preview.h"
#include "option_checks.h"
#include "output_options.h"
#include "session.h"

namespace aureole::app {
namespace {

constexpr int kLargestTable = 1024;
constexpr int kLargestIrradiance = 1024;

struct IblCommand {
    void add_options(CLI::App& command);
    void run();

    void check() const;
    ibl::ShWindow window() const;
    nlohmann::ordered_json sh_json(const ibl::CubeMap& environment) const;
    ibl::BrdfTable table() const;
    nlohmann::ordered_json levels_json(const ibl::CubeMap& environment,
                                       const ibl::CubeChain& chain);
    nlohmann::ordered_json parameters() const;
    std::string summary(const std::vector<std::string>& files);

    Session session;
    EnvironmentOptions input;
    FilterOptions filtering;
    IblFileOptions files;
    std::string folder;
    int irradiance_size = ibl::kIrradianceSize;
    int sh_bands = 3;
    std::string sh_window = "none";
    CLI::Option* sh_window_option = nullptr;
    std::string brdf = "ggx";
    int brdf_size = ibl::kBrdfTableSize;
    bool wants_report = false;
    std::string preview_file;
};

void IblCommand::add_options(CLI::App& command) {
    input.add_options(command);
    command.add_option("-o,--output", folder, "Folder for the files; made if it is missing")
        ->required()
        ->type_name("DIR");
    filtering.add_options(command);
    CLI::Option_group& group = *command.add_option_group("Diffuse light and BRDF");
    whole_number(group.add_option("--irradiance-size", irradiance_size, "Of the irradiance cube"),
                 1, kLargestIrradiance)
        ->type_name("TEXELS")
        ->capture_default_str();
    whole_number(group.add_option("--sh", sh_bands, "Bands of spherical harmonics"), 1,
                 ibl::kMostShBands)
        ->type_name("BANDS")
        ->capture_default_str();
    sh_window_option =
        one_of(group.add_option("--sh-window", sh_window,
                                "Weakens higher bands, just enough that irradiance is nowhere "
                                "negative"),
               {ibl::kShWindowNames.begin(), ibl::kShWindowNames.end()})
            ->capture_default_str();
    one_of(
        group.add_option("--brdf", brdf,
                         "Table to write: ggx: split sum; multiscatter: the same with the energy "
                         "of many bounces; cloth: Charlie"),
        {ibl::kBrdfTableKindNames.begin(), ibl::kBrdfTableKindNames.end()})
        ->capture_default_str();
    whole_number(group.add_option("--brdf-size", brdf_size, "Of the table"), 2, kLargestTable)
        ->type_name("TEXELS")
        ->capture_default_str();
    files.add_options(command);
    command.add_flag("--report", wants_report,
                     "Measure the error of every level against exact sums; also as report.json");
    command
        .add_option("--preview", preview_file,
                    "PNG, SVG or PDF: spheres from smooth to rough, exact, as filtered, and their "
                    "difference; beside it ...-dominant-direction")
        ->type_name("FILE");
    session.add_options(command);
}

void IblCommand::check() const {
    if (folder.empty()) throw InvalidArgument("--output", "", "must name a folder");
    input.check();
    filtering.check(input.size());
    files.check();
    if (!preview_file.empty()) {
        io::check_drawing_extension(preview_file);
        check_folder(preview_file);
    }
}

ibl::ShWindow IblCommand::window() const {
    for (std::size_t i = 0; i < ibl::kShWindowNames.size(); ++i) {
        if (ibl::kShWindowNames[i] == sh_window) return static_cast<ibl::ShWindow>(i);
    }
    return ibl::ShWindow::kNone;
}

nlohmann::ordered_json IblCommand::sh_json(const ibl::CubeMap& environment) const {
    ibl::SphericalHarmonics radiance = ibl::project_to_sh(environment, sh_bands);
    nlohmann::ordered_json json;
    json["bands"] = sh_bands;
    json["basis"] =
        "real, orthonormal, no Condon-Shortley phase, polar axis z; +Y is up; coefficient "
        "l^2 + l + m is Y_l,m";
    json["window"] = sh_window;
    if (window() != ibl::ShWindow::kNone) {
        const double cutoff = ibl::deringing_cutoff(ibl::irradiance_of_sh(radiance), window());
        json["window_cutoff"] = cutoff;
        radiance = ibl::windowed(radiance, window(), cutoff);
    }
    json["radiance"] = radiance.coefficients;
    json["irradiance"] = ibl::irradiance_of_sh(radiance).coefficients;
    json["irradiance_is_divided_by_pi"] = false;
    return json;
}

ibl::BrdfTable IblCommand::table() const {
    for (std::size_t i = 0; i < ibl::kBrdfTableKindNames.size(); ++i) {
        if (ibl::kBrdfTableKindNames[i] == brdf) {
            return ibl::BrdfTable(static_cast<ibl::BrdfTableKind>(i), brdf_size);
        }
    }
    return ibl::BrdfTable(ibl::BrdfTableKind::kGgx, brdf_size);
}

nlohmann::ordered_json IblCommand::levels_json(const ibl::CubeMap& environment,
                                               const ibl::CubeChain& chain) {
    const std::vector<double> roughness = filtering.roughness(environment.size());
    std::optional<ibl::ExactFilter> exact;
    if (wants_report) exact.emplace(environment);
    auto levels = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < chain.size(); ++i) {
        const double alpha = ibl::alpha_from_roughness(roughness[i]);
        nlohmann::ordered_json level = {
            {"level", i}, {"size", chain[i].size()}, {"roughness", roughness[i]}, {"alpha", alpha}};
        if (exact && alpha > 0) {
            const ibl::FilterError error = session.timed("report", [&] {
                return ibl::measure_filter_error(*exact, chain[i], alpha, {}, &session);
            });
            level["error"] = {{"rms", error.rms},
                              {"bias", error.bias},
                              {"most", error.most},
                              {"texels", error.texels}};
        }
        levels.push_back(std::move(level));
    }
    return levels;
}

nlohmann::ordered_json IblCommand::parameters() const {
    nlohmann::ordered_json json = input.parameters();
    json.update(filtering.parameters(input.size()));
    json.update(files.parameters());
    json["irradiance_size"] = irradiance_size;
    json["sh"] = sh_bands;
    json["sh_window"] = sh_window;
    json["brdf"] = brdf;
    json["brdf_size"] = brdf_size;
    json["threads"] = thread_count();
    return json;
}

std::string IblCommand::summary(const std::vector<std::string>& written) {
    std::string text;
    for (const std::string& file : written) text += file + "\n";
    if (!wants_report) return text;
    text += fmt::format("\n{:>5} {:>5} {:>9} {:>10} {:>10} {:>10}\n", "level", "size", "roughness",
                        "rms error", "bias", "largest");
    for (const auto& level : session.json()["levels"]) {
        text += fmt::format("{:>5} {:>5} {:>9.3f}", level["level"].get<int>(),
                            level["size"].get<int>(), level["roughness"].get<double>());
        if (level.contains("error")) {
            const auto& error = level["error"];
            text +=
                fmt::format(" {:>9.3f}% {:>9.3f}% {:>9.3f}%", 100 * error["rms"].get<double>(),
                            100 * error["bias"].get<double>(), 100 * error["most"].get<double>());
        }
        text += "\n";
    }
    return text + "Of luminance, relative to the level's mean.\n";
}

void IblCommand::run() {
    session.start();
    check();
    IblFiles set(folder, files, session);
    const ibl::CubeMap environment = input.read(session);
    const ibl::CubeChain chain =
        session.timed("filter", [&] { return filtering.filter(environment, session); });
    const ibl::CubeMap irradiance = session.timed(
        "irradiance", [&] { return ibl::irradiance_map(environment, irradiance_size); });
    const auto sh = session.timed("sh", [&] { return sh_json(environment); });
    const ibl::BrdfTable brdf_table = session.timed("brdf", [&] { return table(); });
    session.check_interrupt();

    auto& json = session.json();
    json["method"] = filtering.method();
    json["levels"] = levels_json(environment, chain);
    json["parameters"] = parameters();
    session.timed("write", [&] {
        set.write_environment(chain);
        set.write_irradiance(irradiance);
        set.write_table(brdf_table);
        set.write_json("sh.json", sh);
    });
    if (wants_report) set.write_json("report.json", json);
    session.check_interrupt();
    std::vector<std::string> written = set.commit();
    if (!preview_file.empty()) {
        const std::vector<double> roughness = filtering.roughness(input.size());
        const ibl::CubeChain exact = session.timed(
            "preview", [&] { return filtering.filter_exactly(environment, session); });
        write_previews(preview_file, {"exact", &exact, roughness},
                       {filtering.method(), &chain, roughness}, irradiance, session);
        written.push_back(preview_file);
        written.push_back(dominant_direction_file(preview_file));
    }
    json["outputs"] = written;
    session.finish(summary(written));
}

}  // namespace

Run add_ibl_command(CLI::App& app) {
    CLI::App& command = *app.add_subcommand(
        "ibl", "Filter an environment map for lighting: levels of roughness, irradiance, BRDF");
    const auto state = std::make_shared<IblCommand>();
    state->add_options(command);
    return [state] { state->run(); };
}

}  // namespace aureole::app
