// The path of one picture through `aureole glare`: read, see, spread, write.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "aureole/eye/anatomy.h"
#include "aureole/glare/glare.h"
#include "aureole/io/picture.h"
#include "display_options.h"
#include "eye_options.h"
#include "frame_files.h"
#include "output_options.h"
#include "session.h"
#include "view_options.h"

namespace aureole::app {

// The options of the command; those of `output` are added by the command itself.
struct GlareSettings {
    void add_options(CLI::App& command);
    // Checks what can be checked before the first picture is read.
    void prepare(const std::vector<FrameFiles>& files);

    OutputOptions output;
    ViewOptions view;
    EyeOptions eye;
    DisplayOptions display;
    std::string psf_file;
    std::string method = "auto";
    std::string layers = "composite";
    std::string matte_file;
    float threshold = 0;
    float gain = 1;
    std::string surround = "dark";
    std::string side_by_side_file;
};

// Which pictures the eye adapts to if the options do not say.
enum class Metering {
    kEachPicture,  // pictures that have nothing to do with each other
    kFirst,        // a sequence keeps the eye of its first picture
};

// Pictures one after another; PSF and transforms are kept as long as the view and the eye stay.
class GlareJob {
  public:
    GlareJob(const GlareSettings& settings, Session& session, Metering metering)
        : settings_(settings), session_(session), metering_(metering) {}

    void process(const FrameFiles& files);
    // Fills the session's JSON report and returns a summary for people.
    std::string report();

  private:
    // What the transforms were prepared for.
    struct Prepared {
        View display;  // of the display window
        View view;     // of the data window: all of it makes glare
        int channels;
        double metered_cd_m2;  // 0: not needed
        eye::Eye eye;
        glare::Glare glare;
    };

    void prepare(const io::Picture& picture);
    double adaptation_for(const io::Picture& picture);
    const float* matte_for(const io::Picture& picture);
    void write(const FrameFiles& files, const io::Picture& picture, const Image& result);

    const GlareSettings& settings_;
    Session& session_;
    Metering metering_;
    std::optional<Prepared> prepared_;
    std::optional<double> first_metered_cd_m2_;
    Image result_;
    Image matte_;
    glare::Energy energy_;
    double exposure_ev_ = 0;  // of the last picture, for the report
    double white_luminance_cd_m2_ = 0;
    std::size_t nonfinite_pixels_ = 0;
    std::vector<std::string> written_;
};

}  // namespace aureole::app
