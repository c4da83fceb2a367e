// aureole gallery: the documented test cases, with an index page.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/io/file_set.h"
#include "aureole/io/picture.h"
#include "aureole/io/text_file.h"
#include "aureole/io/write_drawing.h"
#include "commands.h"
#include "gallery.h"
#include "gallery_index.h"
#include "gallery_render.h"
#include "gallery_sheet.h"
#include "gallery_video.h"
#include "option_checks.h"
#include "session.h"

namespace aureole::app {
namespace {

constexpr int kNarrowest = 64;
constexpr int kWidest = 1920;

struct GalleryCommand {
    void add_options(CLI::App& command);
    void run();

    std::vector<const Case*> chosen() const;
    void render(const Case& one, const Content& content);
    void render_frames(const Case& one, const Content& content, IndexCase& entry,
                       nlohmann::ordered_json& report);
    void advance();
    std::string file(const std::string& name);

    Session session;
    std::string folder;
    std::string only;
    PanelSize size;

    std::unique_ptr<io::FileSet> files;
    std::vector<std::string> names;  // of what was written
    std::vector<IndexCase> index;
    std::size_t pictures = 0;
    std::size_t pictures_done = 0;
};

std::string case_names() {
    std::string text;
    for (const Case& one : gallery_cases()) {
        text += (text.empty() ? "" : ", ") + std::string(one.name);
    }
    return text;
}

void GalleryCommand::add_options(CLI::App& command) {
    command
        .add_option("-o,--output", folder,
                    "Folder for index.html and its pictures; made if it is missing. In one that "
                    "exists, files of the same names are replaced and others left alone")
        ->required()
        ->type_name("DIR");
    command
        .add_option("--only", only,
                    "Some cases, separated by commas; the index shows only these: " + case_names())
        ->type_name("NAME[,NAME]");
    whole_number(command.add_option("--width", size.width,
                                    "Width of a panel and of a frame; their height is 9/16 of it"),
                 kNarrowest, kWidest)
        ->type_name("PIXELS")
        ->capture_default_str();
    session.add_options(command);
}

std::vector<const Case*> GalleryCommand::chosen() const {
    std::vector<std::string> wanted;
    for (std::size_t from = 0; !only.empty() && from <= only.size();) {
        const std::size_t comma = std::min(only.find(',', from), only.size());
        wanted.push_back(only.substr(from, comma - from));
        from = comma + 1;
    }
    const bool all = wanted.empty();
    std::vector<const Case*> cases;
    for (const Case& one : gallery_cases()) {
        const auto found = std::find(wanted.begin(), wanted.end(), one.name);
        if (!all && found == wanted.end()) continue;
        cases.push_back(&one);
        if (!all) wanted.erase(found);
    }
    // What is left is unknown, or there twice.
    if (!wanted.empty()) {
        throw InvalidArgument("--only", wanted.front(),
                              "must be one of " + case_names() + ", and each once");
    }
    return cases;
}

std::string GalleryCommand::file(const std::string& name) {
    names.push_back(name);
    return files->path(name);
}

void GalleryCommand::advance() {
    session.check_interrupt();
    ++pictures_done;
    session.report("gallery", static_cast<double>(pictures_done) / static_cast<double>(pictures));
}

nlohmann::ordered_json energy_json(const PanelEnergy& energy) {
    return {{"in", energy.in},
            {"out", energy.out},
            {"off_picture", energy.off_picture},
            {"from_surround", energy.from_surround},
            {"blocked", energy.blocked},
            {"spread", energy.spread}};
}

// The line beneath a panel's label.
std::string detail_of(const nlohmann::ordered_json& parameters) {
    const std::string field = fmt::format("{:.3g} deg wide", parameters["fov_deg"].get<double>());
    if (!parameters["glare"].get<bool>()) return field;
    std::string text =
        fmt::format("{}, pupil {:.1f} mm", field, parameters["pupil_mm"].get<double>());
    if (parameters["eyelid"] > 0) {
        text += fmt::format(", lids {:.0f} % closed", 100 * parameters["eyelid"].get<double>());
    }
    return text;
}

void GalleryCommand::render_frames(const Case& one, const Content& content, IndexCase& entry,
                                   nlohmann::ordered_json& report) {
    PanelRenderer renderer;
    const std::string name(one.name);
    for (std::size_t i = 0; i < content.frames.size(); ++i) {
        const Panel& frame = content.frames[i];
        const RenderedPanel rendered = renderer.render(frame);
        const std::string frame_name = fmt::format("{}.{:04}.png", name, i);
        io::write_picture(file(frame_name), io::Picture(rendered.display));
        entry.frame_rows.push_back(
            {frame.label, rendered.parameters, energy_json(rendered.energy)});
        report["frames"].push_back({{"label", frame.label},
                                    {"parameters", rendered.parameters},
                                    {"energy", entry.frame_rows.back().energy}});
        if (i == 0) entry.first_frame = frame_name;
        advance();
    }
    entry.frames_text = one.frames;
    const std::string video = name + ".mp4";
    const std::string staging = std::filesystem::path(files->path(video)).parent_path().string();
    switch (write_video(staging, name, content.frames_per_second, files->path(video))) {
        case Video::kWritten:
            names.push_back(video);
            entry.video = video;
            break;
        case Video::kNoFfmpeg:
            session.note("there is no ffmpeg: sequences are frames only, without MP4");
            break;
        case Video::kFailed:
            session.note("ffmpeg could not make " + video + "; its frames are there");
            break;
    }
    session.check_interrupt();
    report["video"] = !entry.video.empty();
    report["psfs"] = report["psfs"].get<int>() + renderer.psfs_computed();
}

void GalleryCommand::render(const Case& one, const Content& content) {
    PanelRenderer renderer;
    IndexCase entry;
    entry.name = one.name;
    entry.title = one.title;
    entry.text = one.text;
    entry.sheet = entry.name + ".png";
    nlohmann::ordered_json report = {{"name", entry.name}};
    std::vector<SheetPanel> sheet;
    for (const Panel& panel : content.panels) {
        RenderedPanel rendered = renderer.render(panel);
        entry.panels.push_back({panel.label, rendered.parameters, energy_json(rendered.energy)});
        report["panels"].push_back({{"label", panel.label},
                                    {"parameters", rendered.parameters},
                                    {"energy", entry.panels.back().energy}});
        sheet.push_back({panel.label, detail_of(rendered.parameters), std::move(rendered.display)});
        advance();
    }
    io::write_drawing(file(entry.sheet), contact_sheet(entry.title, sheet, one.columns),
                      contact_sheet_width_px(sheet, one.columns));
    report["psfs"] = renderer.psfs_computed();
    if (!content.frames.empty()) render_frames(one, content, entry, report);
    session.json()["cases"].push_back(std::move(report));
    index.push_back(std::move(entry));
}

void GalleryCommand::run() {
    session.start();
    if (folder.empty()) throw InvalidArgument("--output", "", "must name a folder");
    const std::vector<const Case*> cases = chosen();
    // Even, as films want it.
    size.height = std::max(2, (size.width * 9 / 16 + 1) / 2 * 2);
    files = std::make_unique<io::FileSet>(folder);

    std::vector<Content> contents;
    for (const Case* one : cases) {
        contents.push_back(one->make(size));
        pictures += contents.back().panels.size() + contents.back().frames.size();
    }
    for (std::size_t i = 0; i < cases.size(); ++i) {
        session.timed(std::string(cases[i]->name), [&] { render(*cases[i], contents[i]); });
    }
    io::write_text_file(file("index.html"), gallery_index(index));
    session.check_interrupt();
    files->commit();

    auto& json = session.json();
    for (const std::string& name : names) {
        json["outputs"].push_back((std::filesystem::path(folder) / name).string());
    }
    json["parameters"] = {
        {"width", size.width}, {"height", size.height}, {"threads", thread_count()}};
    session.finish((std::filesystem::path(folder) / "index.html").string() + "\n");
}

}  // namespace

Run add_gallery_command(CLI::App& app) {
    CLI::App& command = *app.add_subcommand(
        "gallery", "Render the documented test cases of glare, with an index page");
    const auto state = std::make_shared<GalleryCommand>();
    state->add_options(command);
    return [state] { state->run(); };
}

}  // namespace aureole::app
