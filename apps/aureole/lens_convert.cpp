// aureole lens convert: lens tables of other programs into our format.
#include <filesystem>
#include <memory>

#include "aureole/base/error.h"
#include "aureole/io/text_file.h"
#include "aureole/lens/formats.h"
#include "lens_choice.h"
#include "lens_commands.h"
#include "session.h"

namespace aureole::app {
namespace {

struct LensConvert {
    void run();

    Session session;
    LensOptions lens;
    std::string output;
};

void LensConvert::run() {
    session.start();
    if (std::filesystem::path(output).extension() != ".toml") {
        throw InvalidArgument("output file", output, "must end in .toml");
    }
    lens::Prescription table = lens.prescription(session);
    if (!lens.position().empty()) table = at_position(table, lens.position());
    io::write_text_file(output, lens::to_toml(table));
    auto& json = session.json();
    json["lens"] = lens.name();
    json["output"] = output;
    json["surfaces"] = table.surfaces.size();
    json["warnings"] = table.warnings;
    session.finish(output + "\n");
}

}  // namespace

Run add_lens_convert_command(CLI::App& lens) {
    CLI::App& command = *lens.add_subcommand(
        "convert", "Write a lens table as TOML; what the format cannot say is noted");
    const auto state = std::make_shared<LensConvert>();
    state->lens.add_lens_argument(command);
    command.add_option("-o,--output", state->output, "File to write")
        ->required()
        ->type_name("FILE.toml");
    state->session.add_options(command);
    return [state] { state->run(); };
}

}  // namespace aureole::app
