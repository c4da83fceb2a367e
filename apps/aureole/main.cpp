// aureole: glare, as an eye or a camera sees it, on HDR pictures.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "commands.h"

namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

std::string command_names(const CLI::App& app) {
    std::string names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        names += (names.empty() ? "" : ", ") + command->get_name();
    }
    return names;
}

// The commands that were chosen: `lens show` is a command of a command.
std::vector<const CLI::App*> chosen_commands(const CLI::App& app) {
    std::vector<const CLI::App*> chosen = {&app};
    while (!chosen.back()->get_subcommands().empty()) {
        chosen.push_back(chosen.back()->get_subcommands().front());
    }
    return chosen;
}

// What is wrong with a command line that cannot be parsed. Options that do not exist come first:
// what CLI11 misses may well be what a mistyped option should have been.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<std::string> unexpected = app.remaining(true);
    if (unexpected.empty()) {
        const std::string text = error.what();
        const std::string name = text.substr(0, text.find(':'));
        if (error.get_name() != "ArgumentMismatch") return text;
        return name + (text.ends_with("missing") ? " needs a value" : " is given more than once");
    }
    const std::string& first = unexpected.front();
    if (first.starts_with("-")) return "unknown option " + first;
    const std::string names = command_names(*chosen_commands(app).back());
    if (names.empty()) return "unexpected argument " + first;
    return "unknown command " + first + ": must be one of " + names;
}

int wrong_usage(const CLI::App& app, const std::string& message) {
    std::string words;
    for (const CLI::App* command : chosen_commands(app)) words += command->get_name() + " ";
    fmt::print(stderr, "aureole: {}\nAll options: {}--help\n", message, words);
    return kWrongUsage;
}

int run(int argc, char** argv) {
    CLI::App app(
        "Physically-based glare, lens flares and environment maps on linear HDR pictures.\n"
        "`aureole COMMAND --help` describes a command.",
        "aureole");
    app.set_version_flag("--version", "aureole " AUREOLE_VERSION);
    app.require_subcommand(0, 1);

    using namespace aureole::app;
    std::vector<Run> commands = {
        add_glare_command(app), add_flare_command(app), add_lens_command(app),
        add_ibl_command(app),   add_meter_command(app), add_psf_command(app),
        add_scene_command(app), add_bake_command(app),  add_gallery_command(app)};
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
        return wrong_usage(app, usage_error(app, error));
    }
    for (std::size_t i = 0; i < commands.size(); ++i) {
        if (app.get_subcommands({})[i]->parsed()) {
            commands[i]();
            return 0;
        }
    }
    return wrong_usage(app, "no command given: must be one of " + command_names(app));
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const aureole::InvalidArgument& error) {
        fmt::print(stderr, "aureole: {}\n", error.what());
        return kWrongUsage;
    } catch (const aureole::Cancelled&) {
        fmt::print(stderr, "aureole: interrupted; files already written are complete\n");
        return kFailed;
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "aureole: not enough memory for a picture of this size\n");
        return kFailed;
    } catch (const std::exception& error) {
        fmt::print(stderr, "aureole: {}\n", error.what());
        return kFailed;
    }
}
