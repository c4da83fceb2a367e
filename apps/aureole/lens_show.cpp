// aureole lens show: what a lens is and does, for people and as JSON.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>

#include "aureole/base/error.h"
#include "aureole/lens/ghosts.h"
#include "aureole/lens/glass.h"
#include "aureole/lens/paraxial.h"
#include "aureole/lens/vignetting.h"
#include "lens_choice.h"
#include "lens_commands.h"
#include "session.h"

namespace aureole::app {
namespace {

using Json = nlohmann::ordered_json;

struct LensShow {
    void add_options(CLI::App& command);
    void run();

    Session session;
    LensOptions lens;
    bool sweep = false;
    std::vector<double> angles_deg;
};

void LensShow::add_options(CLI::App& command) {
    lens.add_argument(command);
    CLI::Option* const flag = command.add_flag(
        "--sweep", sweep, "Over the field: image height, distortion, vignetting, illumination");
    add_angles(command, angles_deg, 0, "Of the sweep (default: 11 from 0 to half the field)")
        ->needs(flag);
    session.add_options(command);
}

// Zero means that nothing is stated.
Json stated(double value) { return value > 0 ? Json(value) : Json(nullptr); }

Json table_json(const lens::Lens& lens) {
    Json rows = Json::array();
    for (const lens::Surface& row : lens.prescription().surfaces) {
        Json one = {{"radius_mm", row.radius_mm},
                    {"thickness_mm", row.thickness_mm},
                    {"index", row.index},
                    {"abbe", stated(row.abbe)},
                    {"semi_aperture_mm", row.semi_aperture_mm}};
        if (!row.glass.empty()) one["glass"] = row.glass;
        if (row.stop) one["stop"] = true;
        if (row.profile != lens::Profile::kRotational) {
            one["profile"] = row.profile == lens::Profile::kCylinderX ? "cylinder-x" : "cylinder-y";
        }
        if (row.conic != 0) one["conic"] = row.conic;
        if (!row.asphere.empty()) one["asphere"] = row.asphere;
        if (!row.coating.empty()) one["coating"] = row.coating;
        rows.push_back(std::move(one));
    }
    return rows;
}

Json facts_of(const lens::Prescription& whole, const std::string& position,
              const lens::Lens& lens) {
    const lens::Prescription& table = lens.prescription();
    const lens::CardinalPoints points = cardinal_points(lens, lens::kLineDNm);
    const std::optional<double> printed = lens::printed_f_number(lens);
    std::vector<std::string> positions;
    for (const lens::Position& one : whole.positions) positions.push_back(one.name);
    return {{"name", table.name},
            {"patent", table.patent},
            {"source", table.source},
            {"missing", table.missing},
            {"positions", positions},
            {"position", position},
            {"efl_mm", points.efl_mm},
            {"efl_stated_mm", stated(table.focal_length_mm)},
            {"bfd_mm", points.bfd_mm},
            {"f_number", lens.f_number()},
            {"f_number_paraxial", points.f_number},
            {"f_number_stated", stated(table.f_number)},
            {"f_number_printed_stop", printed ? Json(*printed) : Json(nullptr)},
            {"f_number_printed_stop_paraxial", paraxial_printed_f_number(lens)},
            {"field_stated_deg", stated(table.field_deg)},
            {"stop_surface", lens.stop() + 1},
            {"stop_radius_mm", lens.stop_radius_mm()},
            {"stop_printed_radius_mm",
             table.surfaces[static_cast<std::size_t>(lens.stop())].semi_aperture_mm},
            {"entrance_pupil_z_mm", points.entrance_pupil_z_mm},
            {"entrance_pupil_diameter_mm", points.entrance_pupil_diameter_mm},
            {"exit_pupil_z_mm", points.exit_pupil_z_mm},
            {"exit_pupil_diameter_mm", points.exit_pupil_diameter_mm},
            {"front_principal_z_mm", points.front_principal_z_mm},
            {"rear_principal_z_mm", points.rear_principal_z_mm},
            {"sensor_z_mm", lens.sensor_z_mm()},
            {"surfaces", table.surfaces.size()},
            {"ghosts", enumerate_ghosts(lens, lens::GhostSet::kAll).size()},
            {"ghosts_same_side", enumerate_ghosts(lens, lens::GhostSet::kSameSide).size()},
            {"warnings", table.warnings},
            {"table", table_json(lens)}};
}

std::string number_text(const Json& value) {
    return value.is_number() ? fmt::format("{:.5g}", value.get<double>()) : "-";
}

std::string facts_text(const Json& facts, const std::string& title) {
    const auto line = [](const char* label, const std::string& value) {
        return value.empty() ? "" : fmt::format("  {:<18}{}\n", label, value);
    };
    const auto value = [&](const char* key) { return number_text(facts[key]); };
    const auto words = [&](const char* key) { return facts[key].get<std::string>(); };
    const auto if_stated = [&](const char* key, const std::string& unit) {
        return facts[key].is_null() ? std::string(" (none stated)")
                                    : " (stated " + value(key) + unit + ")";
    };
    std::string text = title + "\n";
    text += line("patent", words("patent"));
    text += line("source", words("source"));
    text += line("missing", words("missing"));
    text += line(
        "positions",
        fmt::format("{}", fmt::join(facts["positions"].get<std::vector<std::string>>(), ", ")));
    text += line("focal length", value("efl_mm") + " mm" + if_stated("efl_stated_mm", " mm"));
    text += line("back focus", value("bfd_mm") + " mm from the last vertex");
    text += line("f-number", "f/" + value("f_number") + if_stated("f_number_stated", "") +
                                 ", paraxially f/" + value("f_number_paraxial"));
    if (!facts["field_stated_deg"].is_null()) {
        text += line("field", value("field_stated_deg") + " deg (stated)");
    }
    text += line("stop", fmt::format("surface {}, radius {} mm", facts["stop_surface"].get<int>(),
                                     value("stop_radius_mm")));
    const std::string exact = facts["f_number_printed_stop"].is_null()
                                  ? std::string()
                                  : "f/" + value("f_number_printed_stop") + ", ";
    text += line("printed stop",
                 fmt::format("radius {} mm: {}paraxially f/{}", value("stop_printed_radius_mm"),
                             exact, value("f_number_printed_stop_paraxial")));
    text += line("entrance pupil", value("entrance_pupil_diameter_mm") +
                                       " mm wide, at z = " + value("entrance_pupil_z_mm") + " mm");
    text += line("exit pupil", value("exit_pupil_diameter_mm") +
                                   " mm wide, at z = " + value("exit_pupil_z_mm") + " mm");
    text += line("principal planes", "front z = " + value("front_principal_z_mm") +
                                         " mm, rear z = " + value("rear_principal_z_mm") + " mm");
    text += line("sensor", "z = " + value("sensor_z_mm") + " mm; z counts from the first vertex");
    text += line("ghosts",
                 fmt::format("{}, of which {} reflect on one side of the stop",
                             facts["ghosts"].get<int>(), facts["ghosts_same_side"].get<int>()));
    text += fmt::format("\n  {:>3}{:>13}{:>11}{:>10}{:>9}{:>10}\n", "#", "radius mm", "gap mm",
                        "index", "Abbe", "semi-ap.");
    int row_number = 0;
    for (const Json& row : facts["table"]) {
        const double radius = row["radius_mm"].get<double>();
        const double index = row["index"].get<double>();
        text += fmt::format(
            "  {:>3}{:>13}{:>11}{:>10}{:>9}{:>10}{}\n", ++row_number,
            radius == 0 ? "flat" : fmt::format("{:.6g}", radius),
            fmt::format("{:.5g}", row["thickness_mm"].get<double>()),
            index == 1 ? "" : fmt::format("{:.5g}", index),
            row["abbe"].is_null() ? "" : fmt::format("{:.4g}", row["abbe"].get<double>()),
            fmt::format("{:.4g}", row["semi_aperture_mm"].get<double>()),
            row.contains("stop")                               ? "  stop"
            : row.contains("conic") || row.contains("asphere") ? "  asphere"
            : row.contains("profile")                          ? "  cylinder"
                                                               : "");
    }
    return text;
}

Json sweep_json(const std::vector<lens::FieldPoint>& points) {
    Json rows = Json::array();
    for (const lens::FieldPoint& point : points) {
        rows.push_back({{"angle_deg", point.angle_deg},
                        {"image_height_mm", point.image_height_mm},
                        {"distortion", point.distortion},
                        {"open_area_mm2", point.open_area_mm2},
                        {"relative_area", point.relative_area},
                        {"transmission", point.transmission},
                        {"relative_illumination", point.relative_illumination}});
    }
    return rows;
}

std::string sweep_text(const std::vector<lens::FieldPoint>& points) {
    std::string text =
        fmt::format("\n  {:>9}{:>11}{:>14}{:>11}{:>16}{:>16}\n", "angle deg", "image mm",
                    "distortion %", "open mm2", "open of axis %", "illumination %");
    // Without the minus sign of what rounds to zero.
    const auto rounded = [](double value) { return std::round(100 * value) / 100 + 0.0; };
    for (const lens::FieldPoint& point : points) {
        text += fmt::format("  {:>9.4g}{:>11.2f}{:>14.2f}{:>11.1f}{:>16.1f}{:>16.1f}\n",
                            point.angle_deg, rounded(point.image_height_mm),
                            rounded(100 * point.distortion), point.open_area_mm2,
                            100 * point.relative_area, 100 * point.relative_illumination);
    }
    return text;
}

void LensShow::run() {
    session.start();
    const lens::Prescription whole = lens.prescription(session);
    const lens::Lens ready = lens.lens(session);
    const std::string position = position_in_force(whole, lens.position());
    auto& json = session.json();
    json["lens"] = lens.name();
    json.update(facts_of(whole, position, ready));
    for (const std::string& warning : ready.warnings()) json["warnings"].push_back(warning);
    std::string text = facts_text(json, title_of(whole, position));
    if (sweep) {
        std::vector<double> angles = angles_deg;
        if (angles.empty() && ready.prescription().field_deg == 0) {
            session.note("no field is stated: the sweep ends at the corner of 36 mm x 24 mm");
        }
        constexpr int kSteps = 10;
        for (int i = 0; i <= kSteps && angles_deg.empty(); ++i) {
            angles.push_back(half_field_deg(ready) * i / kSteps);
        }
        const auto points =
            session.timed("sweep", [&] { return field_sweep(ready, angles, lens::kLineDNm); });
        json["sweep"] = sweep_json(points);
        text += sweep_text(points);
    }
    json["parameters"] = lens.report(ready);
    json["parameters"]["position"] = position;
    session.finish(text);
}

}  // namespace

Run add_lens_show_command(CLI::App& lens) {
    CLI::App& command =
        *lens.add_subcommand("show", "What a lens is and does: focal length, pupils, ghosts...");
    const auto state = std::make_shared<LensShow>();
    state->add_options(command);
    return [state] { state->run(); };
}

}  // namespace aureole::app
