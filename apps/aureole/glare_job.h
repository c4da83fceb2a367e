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
#include "session.h"
#include "view_options.h"

namespace aureole::app {

struct FrameFiles {
    std::string input;
    std::vector<std::string> outputs;
};

// The options of the command.
struct GlareSettings {
    void add_options(CLI::App& command);
    // Checks what can be checked before the first picture is read.
    void prepare(const std::vector<std::string>& outputs);

    ViewOptions view;
    EyeOptions eye;
    DisplayOptions display;
    std::string psf_file;
    std::string method = "auto";
    std::string layers = "composite";
    std::string matte_file;
    float threshold = 0;
    float gain = 1;
    std::string side_by_side_file;
    std::string depth = "float";
};

// Pictures one after another; PSF and transforms are kept as long as the view and the eye stay.
class GlareJob {
  public:
    GlareJob(const GlareSettings& settings, Session& session)
        : settings_(settings), session_(session) {}

    void process(const FrameFiles& files);
    // Fills the session's JSON report and returns a summary for people.
    std::string report();

  private:
    // What the transforms were prepared for.
    struct Prepared {
        View view;
        int channels;
        eye::Eye eye;
        glare::Glare glare;
    };

    void prepare(const View& view, const io::Picture& picture);
    double metered_luminance(const io::Picture& picture) const;
    const float* matte_for(const io::Picture& picture);
    void write(const FrameFiles& files, const io::Picture& picture, const Image& result);

    const GlareSettings& settings_;
    Session& session_;
    std::optional<Prepared> prepared_;
    std::optional<double> adaptation_cd_m2_;  // of the first picture: a sequence keeps its eye
    Image result_;
    Image matte_;
    glare::Energy energy_;
    std::size_t nonfinite_pixels_ = 0;
    std::vector<std::string> written_;
};

}  // namespace aureole::app
