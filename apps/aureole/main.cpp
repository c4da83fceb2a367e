// aureole: glare, as an eye sees it, on HDR pictures.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <vector>

#include "aureole/base/error.h"
#include "commands.h"

namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

int run(int argc, char** argv) {
    CLI::App app(
        "Physically-based glare on linear HDR pictures.\n"
        "`aureole COMMAND --help` describes a command.",
        "aureole");
    app.set_version_flag("--version", "aureole " AUREOLE_VERSION);
    app.require_subcommand(1);

    using namespace aureole::app;
    std::vector<Run> commands = {add_glare_command(app), add_psf_command(app),
                                 add_scene_command(app)};
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : kWrongUsage;
    }
    for (std::size_t i = 0; i < commands.size(); ++i) {
        if (app.get_subcommands({})[i]->parsed()) commands[i]();
    }
    return 0;
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
