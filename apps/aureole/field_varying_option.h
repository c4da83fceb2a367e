// --field-varying and --needles-by-position: whether, and how finely, glare changes over the
// picture.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "aureole/wave/field_error.h"
#include "aureole/wave/varying_psf.h"

namespace aureole::app {

// Positions at which each run compares what is blended with what is right there.
inline constexpr int kHeldOutPositions = 16;

class FieldVaryingOption {
  public:
    void add_to(CLI::Option_group& group);
    // Throws InvalidArgument for a value that is not one of the option's.
    void check();

    // Whether anything changes: streaks (or a camera's stars), or needles.
    bool on() const { return on_ || needles_; }
    // The option that says so; empty if none does.
    std::string first_given() const;
    bool streaks() const { return on_; }
    bool needles() const { return needles_; }
    // Between nodes; 0: the observer's own.
    double spacing_deg() const { return spacing_deg_; }
    // Principal components that are kept; 0: the kernels of all nodes.
    int rank() const { return rank_; }
    // Adds them to the parameters in force.
    void report(nlohmann::ordered_json& parameters) const;
    // What the nodes are, what they hold, and how wrong they are.
    static nlohmann::ordered_json nodes(double spacing_deg, int rank, const wave::VaryingPsf& psf,
                                        const wave::FieldError& error);

  private:
    std::string text_ = "off";
    bool on_ = false;
    bool needles_ = false;
    double spacing_deg_ = 0;
    int rank_ = 0;
};

}  // namespace aureole::app
