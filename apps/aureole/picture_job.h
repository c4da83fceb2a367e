// The path of a picture through `aureole glare` and `aureole flare`: read, look at, spread, add
// ghosts, write.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
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
#include "spread_options.h"

namespace aureole::app {

// The options of both commands; those of `output` are added by the commands themselves.
struct PictureSettings {
    // --output-layers, --matte, --side-by-side, --supersampling to `group`, those of displays to
    // `command`.
    void add_options(CLI::App& group, CLI::App& command);
    // Checks what can be checked before the first picture is read.
    void prepare(const std::vector<FrameFiles>& files);

    OutputOptions output;
    DisplayOptions display;
    CLI::Option* layers_option = nullptr;
    std::string layers = "composite";
    std::string matte_file;
    std::string side_by_side_file;
    int supersampling = 1;  // samples per pixel of the result, in either direction
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
        std::optional<glare::Glare> streaks;  // before the rest, in a pass of their own
        std::optional<glare::Glare> rest;
        std::optional<glare::VaryingGlare> varying;  // in place of both

        bool spreads() const { return streaks || rest || varying; }
        // The pass that the options for methods and thresholds are about.
        const glare::Glare* chosen() const { return streaks ? &*streaks : rest ? &*rest : nullptr; }
    };
    struct Energy : glare::Energy {
        double ghosts = 0;
        double blocked = 0;  // by lids
    };

    void process(const FrameFiles& files);
    void prepare(const io::Picture& picture);
    // For a picture as it was read.
    void read_matte(const io::Picture& picture);
    // --supersampling, of the picture and of the matte. `file` is for messages.
    void average_samples(io::Picture& picture, const std::string& file);
    glare::Energy apply(const ConstImageView& in, const float* matte);
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
    Image with_streaks_;  // between the two passes
    Image layer_;         // what was added and taken away; empty unless it is written
    Image matte_;         // as it was read
    Image small_matte_;   // of the size of the result, with --supersampling
    Energy energy_;
    bool has_ghosts_ = false;
    double exposure_ev_ = 0;  // of the last picture, for the report
    std::size_t nonfinite_pixels_ = 0;
    int psfs_made_ = 0;
    std::map<std::string, int> frames_by_method_;
    std::vector<std::string> written_;
};

}  // namespace aureole::app
