// How the film of a camera, or its sensor, blooms: --halation and what belongs to it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "aureole/lens/halation.h"

namespace aureole::app {

class FilmOptions {
  public:
    // In a group of their own.
    void add_options(CLI::App& command);
    // The first of these options that was given, or nothing.
    std::string first_given() const;
    const lens::HalationOptions& halation() const { return halation_; }

  private:
    CLI::Option_group* group_ = nullptr;
    lens::HalationOptions halation_;
};

}  // namespace aureole::app
