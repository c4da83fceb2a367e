// --field-varying: whether, and how finely, glare changes over the picture.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>

namespace aureole::app {

class FieldVaryingOption {
  public:
    void add_to(CLI::Option_group& group);
    // Throws InvalidArgument for a value that is not one of the option's.
    void check();

    bool on() const { return on_; }
    // Between nodes; 0: the observer's own.
    double spacing_deg() const { return spacing_deg_; }
    // Principal components that are kept; 0: the kernels of all nodes.
    int rank() const { return rank_; }
    nlohmann::ordered_json report() const { return text_; }

  private:
    std::string text_ = "off";
    bool on_ = false;
    double spacing_deg_ = 0;
    int rank_ = 0;
};

}  // namespace aureole::app
