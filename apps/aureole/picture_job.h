// The path of a picture through `aureole glare` and `aureole flare`: read, look at, spread, add
// ghosts, write.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "aureole/glare/glare.h"
#include "aureole/glare/varying_glare.h"
#include "aureole/io/picture.h"
#include "display_options.h"
#include "frame_files.h"
#include "observer.h"
#include "output_options.h"
#include "session.h"

namespace aureole::app {

// The options of both commands; those of `output` are added by the commands themselves.
struct PictureSettings {
    // --output-layers, --matte, --side-by-side to `group`, those of displays to `command`.
    void add_options(CLI::App& group, CLI::App& command);
    // Checks what can be checked before the first picture is read.
    void prepare(const std::vector<FrameFiles>& files);

    OutputOptions output;
    DisplayOptions display;
    CLI::Option* layers_option = nullptr;
    std::string layers = "composite";
    std::string matte_file;
    std::string side_by_side_file;
};

// How a PSF is applied.
struct SpreadSettings {
    void add_options(CLI::App& group);
    // After parsing. Throws InvalidArgument for options that have no effect on this method.
    void check() const;
    // Exposure matters where a tone curve decides what light is.
    glare::GlareOptions options(bool matte, double exposure_ev) const;
    // ACES and a threshold decide what light is, glare is added; what was given stays.
    void set_thesis_look();
    // The first option in force that a kernel that varies over the picture does not know, or
    // nothing.
    std::string first_selective() const;

    std::string method = "fft";
    double cluster_error = 0.01;
    double threshold = 0;
    double gain = 1;
    std::string surround = "dark";
    // Of looks only.
    std::string source_tone_map = "none";
    double source_factor = 1;  // beside the gain
    bool added = false;

  private:
    CLI::Option* error_option_ = nullptr;
    CLI::Option* threshold_option_ = nullptr;
    CLI::Option* gain_option_ = nullptr;
};

// Pictures one after another; PSF and transforms are kept as long as the view and the eye stay.
class PictureJob {
  public:
    PictureJob(const PictureSettings& settings, const SpreadSettings& spread, Observer& observer,
               Session& session)
        : settings_(settings), spread_(spread), observer_(observer), session_(session) {}

    // With progress, as far as nobody interrupts.
    void process(const std::vector<FrameFiles>& list);
    // Fills the session's JSON report and returns a summary for people.
    std::string report();

  private:
    // What the transforms were prepared for.
    struct Prepared {
        View display;  // of the display window
        View view;     // of the data window: all of it makes glare
        int channels;
        double exposure_ev;
        std::optional<glare::Glare> glare;
        std::optional<glare::VaryingGlare> varying;

        bool spreads() const { return glare || varying; }
    };
    struct Energy : glare::Energy {
        double ghosts = 0;
        double blocked = 0;  // by lids
    };

    void process(const FrameFiles& files);
    void prepare(const io::Picture& picture);
    const float* matte_for(const io::Picture& picture);
    void spread(const ConstImageView& in, const float* matte);
    void add_ghosts(const Image& ghosts);
    void write(const FrameFiles& files, const io::Picture& picture);

    const PictureSettings& settings_;
    const SpreadSettings& spread_;
    Observer& observer_;
    Session& session_;
    std::optional<Prepared> prepared_;
    Image solid_angles_;  // of pixels, relative to that on the axis
    Image result_;
    Image layer_;  // what was added and taken away; empty unless it is written
    Image matte_;
    Energy energy_;
    bool has_ghosts_ = false;
    double exposure_ev_ = 0;  // of the last picture, for the report
    std::size_t nonfinite_pixels_ = 0;
    std::vector<std::string> written_;
};

}  // namespace aureole::app
