// How light is spread: in how many passes, by which method, which light.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "aureole/glare/glare.h"

namespace aureole::app {

// Which of the two things that light meets one after the other spread it: lashes or iris, which
// make streaks; and behind them the eye or the film, which blooms.
enum class Passes {
    kOne,      // one PSF of everything
    kBoth,     // streaks, then the bloom of the picture with streaks
    kStreaks,  // the first alone
    kBloom,    // the second alone
};

// The options of `aureole glare`; as they are, for commands without them.
struct SpreadSettings {
    void add_options(CLI::App& group);
    // After parsing. Throws InvalidArgument for options that have no effect on this method.
    void check() const;
    Passes passes() const;
    // Of the only pass, or of streaks.
    // Exposure matters where a tone curve decides what light is.
    glare::GlareOptions options(bool matte, double exposure_ev) const;
    // Of the bloom behind streaks: of all light, and exact.
    glare::GlareOptions bloom_options(bool matte) const;
    // ACES and a threshold decide what light is, glare is added; what was given stays.
    void set_thesis_look();
    // Arms of a star hold little of its light and are seen all the same.
    void set_star_error();
    // The first option in force that a kernel that varies over the picture does not know, or
    // nothing.
    std::string first_selective() const;
    nlohmann::ordered_json report() const;

    std::string passes_name = "one";
    std::string method = "fft";
    std::string resolution = "full";
    double cluster_error = 0.01;
    int cluster_side = 16;
    double threshold = 0;
    double gain = 1;
    std::string surround = "dark";
    // Of looks only.
    std::string source_tone_map = "none";
    double source_factor = 1;  // beside the gain
    bool added = false;

  private:
    CLI::Option* threshold_option_ = nullptr;
    CLI::Option* gain_option_ = nullptr;
    std::vector<CLI::Option*> streak_options_;   // that bloom does not know
    std::vector<CLI::Option*> cluster_options_;  // of methods with clusters
};

}  // namespace aureole::app
