// How ghosts are made and how they look.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "aureole/lens/flare.h"
#include "aureole/lens/lens.h"

namespace aureole::app {

class GhostOptions {
  public:
    // All but --preset, in groups of their own.
    void add_options(CLI::App& command);
    // physical or blog.
    void set_preset(const std::string& word) { preset_ = word; }

    // The first of these options that was given, or nothing.
    std::string first_given() const;
    // Whether there are to be ghosts: not with --ghosts none.
    bool any() const { return method_ != "none"; }
    // Throws InvalidArgument for options that contradict each other, FileError for a --dump-ghosts
    // that cannot be written.
    void check() const;
    // Throws InvalidArgument for a --dump-ghosts of several pictures: it tells what became of the
    // ghosts in one.
    void check_pictures(std::size_t pictures) const;
    // Reads --ghosts-from, whose ghosts must be among those of the lens, and --ghost-texture.
    // Throws FileError.
    lens::FlareOptions options(const lens::Lens& lens) const;

    // Empty: none.
    const std::string& dump_file() const { return dump_file_; }
    // Writes it: every ghost, and what became of it.
    void dump(const std::string& lens_name, const lens::Lens& lens,
              const lens::FlareOptions& options, const lens::FlareReport& report) const;
    // Every value in force.
    nlohmann::ordered_json report(const lens::FlareOptions& options) const;

  private:
    lens::GhostMethod method() const;
    lens::GhostSet set() const;
    void refuse_with_blog(const CLI::Option* option, const char* unless) const;

    void refuse_without_ghosts(const CLI::App& group) const;

    CLI::Option_group* group_ = nullptr;
    CLI::Option_group* look_group_ = nullptr;
    std::string preset_ = "physical";
    std::optional<std::string> method_;
    std::optional<std::string> pairs_;
    CLI::Option* method_option_ = nullptr;
    CLI::Option* pairs_option_ = nullptr;
    std::vector<CLI::Option*> ray_options_;  // of traced and hybrid
    CLI::Option* tolerance_option_ = nullptr;
    lens::FlareOptions options_;
    std::string tint_ = "1";
    std::string texture_file_;
    std::string settings_file_;
    std::string dump_file_;
};

// How many ghosts were drawn how, and what that left out.
nlohmann::ordered_json report_of(const lens::FlareReport& report);

}  // namespace aureole::app
