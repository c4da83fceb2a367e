// Which lens, and how it is set: --lens, --f-number, --focus, --coating.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "aureole/lens/lens.h"
#include "aureole/lens/prescription.h"
#include "session.h"

namespace aureole::app {

class LensOptions {
  public:
    // --lens NAME[:POSITION]|FILE[:POSITION], --f-number, --focus, --coating. Without `fallback`,
    // the id of a lens that comes with Aureole, the lens must be named.
    void add_options(CLI::App& command, const std::string& fallback = "");
    // The same with the lens as an argument, LENS, in the place of --lens.
    void add_argument(CLI::App& command);
    // LENS alone.
    void add_lens_argument(CLI::App& command);

    // As on the command line; empty if it was not given and there is no fallback.
    const std::string& name() const { return name_; }

    // The table with all its positions; notes what its parser mended or ignored. Throws FileError
    // for a file that cannot be read or is malformed, InvalidArgument for a name that no lens has.
    lens::Prescription prescription(Session& session) const;
    // The position after the colon of LENS; empty: the first, or a prime.
    std::string position() const;
    // Ready for light; notes the warnings of the table and of the lens.
    lens::Lens lens(Session& session) const;
    // What is in force, for "parameters" of the JSON report: lens, position, f_number,
    // focus_distance_m (null: infinity), coating.
    nlohmann::ordered_json report(const lens::Lens& lens) const;

  private:
    void add_settings(CLI::App& command);

    std::string name_;
    lens::LensSettings settings_;
};

}  // namespace aureole::app
